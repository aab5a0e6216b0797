/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/aggregation/alignment.h"

#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <float.h>
#include <math.h>

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

/* Second moments of the steps to a node's neighbours, with the metric made Euclidean, and their mean. */
static OstLocal spread_of(const OstMetricGraph *graph, OstLocal node, double moment[9], double middle[3])
{
    const double *w = graph->metric + 6 * (size_t)node, *from = graph->position + 3 * (size_t)node;
    double lower[9] = {w[0], w[3], w[5], w[3], w[1], w[4], w[5], w[4], w[2]};
    const OstLocal first = graph->edge_start[node], count = graph->edge_start[node + 1] - first;
    if (ost_cholesky(3, lower) != 0)
        return 0;
    for (OstLocal k = first; k < first + count; k++) {
        const double *to = graph->position + 3 * (size_t)graph->neighbour[k];
        const double d[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
        const double y[3] = {lower[0] * d[0] + lower[3] * d[1] + lower[6] * d[2], lower[4] * d[1] + lower[7] * d[2],
                             lower[8] * d[2]};
        for (int i = 0; i < 3; i++) {
            middle[i] += y[i] / count;
            for (int j = 0; j < 3; j++)
                moment[3 * i + j] += y[i] * y[j] / count;
        }
    }
    return count;
}

/* Flatness at a node whose neighbours lie to one side of it in the narrowest direction; 0 at others. */
static OstStatus flatness_at(const OstMetricGraph *graph, OstLocal node, double *flatness)
{
    static const double one_sided = 0.25; /* square of the mean over the mean square */
    double moment[9] = {0.0}, middle[3] = {0.0}, value[3], vector[9];
    *flatness = 0.0;
    if (spread_of(graph, node, moment, middle) == 0)
        return OST_SUCCESS;
    OST_TRY(ost_symmetric_eigen(graph->ctx, 3, moment, value, vector));
    const double aside = ost_dot3(vector, middle);
    if (value[0] > 0.0 && aside * aside > one_sided * value[0])
        *flatness = sqrt(value[2] / value[0]);
    return OST_SUCCESS;
}

OstStatus ost_metric_graph_flatness(const OstMetricGraph *graph, double *mean)
{
    enum { SAMPLES = 4000 };
    double sum[2] = {0.0}; /* of nodes at the surface, and of their flatness */
    OstStatus status = OST_SUCCESS;
    for (OstLocal i = 0; i < graph->nodes && status == OST_SUCCESS; i += 1 + graph->nodes / SAMPLES) {
        double flatness;
        status = flatness_at(graph, i, &flatness);
        sum[0] += flatness > 0.0;
        sum[1] += flatness;
    }
    OST_TRY(ost_agree(graph->ctx, status));
    OST_TRY(ost_sum(graph->ctx, 2, sum));
    *mean = sum[0] > 0.0 ? sum[1] / sum[0] : 1.0;
    return OST_SUCCESS;
}
