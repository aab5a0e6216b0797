/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_REFINEMENT_MID_NODES_H
#define ORTHOSTAT_MESH_REFINEMENT_MID_NODES_H

#include "mesh/mesh_data.h"
#include "orthostat/refine.h"

/* The edges between vertices of this rank's tets, ghosts included. An edge is listed at its low end, the vertex with
 * the lower global number; the owner of that vertex owns the edge, and has all tets around it. Owned edges come first.
 */
typedef struct EdgeTable {
    OstLocal count;
    OstLocal *start;  /* node_count + 1: the edges of low end n start at start[n] */
    OstLocal *low;    /* count: low end */
    OstLocal *high;   /* count: high end, ascending among the edges of a low end */
    OstLocal *of_tet; /* tet_count × 6, in the order of ost_tet_edge */
} EdgeTable;

/* Local. Start from {0}; clear it also after a failure. */
OstStatus ost_edge_table_build(const OstMesh *mesh, EdgeTable *table);
void ost_edge_table_clear(EdgeTable *table);

/* Local. The edge between two local nodes, or -1. */
OstLocal ost_edge_find(const EdgeTable *table, const OstMesh *mesh, OstLocal a, OstLocal b);

/* The new nodes, when linear tets are made quadratic or refined: this rank's vertices, then the mid-edge nodes (index
 * node_count + edge). A vertex and the mid-edge nodes of the edges of which it is the low end have consecutive global
 * numbers. */
typedef struct MidNodes {
    const OstMesh *mesh;
    EdgeTable edges;
    OstLocal count;       /* vertices and edges */
    OstLocal owned_nodes; /* of them */
    OstGlobal first_node, global_nodes;
    OstGlobal highest_label; /* of a vertex */
    OstGlobal *number;       /* count: new global numbers, contiguous over ranks */
    OstGlobal *label;        /* count: valid for owned nodes only */
    double *coordinates;
} MidNodes;

/* Collective. Start from {0}; clear it also after a failure. Raises OST_LIMIT_EXCEEDED if the new nodes' labels
 * overflow. */
OstStatus ost_mid_nodes_create(const OstMesh *mesh, const OstShapeSurface *shape, MidNodes *mid);
void ost_mid_nodes_clear(MidNodes *mid);

/* Local. The label of edge e (0-5) of a tet, provided that no other tet with that edge has a lower label. */
OstGlobal ost_mid_nodes_label(const MidNodes *mid, OstLocal tet, int e);

/* Local. Is the new node owned here? */
int ost_mid_nodes_owns(const MidNodes *mid, OstLocal node);

#endif
