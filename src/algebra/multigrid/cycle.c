/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/cycle.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

enum { INNER_STEPS = 2, COARSEST_STEPS = 50 };

/* Inner iterations stop at this residual; the second is for a coarsest level without a direct solve. */
static const double inner_tolerance = 0.1, coarsest_tolerance = 0.01;

static void destroy_level(OstCycleLevel *level)
{
    OST_FREE(level->right_side);
    OST_FREE(level->solution);
    OST_FREE(level->residual);
    OST_FREE(level->preconditioned);
    OST_FREE(level->product);
    OST_FREE(level->direction);
    OST_FREE(level->direction_product);
}

void ost_cycle_destroy(OstCycle **cycle)
{
    if (!*cycle)
        return;
    for (int l = 0; l < OST_MAX_LEVELS; l++)
        destroy_level(&(*cycle)->level[l]);
    ost_coarsest_destroy(&(*cycle)->coarsest);
    ost_metric_levels_clear(&(*cycle)->levels);
    OST_FREE(*cycle);
}

/* What a level's conjugate gradients need beyond a cycle. */
static OstStatus allocate_inner(OstContext *ctx, OstCycleLevel *level, OstLocal columns)
{
    const int size = level->matrix->size;
    const OstLocal rows = level->matrix->rows;
    OST_TRY(ost_level_vector_create(ctx, size, columns, &level->right_side));
    OST_TRY(ost_level_vector_create(ctx, size, columns, &level->preconditioned));
    OST_TRY(ost_level_vector_create(ctx, size, rows, &level->product));
    OST_TRY(ost_level_vector_create(ctx, size, rows, &level->direction));
    return ost_level_vector_create(ctx, size, rows, &level->direction_product);
}

/* `columns`: the most that any operator reading this level's vectors has. */
static OstStatus allocate_level(OstContext *ctx, OstCycleLevel *level, OstLocal columns, int inner)
{
    const int size = level->matrix->size;
    const OstLocal rows = level->matrix->rows;
    OST_TRY(ost_level_vector_create(ctx, size, columns, &level->solution));
    OST_TRY(ost_level_vector_create(ctx, size, rows, &level->residual));
    return inner ? allocate_inner(ctx, level, columns) : OST_SUCCESS;
}

static OstStatus set_up_level(OstCycle *cycle, int l, const OstSolverOptions *options)
{
    OstMetricLevels *levels = &cycle->levels;
    OstCycleLevel *level = &cycle->level[l];
    level->matrix = levels->matrix[l];
    level->prolongator = levels->prolongator[l];
    OstLocal columns = level->matrix->columns;
    if (l > 0 && levels->prolongator[l - 1]->columns > columns)
        columns = levels->prolongator[l - 1]->columns;
    OST_TRY(ost_agree(cycle->ctx, allocate_level(cycle->ctx, level, columns, l > 0)));
    if (l == levels->count - 1 && !cycle->coarsest)
        OST_TRY(ost_smoother_create(level->matrix, levels->graph[l], options, &levels->smoother[l]));
    level->smoother = levels->smoother[l];
    ost_metric_graph_destroy(&levels->graph[l]);
    return OST_SUCCESS;
}

static OstStatus factor_coarsest(OstCycle *cycle, const OstSolverOptions *options)
{
    OstMetricLevels *levels = &cycle->levels;
    const OstGlobal mine = (OstGlobal)ost_level_unknowns(levels->matrix[levels->count - 1]);
    OstGlobal all = 0;
    OST_TRY(OST_MPI(cycle->ctx, MPI_Allreduce(&mine, &all, 1, MPI_INT64_T, MPI_SUM, ost_comm(cycle->ctx))));
    if (all <= OST_COARSEST_LIMIT || levels->count >= options->most_levels)
        OST_TRY(ost_coarsest_create(levels->coarsest, options->factor_memory, &cycle->coarsest));
    ost_exact_matrix_destroy(&levels->coarsest);
    return OST_SUCCESS;
}

OstStatus ost_cycle_create(OstContext *ctx, OstMetricLevels *levels, const OstSolverOptions *options, OstCycle **cycle)
{
    OstCycle *made = NULL;
    *cycle = NULL;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &made, 1));
    if (status != OST_SUCCESS)
        goto done;
    made->ctx = ctx;
    made->inner_steps = INNER_STEPS;
    made->levels = *levels;
    memset(levels, 0, sizeof *levels);
    OST_TRY_DONE(factor_coarsest(made, options));
    for (int l = 0; l < made->levels.count; l++)
        OST_TRY_DONE(set_up_level(made, l, options));
done:
    if (status != OST_SUCCESS)
        ost_cycle_destroy(&made);
    *cycle = made;
    return status;
}

static OstStatus solve_coarse(OstCycle *cycle, int l);

/* x = one cycle from zero for A x = b on level l; x has room for ghosts. */
static OstStatus descend(OstCycle *cycle, int l, const double *b, double *x)
{
    OstCycleLevel *level = &cycle->level[l];
    if (!level->prolongator)
        return cycle->coarsest ? ost_coarsest_solve(cycle->coarsest, b, x)
                               : ost_smoother_apply(level->smoother, b, x, 1);
    OstCycleLevel *coarse = level + 1;
    OST_TRY(ost_smoother_apply(level->smoother, b, x, 1));
    memcpy(level->residual, b, ost_level_unknowns(level->matrix) * sizeof *b);
    OST_TRY(ost_level_matrix_add(level->matrix, -1.0, x, level->residual));
    OST_TRY(ost_prolongator_restrict(level->prolongator, level->residual, coarse->right_side));
    OST_TRY(solve_coarse(cycle, l + 1));
    OST_TRY(ost_prolongator_add(level->prolongator, coarse->solution, x));
    return ost_smoother_apply(level->smoother, b, x, 0);
}

static double dot(size_t n, const double *a, const double *b)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; i++)
        sum += a[i] * b[i];
    return sum;
}

static OstStatus sum_over_ranks(const OstCycle *cycle, int count, double *sums)
{
    return OST_MPI(cycle->ctx, MPI_Allreduce(MPI_IN_PLACE, sums, count, MPI_DOUBLE, MPI_SUM, ost_comm(cycle->ctx)));
}

/* One step of flexible conjugate gradients from the residual r, which it updates along with x. `scale` carries p·Ap
 * over the steps, 0 before the first. *square becomes ||r||², as the recurrence has it; a step that would not go down
 * is not taken and sets it to 0. */
static OstStatus inner_step(OstCycle *cycle, int l, double *r, double *x, double *scale, double *square)
{
    OstCycleLevel *level = &cycle->level[l];
    const size_t n = ost_level_unknowns(level->matrix);
    double *z = level->preconditioned, *az = level->product;
    double *p = level->direction, *ap = level->direction_product;
    OST_TRY(descend(cycle, l, r, z));
    memset(az, 0, n * sizeof *az);
    OST_TRY(ost_level_matrix_add(level->matrix, 1.0, z, az));
    if (*scale > 0.0) {
        double overlap = dot(n, z, ap);
        OST_TRY(sum_over_ranks(cycle, 1, &overlap));
        const double beta = overlap / *scale;
        for (size_t i = 0; i < n; i++) {
            p[i] = z[i] - beta * p[i];
            ap[i] = az[i] - beta * ap[i];
        }
    } else {
        memcpy(p, z, n * sizeof *p);
        memcpy(ap, az, n * sizeof *ap);
    }
    double sums[5] = {dot(n, p, ap), dot(n, p, r), dot(n, r, r), dot(n, r, ap), dot(n, ap, ap)};
    OST_TRY(sum_over_ranks(cycle, 5, sums));
    *scale = sums[0];
    *square = 0.0;
    if (!(sums[0] > 0.0) || !(sums[2] > 0.0))
        return OST_SUCCESS;
    const double alpha = sums[1] / sums[0];
    for (size_t i = 0; i < n; i++) {
        x[i] += alpha * p[i];
        r[i] -= alpha * ap[i];
    }
    *square = sums[2] - 2.0 * alpha * sums[3] + alpha * alpha * sums[4];
    return OST_SUCCESS;
}

/* Solves on level l, roughly unless it is the coarsest, from right_side (which is used up) into solution. */
static OstStatus solve_coarse(OstCycle *cycle, int l)
{
    OstCycleLevel *level = &cycle->level[l];
    const size_t n = ost_level_unknowns(level->matrix);
    const int smoother_only = !level->prolongator && !cycle->coarsest;
    const int steps = smoother_only ? COARSEST_STEPS : cycle->inner_steps;
    const double tolerance = smoother_only ? coarsest_tolerance : inner_tolerance;
    double *r = level->right_side, *x = level->solution;
    if ((!level->prolongator && cycle->coarsest) || steps == 1)
        return descend(cycle, l, r, x);
    double first = dot(n, r, r), square = 0.0, scale = 0.0;
    OST_TRY(sum_over_ranks(cycle, 1, &first));
    memset(x, 0, n * sizeof *x);
    for (int k = 0; k < steps; k++) {
        OST_TRY(inner_step(cycle, l, r, x, &scale, &square));
        if (square <= tolerance * tolerance * first)
            break;
    }
    return OST_SUCCESS;
}

OstStatus ost_cycle_apply(OstCycle *cycle, const double *r, double *z)
{
    OstCycleLevel *level = &cycle->level[0];
    OST_TRY(descend(cycle, 0, r, level->solution));
    memcpy(z, level->solution, ost_level_unknowns(level->matrix) * sizeof *z);
    return OST_SUCCESS;
}

OstStatus ost_cycle_solve(OstCycle *cycle, const double *r, double *z)
{
    OstCycleLevel *level = &cycle->level[0];
    const size_t n = ost_level_unknowns(level->matrix);
    if (!level->direction_product)
        OST_TRY(ost_agree(cycle->ctx, allocate_inner(cycle->ctx, level, level->matrix->columns)));
    memcpy(level->right_side, r, n * sizeof *r);
    OST_TRY(solve_coarse(cycle, 0));
    memcpy(z, level->solution, n * sizeof *z);
    return OST_SUCCESS;
}
