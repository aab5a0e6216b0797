/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_WELD_H
#define ORTHOSTAT_MESH_DISTRIBUTION_WELD_H

#include "mesh/distribution/slab.h"

/* What moves as one should be on one rank, as multigrid's aggregates and blocks end at its border. After METIS has cut
 * the mesh, such a set of nodes goes to the part that has most of it (`part`: of the slab's nodes and ghosts), unless
 * it is more than a quarter of a rank's share. */

/* Collective. Nodes that are far closer to each other than to the others of their tets, as through a flat layer. *any:
 * are there flat tets? Else nothing is done. OST_EFFECT_CLOSE_NODES. */
OstStatus ost_parts_weld_close(const OstMeshChunk *chunk, const Slab *slab, int *part, int *any);

/* Collective. Stiff inclusions in soft surroundings: tets hang together where they are about as stiff as the stiffest
 * at their nodes. `stiffness` is that of the chunk's tets. *any: do they differ by a ratio of more than 10,000? Else
 * nothing is done. OST_EFFECT_WHOLE_INCLUSIONS. */
OstStatus ost_parts_weld_stiff(const OstMeshChunk *chunk, const Slab *slab, const double *stiffness, int *part,
                               int *any);

#endif
