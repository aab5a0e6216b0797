/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/levels.h"

#include "algebra/aggregation/aggregates.h"
#include "algebra/aggregation/columns.h"
#include "algebra/level/galerkin.h"
#include "algebra/matrix/vector.h"
#include "algebra/multigrid/gathered_level.h"
#include "algebra/multigrid/prolongator_smoothing.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <math.h>
#include <string.h>

/* A level is dropped if it has more than this fraction of the unknowns of the finer one. */
static const double least_gain = 0.8;

/* Coarse nodes are apart where the strength of their connection is below the first, or this over the root of the
 * largest jump of stiffness. */
static const double weakest = 0.03, weak_jump = 10.0;

/* A coarse node is alone where the squares of its connections' strengths add up to less. */
static const double alone = 1e-4;

/* Up to a ratio of 1000 between Young's moduli (shortening, its root, up to 32) the options are used as they are.
 * Beyond it the stiff direction is nearly inextensible: the six modes of an aggregate represent that over few nodes
 * only, and the smoother's blocks must be as large. Iterations on the tube of cases/tube with a ratio of 1e6, stiff
 * along, through the wall and around: 25, 108 and over 300 with the default options; 12, 18 and 53 with aggregates of
 * 12 nodes and blocks of 10. */
static const double unchanged_shortening = 32.0, fewest_nodes = 10.0;

/* A coarse level's aggregates have at least this share of the blocks in its rows, up to so many nodes. Where aggregates
 * of the option's 8 nodes have 60 neighbours, as in a solid body, the next level is nearly full: with a third of 60 the
 * iterations are the same and its product and prolongator a quarter of the work. Along a wall of one aggregate there
 * are 12 to 20 neighbours, and larger aggregates would cost iterations. So they do below quadratic tets that are
 * corrected by aggregates of their nodes or by their vertices: a bracket with E3 x 1000 takes 59 and 65 iterations with
 * up to 27, 38 and 48 with 10. */
static const double row_share = 1.0 / 3.0, most_coarse_nodes = 27.0, most_below_quadratic = 10.0;

/* Where no factors fit into memory, coarse aggregates of so many nodes take the place of a factored second level.
 * Linear tets at 0.999 of the border of stability, E3 x 1e6 along circles: a tube of 16,632 unknowns takes 74
 * iterations with the second level factored, 525 by METRIC and 207 by STRONG with these; one of about 60,000 takes 236
 * with these. */
static const double few_coarse_nodes = 3.0;

/* A patch of quadratic tets grows by as many layers of nodes: slivers of 17,442 unknowns take 465 iterations with one
 * and 80 with two, at 1.8 times the price. */
static const int layers_of_quadratic = 2;

/* The columns of a plate of quadratic tets are nodes of a flat mesh, whose factors are small: they are not coarsened
 * further, up to so many unknowns. */
static const OstGlobal flat_unknowns = 250000;

/* Of a rotation's energy so much is added to it, in single precision and where levels keep what that rounds off. It
 * must be far below a jump of stiffness, as rigid inclusions turn too: 18 spheres, 1e9 times stiffer than a matrix of
 * ratio 1000, take 151 iterations with 1e-6 (condition 96) and 44 with 1e-9 and 1e-12 (4.1). */
static const double held = 1e-6, held_precisely = 1e-12;

/* The levels under construction, from the finest down. */
typedef struct Coarsening {
    OstContext *ctx;
    OstSolverOptions options;
    OstLevels *levels;
    double **modes;         /* near-null space of the coarsest level so far */
    OstGlobal unknowns;     /* on all ranks */
    int stride;             /* every how manyth rank has nodes of it */
    OstAggregates *columns; /* of a plate, until they are the finest level's aggregates; else NULL */
    int by_columns;         /* are they the aggregates at hand? */
    int has_vertices;       /* is the second level that of vertices? */
} Coarsening;

static OstStatus adapt_options(const OstMetricGraph *graph, OstSolverOptions *options)
{
    double shortening;
    OST_TRY(ost_metric_graph_shortening(graph, &shortening));
    if (shortening <= unchanged_shortening)
        return OST_SUCCESS;
    const double factor = shortening / unchanged_shortening;
    const double aggregate = options->aggregate_nodes, block = options->smoother_block_nodes;
    if (!(options->given & OST_GIVEN_AGGREGATE) && !options->fine)
        options->aggregate_nodes = fmin(aggregate, fmax(aggregate / factor, fewest_nodes));
    if (!(options->given & OST_GIVEN_BLOCK))
        options->smoother_block_nodes = fmax(block, fmin(block * factor, fewest_nodes));
    return OST_SUCCESS;
}

/* A coarse node's strength of connection is |A_ij| / sqrt(|A_ii| |A_jj|), Frobenius norms of blocks. Of two aggregates
 * with a jump of stiffness between them it is about one over its root; once a whole inclusion is one aggregate, its
 * block has the softness of what is around it, and the connection is strong. */
static void part_weak(const OstDoubleMatrix *matrix, OstMetricGraph *graph)
{
    const double least = fmin(weakest, weak_jump / sqrt(graph->jump));
    const int entries = matrix->size * matrix->size;
    for (OstLocal i = 0; i < graph->nodes; i++)
        for (OstLocal k = graph->edge_start[i]; k < graph->edge_start[i + 1]; k++) {
            const OstLocal j = graph->neighbour[k];
            const double *between = ost_double_matrix_find(matrix, i, j);
            const double *own = ost_double_matrix_diagonal(matrix, i), *other = ost_double_matrix_diagonal(matrix, j);
            const double square = ost_dot((size_t)entries, between, between);
            const double own_square = ost_dot((size_t)entries, own, own);
            const double other_square = ost_dot((size_t)entries, other, other);
            if (square < least * least * sqrt(own_square * other_square))
                graph->length[k] = INFINITY;
        }
}

/* Is the node hardly connected to others, as a soft pocket between stiff cells? By the sum of its connections' squared
 * strengths; only where all of them are this rank's. */
static int is_alone(const OstDoubleMatrix *matrix, OstLocal i)
{
    const size_t entries = (size_t)(matrix->size * matrix->size);
    const double *own = ost_double_matrix_diagonal(matrix, i);
    const double own_square = ost_dot(entries, own, own);
    double sum = 0.0, room[OST_BLOCK];
    for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++) {
        const OstLocal j = matrix->column[k];
        if (j >= matrix->rows)
            return 0;
        if (j == i)
            continue;
        const double *between = ost_double_matrix_block(matrix, matrix->size, i, k, room);
        const double *other = ost_double_matrix_diagonal(matrix, j);
        sum += ost_dot(entries, between, between) / sqrt(own_square * ost_dot(entries, other, other));
    }
    return sum < alone;
}

/* Leaves nodes that are alone to the smoother, which solves for them: they would be nodes of all coarser levels, too
 * many to be factored. */
static OstStatus leave_alone(const OstDoubleMatrix *matrix, OstAggregates *aggregates)
{
    OstLocal *number = NULL, count = 0;
    OST_TRY(OST_NEW(matrix->ctx, &number, aggregates->count));
    for (OstLocal i = 0; i < matrix->rows; i++) /* nodes of each, up to here */
        if (aggregates->of_node[i] >= 0)
            number[aggregates->of_node[i]]++;
    for (OstLocal i = 0; i < matrix->rows; i++)
        if (aggregates->of_node[i] >= 0 && number[aggregates->of_node[i]] == 1 && is_alone(matrix, i))
            aggregates->of_node[i] = -1;
    memset(number, 0, (size_t)aggregates->count * sizeof *number);
    for (OstLocal i = 0; i < matrix->rows; i++)
        if (aggregates->of_node[i] >= 0)
            number[aggregates->of_node[i]] = 1;
    for (OstLocal a = 0; a < aggregates->count; a++)
        number[a] = number[a] ? count++ : -1;
    for (OstLocal i = 0; i < matrix->rows; i++)
        if (aggregates->of_node[i] >= 0)
            aggregates->of_node[i] = number[aggregates->of_node[i]];
    aggregates->count = count;
    OST_FREE(number);
    return OST_SUCCESS;
}

/* Nodes of an aggregate of level l, which is the coarsest so far. */
static OstStatus choose_target(const Coarsening *work, int l, double *target)
{
    const OstSolverOptions *options = &work->options;
    const OstLevelMatrix *matrix = work->levels->matrix[l];
    const OstGlobal square = matrix->size * matrix->size;
    OstGlobal entries[2] = {matrix->nonzeros, square * matrix->rows};
    *target = l == 0 ? options->aggregate_nodes : options->coarse_aggregate_nodes;
    const double most = options->own_blocks || work->has_vertices ? most_below_quadratic : most_coarse_nodes;
    if (l == 0 || options->given & OST_GIVEN_COARSE_AGGREGATE)
        return OST_SUCCESS;
    if (options->fine) {
        *target = few_coarse_nodes;
        return OST_SUCCESS;
    }
    OST_TRY(ost_sum_numbers(work->ctx, 2, entries));
    *target = fmax(*target, fmin(row_share * (double)entries[0] / (double)entries[1], most));
    return OST_SUCCESS;
}

/* Aggregates the coarsest level so far; also the graph of the next level and its unknowns over all ranks. */
static OstStatus aggregate(Coarsening *work, OstAggregates **aggregates, OstGlobal *unknowns)
{
    const int l = work->levels->count - 1;
    OstMetricGraph *graph = work->levels->graph[l];
    if (l > 0 && ost_metric_graph_is_uneven(graph))
        part_weak(work->levels->coarsest, graph);
    /* Two nodes of 3 unknowns cannot represent the six rigid modes; a coarse node has all six. */
    OstAggregateShape shape = {.minimum = l == 0 ? 3 : 1, .recentrings = 2};
    OST_TRY(choose_target(work, l, &shape.target));
    *aggregates = work->columns;
    work->columns = NULL;
    work->by_columns = *aggregates != NULL;
    OstStatus status = *aggregates ? OST_SUCCESS : ost_aggregates_create(graph, &shape, aggregates);
    if (l > 0 && ost_metric_graph_is_uneven(graph))
        OST_THEN(leave_alone(work->levels->coarsest, *aggregates));
    OST_THEN(ost_metric_graph_coarsen(graph, *aggregates, &work->levels->graph[l + 1]));
    OST_TRY(ost_agree(work->ctx, status));
    *unknowns = OST_MODES * (OstGlobal)(*aggregates)->count;
    OST_TRY(ost_sum_numbers(work->ctx, 1, unknowns));
    work->levels->flat = work->by_columns && work->options.columns == 2 && *unknowns <= flat_unknowns;
    if (work->levels->flat)
        work->options.most_levels = 2;
    return OST_SUCCESS;
}

/* Does level l keep what single precision rounds off? */
static int is_precise(const OstSolverOptions *options, const OstLevels *levels, int l)
{
    return ost_metric_graph_is_uneven(levels->graph[l]) || options->precise > (l == 0);
}

/* The cycle's matrix of level l, which is the coarsest so far. */
static OstStatus create_matrix(const OstSolverOptions *options, OstLevels *levels, int l)
{
    OST_TRY(ost_level_matrix_create(levels->coarsest, &levels->matrix[l]));
    if (!is_precise(options, levels, l))
        return OST_SUCCESS;
    return ost_agree(levels->coarsest->ctx, ost_level_matrix_keep_rest(levels->coarsest, levels->matrix[l]));
}

/* A level that is solved by dense factors goes to one rank, another one to as many as have enough to do. One that is
 * factored by MUMPS stays where it is. */
static OstStatus gather(Coarsening *work, OstGlobal first, OstGlobal unknowns, OstDoubleMatrix **coarse)
{
    const int l = work->levels->count - 1;
    const int together = unknowns <= work->options.coarsest_unknowns;
    const int stride = ost_gathered_stride(unknowns / OST_MODES, ost_size(work->ctx), work->stride, together);
    if (stride == work->stride || (!together && l + 2 >= work->options.most_levels))
        return OST_SUCCESS;
    OstLooseLevel level = {.matrix = coarse,
                           .graph = &work->levels->graph[l + 1],
                           .modes = work->modes,
                           .prolongator = work->levels->prolongator[l],
                           .first = first};
    work->stride = stride;
    return ost_level_gather(&level, stride);
}

/* Interpolates over the blocks of the level's smoother; or over the aggregates themselves, if they are as small as
 * blocks: an aggregate's own function stays whole, and its neighbours bend least to meet it. Iterations of quadratic
 * tets on unstructured meshes, ratio 1000, by blocks of the smoother and by aggregates: 44 42 36 50 51 50 and 37 37 29
 * 40 40 45. Larger blocks of the smoother itself gain nothing. Columns of a plate are rigid as they are: with their
 * matrix factored the condition is 2 (isotropic) to 150 (ratio 1e6, axes that vary), and their matrix stays a flat
 * mesh's. */
static OstStatus smooth_prolongator(const Coarsening *work, const OstTentative *tentative,
                                    const OstAggregates *aggregates, OstSmoother **by)
{
    OstLevels *levels = work->levels;
    const int l = levels->count - 1;
    if ((work->options.own_blocks || work->by_columns) && l == 0)
        OST_TRY(ost_smoother_create_of(levels->matrix[l], levels->graph[l], aggregates, &work->options, by));
    else
        *by = levels->smoother[l];
    if (work->by_columns)
        return ost_tentative_keep(tentative, levels->coarsest, &levels->prolongator[l]);
    return ost_tentative_smooth(tentative, levels->coarsest, *by, &levels->prolongator[l]);
}

/* Where no factors fit, the finest level is smoothed over patches; its smoother has just been made. */
static OstStatus add_patches(Coarsening *work)
{
    const OstLevels *levels = work->levels;
    if (!work->options.patches || levels->count > 1)
        return OST_SUCCESS;
    return ost_smoother_add_patches(levels->coarsest, levels->graph[0], work->options.fine ? 1 : layers_of_quadratic,
                                    work->options.patches > 1, levels->smoother[0]);
}

/* Adds the level below the coarsest so far. Below vertices that turn, aggregates are the smoother's blocks too: with
 * others the quadratic tets of two brackets and a pin, ratio 1000, take 49, 35 and 26 iterations in place of 41, 28
 * and 23; below linear tets it gains nothing. The Galerkin product is the peak of memory: all that can is freed before.
 */
static OstStatus add_level(Coarsening *work, const OstAggregates *aggregates, OstGlobal unknowns)
{
    OstLevels *levels = work->levels;
    const int l = levels->count - 1;
    OstTentative *tentative = NULL;
    OstDoubleMatrix *coarse = NULL;
    OstSmoother *by = NULL; /* what the prolongator is smoothed by */
    OstStatus status = ost_tentative_create(levels->coarsest, aggregates, *work->modes, work->by_columns, &tentative);
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(ost_smoother_create_of(levels->matrix[l], levels->graph[l], work->has_vertices ? aggregates : NULL,
                                        &work->options, &levels->smoother[l]));
    OST_TRY_DONE(add_patches(work));
    OST_TRY_DONE(smooth_prolongator(work, tentative, aggregates, &by));
    ost_metric_graph_destroy(&levels->graph[l]);
    const OstGlobal first = tentative->first_coarse;
    OST_FREE(*work->modes);
    *work->modes = tentative->modes;
    tentative->modes = NULL;
    ost_tentative_destroy(&tentative);
    OST_TRY_DONE(ost_galerkin_create(levels->coarsest, by->blocks, levels->prolongator[l], first, &coarse));
    ost_double_matrix_mend_diagonal(coarse);
    ost_double_matrix_destroy(&levels->coarsest);
    levels->coarsest = coarse;
    OST_TRY_DONE(gather(work, first, unknowns, &levels->coarsest));
    OST_TRY_DONE(create_matrix(&work->options, levels, l + 1));
    levels->count++;
done:
    if (by != levels->smoother[l])
        ost_smoother_destroy(&by);
    ost_tentative_destroy(&tentative);
    return status;
}

/* Blocks of one node each, for the Galerkin product: rows of the vertices' prolongator share no columns. */
static OstStatus list_nodes(OstContext *ctx, OstLocal nodes, OstSmootherBlocks *each)
{
    OST_TRY(OST_NEW(ctx, &each->node_start, nodes + 1));
    OST_TRY(OST_NEW(ctx, &each->node, nodes));
    each->count = nodes;
    for (OstLocal i = 0; i < nodes; i++) {
        each->node[i] = i;
        each->node_start[i + 1] = i + 1;
    }
    return OST_SUCCESS;
}

/* Vertices that all turn alike, and are not displaced, move no node: the level's matrix is singular there, and could
 * not be factored. */
static void hold_rotations(OstDoubleMatrix *coarse, double share)
{
    for (OstLocal v = 0; v < coarse->rows; v++) {
        double *block = ost_double_matrix_diagonal(coarse, v);
        for (int i = OST_MODES / 2; i < OST_MODES; i++)
            block[(OST_MODES + 1) * i] *= 1.0 + share;
    }
}

/* Adds the level of the vertices below the finest. */
static OstStatus add_vertices(Coarsening *work, OstVertexSpace *vertices)
{
    OstLevels *levels = work->levels;
    OstSmootherBlocks each = {0};
    OstDoubleMatrix *coarse = NULL;
    OstGlobal unknowns = OST_MODES * (OstGlobal)vertices->graph->nodes;
    OstStatus status;
    OST_TRY_DONE(ost_sum_numbers(work->ctx, 1, &unknowns));
    OST_TRY_DONE(ost_smoother_create(levels->matrix[0], levels->graph[0], &work->options, &levels->smoother[0]));
    OST_TRY_DONE(add_patches(work));
    ost_metric_graph_destroy(&levels->graph[0]);
    OST_FREE(*work->modes);
    levels->prolongator[0] = vertices->prolongator;
    levels->graph[1] = vertices->graph;
    *work->modes = vertices->modes;
    *vertices = (OstVertexSpace){.first = vertices->first};
    OST_TRY_DONE(ost_agree(work->ctx, list_nodes(work->ctx, levels->prolongator[0]->rows, &each)));
    OST_TRY_DONE(ost_galerkin_create(levels->coarsest, &each, levels->prolongator[0], vertices->first, &coarse));
    ost_double_matrix_mend_diagonal(coarse);
    hold_rotations(coarse, is_precise(&work->options, levels, 1) ? held_precisely : held);
    ost_double_matrix_destroy(&levels->coarsest);
    levels->coarsest = coarse;
    OST_TRY_DONE(gather(work, vertices->first, unknowns, &levels->coarsest));
    OST_TRY_DONE(create_matrix(&work->options, levels, 1));
    levels->count++;
    work->unknowns = unknowns;
done:
    OST_FREE(each.node_start, each.node);
    return status;
}

static OstStatus coarsen(Coarsening *work)
{
    OstLevels *levels = work->levels;
    OstAggregates *aggregates = NULL;
    OstStatus status = OST_SUCCESS;
    while (work->unknowns > work->options.coarsest_unknowns && levels->count < work->options.most_levels) {
        OstGlobal unknowns = 0;
        OST_TRY_DONE(aggregate(work, &aggregates, &unknowns));
        if (unknowns == 0 || (double)unknowns > least_gain * (double)work->unknowns) {
            ost_metric_graph_destroy(&levels->graph[levels->count]);
            levels->flat = 0;
            break;
        }
        OST_TRY_DONE(add_level(work, aggregates, unknowns));
        ost_aggregates_destroy(&aggregates);
        work->unknowns = unknowns;
    }
done:
    ost_aggregates_destroy(&aggregates);
    OST_FREE(*work->modes);
    return status;
}

/* The softest motions of a plate lie in its finest level. */
static OstStatus find_columns(Coarsening *work)
{
    OST_TRY(ost_columns_create(work->levels->graph[0], &work->columns));
    if (work->columns)
        work->options.precise = 2;
    else
        work->options.columns = 0;
    return OST_SUCCESS;
}

OstStatus ost_levels_create(const OstBlockMatrix *matrix, const OstScaling *scaling, double **modes,
                            OstMetricGraph **finest_graph, OstVertexSpace *vertices, const OstSolverOptions *options,
                            OstLevels *levels)
{
    Coarsening work = {.ctx = matrix->ctx,
                       .options = *options,
                       .levels = levels,
                       .modes = modes,
                       .unknowns = 3 * matrix->global_rows,
                       .stride = 1,
                       .has_vertices = vertices != NULL};
    memset(levels, 0, sizeof *levels);
    levels->count = 1;
    levels->graph[0] = *finest_graph;
    *finest_graph = NULL;
    OstStatus status = ost_agree(matrix->ctx, ost_double_matrix_borrow(matrix, scaling, &levels->coarsest));
    if (status == OST_SUCCESS && options->columns)
        status = find_columns(&work);
    OST_THEN(create_matrix(&work.options, levels, 0));
    OST_THEN(adapt_options(levels->graph[0], &work.options));
    if (status == OST_SUCCESS && vertices)
        status = add_vertices(&work, vertices);
    OST_THEN(coarsen(&work));
    ost_aggregates_destroy(&work.columns);
    if (status != OST_SUCCESS)
        ost_levels_clear(levels);
    return status;
}

void ost_levels_clear(OstLevels *levels)
{
    for (int l = 0; l < OST_MAX_LEVELS; l++) {
        ost_smoother_destroy(&levels->smoother[l]);
        ost_level_matrix_destroy(&levels->matrix[l]);
        ost_prolongator_destroy(&levels->prolongator[l]);
        ost_metric_graph_destroy(&levels->graph[l]);
    }
    ost_double_matrix_destroy(&levels->coarsest);
    levels->count = 0;
}
