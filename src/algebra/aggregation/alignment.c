/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/aggregation/alignment.h"

#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <float.h>

enum { LINE = 1, PLANE = 4 }; /* edges of a node that follow one stiff direction, or two */

static const double as_stiff = 3.0; /* two directions count as equally stiff up to this ratio in the metric */

/* Keeps the `count` smallest values, ascending. */
static void keep_smallest(int count, double *smallest, double value)
{
    for (int k = 0; k < count; k++)
        if (value < smallest[k]) {
            const double next = smallest[k];
            smallest[k] = value;
            value = next;
        }
}

/* The metric of a unit step along the node's stiffest edges; 0 if it has too few edges. */
static double stiffest_edge(const OstMetricGraph *graph, OstLocal node, int count)
{
    double smallest[PLANE] = {DBL_MAX, DBL_MAX, DBL_MAX, DBL_MAX};
    const double *from = graph->position + 3 * (size_t)node;
    for (OstLocal k = graph->edge_start[node]; k < graph->edge_start[node + 1]; k++) {
        const double *to = graph->position + 3 * (size_t)graph->neighbour[k];
        const double d[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
        const double square = ost_dot3(d, d);
        if (square > 0.0)
            keep_smallest(count, smallest, ost_metric_square(graph->metric + 6 * (size_t)node, d) / square);
    }
    return smallest[count - 1] < DBL_MAX ? smallest[count - 1] : 0.0;
}

OstStatus ost_metric_graph_misalignment(const OstMetricGraph *graph, double *mean)
{
    double sum[2] = {0.0, 0.0}; /* of nodes, and of their misalignments */
    OstStatus status = OST_SUCCESS;
    for (OstLocal i = 0; i < graph->nodes && status == OST_SUCCESS; i++) {
        const double *w = graph->metric + 6 * (size_t)i;
        const double full[9] = {w[0], w[3], w[5], w[3], w[1], w[4], w[5], w[4], w[2]};
        double value[3];
        status = ost_symmetric_eigen(graph->ctx, 3, full, value, NULL);
        if (status != OST_SUCCESS)
            break;
        const double edge = stiffest_edge(graph, i, value[1] < as_stiff * value[0] ? PLANE : LINE);
        if (edge > 0.0) {
            sum[0] += 1.0;
            sum[1] += edge / value[0];
        }
    }
    OST_TRY(ost_agree(graph->ctx, status));
    OST_TRY(ost_sum(graph->ctx, 2, sum));
    *mean = sum[0] > 0.0 ? sum[1] / sum[0] : 1.0;
    return OST_SUCCESS;
}
