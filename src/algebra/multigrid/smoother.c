/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/smoother.h"

#include "algebra/multigrid/spectrum.h"
#include "core/error.h"
#include "core/memory.h"

#include <string.h>

static const double safety = 1.1; /* factor on the estimated largest eigenvalue */

void ost_smoother_destroy(OstSmoother **smoother)
{
    if (!*smoother)
        return;
    ost_smoother_blocks_destroy(&(*smoother)->blocks);
    ost_patches_destroy(&(*smoother)->patches);
    OST_FREE((*smoother)->residual);
    OST_FREE(*smoother);
}

/* z = B^-1 r. `direction` is scratch here. */
static void apply_blocks(const void *data, const double *r, double *z)
{
    const OstSmoother *smoother = data;
    const OstBlockStep step = {.keep = 0.0, .add = 1.0, .direction = z, .x = smoother->direction, .from_zero = 1};
    ost_smoother_blocks_step(smoother->blocks, &step, r);
}

OstStatus ost_smoother_create_of(const OstLevelMatrix *matrix, const OstMetricGraph *graph, const OstAggregates *groups,
                                 const OstSolverOptions *options, OstSmoother **smoother)
{
    OstContext *ctx = matrix->ctx;
    OstSmoother *made = NULL;
    *smoother = NULL;
    OstStatus status = OST_NEW(ctx, &made, 1);
    OST_THEN(
        ost_level_vector_create(ctx, matrix->size, (size_t)matrix->rows + (size_t)matrix->columns, &made->residual));
    if (status == OST_SUCCESS && groups)
        status = ost_smoother_blocks_of(matrix, groups, &made->blocks);
    else if (status == OST_SUCCESS)
        status = ost_smoother_blocks_create(matrix, graph, options->smoother_block_nodes, &made->blocks);
    OST_TRY_DONE(ost_agree(ctx, status));
    made->matrix = matrix;
    made->direction = made->residual + ost_level_unknowns(matrix); /* which is the residual's padding */
    made->degree = options->smoother_degree;
    made->ratio = options->smoother_ratio;
    OST_TRY_DONE(ost_largest_eigenvalue(matrix, apply_blocks, made, &made->largest));
done:
    if (status != OST_SUCCESS)
        ost_smoother_destroy(&made);
    *smoother = made;
    return status;
}

OstStatus ost_smoother_create(const OstLevelMatrix *matrix, const OstMetricGraph *graph,
                              const OstSolverOptions *options, OstSmoother **smoother)
{
    return ost_smoother_create_of(matrix, graph, NULL, options, smoother);
}

/* Ranks sweep at the same time: as much of the largest eigenvalue of what they do together is taken as is above 1. */
OstStatus ost_smoother_add_patches(const OstDoubleMatrix *stiffness, const OstMetricGraph *graph, int layers, int safe,
                                   OstSmoother *smoother)
{
    double largest = 1.0;
    OST_TRY(ost_patches_create(stiffness, graph, layers, safe, &smoother->patches));
    if (ost_size(stiffness->ctx) > 1)
        OST_TRY(ost_largest_eigenvalue(smoother->matrix, ost_patches_solve, smoother->patches, &largest));
    smoother->weight = largest > 1.0 ? 1.0 / (safety * largest) : 1.0;
    return OST_SUCCESS;
}

/* Chebyshev iteration: Saad, Iterative Methods for Sparse Linear Systems, algorithm 12.1. */
OstChebyshev ost_smoother_begin(const OstSmoother *smoother)
{
    const double upper = safety * smoother->largest, lower = smoother->largest / smoother->ratio;
    const double centre = 0.5 * (upper + lower), half_width = 0.5 * (upper - lower), sigma = centre / half_width;
    return (OstChebyshev){.add = 1.0 / centre, .rho = 1.0 / sigma, .sigma = sigma, .half_width = half_width};
}

void ost_smoother_next(OstChebyshev *steps)
{
    const double next = 1.0 / (2.0 * steps->sigma - steps->rho);
    steps->keep = next * steps->rho;
    steps->add = 2.0 * next / steps->half_width;
    steps->rho = next;
}

/* residual = b - A x */
static void find_residual(OstSmoother *smoother, const double *b, const double *x, int from_zero)
{
    const size_t n = ost_level_unknowns(smoother->matrix);
    if (n > 0)
        memcpy(smoother->residual, b, n * sizeof(double));
    if (from_zero)
        return;
    if (n > 0)
        memcpy(smoother->direction, x, n * sizeof(double));
    ost_level_matrix_add(smoother->matrix, -1.0, smoother->direction, smoother->residual);
}

static void sweep(OstSmoother *smoother, double *x, int from_zero)
{
    const size_t n = ost_level_unknowns(smoother->matrix);
    if (n > 0)
        memset(smoother->direction, 0, n * sizeof(double));
    ost_patches_sweep(smoother->patches, !from_zero, smoother->residual, smoother->direction);
    for (size_t i = 0; i < n; i++)
        x[i] = (from_zero ? 0.0 : x[i]) + smoother->weight * smoother->direction[i];
}

void ost_smoother_apply(OstSmoother *smoother, const double *b, double *x, int from_zero)
{
    OstChebyshev steps = ost_smoother_begin(smoother);
    find_residual(smoother, b, x, from_zero);
    if (smoother->patches) {
        sweep(smoother, x, from_zero);
        return;
    }
    OstBlockStep step = {.add = steps.add, .direction = smoother->direction, .x = x, .from_zero = from_zero};
    ost_smoother_blocks_step(smoother->blocks, &step, smoother->residual);
    step.from_zero = 0;
    for (int k = 1; k < smoother->degree; k++) {
        ost_level_matrix_add(smoother->matrix, -1.0, smoother->direction, smoother->residual);
        ost_smoother_next(&steps);
        step.keep = steps.keep;
        step.add = steps.add;
        ost_smoother_blocks_step(smoother->blocks, &step, smoother->residual);
    }
}
