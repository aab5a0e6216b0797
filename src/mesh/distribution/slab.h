/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_SLAB_H
#define ORTHOSTAT_MESH_DISTRIBUTION_SLAB_H

#include "core/parallel/halo.h"
#include "mesh/mesh_data.h"

/* A rank's piece of a chunk, before the partition: its nodes, all tets that touch one of them, its other tets and
 * boundary items, and as ghosts all other nodes of these. */
typedef struct Slab {
    OstContext *ctx;
    OstGlobal global_nodes;
    OstGlobal first_node;
    OstLocal node_count;
    OstLocal ghost_count;
    OstGlobal *ghost_number; /* ascending */
    int nodes_per_tet;
    OstLocal tet_count;  /* this rank's tets of the chunk, in their order, then ghost tets */
    OstLocal *tet_nodes; /* tet_count × nodes_per_tet, local: nodes first, then ghosts */
    OstHalo *halo;
} Slab;

/* Collective. */
OstStatus ost_slab_create(const OstMeshChunk *chunk, Slab **slab);
void ost_slab_destroy(Slab **slab);

/* Local. The slab's local number of one of its nodes or ghosts. */
OstLocal ost_slab_local(const Slab *slab, OstGlobal node);

#endif
