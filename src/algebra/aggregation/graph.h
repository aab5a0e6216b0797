/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_AGGREGATION_GRAPH_H
#define ORTHOSTAT_ALGEBRA_AGGREGATION_GRAPH_H

#include "algebra/matrix/geometry.h"

/* The nodes of one level on this rank and the edges between them, each as long as the material's metric says: short
 * along the stiff directions. Edges to other ranks' nodes are left out, as aggregates do not cross ranks. */
typedef struct OstMetricGraph {
    OstContext *ctx;
    OstLocal nodes;
    OstLocal *edge_start; /* nodes + 1 */
    OstLocal *neighbour;  /* edge_start[nodes] */
    float *length;        /* edge_start[nodes] */
    double *position;     /* nodes × 3 */
    double *metric;       /* nodes × 6 (11 22 33 12 23 31) */
} OstMetricGraph;

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

/* Local. The graph whose nodes are the aggregates: at their centroids, with the mean metric of their nodes, neighbours
 * where any of their nodes are. */
OstStatus ost_metric_graph_coarsen(const OstMetricGraph *fine, const OstAggregates *aggregates,
                                   OstMetricGraph **coarse);
/* Collective. How much shorter the metric makes edges, squared: the most over all ranks, and about √(E_max / E_min)
 * where an edge lies along what is stiff. Where the axes turn within a node's tets their mean metric, and so this, is
 * less. */
OstStatus ost_metric_graph_shortening(const OstMetricGraph *graph, double *most);

void ost_metric_graph_destroy(OstMetricGraph **graph);

void ost_aggregates_destroy(OstAggregates **aggregates);

/* Local. The nodes of each aggregate, ascending: member[start[a]] up to start[a + 1]; both arrays are the caller's to
 * free. Nodes that are in none are left out. */
OstStatus ost_aggregates_list(const OstAggregates *aggregates, OstLocal nodes, OstLocal **start, OstLocal **member);

/* Local. Squared length of a vector in a metric. */
static inline double ost_metric_square(const double w[6], const double d[3])
{
    return w[0] * d[0] * d[0] + w[1] * d[1] * d[1] + w[2] * d[2] * d[2] +
           2.0 * (w[3] * d[0] * d[1] + w[4] * d[1] * d[2] + w[5] * d[2] * d[0]);
}

#endif
