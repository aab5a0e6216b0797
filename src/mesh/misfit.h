/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_MISFIT_H
#define ORTHOSTAT_MESH_MISFIT_H

#include "mesh/mesh_data.h"

/* Faces of the surface that lie on faces of other tets, back to back. */
typedef struct OstMisfits {
    OstGlobal cracked;        /* on a face whose vertices are others, at the same places */
    OstGlobal faces;          /* on faces with vertices elsewhere: neighbours that do not fit */
    double low[3], high[3];   /* the box around these faces */
    OstGlobal tet, neighbour; /* the lowest label of a tet with such a face, and of a tet on its other side */
} OstMisfits;

/* Collective. Faces all of whose vertices are `joined` in another way (owned_nodes; NULL: none) do not count. */
OstStatus ost_mesh_find_misfits(const OstMesh *mesh, const unsigned char *joined, OstMisfits *misfits);

#endif
