/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_REDISTRIBUTE_H
#define ORTHOSTAT_MESH_DISTRIBUTION_REDISTRIBUTE_H

#include "mesh/distribution/slab.h"

/* Collective. Moves the chunk's nodes and tets to the ranks of their parts (`part`: of the slab's nodes and ghosts) and
 * fills `mesh`. Within a part, nodes and tets keep their order. Frees the chunk's arrays as it goes. */
OstStatus ost_mesh_redistribute(OstMeshChunk *chunk, const Slab *slab, const int *part, OstMesh *mesh);

/* Collective. Moves one boundary's items to the ranks that own their nodes, and turns these into the mesh's local
 * numbers. `number`: new global numbers of the slab's nodes and ghosts. */
OstStatus ost_boundary_redistribute(OstBoundary *boundary, const Slab *slab, const int *part, const OstGlobal *number,
                                    const OstMesh *mesh);

#endif
