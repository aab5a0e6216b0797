/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_SMOOTHER_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_SMOOTHER_H

#include "algebra/level/smoother_blocks.h"

/* Chebyshev polynomial in block Jacobi times the matrix, over the upper part of its spectrum. From a zero guess it is a
 * symmetric positive definite operator. */
typedef struct OstSmoother {
    const OstLevelMatrix *matrix;
    OstSmootherBlocks *blocks;
    int degree;
    double ratio;
    double largest; /* eigenvalue of B^-1 A, estimated */
    double *residual, *direction;
} OstSmoother;

/* Collective. The matrix stays the caller's and outlives the smoother; the graph is not kept. */
OstStatus ost_smoother_create(const OstLevelMatrix *matrix, const OstMetricGraph *graph,
                              const OstSolverOptions *options, OstSmoother **smoother);
void ost_smoother_destroy(OstSmoother **smoother);

/* Collective over neighbours. Improves x towards A x = b; with `from_zero`, x is taken to be 0. */
OstStatus ost_smoother_apply(OstSmoother *smoother, const double *b, double *x, int from_zero);

#endif
