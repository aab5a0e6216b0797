/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/quadratic.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

/* What linear tets cannot show is wider than what aggregates cannot: two more degrees pay. */
enum { MORE_SMOOTHING = 2 };

void ost_quadratic_level_destroy(OstQuadraticLevel **level)
{
    if (!*level)
        return;
    ost_smoother_destroy(&(*level)->smoother);
    ost_level_matrix_destroy(&(*level)->matrix);
    ost_interpolation_destroy(&(*level)->interpolation);
    OST_FREE((*level)->solution);
    OST_FREE((*level)->residual);
    OST_FREE((*level)->right_side);
    OST_FREE((*level)->correction);
    OST_FREE(*level);
}

static OstStatus create_matrix(const OstBlockMatrix *matrix, const OstScaling *scaling, OstLevelMatrix **made)
{
    OstExactMatrix *exact = NULL;
    OstStatus status = ost_agree(matrix->ctx, ost_exact_matrix_borrow(matrix, scaling, &exact));
    if (status == OST_SUCCESS)
        status = ost_level_matrix_create(exact, made);
    ost_exact_matrix_destroy(&exact);
    return status;
}

static OstStatus allocate_vectors(OstQuadraticLevel *level, OstLocal linear_rows)
{
    OstContext *ctx = level->ctx;
    OST_TRY(ost_level_vector_create(ctx, 3, level->matrix->columns, &level->solution));
    OST_TRY(ost_level_vector_create(ctx, 3, level->matrix->rows, &level->residual));
    OST_TRY(ost_level_vector_create(ctx, 3, linear_rows, &level->right_side));
    return ost_level_vector_create(ctx, 3, linear_rows, &level->correction);
}

OstStatus ost_quadratic_level_create(const OstBlockMatrix *matrix, const OstMetricGraph *graph,
                                     const OstCoarseSpace *space, const OstScaling *quadratic,
                                     const OstScaling *linear_scaling, OstCycle *linear,
                                     const OstSolverOptions *options, OstQuadraticLevel **level)
{
    OstContext *ctx = matrix->ctx;
    OstSolverOptions smoothing = *options;
    OstQuadraticLevel *made = NULL;
    *level = NULL;
    smoothing.smoother_degree += MORE_SMOOTHING;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &made, 1));
    if (status != OST_SUCCESS)
        goto done;
    made->ctx = ctx;
    made->linear = linear;
    OST_TRY_DONE(create_matrix(matrix, quadratic, &made->matrix));
    OST_TRY_DONE(ost_agree(ctx, allocate_vectors(made, space->matrix->rows)));
    OST_TRY_DONE(ost_agree(ctx, ost_interpolation_create(space, quadratic, linear_scaling, &made->interpolation)));
    OST_TRY_DONE(ost_smoother_create(made->matrix, graph, &smoothing, &made->smoother));
done:
    if (status != OST_SUCCESS)
        ost_quadratic_level_destroy(&made);
    *level = made;
    return status;
}

OstStatus ost_quadratic_level_apply(OstQuadraticLevel *level, const double *r, double *z)
{
    const size_t n = ost_level_unknowns(level->matrix);
    double *x = level->solution;
    OST_TRY(ost_smoother_apply(level->smoother, r, x, 1));
    memcpy(level->residual, r, n * sizeof *r);
    OST_TRY(ost_level_matrix_add(level->matrix, -1.0, x, level->residual));
    OST_TRY(ost_interpolation_restrict(level->interpolation, level->residual, level->right_side));
    OST_TRY(ost_cycle_solve(level->linear, level->right_side, level->correction));
    OST_TRY(ost_interpolation_add(level->interpolation, level->correction, x));
    OST_TRY(ost_smoother_apply(level->smoother, r, x, 0));
    memcpy(z, x, n * sizeof *z);
    return OST_SUCCESS;
}
