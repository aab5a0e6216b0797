/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/quadratic.h"

#include "core/error.h"
#include "core/kernel.h"
#include "core/memory.h"

#include <string.h>

/* Linear tets leave a wider part of the spectrum to the smoother than aggregates do: two more degrees pay. */
enum { MORE_SMOOTHING = 2, PARENTS = 4 };

void ost_quadratic_level_destroy(OstQuadraticLevel **level)
{
    if (!*level)
        return;
    ost_smoother_destroy(&(*level)->smoother);
    ost_level_matrix_destroy(&(*level)->matrix);
    OST_FREE((*level)->fine);
    OST_FREE(*level);
}

OstStatus ost_quadratic_level_create(const OstBlockMatrix *matrix, const OstMetricGraph *graph,
                                     const OstCoarseSpace *space, const OstScaling *quadratic, const OstScaling *linear,
                                     const OstSolverOptions *options, OstQuadraticLevel **level)
{
    OstContext *ctx = matrix->ctx;
    const size_t fine = 3 * (size_t)matrix->rows, coarse = 3 * (size_t)space->matrix->columns;
    OstSolverOptions smoothing = *options;
    OstDoubleMatrix *view = NULL;
    OstQuadraticLevel *made = NULL;
    smoothing.smoother_degree += MORE_SMOOTHING;
    OstStatus status = OST_NEW(ctx, &made, 1);
    OST_THEN(OST_NEW(ctx, &made->fine, fine + coarse));
    OST_THEN(ost_double_matrix_borrow(matrix, quadratic, &view));
    OST_TRY_DONE(ost_agree(ctx, status));
    made->space = *space;
    made->quadratic = quadratic;
    made->linear = linear;
    made->coarse = made->fine + fine;
    OST_TRY_DONE(ost_level_matrix_create(view, &made->matrix));
    OST_TRY_DONE(ost_smoother_create(made->matrix, graph, &smoothing, &made->smoother));
done:
    ost_double_matrix_destroy(&view);
    if (status != OST_SUCCESS)
        ost_quadratic_level_destroy(&made);
    *level = made;
    return status;
}

OstStatus ost_quadratic_level_prolong(const OstQuadraticLevel *level, const double *c, double *x)
{
    const size_t rows = (size_t)level->quadratic->rows;
    ost_scaling_from_scaled(level->linear, c, level->coarse);
    OST_TRY(ost_halo_import(level->space.matrix->halo, 3 * sizeof(double), level->coarse));
    memset(x, 0, 3 * rows * sizeof *x);
    for (size_t k = 0; k < PARENTS * rows; k++) {
        const OstLocal parent = level->space.parents[k];
        for (size_t i = 0; i < 3 && parent >= 0; i++)
            x[3 * (k / PARENTS) + i] += level->space.weights[k] * level->coarse[3 * (size_t)parent + i];
    }
    ost_scaling_to_scaled_mode(level->quadratic, x, x);
    return OST_SUCCESS;
}

OstStatus ost_quadratic_level_restrict(const OstQuadraticLevel *level, const double *x, double *c)
{
    ost_scaling_unscale_residual(level->quadratic, x, level->fine);
    memset(level->coarse, 0, 3 * (size_t)level->space.matrix->columns * sizeof(double));
    for (size_t k = 0; k < PARENTS * (size_t)level->quadratic->rows; k++) {
        const OstLocal parent = level->space.parents[k];
        for (size_t i = 0; i < 3 && parent >= 0; i++)
            level->coarse[3 * (size_t)parent + i] += level->space.weights[k] * level->fine[3 * (k / PARENTS) + i];
    }
    OST_TRY(ost_halo_add_to_owners(level->space.matrix->halo, 3, level->coarse));
    ost_scaling_to_scaled(level->linear, level->coarse, c);
    return OST_SUCCESS;
}

/* S x, S' x, S^-1 x and S^-T x of a row's scaling, with columns. */
static inline void scale(const double s[6], const OstColumns x[3], OstColumns y[3])
{
    y[0] = s[0] * x[0];
    y[1] = s[1] * x[0] + s[2] * x[1];
    y[2] = s[3] * x[0] + s[4] * x[1] + s[5] * x[2];
}

static inline void scale_back(const double s[6], const OstColumns x[3], OstColumns y[3])
{
    y[0] = s[0] * x[0] + s[1] * x[1] + s[3] * x[2];
    y[1] = s[2] * x[1] + s[4] * x[2];
    y[2] = s[5] * x[2];
}

static inline void unscale(const double s[6], const OstColumns x[3], OstColumns y[3])
{
    y[0] = x[0] / s[0];
    y[1] = (x[1] - s[1] * y[0]) / s[2];
    y[2] = (x[2] - s[3] * y[0] - s[4] * y[1]) / s[5];
}

static inline void unscale_back(const double s[6], const OstColumns x[3], OstColumns y[3])
{
    y[2] = x[2] / s[5];
    y[1] = (x[1] - s[4] * y[2]) / s[2];
    y[0] = (x[0] - s[1] * y[1] - s[3] * y[2]) / s[0];
}

OST_KERNEL OstStatus ost_quadratic_level_prolong_columns(const OstQuadraticLevel *level, const OstColumns *c,
                                                         OstColumns *room, OstColumns *x)
{
    for (size_t n = 0; n < (size_t)level->linear->rows; n++)
        scale_back(level->linear->factor + 6 * n, c + 3 * n, room + 3 * n);
    OST_TRY(ost_halo_import(level->space.matrix->halo, 3 * sizeof(OstColumns), room));
    for (size_t n = 0; n < (size_t)level->quadratic->rows; n++) {
        OstColumns sum[3] = {{0}};
        for (size_t k = PARENTS * n; k < PARENTS * (n + 1); k++)
            for (size_t i = 0; i < 3 && level->space.parents[k] >= 0; i++)
                sum[i] += level->space.weights[k] * room[3 * (size_t)level->space.parents[k] + i];
        unscale_back(level->quadratic->factor + 6 * n, sum, x + 3 * n);
    }
    return OST_SUCCESS;
}

OST_KERNEL OstStatus ost_quadratic_level_restrict_columns(const OstQuadraticLevel *level, const OstColumns *x,
                                                          OstColumns *room, OstColumns *c)
{
    memset(room, 0, 3 * (size_t)level->space.matrix->columns * sizeof *room);
    for (size_t n = 0; n < (size_t)level->quadratic->rows; n++) {
        OstColumns fine[3];
        unscale(level->quadratic->factor + 6 * n, x + 3 * n, fine);
        for (size_t k = PARENTS * n; k < PARENTS * (n + 1); k++)
            for (size_t i = 0; i < 3 && level->space.parents[k] >= 0; i++)
                room[3 * (size_t)level->space.parents[k] + i] += level->space.weights[k] * fine[i];
    }
    OST_TRY(ost_halo_add_to_owners(level->space.matrix->halo, 3 * OST_COLUMNS, (double *)room));
    for (size_t n = 0; n < (size_t)level->linear->rows; n++)
        scale(level->linear->factor + 6 * n, room + 3 * n, c + 3 * n);
    return OST_SUCCESS;
}
