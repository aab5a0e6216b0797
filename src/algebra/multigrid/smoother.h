/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_SMOOTHER_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_SMOOTHER_H

#include "algebra/level/patches.h"
#include "algebra/level/smoother_blocks.h"

/* Chebyshev iteration preconditioned by block Jacobi, over the upper end of the spectrum of B^-1 A. From a zero guess
 * it is a symmetric positive definite operator. Or, where there are patches, a sweep over them: from a zero guess in
 * their order, else in the reverse one, so that a cycle is symmetric. */
typedef struct OstSmoother {
    const OstLevelMatrix *matrix;
    OstSmootherBlocks *blocks;
    int degree;
    double ratio;   /* the interval is [largest / ratio, 1.1 largest] */
    double largest; /* eigenvalue of B^-1 A, estimated */
    double *residual, *direction;
    OstPatches *patches; /* NULL: none */
    double weight;       /* of a sweep: below 1 where several ranks sweep at the same time */
} OstSmoother;

/* Collective. The matrix stays the caller's and outlives the smoother; the graph is not kept. */
OstStatus ost_smoother_create(const OstLevelMatrix *matrix, const OstMetricGraph *graph,
                              const OstSolverOptions *options, OstSmoother **smoother);

/* Collective. The same with blocks of given groups of nodes (NULL: as above). */
OstStatus ost_smoother_create_of(const OstLevelMatrix *matrix, const OstMetricGraph *graph, const OstAggregates *groups,
                                 const OstSolverOptions *options, OstSmoother **smoother);

/* Collective. Makes a smoother of the finest level, whose matrix is `stiffness`, sweep over patches; `layers` and
 * `safe` as they have them. */
OstStatus ost_smoother_add_patches(const OstDoubleMatrix *stiffness, const OstMetricGraph *graph, int layers, int safe,
                                   OstSmoother *smoother);
void ost_smoother_destroy(OstSmoother **smoother);

/* The coefficients of the iteration's steps: direction = keep × direction + add × B^-1 r. The first has keep = 0. */
typedef struct OstChebyshev {
    double keep, add;
    double rho, sigma, half_width;
} OstChebyshev;

/* Local. Those of the first step, and of the next. */
OstChebyshev ost_smoother_begin(const OstSmoother *smoother);
void ost_smoother_next(OstChebyshev *steps);

/* Collective over neighbours. Improves x towards A x = b; with `from_zero`, x is taken as 0. */
void ost_smoother_apply(OstSmoother *smoother, const double *b, double *x, int from_zero);

#endif
