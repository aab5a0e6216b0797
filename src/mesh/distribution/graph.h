/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_DISTRIBUTION_GRAPH_H
#define ORTHOSTAT_MESH_DISTRIBUTION_GRAPH_H

#include "mesh/distribution/slab.h"

#include <metis.h>

/* Neighbours of each row: neighbour[start[r]] .. neighbour[start[r + 1] - 1], as METIS takes them. The weights are NULL
 * where all are 1. */
typedef struct Graph {
    OstLocal rows;
    idx_t *start;
    idx_t *neighbour;
    idx_t *edge_weight;
    idx_t *row_weight;
} Graph;

/* Local. Nodes that share a tet: rows are the slab's nodes, neighbours its local numbers. Start from {0}; clear it also
 * after a failure. Raises OST_LIMIT_EXCEEDED where METIS could not number it. */
OstStatus ost_graph_of_nodes(const Slab *slab, Graph *graph);
void ost_graph_clear(Graph *graph);

/* Local. Can METIS number so many rows and entries (two for each edge)? `what` names the graph in the message. */
OstStatus ost_graph_check_limits(OstContext *ctx, const char *what, OstGlobal rows, OstGlobal entries);

/* Local. METIS sums weights in idx_t: scales them down, none to 0, until their sum fits. */
void ost_graph_shrink_weights(OstGlobal count, idx_t *weight);

#endif
