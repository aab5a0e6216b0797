/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/aggregation/columns.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <math.h>

/* An edge is short below the first part of the mean of each of its nodes' edges. In the mean, a column has at least the
 * second number of nodes: three where quadratic tets are one deep, less where some are constrained. None has more than
 * MOST. */
static const double close = 0.1, fewest = 2.5;
enum { MOST = 100 };

/* In space or in the metric; infinite where two nodes must stay apart. */
static double length_of(const OstMetricGraph *graph, int in_metric, OstLocal i, OstLocal k)
{
    if (in_metric || isinf(graph->length[k]))
        return graph->length[k];
    const double *a = graph->position + 3 * (size_t)i, *b = graph->position + 3 * (size_t)graph->neighbour[k];
    const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    return sqrt(ost_dot3(d, d));
}

static OstLocal root_of(OstLocal *set, OstLocal i)
{
    for (; set[i] != i; i = set[i])
        set[i] = set[set[i]];
    return i;
}

/* The length below which an edge of the node is short. */
static double short_length(const OstMetricGraph *graph, int in_metric, OstLocal i)
{
    double sum = 0.0, count = 0.0;
    for (OstLocal k = graph->edge_start[i]; k < graph->edge_start[i + 1]; k++) {
        const double length = length_of(graph, in_metric, i, k);
        sum += isinf(length) ? 0.0 : length;
        count += !isinf(length);
    }
    return close * sum / fmax(count, 1.0);
}

/* Joins the ends of short edges. The root of a set is its first node. */
static void join(const OstMetricGraph *graph, int in_metric, OstLocal *set, double *limit)
{
    for (OstLocal i = 0; i < graph->nodes; i++) {
        set[i] = i;
        limit[i] = short_length(graph, in_metric, i);
    }
    for (OstLocal i = 0; i < graph->nodes; i++)
        for (OstLocal k = graph->edge_start[i]; k < graph->edge_start[i + 1]; k++) {
            const OstLocal j = graph->neighbour[k];
            if (j < i || length_of(graph, in_metric, i, k) > fmin(limit[i], limit[j]))
                continue;
            const OstLocal a = root_of(set, i), b = root_of(set, j);
            set[a > b ? a : b] = a < b ? a : b;
        }
}

/* Numbers the sets by their first nodes; returns the nodes of the largest. `size` is scratch, zeros. */
static OstLocal number_sets(OstLocal nodes, OstLocal *set, OstLocal *size, OstAggregates *columns)
{
    OstLocal largest = 0;
    for (OstLocal i = 0; i < nodes; i++) {
        const OstLocal root = root_of(set, i);
        columns->of_node[i] = root == i ? columns->count++ : columns->of_node[root];
        const OstLocal now = ++size[columns->of_node[i]];
        largest = now > largest ? now : largest;
    }
    return largest;
}

static OstStatus group(const OstMetricGraph *graph, int in_metric, OstAggregates *columns, OstLocal *largest)
{
    OstContext *ctx = graph->ctx;
    const OstLocal n = graph->nodes;
    OstLocal *set = NULL;
    double *limit = NULL;
    OstStatus status;
    OST_TRY_DONE(OST_NEW(ctx, &set, 2 * (size_t)n));
    OST_TRY_DONE(OST_NEW(ctx, &limit, n));
    OST_TRY_DONE(OST_NEW(ctx, &columns->of_node, n));
    join(graph, in_metric, set, limit);
    *largest = number_sets(n, set, set + n, columns);
done:
    OST_FREE(set, limit);
    return status;
}

static OstStatus find(const OstMetricGraph *graph, int in_metric, OstAggregates **columns)
{
    OstContext *ctx = graph->ctx;
    OstLocal largest = 0;
    *columns = NULL;
    OstStatus status = OST_NEW(ctx, columns, 1);
    if (status == OST_SUCCESS) {
        (*columns)->ctx = ctx;
        status = group(graph, in_metric, *columns, &largest);
    }
    OST_TRY_DONE(ost_agree(ctx, status));
    OstGlobal count[2] = {(*columns)->count, graph->nodes}, most = largest;
    OST_TRY_DONE(ost_sum_numbers(ctx, 2, count));
    OST_TRY_DONE(ost_max_numbers(ctx, 1, &most));
    if ((double)count[1] < fewest * (double)count[0] || most > MOST)
        ost_aggregates_destroy(columns);
done:
    if (status != OST_SUCCESS)
        ost_aggregates_destroy(columns);
    return status;
}

OstStatus ost_columns_create(const OstMetricGraph *graph, OstAggregates **columns)
{
    OST_TRY(find(graph, 0, columns));
    return *columns ? OST_SUCCESS : find(graph, 1, columns);
}
