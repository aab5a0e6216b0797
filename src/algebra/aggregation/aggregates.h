/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_AGGREGATION_AGGREGATES_H
#define ORTHOSTAT_ALGEBRA_AGGREGATION_AGGREGATES_H

#include "algebra/aggregation/graph.h"

/* How a graph is to be grouped. */
typedef struct OstAggregateShape {
    double target;    /* nodes per aggregate, on average */
    OstLocal minimum; /* smaller ones are given to their neighbours; parts of the graph smaller than this are left out
                         (of_node -1) */
    int recentrings;  /* Lloyd passes */
} OstAggregateShape;

/* Local. Aggregates that are round in the graph's metric: a greedy cover by balls whose radius is tuned to the target,
 * then each node to its nearest seed, and seeds moved to the centre of what they got. */
OstStatus ost_aggregates_create(const OstMetricGraph *graph, const OstAggregateShape *shape,
                                OstAggregates **aggregates);

#endif
