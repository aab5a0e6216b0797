/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/aggregation/aggregates.h"

#include "core/error.h"
#include "core/memory.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum {
    RADIUS_TRIES = 6,
    RADIUS_SAMPLES = 40,
    UNREACHED = -1,
    LEFT_OUT = -2,
    BELOW = 4 /* children of a heap's entry: half as many steps as with two, on the same cache lines */
};

static const float close = 0.1f; /* an edge is short below this part of the mean of each of its nodes' edges */
static const double whole = 2.0; /* a part of the graph of so many targets stays one aggregate */

typedef struct PathEnd {
    float distance;
    OstLocal node;
} PathEnd;

typedef struct Ball {
    OstLocal nodes;
    double reach; /* distance of the farthest node */
} Ball;

typedef struct Grouping {
    const OstMetricGraph *graph;
    const OstAggregateShape *shape;
    const float *length; /* of the graph's edges; 0 between nodes that stay together */
    float *own_length;   /* NULL if that is the graph's */
    /* shortest paths from the sources, by Dijkstra's method: */
    float *distance;  /* nodes: from the nearest source */
    OstLocal *source; /* nodes: which source that is; UNREACHED if none is connected */
    PathEnd *queue;   /* a heap, nearest first */
    OstLocal queue_count, queue_room;
    /* the aggregates: */
    unsigned char *covered; /* nodes */
    OstLocal count;         /* number of seeds */
    OstLocal whole_seeds;   /* of them, those of small components, which stay whole */
    OstLocal whole_nodes;   /* and the nodes of these components */
    OstLocal *seed;         /* nodes */
    OstLocal *size;         /* nodes: of each seed's aggregate */
    double *centre;         /* nodes × 3: of each seed's aggregate */
    double *offset;         /* nodes: squared distance, in the metric, of the best new seed from the centre */
} Grouping;

static void destroy_grouping(Grouping *g)
{
    OST_FREE(g->own_length, g->distance, g->source, g->queue, g->covered, g->seed, g->size, g->centre);
    OST_FREE(g->offset);
}

static OstStatus create_grouping(const OstMetricGraph *graph, const OstAggregateShape *shape, Grouping *g)
{
    const size_t n = (size_t)graph->nodes;
    *g = (Grouping){.graph = graph, .shape = shape, .length = graph->length};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(graph->ctx, &g->distance, n));
    OST_TRY_DONE(OST_NEW(graph->ctx, &g->source, n));
    OST_TRY_DONE(OST_NEW(graph->ctx, &g->covered, n));
    OST_TRY_DONE(OST_NEW(graph->ctx, &g->seed, n));
    OST_TRY_DONE(OST_NEW(graph->ctx, &g->size, n));
    OST_TRY_DONE(OST_NEW(graph->ctx, &g->centre, 3 * n));
    OST_TRY_DONE(OST_NEW(graph->ctx, &g->offset, n));
done:
    if (status != OST_SUCCESS)
        destroy_grouping(g);
    return status;
}

static void clear_paths(Grouping *g)
{
    g->queue_count = 0;
    for (OstLocal i = 0; i < g->graph->nodes; i++) {
        g->source[i] = -1;
        g->distance[i] = FLT_MAX;
    }
}

static OstStatus push(Grouping *g, float distance, OstLocal node)
{
    if (g->queue_count == g->queue_room) {
        const OstLocal room = 2 * g->queue_room + 256;
        OST_TRY(OST_RESIZE(g->graph->ctx, &g->queue, room));
        g->queue_room = room;
    }
    PathEnd *queue = g->queue;
    OstLocal k = g->queue_count++;
    for (; k > 0 && queue[(k - 1) / BELOW].distance > distance; k = (k - 1) / BELOW)
        queue[k] = queue[(k - 1) / BELOW];
    queue[k] = (PathEnd){distance, node};
    return OST_SUCCESS;
}

static PathEnd pop(Grouping *g)
{
    PathEnd *queue = g->queue;
    const PathEnd nearest = queue[0];
    const OstLocal count = --g->queue_count;
    const PathEnd last = queue[count];
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

/* Settles the nodes within `radius` of `node`, at most `most` of them, nearest first, and sets their source to
 * `source`, a number not used since clear_paths; marks of other sources are overwritten. `settled`, unless NULL, gets a
 * 1 for each settled node. */
static OstStatus settle_ball(Grouping *g, OstLocal node, OstLocal source, double radius, OstLocal most,
                             unsigned char *settled, Ball *ball)
{
    const OstMetricGraph *graph = g->graph;
    *ball = (Ball){0, 0.0};
    g->queue_count = 0;
    g->source[node] = source;
    g->distance[node] = 0.0f;
    OST_TRY(push(g, 0.0f, node));
    while (g->queue_count > 0 && ball->nodes < most) {
        const PathEnd end = pop(g);
        if (end.distance > g->distance[end.node])
            continue; /* a shorter path was found since */
        ball->nodes++;
        ball->reach = end.distance;
        if (settled)
            settled[end.node] = 1;
        for (OstLocal k = graph->edge_start[end.node]; k < graph->edge_start[end.node + 1]; k++) {
            const OstLocal j = graph->neighbour[k];
            const float distance = end.distance + g->length[k];
            if (distance > radius || (g->source[j] == source && distance >= g->distance[j]))
                continue;
            g->source[j] = source;
            g->distance[j] = distance;
            OST_TRY(push(g, distance, j));
        }
    }
    return OST_SUCCESS;
}

/* Assigns every connected node to the nearest seed. */
static OstStatus assign(Grouping *g)
{
    const OstMetricGraph *graph = g->graph;
    clear_paths(g);
    for (OstLocal s = 0; s < g->count; s++) {
        g->distance[g->seed[s]] = 0.0f;
        g->source[g->seed[s]] = s;
        OST_TRY(push(g, 0.0f, g->seed[s]));
    }
    while (g->queue_count > 0) {
        const PathEnd end = pop(g);
        if (end.distance > g->distance[end.node])
            continue;
        for (OstLocal k = graph->edge_start[end.node]; k < graph->edge_start[end.node + 1]; k++) {
            const OstLocal j = graph->neighbour[k];
            const float distance = end.distance + g->length[k];
            const int together = g->length[k] == 0.0f && g->source[j] != g->source[end.node];
            if (together ? distance > g->distance[j] : distance >= g->distance[j])
                continue;
            g->distance[j] = distance;
            g->source[j] = g->source[end.node];
            OST_TRY(push(g, distance, j));
        }
    }
    return OST_SUCCESS;
}

/* --- nodes that stay together --- */

static OstLocal root_of(OstLocal *set, OstLocal i)
{
    for (; set[i] != i; i = set[i])
        set[i] = set[set[i]];
    return i;
}

/* The length below which an edge of the node is short. */
static float short_length(const OstMetricGraph *graph, OstLocal node)
{
    float sum = 0.0f;
    OstLocal finite = 0;
    for (OstLocal k = graph->edge_start[node]; k < graph->edge_start[node + 1]; k++)
        if (!isinf(graph->length[k])) {
            sum += graph->length[k];
            finite++;
        }
    return finite > 0 ? close * sum / (float)finite : 0.0f;
}

/* Joins the ends of short edges; returns how many there are. `limit` is scratch. */
static OstLocal join_close(const OstMetricGraph *graph, OstLocal *set, float *limit)
{
    OstLocal joined = 0;
    for (OstLocal i = 0; i < graph->nodes; i++)
        limit[i] = short_length(graph, i);
    for (OstLocal i = 0; i < graph->nodes; i++)
        for (OstLocal k = graph->edge_start[i]; k < graph->edge_start[i + 1]; k++) {
            const OstLocal j = graph->neighbour[k];
            if (j < i || graph->length[k] > fminf(limit[i], limit[j]))
                continue;
            if (joined++ == 0)
                for (OstLocal n = 0; n < graph->nodes; n++)
                    set[n] = n;
            set[root_of(set, j)] = root_of(set, i);
        }
    return joined;
}

/* Nodes far closer to each other than to all others, as through the thickness of a flat layer, move as one: an
 * aggregate or block that has only some of them is of little use. Where another seed is as near, the two could part. */
static OstStatus keep_together(Grouping *g)
{
    const OstMetricGraph *graph = g->graph;
    const OstLocal n = graph->nodes, most = (OstLocal)fmax(g->shape->target, g->shape->together);
    OstLocal *set = g->seed, *size = g->size; /* not in use yet */
    if (join_close(graph, set, g->distance) == 0)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(graph->ctx, &g->own_length, graph->edge_start[n]));
    memset(size, 0, (size_t)n * sizeof *size);
    for (OstLocal i = 0; i < n; i++)
        size[root_of(set, i)]++;
    for (OstLocal i = 0; i < n; i++)
        for (OstLocal k = graph->edge_start[i]; k < graph->edge_start[i + 1]; k++) {
            const OstLocal root = root_of(set, i);
            const int together = root == root_of(set, graph->neighbour[k]) && size[root] <= most;
            g->own_length[k] = together ? 0.0f : graph->length[k];
        }
    g->length = g->own_length;
    return OST_SUCCESS;
}

/* --- seeds --- */

/* First guess: the mean radius of a ball with 1.6 × target nodes, over a sample of the nodes. */
static OstStatus guess_radius(Grouping *g, double *radius)
{
    const OstLocal most = (OstLocal)ceil(1.6 * g->shape->target);
    OstLocal samples = 0;
    double sum = 0.0;
    clear_paths(g);
    for (OstLocal i = 0; i < g->graph->nodes; i += g->graph->nodes / RADIUS_SAMPLES + 1) {
        Ball ball;
        OST_TRY(settle_ball(g, i, samples++, FLT_MAX, most, NULL, &ball));
        sum += ball.reach;
    }
    *radius = sum / samples;
    return OST_SUCCESS;
}

/* Covers a node's whole component from that node, if it is small enough for one aggregate. Where nothing is apart, it
 * never is: only nodes with an edge of infinite length are asked. */
static OstStatus cover_component(Grouping *g, OstLocal node)
{
    const OstMetricGraph *graph = g->graph;
    const OstLocal most = (OstLocal)(whole * g->shape->target) + 1;
    int is_apart = 0;
    Ball ball;
    for (OstLocal k = graph->edge_start[node]; k < graph->edge_start[node + 1]; k++)
        is_apart |= isinf(graph->length[k]) != 0;
    if (!is_apart)
        return OST_SUCCESS;
    OST_TRY(settle_ball(g, node, graph->nodes + 2 * g->count, FLT_MAX, most, NULL, &ball));
    if (ball.nodes >= most)
        return OST_SUCCESS;
    g->whole_seeds++;
    g->whole_nodes += ball.nodes;
    return settle_ball(g, node, graph->nodes + 2 * g->count + 1, FLT_MAX, most, g->covered, &ball);
}

/* Each node becomes a seed unless the ball of an earlier seed covers it. */
static OstStatus cover(Grouping *g, double radius)
{
    const OstLocal n = g->graph->nodes;
    g->count = g->whole_seeds = g->whole_nodes = 0;
    memset(g->covered, 0, (size_t)n);
    clear_paths(g);
    for (OstLocal i = 0; i < n; i++) {
        Ball ball;
        if (g->covered[i])
            continue;
        g->seed[g->count] = i;
        if (ost_metric_graph_is_uneven(g->graph))
            OST_TRY(cover_component(g, i));
        OST_TRY(settle_ball(g, i, g->count, radius, n, g->covered, &ball));
        g->count++;
    }
    return OST_SUCCESS;
}

/* Finds the radius by trial, as balls overlap: nodes per seed grow about as radius^2.2. On a regular mesh they grow in
 * jumps, so the target may be missed; then the best trial is taken. */
static OstStatus choose_seeds(Grouping *g)
{
    double radius, best = 0.0, best_miss = DBL_MAX;
    double low = 0.0, high = FLT_MAX;
    OST_TRY(guess_radius(g, &radius));
    for (int try = 0; try < RADIUS_TRIES; try++) {
        OST_TRY(cover(g, radius));
        const OstLocal nodes = g->graph->nodes - g->whole_nodes, seeds = g->count - g->whole_seeds;
        const double excess = seeds > 0 ? (double)nodes / (double)seeds / g->shape->target : 1.0;
        if (excess > 0.88 && excess < 1.13)
            return OST_SUCCESS;
        if (fabs(log(excess)) < best_miss) {
            best_miss = fabs(log(excess));
            best = radius;
        }
        if (excess > 1.0)
            high = radius;
        else
            low = radius;
        radius *= pow(1.0 / excess, 0.45);
        if (radius <= low || radius >= high)
            radius = high < FLT_MAX ? 0.5 * (low + high) : 2.0 * low;
    }
    return cover(g, best);
}

/* The node nearest to the centroid of each aggregate becomes its seed. */
static void recentre(Grouping *g)
{
    const OstMetricGraph *graph = g->graph;
    const OstLocal *of_node = g->source;
    memset(g->centre, 0, 3 * (size_t)g->count * sizeof *g->centre);
    memset(g->size, 0, (size_t)g->count * sizeof *g->size);
    for (OstLocal i = 0; i < graph->nodes; i++) {
        if (of_node[i] < 0)
            continue;
        g->size[of_node[i]]++;
        for (int c = 0; c < 3; c++)
            g->centre[3 * (size_t)of_node[i] + (size_t)c] += graph->position[3 * (size_t)i + (size_t)c];
    }
    for (OstLocal s = 0; s < g->count; s++) {
        g->offset[s] = DBL_MAX;
        for (int c = 0; c < 3; c++)
            g->centre[3 * (size_t)s + (size_t)c] /= g->size[s];
    }
    for (OstLocal i = 0; i < graph->nodes; i++) {
        const OstLocal s = of_node[i];
        if (s < 0)
            continue;
        double d[3];
        for (int c = 0; c < 3; c++)
            d[c] = graph->position[3 * (size_t)i + (size_t)c] - g->centre[3 * (size_t)s + (size_t)c];
        const double square = ost_metric_square(graph->metric + 6 * (size_t)i, d);
        if (square < g->offset[s]) {
            g->offset[s] = square;
            g->seed[s] = i;
        }
    }
}

/* Drops the seeds of aggregates below the minimum size; returns whether there were any. */
static int drop_small(Grouping *g)
{
    OstLocal kept = 0;
    for (OstLocal s = 0; s < g->count; s++)
        if (g->size[s] >= g->shape->minimum)
            g->seed[kept++] = g->seed[s];
    const int dropped = kept < g->count;
    g->count = kept;
    return dropped;
}

/* Dropping may leave a connected component without seeds: it becomes one aggregate, or is left out if it is too small.
 */
static OstStatus adopt_orphans(Grouping *g)
{
    const OstLocal n = g->graph->nodes;
    for (OstLocal i = 0; i < n; i++) {
        Ball component;
        if (g->source[i] != UNREACHED)
            continue;
        OST_TRY(settle_ball(g, i, g->count, FLT_MAX, n, NULL, &component));
        if (component.nodes >= g->shape->minimum)
            g->seed[g->count++] = i;
        else
            OST_TRY(settle_ball(g, i, LEFT_OUT, FLT_MAX, n, NULL, &component));
    }
    return OST_SUCCESS;
}

static OstStatus group(Grouping *g)
{
    int dropped = 1;
    OST_TRY(keep_together(g));
    OST_TRY(choose_seeds(g));
    OST_TRY(assign(g));
    for (int pass = 0; pass < g->shape->recentrings || dropped; pass++) {
        recentre(g);
        dropped = drop_small(g);
        if (pass < g->shape->recentrings || dropped)
            OST_TRY(assign(g));
        if (dropped)
            OST_TRY(adopt_orphans(g));
    }
    return OST_SUCCESS;
}

OstStatus ost_aggregates_create(const OstMetricGraph *graph, const OstAggregateShape *shape, OstAggregates **aggregates)
{
    Grouping g;
    *aggregates = NULL;
    OST_TRY(create_grouping(graph, shape, &g));
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(graph->ctx, aggregates, 1));
    (*aggregates)->ctx = graph->ctx;
    OST_TRY_DONE(OST_NEW(graph->ctx, &(*aggregates)->of_node, graph->nodes));
    if (graph->nodes > 0)
        OST_TRY_DONE(group(&g));
    for (OstLocal i = 0; i < graph->nodes; i++)
        (*aggregates)->of_node[i] = g.source[i] < 0 ? -1 : g.source[i];
    (*aggregates)->count = g.count;
done:
    destroy_grouping(&g);
    if (status != OST_SUCCESS)
        ost_aggregates_destroy(aggregates);
    return status;
}
