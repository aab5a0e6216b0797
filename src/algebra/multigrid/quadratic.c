/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/quadratic.h"

#include "core/error.h"
#include "core/memory.h"

/* Linear tets leave a wider part of the spectrum to the smoother than aggregates do: two more degrees pay. */
enum { MORE_SMOOTHING = 2 };

void ost_quadratic_level_destroy(OstQuadraticLevel **level)
{
    if (!*level)
        return;
    ost_smoother_destroy(&(*level)->smoother);
    ost_level_matrix_destroy(&(*level)->matrix);
    ost_interpolation_destroy(&(*level)->interpolation);
    OST_FREE(*level);
}

static OstStatus create_matrix(const OstBlockMatrix *matrix, const OstScaling *scaling, OstLevelMatrix **made)
{
    OstDoubleMatrix *source = NULL;
    OstStatus status = ost_agree(matrix->ctx, ost_double_matrix_borrow(matrix, scaling, &source));
    if (status == OST_SUCCESS)
        status = ost_level_matrix_create(source, made);
    ost_double_matrix_destroy(&source);
    return status;
}

OstStatus ost_quadratic_level_create(const OstBlockMatrix *matrix, const OstMetricGraph *graph,
                                     const OstCoarseSpace *space, const OstScaling *quadratic, const OstScaling *linear,
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
    OST_TRY_DONE(create_matrix(matrix, quadratic, &made->matrix));
    OST_TRY_DONE(ost_agree(ctx, ost_interpolation_create(space, quadratic, linear, &made->interpolation)));
    OST_TRY_DONE(ost_smoother_create(made->matrix, graph, &smoothing, &made->smoother));
done:
    if (status != OST_SUCCESS)
        ost_quadratic_level_destroy(&made);
    *level = made;
    return status;
}
