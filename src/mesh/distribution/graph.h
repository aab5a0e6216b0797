/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_GRAPH_H
#define ORTHOSTAT_MESH_DISTRIBUTION_GRAPH_H

#include "mesh/distribution/slab.h"

#include <metis.h>

/* A graph as METIS takes it: the neighbours of row r are neighbour[start[r]] .. neighbour[start[r + 1] - 1]. Weights
 * that are all 1 are NULL. */
typedef struct Graph {
    OstLocal rows;
    idx_t *start;
    idx_t *neighbour;
    idx_t *edge_weight;
    idx_t *row_weight;
} Graph;

/* Local. The graph of nodes that share a tet: rows are the slab's nodes, neighbours local numbers. Start from {0};
 * clear it also after a failure. Raises OST_LIMIT_EXCEEDED if it is too large for METIS' numbers. */
OstStatus ost_graph_of_nodes(const Slab *slab, Graph *graph);
void ost_graph_clear(Graph *graph);

/* Local. Raises OST_LIMIT_EXCEEDED if METIS cannot number so many rows or entries (two for each edge). `what` names the
 * graph in the message. */
OstStatus ost_graph_check_limits(OstContext *ctx, const char *what, OstGlobal rows, OstGlobal entries);

/* Local. Scales weights down, none to 0, until their sum fits idx_t, in which METIS sums them. */
void ost_graph_shrink_weights(OstGlobal count, idx_t *weight);

#endif
