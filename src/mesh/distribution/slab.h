/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_SLAB_H
#define ORTHOSTAT_MESH_DISTRIBUTION_SLAB_H

#include "core/parallel/halo.h"
#include "core/parallel/route.h"
#include "mesh/mesh_data.h"

/* A rank's piece of a chunk, before the partition: its nodes, its tets, and as ghosts all other nodes of these and of
 * its boundary items. */
typedef struct Slab {
    OstContext *ctx;
    OstGlobal global_nodes;
    OstGlobal first_node;
    OstLocal node_count;
    OstLocal ghost_count;
    OstGlobal *ghost_number; /* ascending */
    int nodes_per_tet;
    OstLocal tet_count;  /* this rank's tets of the chunk, in their order */
    OstLocal *tet_nodes; /* tet_count × nodes_per_tet, local: nodes first, then ghosts */
    OstHalo *halo;
} Slab;

/* Collective. Destroy the slab also after a failure. */
OstStatus ost_slab_create(const OstMeshChunk *chunk, Slab **slab);

/* Collective. The slab of the nodes after they moved along a route (of the slab's nodes, each to one rank; `to`: that
 * rank, of nodes and ghosts), numbered in the order in which they arrive. Its tets are all that touch one of them, on
 * several ranks. Destroy it also after a failure. */
OstStatus ost_slab_move(const Slab *slab, const OstRoute *route, const int *to, Slab **moved);
void ost_slab_destroy(Slab **slab);

/* Local. The slab's local number of one of its nodes or ghosts. */
OstLocal ost_slab_local(const Slab *slab, OstGlobal node);

#endif
