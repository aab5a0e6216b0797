/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/metric_smoother.h"

#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

enum { POWER_STEPS = 20 };

static const double safety = 1.1; /* of the estimated largest eigenvalue */

void ost_smoother_destroy(OstSmoother **smoother)
{
    if (!*smoother)
        return;
    ost_metric_blocks_destroy(&(*smoother)->blocks);
    OST_FREE((*smoother)->residual);
    OST_FREE((*smoother)->correction);
    OST_FREE((*smoother)->direction);
    OST_FREE(*smoother);
}

static size_t unknowns(const OstMetricOperator *matrix)
{
    return (size_t)matrix->height * (size_t)matrix->rows;
}

/* A number in [-1/2, 1/2) that depends on the global number of the unknown alone. */
static double scatter(uint64_t number)
{
    number = (number + 1) * 0x9e3779b97f4a7c15u; /* splitmix64 */
    number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9u;
    number = (number ^ (number >> 27)) * 0x94d049bb133111ebu;
    return (double)((number ^ (number >> 31)) >> 11) * 0x1p-53 - 0.5;
}

static OstStatus start_vector(OstSmoother *smoother, double *x)
{
    OstContext *ctx = smoother->matrix->ctx;
    const OstGlobal n = (OstGlobal)unknowns(smoother->matrix);
    OstGlobal end = 0;
    OST_TRY(OST_MPI(ctx, MPI_Scan(&n, &end, 1, MPI_INT64_T, MPI_SUM, ost_comm(ctx))));
    for (OstGlobal i = 0; i < n; i++)
        x[i] = scatter((uint64_t)(end - n + i));
    return OST_SUCCESS;
}

/* Power steps on B^-1 A. The quotient of the norms may overshoot a little, which is the safe side. */
static OstStatus estimate_largest(OstSmoother *smoother)
{
    OstContext *ctx = smoother->matrix->ctx;
    const size_t n = unknowns(smoother->matrix);
    double *x = smoother->direction;
    OST_TRY(start_vector(smoother, x));
    for (int step = 0; step < POWER_STEPS; step++) {
        memset(smoother->residual, 0, n * sizeof(double));
        OST_TRY(ost_metric_operator_add(smoother->matrix, 1.0, x, smoother->residual));
        ost_metric_blocks_apply(smoother->blocks, smoother->residual, smoother->correction);
        double squares[2] = {0.0, 0.0};
        for (size_t i = 0; i < n; i++) {
            squares[0] += smoother->correction[i] * smoother->correction[i];
            squares[1] += x[i] * x[i];
        }
        OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, squares, 2, MPI_DOUBLE, MPI_SUM, ost_comm(ctx))));
        if (!(squares[0] > 0.0) || !(squares[1] > 0.0) || !isfinite(squares[0]))
            break;
        smoother->largest = sqrt(squares[0] / squares[1]);
        const double factor = 1.0 / sqrt(squares[0]);
        for (size_t i = 0; i < n; i++)
            x[i] = smoother->correction[i] * factor;
    }
    return OST_SUCCESS;
}

OstStatus ost_smoother_create(const OstMetricOperator *matrix, const OstMetricGraph *graph,
                              const OstSolverOptions *options, OstSmoother **smoother)
{
    OstContext *ctx = matrix->ctx;
    OstSmoother *made = NULL;
    *smoother = NULL;
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &made->residual, unknowns(matrix));
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &made->correction, unknowns(matrix));
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &made->direction, (size_t)matrix->height * (size_t)matrix->columns);
    if (status == OST_SUCCESS)
        status = ost_metric_blocks_create(matrix, graph, options->smoother_block_nodes, &made->blocks);
    OST_TRY_DONE(ost_agree(ctx, status));
    made->matrix = matrix;
    made->degree = options->smoother_degree;
    made->ratio = options->smoother_ratio;
    made->largest = 1.0;
    OST_TRY_DONE(ost_agree(ctx, estimate_largest(made)));
done:
    if (status != OST_SUCCESS)
        ost_smoother_destroy(&made);
    *smoother = made;
    return status;
}

/* direction = keep direction + add correction, and x += direction */
static void step(OstSmoother *smoother, double keep, double add, double *x)
{
    double *restrict direction = smoother->direction;
    const double *restrict correction = smoother->correction;
    const size_t n = unknowns(smoother->matrix);
    for (size_t i = 0; i < n; i++) {
        direction[i] = keep * direction[i] + add * correction[i];
        x[i] += direction[i];
    }
}

/* Saad, Iterative Methods for Sparse Linear Systems, algorithm 12.1. */
OstStatus ost_smoother_apply(OstSmoother *smoother, const double *b, double *x, int from_zero)
{
    const size_t n = unknowns(smoother->matrix);
    const double upper = safety * smoother->largest;
    const double lower = smoother->largest / smoother->ratio;
    const double centre = 0.5 * (upper + lower);
    const double half_width = 0.5 * (upper - lower);
    const double sigma = centre / half_width;
    double rho = 1.0 / sigma;
    memcpy(smoother->residual, b, n * sizeof(double));
    if (from_zero)
        memset(x, 0, n * sizeof(double));
    else
        OST_TRY(ost_metric_operator_add(smoother->matrix, -1.0, x, smoother->residual));
    ost_metric_blocks_apply(smoother->blocks, smoother->residual, smoother->correction);
    step(smoother, 0.0, 1.0 / centre, x);
    for (int k = 1; k < smoother->degree; k++) {
        OST_TRY(ost_metric_operator_add(smoother->matrix, -1.0, smoother->direction, smoother->residual));
        ost_metric_blocks_apply(smoother->blocks, smoother->residual, smoother->correction);
        const double next = 1.0 / (2.0 * sigma - rho);
        step(smoother, next * rho, 2.0 * next / half_width, x);
        rho = next;
    }
    return OST_SUCCESS;
}
