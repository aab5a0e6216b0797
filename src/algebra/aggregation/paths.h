/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_AGGREGATION_PATHS_H
#define ORTHOSTAT_ALGEBRA_AGGREGATION_PATHS_H

#include "algebra/aggregation/graph.h"

typedef struct OstPathEnd {
    float distance;
    OstLocal node;
} OstPathEnd;

/* Shortest paths in a metric graph by Dijkstra's method, from one node or from many. */
typedef struct OstPaths {
    const OstMetricGraph *graph;
    float *distance;      /* nodes: from the nearest source */
    OstLocal *source;     /* nodes: which source that is; -1 if none is connected */
    OstLocal queue_count; /* a heap with four children per entry, nearest first */
    OstLocal queue_room;
    OstPathEnd *queue;
} OstPaths;

/* Local, as is everything here. */
OstStatus ost_paths_create(const OstMetricGraph *graph, OstPaths **paths);
void ost_paths_destroy(OstPaths **paths);

/* Removes all sources. */
void ost_paths_clear(OstPaths *paths);

typedef struct OstBall {
    OstLocal nodes;
    double reach; /* distance of the farthest node */
} OstBall;

/* Settles the nodes within `radius` of `node`, at most `most` of them, nearest first, and sets their source to
 * `source`, a number not used since ost_paths_clear; marks of other sources are overwritten. `settled`, unless NULL,
 * gets a 1 for each settled node. */
OstStatus ost_paths_ball(OstPaths *paths, OstLocal node, OstLocal source, double radius, OstLocal most,
                         unsigned char *settled, OstBall *ball);

/* Assigns every connected node to the nearest of `count` sources. */
OstStatus ost_paths_assign(OstPaths *paths, OstLocal count, const OstLocal *sources);

#endif
