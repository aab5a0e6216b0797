/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_REFINEMENT_MID_NODES_H
#define ORTHOSTAT_MESH_REFINEMENT_MID_NODES_H

#include "mesh/refinement/edge_table.h"
#include "orthostat/refine.h"

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
 * overflow, OST_INVALID_INPUT if a tet's label is not positive. */
OstStatus ost_mid_nodes_create(const OstMesh *mesh, const OstShapeSurface *shape, MidNodes *mid);
void ost_mid_nodes_clear(MidNodes *mid);

/* Local. The label of edge e (0-5) of a tet, provided that no other tet with that edge has a lower label. */
OstGlobal ost_mid_nodes_label(const MidNodes *mid, OstLocal tet, int e);

/* Local. Is the new node owned here? */
int ost_mid_nodes_owns(const MidNodes *mid, OstLocal node);

#endif
