/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/metric.h"

#include "algebra/aggregation/alignment.h"
#include "algebra/aggregation/columns.h"
#include "algebra/krylov/cg.h"
#include "algebra/matrix/vector.h"
#include "algebra/multigrid/cycle.h"
#include "algebra/multigrid/quadratic.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/together/together.h"

#include <math.h>
#include <stdio.h>

/* Linear tets whose edges cross a stiff direction lock: their energy is far above that of the quadratic tets in the
 * same bending, so that they correct little. Vertices that also turn do not lock, and their level has four times the
 * nonzeros. Gears, brackets, spindles and pins of 9,000 to 99,000 unknowns, iterations to 1e-8 over linear tets and
 * over turning vertices: 21 to 27 and 12 to 15 at a ratio of 10 (misalignment 1.1 to 1.25; seconds about the same), 50
 * to 57 and 21 to 24 at 100 (1.5 to 2.0), 55 to 107 and 19 to 43 at 1000 (2.8 to 5.6). */
const double ost_metric_misaligned = 1.5;
static const double quadratic_aggregate = 14.0; /* of 16: 38 iterations become 41 */
enum { LOCKED_MORE_DEGREE = 2 };

/* What quadratic tets are corrected by. */
typedef enum Correction { LINEAR_TETS, TURNING_VERTICES, AGGREGATES } Correction;

/* Linear tets that are longer than the body is thick lock too: their energy in bending is too large by the square of
 * that. Turning vertices do not bend as one through the thickness. A beam 100 : 1 of 140 x 2 x 2 hexes, 1000 times
 * stiffer across: 7.2, and 352 iterations over linear tets, 46 without. */
static const double longest = 5.0;
/* With the vertices' matrix factored they do well a while: condition 2 for a length of 3, 6 for 6, 36 for 13, 85 for
 * 30, 850 for 54 (plates; aggregates 51 and 98 for the last two). */
const double ost_metric_longest_of_vertices = 15.0;
/* Linear tets in a plate, and how much longer than thick they are, in the metric: from this on, the softest motion of a
 * smoother's block has less energy than single precision holds. A plate 1000 : 1 of 24 x 24 x 2 hexes: 140, and 40
 * iterations; 1000 times stiffer across, nu 0.45: 790, and 619 iterations, 44 over columns. */
static const double flattest = 200.0;
static const double largest_block = 24.0; /* nodes; aggregates up to this size are blocks too */

struct OstMetric {
    OstContext *ctx;
    OstSolverOptions options;
    const OstBlockMatrix *matrix;
    OstScaling *scaling;
    OstCycle *cycle;
    OstScaling *linear_scaling; /* of the linear tets, for quadratic ones */
    int over_linear;            /* are they a level? */
    int levels;
    OstGlobal level_unknowns[OST_MAX_LEVELS];
    double operator_complexity;
};

void ost_metric_destroy(OstMetric **metric)
{
    if (!*metric)
        return;
    ost_cycle_destroy(&(*metric)->cycle);
    ost_scaling_destroy(&(*metric)->linear_scaling);
    ost_scaling_destroy(&(*metric)->scaling);
    OST_FREE(*metric);
}

/* The modes in scaled unknowns, each divided to be of order 1. */
static OstStatus scale_modes(const OstScaling *scaling, const double *modes, double **scaled)
{
    const size_t n = 3 * (size_t)scaling->rows;
    OST_TRY(ost_agree(scaling->ctx, OST_NEW(scaling->ctx, scaled, 6 * n)));
    for (size_t k = 0; k < 6; k++) {
        double *mode = *scaled + k * n;
        double size;
        ost_scaling_to_scaled_mode(scaling, modes + k * n, mode);
        OST_TRY(ost_vector_size(scaling->ctx, n, mode, &size));
        for (size_t i = 0; i < n; i++)
            mode[i] /= size;
    }
    return OST_SUCCESS;
}

/* Counts the levels' unknowns and nonzeros over all ranks, for the report. */
static OstStatus measure_levels(OstMetric *metric, const OstLevels *levels)
{
    OstGlobal size[2 * OST_MAX_LEVELS] = {0};
    for (int l = 0; l < levels->count; l++) {
        size[2 * l] = (OstGlobal)ost_level_unknowns(levels->matrix[l]);
        size[2 * l + 1] = levels->matrix[l]->nonzeros;
    }
    OST_TRY(ost_sum_numbers(metric->ctx, 2 * OST_MAX_LEVELS, size));
    OstGlobal nonzeros = 0;
    metric->levels = levels->count;
    for (int l = 0; l < levels->count; l++) {
        metric->level_unknowns[l] = size[2 * l];
        nonzeros += size[2 * l + 1];
    }
    metric->operator_complexity = (double)nonzeros / (double)size[1];
    return OST_SUCCESS;
}

/* Builds the levels of a matrix by aggregation; takes over its graph, and empties the caller's. */
static OstStatus build_levels(OstMetric *metric, const OstBlockMatrix *matrix, const OstScaling *scaling,
                              const OstSolverGeometry *geometry, OstMetricGraph **graph, OstVertexSpace *vertices,
                              OstLevels *levels)
{
    double *modes = NULL;
    OstStatus status;
    OST_TRY_DONE(scale_modes(scaling, geometry->modes, &modes));
    ost_geometry_release(geometry);
    OST_TRY_DONE(ost_levels_create(matrix, scaling, &modes, graph, vertices, &metric->options, levels));
    OST_TRY_DONE(measure_levels(metric, levels));
done:
    OST_FREE(modes);
    return status;
}

/* Adds the quadratic level to the report; the operator complexity is relative to its matrix. */
static OstStatus count_quadratic(OstMetric *metric, const OstBlockMatrix *linear)
{
    OstGlobal blocks[2] = {metric->matrix->row_start[metric->matrix->rows], linear->row_start[linear->rows]};
    OST_TRY(ost_sum_numbers(metric->ctx, 2, blocks));
    if (metric->levels < OST_MAX_LEVELS)
        metric->levels++;
    for (int l = metric->levels - 1; l > 0; l--)
        metric->level_unknowns[l] = metric->level_unknowns[l - 1];
    metric->level_unknowns[0] = 3 * metric->matrix->global_rows;
    metric->operator_complexity = 1.0 + metric->operator_complexity * (double)blocks[1] / (double)blocks[0];
    return OST_SUCCESS;
}

/* Builds the levels of the linear tets. */
static OstStatus build_linear(OstMetric *metric, const OstCoarseSpace *space, const OstSolverFacts *facts,
                              OstLevels *levels)
{
    OstSolverGeometry geometry = *space->geometry;
    OstMetricGraph *graph = NULL;
    OstStatus status;
    geometry.facts = facts;
    metric->options.precise *= 2; /* the linear tets are a coarse level */
    metric->options.most_levels = metric->options.most_levels > 1 ? metric->options.most_levels - 1 : 1;
    OST_TRY_DONE(ost_scaling_create(space->matrix, &metric->linear_scaling));
    OST_TRY_DONE(ost_metric_graph_create(space->matrix, &geometry, &graph));
    OST_TRY_DONE(build_levels(metric, space->matrix, metric->linear_scaling, &geometry, &graph, NULL, levels));
    OST_TRY_DONE(count_quadratic(metric, space->matrix));
done:
    ost_metric_graph_destroy(&graph);
    return status;
}

/* The length of the tets over the thickness of the body, in the metric; 0 where that is not known. */
static OstStatus find_length(const OstMetricGraph *graph, const OstSolverFacts *facts, double *length)
{
    *length = 0.0;
    if (!facts || !(facts->thickness > 0.0))
        return OST_SUCCESS;
    OST_TRY(ost_metric_graph_flatness(graph, length));
    *length /= fmax(0.5 * (facts->thickness - 1.0), 1.0); /* tets across */
    return OST_SUCCESS;
}

static void set_options_of_aggregates(OstSolverOptions *options, int locks)
{
    if (!(options->given & OST_GIVEN_AGGREGATE) && options->aggregate_nodes > quadratic_aggregate)
        options->aggregate_nodes = quadratic_aggregate;
    options->own_blocks = options->aggregate_nodes <= largest_block;
    if (locks)
        options->precise *= 2; /* the finest level has the softest motions */
    options->columns = locks && options->method != OST_METHOD_TWO_LEVEL ? 2 : 0;
    if (options->method != OST_METHOD_STRONG && !(options->given & OST_GIVEN_DEGREE))
        options->smoother_degree += LOCKED_MORE_DEGREE;
}

static OstStatus has_columns(const OstMetricGraph *graph, int *has)
{
    OstAggregates *columns = NULL;
    OST_TRY(ost_columns_create(graph, &columns));
    *has = columns != NULL;
    ost_aggregates_destroy(&columns);
    return OST_SUCCESS;
}

/* The cheapest that does not lock. STRONG and TWO_LEVEL come where linear tets were not enough. Along the stiff
 * directions STRONG goes over aggregates: a tube with E3 x 1e6 near the border of stability takes 415 iterations with
 * it; over vertices STRONG does not converge there. */
static OstStatus choose_correction(const OstMetric *metric, const OstMetricGraph *graph, const OstSolverFacts *facts,
                                   Correction *correction, int *locks)
{
    static const char *const name[] = {"linear tets", "vertices that also turn", "aggregates of quadratic tets' nodes"};
    const OstMethod method = metric->options.method;
    double misalignment, length, slenderness = 0.0;
    int is_plate = 0;
    OST_TRY(ost_metric_graph_misalignment(graph, &misalignment));
    OST_TRY(find_length(graph, facts, &length));
    if (method == OST_METHOD_TWO_LEVEL)
        OST_TRY(ost_metric_graph_slenderness(graph, &slenderness));
    const int crosses = misalignment > ost_metric_misaligned;
    const int bends = crosses || (method == OST_METHOD_TWO_LEVEL && slenderness <= ost_metric_longest_of_vertices);
    *locks = length > longest;
    OST_TRY(bends && *locks ? has_columns(graph, &is_plate) : OST_SUCCESS);
    if (is_plate || (!bends && (*locks || method == OST_METHOD_STRONG)))
        *correction = AGGREGATES;
    else
        *correction = crosses || method == OST_METHOD_TWO_LEVEL ? TURNING_VERTICES : LINEAR_TETS;
    ost_log(metric->ctx, OST_LOG_VERBOSE,
            "solver: quadratic tets over %s: edges cross the stiff directions by %.2g (along them: 1), and are %.2g "
            "times as long as the body is thick",
            name[*correction], misalignment, length);
    return OST_SUCCESS;
}

static OstStatus build_over_linear(OstMetric *metric, const OstSolverGeometry *geometry, const OstMetricGraph *graph,
                                   OstLevels *levels, OstQuadraticLevel **quadratic)
{
    metric->over_linear = 1;
    ost_geometry_release(geometry);
    OST_TRY(build_linear(metric, geometry->coarse, geometry->facts, levels));
    return ost_quadratic_level_create(metric->matrix, graph, geometry->coarse, metric->scaling, metric->linear_scaling,
                                      &metric->options, quadratic);
}

static OstStatus build_over_vertices(OstMetric *metric, const OstSolverGeometry *geometry, OstMetricGraph **graph,
                                     OstLevels *levels)
{
    const OstCoarseSpace *space = geometry->coarse;
    OstVertexSpace vertices = {0};
    OstStatus status;
    OST_TRY_DONE(ost_scaling_create(space->matrix, &metric->linear_scaling));
    OST_TRY_DONE(ost_vertex_space_create(space, geometry, metric->scaling, metric->linear_scaling, &vertices));
    OST_TRY_DONE(build_levels(metric, metric->matrix, metric->scaling, geometry, graph, &vertices, levels));
done:
    ost_vertex_space_clear(&vertices);
    ost_scaling_destroy(&metric->linear_scaling);
    return status;
}

/* Builds the levels of quadratic tets; `quadratic` is the finest one where they go over linear tets. */
static OstStatus build_quadratic(OstMetric *metric, const OstSolverGeometry *geometry, OstLevels *levels,
                                 OstQuadraticLevel **quadratic)
{
    OstMetricGraph *graph = NULL;
    Correction correction = LINEAR_TETS;
    int locks = 0;
    OstStatus status;
    OST_TRY_DONE(ost_metric_graph_create(metric->matrix, geometry, &graph));
    OST_TRY_DONE(choose_correction(metric, graph, geometry->facts, &correction, &locks));
    if (correction == LINEAR_TETS) {
        OST_TRY_DONE(build_over_linear(metric, geometry, graph, levels, quadratic));
    } else if (correction == TURNING_VERTICES) {
        OST_TRY_DONE(build_over_vertices(metric, geometry, &graph, levels));
    } else {
        set_options_of_aggregates(&metric->options, locks);
        OST_TRY_DONE(build_levels(metric, metric->matrix, metric->scaling, geometry, &graph, NULL, levels));
    }
done:
    ost_metric_graph_destroy(&graph);
    return status;
}

static OstStatus build_alone(OstMetric *metric, const OstSolverGeometry *geometry, OstLevels *levels)
{
    OstMetricGraph *graph = NULL;
    double flatness;
    OstStatus status;
    OST_TRY_DONE(ost_metric_graph_create(metric->matrix, geometry, &graph));
    OST_TRY_DONE(ost_metric_graph_flatness(graph, &flatness));
    metric->options.columns = flatness > flattest && metric->options.method != OST_METHOD_TWO_LEVEL;
    OST_TRY_DONE(build_levels(metric, metric->matrix, metric->scaling, geometry, &graph, NULL, levels));
done:
    ost_metric_graph_destroy(&graph);
    return status;
}

OstStatus ost_metric_create(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                            const OstSolverOptions *options, OstMetric **metric)
{
    OstContext *ctx = matrix->ctx;
    OstMetric *made = NULL;
    OstLevels levels = {0};
    OstQuadraticLevel *quadratic = NULL;
    OstStatus status;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &made, 1)));
    made->ctx = ctx;
    made->options = *options;
    made->matrix = matrix;
    OST_TRY_DONE(ost_scaling_create(matrix, &made->scaling));
    if (geometry->coarse)
        OST_TRY_DONE(build_quadratic(made, geometry, &levels, &quadratic));
    else
        OST_TRY_DONE(build_alone(made, geometry, &levels));
    OST_TRY_DONE(ost_cycle_create(ctx, &levels, &quadratic, &made->options, &made->cycle));
    if (options->method == OST_METHOD_STRONG)
        ost_cycle_strengthen(made->cycle, 0, made->options.smoother_ratio);
done:
    ost_quadratic_level_destroy(&quadratic);
    ost_levels_clear(&levels);
    if (status != OST_SUCCESS)
        ost_metric_destroy(&made);
    *metric = made;
    return status;
}

OstStatus ost_metric_measure(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry, OstSolverFacts *facts)
{
    OstMetricGraph *graph = NULL;
    int is_plate = 0;
    OstStatus status;
    OST_TRY_DONE(ost_metric_graph_create(matrix, geometry, &graph));
    OST_TRY_DONE(ost_metric_graph_misalignment(graph, &facts->misalignment));
    OST_TRY_DONE(ost_metric_graph_slenderness(graph, &facts->slenderness));
    OST_TRY_DONE(has_columns(graph, &is_plate));
    if (is_plate)
        facts->slenderness = 0.0;
done:
    ost_metric_graph_destroy(&graph);
    return status;
}

int ost_metric_is_over_linear(const OstMetric *metric)
{
    return metric->over_linear;
}

void ost_metric_strengthen(OstMetric *metric, const OstSolverOptions *options)
{
    ost_cycle_strengthen(metric->cycle, options->smoother_degree - metric->options.smoother_degree,
                         options->smoother_ratio);
    metric->options.smoother_degree = options->smoother_degree;
    metric->options.smoother_ratio = options->smoother_ratio;
}

void ost_metric_system(const OstMetric *metric, OstCgSystem *system, OstPreconditioner *cycle)
{
    *system = (OstCgSystem){.matrix = metric->matrix, .scaling = metric->scaling};
    *cycle = (OstPreconditioner){.data = metric->cycle,
                                 .apply = ost_cycle_apply,
                                 .half = ost_cycle_apply_half,
                                 .brief = ost_cycle_apply_brief,
                                 .precise = metric->options.precise > 0};
}

void ost_metric_report(const OstMetric *metric, OstSolveReport *report)
{
    report->levels = metric->levels;
    for (int l = 0; l < metric->levels; l++)
        report->level_unknowns[l] = metric->level_unknowns[l];
    report->operator_complexity = metric->operator_complexity;
}

OstStatus ost_metric_improve(OstMetric *metric, const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    OstPreconditioner cycle;
    OstCgSystem system;
    ost_metric_system(metric, &system, &cycle);
    ost_metric_report(metric, report);
    snprintf(report->engine, sizeof report->engine, "%s CG, ML cycle of %d levels",
             ost_together_any(metric->ctx) ? "own" : "AztecOO", metric->levels);
    return ost_cg_solve(&system, &cycle, f, u, goal, report);
}
