/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_AGGREGATION_GRAPH_H
#define ORTHOSTAT_ALGEBRA_AGGREGATION_GRAPH_H

#include "algebra/matrix/geometry.h"

/* The nodes of one level on this rank and the edges between them, with lengths in the material metric: short along
 * stiff directions. There are no edges to other ranks' nodes, as aggregates do not cross ranks. */
typedef struct OstMetricGraph {
    OstContext *ctx;
    OstLocal nodes;
    OstLocal *edge_start; /* nodes + 1 */
    OstLocal *neighbour;  /* edge_start[nodes] */
    float *length;        /* edge_start[nodes] */
    double *position;     /* nodes × 3 */
    double *metric;       /* nodes × 6 (11 22 33 12 23 31) */
    double jump;          /* largest ratio of two neighbours' stiffness, over all ranks; 1 where none is uneven */
} OstMetricGraph;

/* Neighbours are apart where one is more than a hundred times as stiff as the other: the length of their edge is
 * INFINITY, and no aggregate crosses it. */
static inline int ost_metric_graph_is_uneven(const OstMetricGraph *graph)
{
    return graph->jump > 1.0;
}

/* A grouping of a graph's nodes. */
typedef struct OstAggregates {
    OstContext *ctx;
    OstLocal count;
    OstLocal *of_node; /* nodes: the aggregate, or -1 for a node left to the smoother */
} OstAggregates;

/* Collective. The graph of a matrix; geometry->metric NULL gives the Euclidean metric. Raises OST_INVALID_INPUT with
 * the node if a position or metric is not finite, or a metric not positive definite. */
OstStatus ost_metric_graph_create(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                                  OstMetricGraph **graph);

/* Local. The graph whose nodes are the aggregates: at their centroids, with the mean metric of their nodes. Two are
 * neighbours if any of their nodes are. */
OstStatus ost_metric_graph_coarsen(const OstMetricGraph *fine, const OstAggregates *aggregates,
                                   OstMetricGraph **coarse);

/* Collective. The largest ratio, over all edges, of squared Euclidean length to squared length in the metric. About
 * √(E_max / E_min) if an edge lies along the stiff direction; smaller if the material axes differ between the tets of a
 * node, whose metrics are averaged. */
OstStatus ost_metric_graph_shortening(const OstMetricGraph *graph, double *most);

/* Local. The graph of a matrix's pattern between its own rows; `place` has three coordinates and six numbers of the
 * metric for each. */
OstStatus ost_metric_graph_of_pattern(OstContext *ctx, OstLocal rows, const OstLocal *row_start, const OstLocal *column,
                                      const double *place, OstMetricGraph **graph);

void ost_metric_graph_destroy(OstMetricGraph **graph);

void ost_aggregates_destroy(OstAggregates **aggregates);

/* Local. The nodes of each aggregate, ascending: member[start[a]] to member[start[a + 1] - 1]. The caller frees both
 * arrays. Nodes without an aggregate are not listed. */
OstStatus ost_aggregates_list(const OstAggregates *aggregates, OstLocal nodes, OstLocal **start, OstLocal **member);

/* Local. Squared length of a vector in a metric. */
static inline double ost_metric_square(const double w[6], const double d[3])
{
    return w[0] * d[0] * d[0] + w[1] * d[1] * d[1] + w[2] * d[2] * d[2] +
           2.0 * (w[3] * d[0] * d[1] + w[4] * d[1] * d[2] + w[5] * d[2] * d[0]);
}

#endif
