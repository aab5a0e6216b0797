/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_SLAB_H
#define ORTHOSTAT_MESH_DISTRIBUTION_SLAB_H

#include "core/parallel/halo.h"
#include "mesh/mesh_data.h"

/* A chunk seen from its nodes: this rank's nodes of the chunk, all tets that touch one of them (wherever the chunk
 * holds them), and as ghosts all other nodes that those tets and this rank's items of the chunk mention. */
typedef struct Slab {
    OstContext *ctx;
    OstGlobal global_nodes;
    OstGlobal first_node;
    OstLocal node_count;
    OstLocal ghost_count;
    OstGlobal *ghost_number; /* ascending */
    int nodes_per_tet;
    OstLocal tet_count;  /* the chunk's tets of this rank, in their order, and then those that came to visit */
    OstLocal *tet_nodes; /* tet_count × nodes_per_tet, local: nodes first, then ghosts */
    OstHalo *halo;
} Slab;

/* Collective. */
OstStatus ost_slab_create(const OstMeshChunk *chunk, Slab **slab);
void ost_slab_destroy(Slab **slab);

/* Local. The slab's number of a node that it holds. */
OstLocal ost_slab_local(const Slab *slab, OstGlobal node);

#endif
