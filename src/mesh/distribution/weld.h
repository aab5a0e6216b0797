/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_WELD_H
#define ORTHOSTAT_MESH_DISTRIBUTION_WELD_H

#include "mesh/distribution/slab.h"

/* Collective. Gives every stiff inclusion to one rank whole: it moves as a rigid body, and multigrid can see that only
 * where one rank has all of it. Tets hang together where they are about as stiff as the stiffest at their nodes; what
 * hangs together in something far softer, unless it is more than a quarter of a rank's share, goes to the part (`part`:
 * of the slab's nodes and ghosts) that has most of it. `stiffness` is that of the chunk's tets; up to a ratio of 10,000
 * nothing is done. */
OstStatus ost_parts_weld(const OstMeshChunk *chunk, const Slab *slab, const double *stiffness, int *part);

#endif
