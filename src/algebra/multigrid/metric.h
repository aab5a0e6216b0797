/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_METRIC_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_METRIC_H

#include "algebra/krylov/refine.h"
#include "algebra/matrix/geometry.h"

/* The recipe METRIC: rows scaled by their diagonal blocks, aggregates round in the material's metric,
 * smoothed aggregation on them, block Chebyshev smoothing, a K-cycle, flexible conjugate gradients. */
typedef struct OstMetric OstMetric;

/* Collective. The matrix stays the caller's and outlives the solver. Raises OST_INVALID_INPUT if the geometry is not
 * usable or a diagonal block is not positive definite. */
OstStatus ost_metric_create(OstContext *ctx, const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                            const OstSolverOptions *options, OstMetric **metric);
void ost_metric_destroy(OstMetric **metric);

/* Local. Takes the smoother's degree and ratio from `options`, and more care with the eigenvalues it was built on; the
 * hierarchy and the smoothers' blocks stay. */
void ost_metric_strengthen(OstMetric *metric, const OstSolverOptions *options);

/* Collective. As ost_cg_solve; fills the report's levels, complexity and condition estimate. */
OstStatus ost_metric_improve(OstMetric *metric, const double *f, double *u, OstGoal *goal, OstSolveReport *report);

/* Collective. The same from u = 0 by the options' residual and iterations; also fills the report's iterations and
 * relative_residual. Raises OST_NOT_CONVERGED if they do not do. */
OstStatus ost_metric_solve(OstMetric *metric, const double *f, double *u, OstSolveReport *report);

#endif
