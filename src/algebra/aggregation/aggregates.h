/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_AGGREGATION_AGGREGATES_H
#define ORTHOSTAT_ALGEBRA_AGGREGATION_AGGREGATES_H

#include "algebra/aggregation/graph.h"

/* How a graph is to be grouped. */
typedef struct OstAggregateShape {
    double target;    /* nodes per aggregate, on average */
    OstLocal minimum; /* smaller ones are merged into their neighbours; connected components of fewer nodes are left
                         out (of_node -1) */
    int recentrings;  /* Lloyd passes */
    double together;  /* so many nodes that are far closer to each other than to all others stay together; at least
                         `target` do */
} OstAggregateShape;

/* Local. Aggregates that are round in the graph's metric: a greedy cover by balls of a radius that gives the target
 * size; then each node joins its nearest seed, and each seed moves to the centre of its aggregate. */
OstStatus ost_aggregates_create(const OstMetricGraph *graph, const OstAggregateShape *shape,
                                OstAggregates **aggregates);

#endif
