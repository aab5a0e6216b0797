/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/aggregation/alignment.h"

#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <float.h>
#include <math.h>
#include <string.h>

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

/* The Cholesky factor of a node's metric, which makes it Euclidean; returns whether there is one. */
static int factor_metric(const OstMetricGraph *graph, OstLocal node, double lower[9])
{
    const double *w = graph->metric + 6 * (size_t)node;
    const double full[9] = {w[0], w[3], w[5], w[3], w[1], w[4], w[5], w[4], w[2]};
    memcpy(lower, full, sizeof full);
    return ost_cholesky(3, lower) == 0;
}

/* The step to a neighbour, with the metric made Euclidean. */
static void find_step(const OstMetricGraph *graph, const double lower[9], OstLocal node, OstLocal neighbour,
                      double step[3])
{
    const double *from = graph->position + 3 * (size_t)node, *to = graph->position + 3 * (size_t)neighbour;
    const double d[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    step[0] = lower[0] * d[0] + lower[3] * d[1] + lower[6] * d[2];
    step[1] = lower[4] * d[1] + lower[7] * d[2];
    step[2] = lower[8] * d[2];
}

/* Second moments of the steps to a node's neighbours, with the metric made Euclidean, and their mean. */
static OstLocal spread_of(const OstMetricGraph *graph, const double lower[9], OstLocal node, double moment[9],
                          double middle[3])
{
    const OstLocal first = graph->edge_start[node], count = graph->edge_start[node + 1] - first;
    for (OstLocal k = first; k < first + count; k++) {
        double y[3];
        find_step(graph, lower, node, graph->neighbour[k], y);
        for (int i = 0; i < 3; i++) {
            middle[i] += y[i] / count;
            for (int j = 0; j < 3; j++)
                moment[3 * i + j] += y[i] * y[j] / count;
        }
    }
    return count;
}

/* A node of the surface: the neighbours lie to one side of it in the narrowest direction. */
typedef struct Surface {
    double spread[3]; /* of the neighbours, squares, ascending */
    double inward[3]; /* unit vector in the narrowest direction */
    double lower[9];  /* makes the metric Euclidean */
} Surface;

static OstStatus look_at_surface(const OstMetricGraph *graph, OstLocal node, Surface *at, int *is_surface)
{
    static const double one_sided = 0.25; /* square of the mean over the mean square */
    double moment[9] = {0.0}, middle[3] = {0.0}, vector[9];
    *is_surface = 0;
    if (!factor_metric(graph, node, at->lower) || spread_of(graph, at->lower, node, moment, middle) == 0)
        return OST_SUCCESS;
    OST_TRY(ost_symmetric_eigen(graph->ctx, 3, moment, at->spread, vector));
    const double aside = ost_dot3(vector, middle);
    *is_surface = at->spread[0] > 0.0 && aside * aside > one_sided * at->spread[0];
    for (int c = 0; c < 3; c++)
        at->inward[c] = aside > 0.0 ? vector[c] : -vector[c];
    return OST_SUCCESS;
}

enum { SAMPLES = 4000 };

OstStatus ost_metric_graph_flatness(const OstMetricGraph *graph, double *mean)
{
    double sum[2] = {0.0}; /* of nodes at the surface, and of their flatness */
    OstStatus status = OST_SUCCESS;
    for (OstLocal i = 0; i < graph->nodes && status == OST_SUCCESS; i += 1 + graph->nodes / SAMPLES) {
        Surface at;
        int is_surface;
        status = look_at_surface(graph, i, &at, &is_surface);
        if (status != OST_SUCCESS || !is_surface)
            continue;
        sum[0] += 1.0;
        sum[1] += sqrt(at.spread[2] / at.spread[0]);
    }
    OST_TRY(ost_agree(graph->ctx, status));
    OST_TRY(ost_sum(graph->ctx, 2, sum));
    *mean = sum[0] > 0.0 ? sum[1] / sum[0] : 1.0;
    return OST_SUCCESS;
}

/* The neighbour that lies most nearly inwards, and how far; -1 behind the last one. */
static OstLocal step_inwards(const OstMetricGraph *graph, const Surface *at, OstLocal node, double *length)
{
    double cosine = 0.5;
    OstLocal next = -1;
    for (OstLocal k = graph->edge_start[node]; k < graph->edge_start[node + 1]; k++) {
        double step[3];
        find_step(graph, at->lower, node, graph->neighbour[k], step);
        const double along = ost_dot3(at->inward, step), size = sqrt(ost_dot3(step, step));
        if (along > cosine * size) {
            cosine = along / size;
            *length = along;
            next = graph->neighbour[k];
        }
    }
    return next;
}

static double find_thickness(const OstMetricGraph *graph, const Surface *at, OstLocal node)
{
    enum { MOST = 100 }; /* steps: no thin body any more */
    double thickness = 0.0, length = 0.0;
    for (int k = 0; k < MOST && (node = step_inwards(graph, at, node, &length)) >= 0; k++)
        thickness += length;
    return thickness;
}

OstStatus ost_metric_graph_slenderness(const OstMetricGraph *graph, double *mean)
{
    static const double of_spread = 1.8;      /* a tet's length over the root mean square of steps */
    static const double apart = 0.6180339887; /* of all nodes: samples follow no row of nodes */
    double sum[2] = {0.0};                    /* of areas, and of the logarithms times them */
    OstStatus status = OST_SUCCESS;
    for (int k = 0; k < SAMPLES && k < graph->nodes && status == OST_SUCCESS; k++) {
        const double place = k * apart - floor(k * apart);
        const OstLocal node = graph->nodes <= SAMPLES ? k : (OstLocal)(place * graph->nodes);
        Surface at;
        int is_surface;
        status = look_at_surface(graph, node, &at, &is_surface);
        const double thickness = status == OST_SUCCESS && is_surface ? find_thickness(graph, &at, node) : 0.0;
        if (!(thickness > 0.0))
            continue;
        const double area = sqrt(at.spread[1] * at.spread[2]);
        sum[0] += area;
        sum[1] += area * log(of_spread * sqrt(at.spread[2]) / thickness);
    }
    OST_TRY(ost_agree(graph->ctx, status));
    OST_TRY(ost_sum(graph->ctx, 2, sum));
    *mean = sum[0] > 0.0 ? exp(sum[1] / sum[0]) : 0.0;
    return OST_SUCCESS;
}
