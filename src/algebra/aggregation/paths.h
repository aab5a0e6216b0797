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
    OstLocal *source;     /* nodes: which source that is; -1 where none was reached */
    OstLocal queue_count; /* a binary heap, nearest first */
    OstLocal queue_room;
    OstPathEnd *queue;
} OstPaths;

/* Local, as is everything here. */
OstStatus ost_paths_create(const OstMetricGraph *graph, OstPaths **paths);
void ost_paths_destroy(OstPaths **paths);

/* Forgets every source. */
void ost_paths_clear(OstPaths *paths);

/* Settles the nodes within `radius` of `node`, at most `most` of them, nearest first, and marks them with `source`,
 * which must be a number not used since the paths were cleared. Other sources' marks are overwritten. `settled`, unless
 * NULL, gets a 1 for each settled node. */
typedef struct OstBall {
    OstLocal nodes;
    double reach; /* distance of the farthest */
} OstBall;
OstStatus ost_paths_ball(OstPaths *paths, OstLocal node, OstLocal source, double radius, OstLocal most,
                         unsigned char *settled, OstBall *ball);

/* Assigns every node that can be reached to the nearest of `count` sources. */
OstStatus ost_paths_assign(OstPaths *paths, OstLocal count, const OstLocal *sources);

#endif
