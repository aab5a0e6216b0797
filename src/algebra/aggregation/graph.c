/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/aggregation/graph.h"

#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <float.h>
#include <string.h>

/* Contrasts up to `uneven` leave everything as it is: meshes of uneven size, slivers, and what conjugate gradients and
 * the smoother manage by themselves. Beyond it, neighbours are apart at a ratio of `apart`. */
static const double uneven = 1e4, apart = 100.0;

void ost_metric_graph_destroy(OstMetricGraph **graph)
{
    if (!*graph)
        return;
    OST_FREE((*graph)->edge_start, (*graph)->neighbour, (*graph)->length, (*graph)->position, (*graph)->metric);
    OST_FREE(*graph);
}

void ost_aggregates_destroy(OstAggregates **aggregates)
{
    if (!*aggregates)
        return;
    OST_FREE((*aggregates)->of_node);
    OST_FREE(*aggregates);
}

OstStatus ost_aggregates_list(const OstAggregates *aggregates, OstLocal nodes, OstLocal **start, OstLocal **member)
{
    OST_TRY(OST_NEW(aggregates->ctx, start, aggregates->count + 2));
    OST_TRY(OST_NEW(aggregates->ctx, member, nodes));
    OstLocal *next = *start + 1; /* becomes the next aggregate's start while it is filled */
    for (OstLocal i = 0; i < nodes; i++)
        if (aggregates->of_node[i] >= 0)
            next[aggregates->of_node[i] + 1]++;
    for (OstLocal a = 0; a < aggregates->count; a++)
        next[a + 1] += next[a];
    for (OstLocal i = 0; i < nodes; i++)
        if (aggregates->of_node[i] >= 0)
            (*member)[next[aggregates->of_node[i]]++] = i;
    return OST_SUCCESS;
}

static OstStatus allocate_graph(OstContext *ctx, OstLocal nodes, OstLocal edges, OstMetricGraph **graph)
{
    OST_TRY(OST_NEW(ctx, graph, 1));
    OstMetricGraph *g = *graph;
    g->ctx = ctx;
    g->nodes = nodes;
    OST_TRY(OST_NEW(ctx, &g->edge_start, nodes + 1));
    OST_TRY(OST_NEW(ctx, &g->neighbour, edges));
    OST_TRY(OST_NEW(ctx, &g->length, edges));
    OST_TRY(OST_NEW(ctx, &g->position, 3 * (size_t)nodes));
    return OST_NEW(ctx, &g->metric, 6 * (size_t)nodes);
}

static int is_metric(const double w[6])
{
    double full[9] = {w[0], w[3], w[5], w[3], w[1], w[4], w[5], w[4], w[2]};
    double sum = 0.0;
    for (int k = 0; k < 6; k++)
        sum += w[k];
    return isfinite(sum) && ost_cholesky(3, full) == 0;
}

static OstStatus check_node(const OstMetricGraph *graph, OstLocal node, OstGlobal number)
{
    const double *x = graph->position + 3 * (size_t)node;
    const double *w = graph->metric + 6 * (size_t)node;
    if (!isfinite(x[0]) || !isfinite(x[1]) || !isfinite(x[2]))
        return OST_RAISE(graph->ctx, OST_INVALID_INPUT, "node %lld lies at (%g, %g, %g); expected finite coordinates",
                         (long long)number, x[0], x[1], x[2]);
    if (!is_metric(w))
        return OST_RAISE(graph->ctx, OST_INVALID_INPUT,
                         "the material's metric at node %lld is [%g %g %g %g %g %g]; expected a finite positive "
                         "definite tensor: check the moduli and axes of the tets around it",
                         (long long)number, w[0], w[1], w[2], w[3], w[4], w[5]);
    return OST_SUCCESS;
}

/* The length of each edge in the mean metric of its two nodes. */
static void measure_edges(OstMetricGraph *graph)
{
    for (OstLocal i = 0; i < graph->nodes; i++)
        for (OstLocal k = graph->edge_start[i]; k < graph->edge_start[i + 1]; k++) {
            const OstLocal j = graph->neighbour[k];
            double d[3], w[6];
            for (int c = 0; c < 3; c++)
                d[c] = graph->position[3 * (size_t)j + (size_t)c] - graph->position[3 * (size_t)i + (size_t)c];
            for (int c = 0; c < 6; c++)
                w[c] = 0.5 * (graph->metric[6 * (size_t)i + (size_t)c] + graph->metric[6 * (size_t)j + (size_t)c]);
            graph->length[k] = (float)sqrt(fmax(ost_metric_square(w, d), 0.0));
        }
}

static double trace(const OstBlockMatrix *matrix, OstLocal row)
{
    const double *block = ost_block_matrix_diagonal(matrix, row);
    return block[0] + block[4] + block[8];
}

/* How rigid a node is: unlike the trace, that of a material that is stiff in one direction is far below that of one
 * which is stiff in all. It does not depend on axes. */
static double rigidity(const OstBlockMatrix *matrix, OstLocal row)
{
    return cbrt(ost_determinant3(ost_block_matrix_diagonal(matrix, row)));
}

static int differ(double here, double there)
{
    return fmax(here, there) > apart * fmin(here, there);
}

/* A stiff inclusion in soft surroundings moves as a rigid body, at an energy far below that of its own parts. Its six
 * modes must lie in the coarse space whole: an aggregate that holds some of it and some of what is around cannot move
 * without straining it. Two inclusions with nothing but soft tets between them may have all nodes of a body: then no
 * two neighbours differ, but their coupling is far weaker than their own blocks. */
static int are_apart(const OstBlockMatrix *matrix, OstLocal i, OstLocal k, double weakest_coupling)
{
    const OstLocal j = matrix->column[k];
    const double here = trace(matrix, i), there = trace(matrix, j), least = weakest_coupling * fmin(here, there);
    double room[9];
    const double *between = ost_block_matrix_block(matrix, i, k, room);
    return differ(here, there) || differ(rigidity(matrix, i), rigidity(matrix, j)) ||
           ost_dot(9, between, between) < least * least;
}

static OstStatus find_jump(const OstBlockMatrix *matrix, const OstSolverFacts *facts, const OstMetricGraph *graph,
                           double *jump)
{
    *jump = facts ? fmax(facts->jump, 1.0) : 1.0;
    for (OstLocal i = 0; i < graph->nodes; i++)
        for (OstLocal k = graph->edge_start[i]; k < graph->edge_start[i + 1]; k++)
            *jump = fmax(*jump, trace(matrix, i) / trace(matrix, graph->neighbour[k]));
    return ost_max(graph->ctx, 1, jump);
}

static OstStatus part_at_jumps(const OstBlockMatrix *matrix, const OstSolverFacts *facts, OstMetricGraph *graph)
{
    double jump;
    OST_TRY(find_jump(matrix, facts, graph, &jump));
    graph->jump = jump > uneven && isfinite(jump) ? jump : 1.0;
    if (!ost_metric_graph_is_uneven(graph))
        return OST_SUCCESS;
    const double weakest_coupling = 0.1 / sqrt(graph->jump);
    for (OstLocal i = 0; i < graph->nodes; i++) {
        OstLocal edge = graph->edge_start[i];
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++) {
            if (matrix->column[k] >= matrix->rows || matrix->column[k] == i)
                continue;
            if (are_apart(matrix, i, k, weakest_coupling))
                graph->length[edge] = INFINITY;
            edge++;
        }
    }
    return OST_SUCCESS;
}

static OstStatus fill_from_matrix(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                                  OstMetricGraph *graph)
{
    const size_t n = (size_t)matrix->rows;
    if (n > 0)
        memcpy(graph->position, geometry->coordinates, 3 * n * sizeof(double));
    if (n > 0 && geometry->metric)
        memcpy(graph->metric, geometry->metric, 6 * n * sizeof(double));
    OstLocal edges = 0;
    for (OstLocal i = 0; i < matrix->rows; i++) {
        for (int c = 0; c < 6 && !geometry->metric; c++) /* not by memcpy of a constant: GCC 12 miscompiles that */
            graph->metric[6 * (size_t)i + (size_t)c] = c < 3 ? 1.0 : 0.0;
        OST_TRY(check_node(graph, i, matrix->first_row + i));
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++)
            if (matrix->column[k] < matrix->rows && matrix->column[k] != i)
                graph->neighbour[edges++] = matrix->column[k];
        graph->edge_start[i + 1] = edges;
    }
    measure_edges(graph);
    return OST_SUCCESS;
}

OstStatus ost_metric_graph_create(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                                  OstMetricGraph **graph)
{
    OstContext *ctx = matrix->ctx;
    *graph = NULL;
    OstStatus status = allocate_graph(ctx, matrix->rows, matrix->row_start[matrix->rows], graph);
    OST_THEN(fill_from_matrix(matrix, geometry, *graph));
    status = ost_agree(ctx, status);
    OST_THEN(part_at_jumps(matrix, geometry->facts, *graph));
    if (status != OST_SUCCESS)
        ost_metric_graph_destroy(graph);
    return status;
}

OstStatus ost_metric_graph_of_pattern(OstContext *ctx, OstLocal rows, const OstLocal *row_start, const OstLocal *column,
                                      const double *place, OstMetricGraph **graph)
{
    OstLocal edges = 0;
    OST_TRY(allocate_graph(ctx, rows, row_start[rows], graph));
    for (OstLocal i = 0; i < rows; i++) {
        memcpy((*graph)->position + 3 * (size_t)i, place + 9 * (size_t)i, 3 * sizeof *place);
        memcpy((*graph)->metric + 6 * (size_t)i, place + 9 * (size_t)i + 3, 6 * sizeof *place);
        for (OstLocal k = row_start[i]; k < row_start[i + 1]; k++)
            if (column[k] < rows && column[k] != i)
                (*graph)->neighbour[edges++] = column[k];
        (*graph)->edge_start[i + 1] = edges;
    }
    measure_edges(*graph);
    return OST_SUCCESS;
}

OstStatus ost_metric_graph_shortening(const OstMetricGraph *graph, double *most)
{
    double least = 1.0; /* squared length in the metric over squared Euclidean length */
    for (OstLocal i = 0; i < graph->nodes; i++)
        for (OstLocal k = graph->edge_start[i]; k < graph->edge_start[i + 1]; k++) {
            const double *a = graph->position + 3 * (size_t)i;
            const double *b = graph->position + 3 * (size_t)graph->neighbour[k];
            const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
            const double plain = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
            if (plain > 0.0)
                least = fmin(least, (double)graph->length[k] * (double)graph->length[k] / plain);
        }
    *most = 1.0 / fmax(least, DBL_EPSILON);
    return OST_MPI(graph->ctx, MPI_Allreduce(MPI_IN_PLACE, most, 1, MPI_DOUBLE, MPI_MAX, ost_comm(graph->ctx)));
}

static void average_members(const OstMetricGraph *fine, const OstLocal *start, const OstLocal *member,
                            OstMetricGraph *coarse)
{
    for (OstLocal a = 0; a < coarse->nodes; a++) {
        double *x = coarse->position + 3 * (size_t)a;
        double *w = coarse->metric + 6 * (size_t)a;
        const OstLocal members = start[a + 1] - start[a];
        for (OstLocal m = start[a]; m < start[a + 1]; m++) {
            for (int c = 0; c < 3; c++)
                x[c] += fine->position[3 * (size_t)member[m] + (size_t)c];
            for (int c = 0; c < 6; c++)
                w[c] += fine->metric[6 * (size_t)member[m] + (size_t)c];
        }
        for (int c = 0; c < 3; c++)
            x[c] /= members;
        for (int c = 0; c < 6; c++)
            w[c] /= members;
    }
}

/* `seen` holds, for each aggregate, the last one whose neighbour it was found to be. */
static void connect_aggregates(const OstMetricGraph *fine, const OstAggregates *aggregates, const OstLocal *start,
                               const OstLocal *member, OstLocal *seen, OstMetricGraph *coarse)
{
    OstLocal edges = 0;
    for (OstLocal a = 0; a < coarse->nodes; a++)
        seen[a] = -1;
    for (OstLocal a = 0; a < coarse->nodes; a++) {
        for (OstLocal m = start[a]; m < start[a + 1]; m++)
            for (OstLocal k = fine->edge_start[member[m]]; k < fine->edge_start[member[m] + 1]; k++) {
                const OstLocal b = aggregates->of_node[fine->neighbour[k]];
                if (b < 0 || b == a || seen[b] == a)
                    continue;
                seen[b] = a;
                coarse->neighbour[edges++] = b;
            }
        coarse->edge_start[a + 1] = edges;
    }
}

OstStatus ost_metric_graph_coarsen(const OstMetricGraph *fine, const OstAggregates *aggregates, OstMetricGraph **coarse)
{
    OstContext *ctx = fine->ctx;
    OstLocal *start = NULL, *member = NULL, *seen = NULL;
    *coarse = NULL;
    OstStatus status = allocate_graph(ctx, aggregates->count, fine->edge_start[fine->nodes], coarse);
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(ost_aggregates_list(aggregates, fine->nodes, &start, &member));
    OST_TRY_DONE(OST_NEW(ctx, &seen, aggregates->count));
    average_members(fine, start, member, *coarse);
    connect_aggregates(fine, aggregates, start, member, seen, *coarse);
    const OstLocal edges = (*coarse)->edge_start[aggregates->count];
    OST_TRY_DONE(OST_RESIZE(ctx, &(*coarse)->neighbour, edges));
    OST_TRY_DONE(OST_RESIZE(ctx, &(*coarse)->length, edges));
    measure_edges(*coarse);
    (*coarse)->jump = fine->jump;
done:
    OST_FREE(start, member, seen);
    if (status != OST_SUCCESS)
        ost_metric_graph_destroy(coarse);
    return status;
}
