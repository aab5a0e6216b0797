/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/aggregation/paths.h"

#include "core/error.h"
#include "core/memory.h"

#include <float.h>

OstStatus ost_paths_create(const OstMetricGraph *graph, OstPaths **paths)
{
    OstStatus status = OST_NEW(graph->ctx, paths, 1);
    if (status != OST_SUCCESS)
        return status;
    (*paths)->graph = graph;
    OST_TRY_DONE(OST_NEW(graph->ctx, &(*paths)->distance, graph->nodes));
    OST_TRY_DONE(OST_NEW(graph->ctx, &(*paths)->source, graph->nodes));
    ost_paths_clear(*paths);
done:
    if (status != OST_SUCCESS)
        ost_paths_destroy(paths);
    return status;
}

void ost_paths_destroy(OstPaths **paths)
{
    if (!*paths)
        return;
    OST_FREE((*paths)->distance);
    OST_FREE((*paths)->source);
    OST_FREE((*paths)->queue);
    OST_FREE(*paths);
}

void ost_paths_clear(OstPaths *paths)
{
    paths->queue_count = 0;
    for (OstLocal i = 0; i < paths->graph->nodes; i++) {
        paths->source[i] = -1;
        paths->distance[i] = FLT_MAX;
    }
}

/* A heap with four children per entry: half as many steps as with two, on the same cache lines. */
enum { BELOW = 4 };

static OstStatus push(OstPaths *paths, float distance, OstLocal node)
{
    if (paths->queue_count == paths->queue_room) {
        const OstLocal room = 2 * paths->queue_room + 256;
        OST_TRY(OST_RESIZE(paths->graph->ctx, &paths->queue, room));
        paths->queue_room = room;
    }
    OstPathEnd *queue = paths->queue;
    OstLocal k = paths->queue_count++;
    for (; k > 0 && queue[(k - 1) / BELOW].distance > distance; k = (k - 1) / BELOW)
        queue[k] = queue[(k - 1) / BELOW];
    queue[k] = (OstPathEnd){distance, node};
    return OST_SUCCESS;
}

static OstPathEnd pop(OstPaths *paths)
{
    OstPathEnd *queue = paths->queue;
    const OstPathEnd nearest = queue[0];
    const OstLocal count = --paths->queue_count;
    const OstPathEnd last = queue[count];
    OstLocal k = 0;
    for (OstLocal child = 1; child < count; child = BELOW * k + 1) {
        const OstLocal end = child + BELOW < count ? child + BELOW : count;
        OstLocal least = child;
        for (OstLocal c = child + 1; c < end; c++)
            least = queue[c].distance < queue[least].distance ? c : least;
        if (queue[least].distance >= last.distance)
            break;
        queue[k] = queue[least];
        k = least;
    }
    queue[k] = last;
    return nearest;
}

OstStatus ost_paths_ball(OstPaths *paths, OstLocal node, OstLocal source, double radius, OstLocal most,
                         unsigned char *settled, OstBall *ball)
{
    const OstMetricGraph *graph = paths->graph;
    *ball = (OstBall){0, 0.0};
    paths->queue_count = 0;
    paths->source[node] = source;
    paths->distance[node] = 0.0f;
    OST_TRY(push(paths, 0.0f, node));
    while (paths->queue_count > 0 && ball->nodes < most) {
        const OstPathEnd end = pop(paths);
        if (end.distance > paths->distance[end.node])
            continue; /* a shorter path was found since */
        ball->nodes++;
        ball->reach = end.distance;
        if (settled)
            settled[end.node] = 1;
        for (OstLocal k = graph->edge_start[end.node]; k < graph->edge_start[end.node + 1]; k++) {
            const OstLocal j = graph->neighbour[k];
            const float distance = end.distance + graph->length[k];
            if (distance > radius || (paths->source[j] == source && distance >= paths->distance[j]))
                continue;
            paths->source[j] = source;
            paths->distance[j] = distance;
            OST_TRY(push(paths, distance, j));
        }
    }
    return OST_SUCCESS;
}

OstStatus ost_paths_assign(OstPaths *paths, OstLocal count, const OstLocal *sources)
{
    const OstMetricGraph *graph = paths->graph;
    ost_paths_clear(paths);
    for (OstLocal s = 0; s < count; s++) {
        paths->distance[sources[s]] = 0.0f;
        paths->source[sources[s]] = s;
        OST_TRY(push(paths, 0.0f, sources[s]));
    }
    while (paths->queue_count > 0) {
        const OstPathEnd end = pop(paths);
        if (end.distance > paths->distance[end.node])
            continue;
        for (OstLocal k = graph->edge_start[end.node]; k < graph->edge_start[end.node + 1]; k++) {
            const OstLocal j = graph->neighbour[k];
            const float distance = end.distance + graph->length[k];
            if (distance >= paths->distance[j])
                continue;
            paths->distance[j] = distance;
            paths->source[j] = paths->source[end.node];
            OST_TRY(push(paths, distance, j));
        }
    }
    return OST_SUCCESS;
}
