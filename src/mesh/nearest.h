/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_NEAREST_H
#define ORTHOSTAT_MESH_NEAREST_H

#include "mesh/mesh_data.h"

/* The vertex nearest to a place, on all ranks. */
typedef struct OstNearest {
    OstLocal node; /* on its owner; elsewhere -1 */
    int owner;
    double distance; /* from the place */
    double at[3];
} OstNearest;

/* Collective. Corners of tets alone are meant, so that the answer is the same for every element order; of vertices that
 * are equally near it is the one with the lowest label, on any number of ranks. */
OstStatus ost_mesh_nearest(const OstMesh *mesh, const double place[3], OstNearest *vertex);

/* Collective. The shortest and the longest edge at such a vertex. */
OstStatus ost_mesh_edges_at(const OstMesh *mesh, const OstNearest *vertex, double *shortest, double *longest);

#endif
