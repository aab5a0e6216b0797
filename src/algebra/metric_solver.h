/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_METRIC_SOLVER_H
#define ORTHOSTAT_ALGEBRA_METRIC_SOLVER_H

#include "algebra/solver.h"

/* The recipe METRIC: rows scaled by their diagonal blocks, aggregates round in the material's metric,
 * smoothed aggregation on them, block Chebyshev smoothing, a K-cycle, flexible conjugate gradients. */
typedef struct OstMetric OstMetric;

/* Collective. The matrix stays the caller's and outlives the solver. Raises OST_INVALID_INPUT if the geometry is not
 * usable or a diagonal block is not positive definite. */
OstStatus ost_metric_create(OstContext *ctx, const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                            const OstSolverOptions *options, OstMetric **metric);
void ost_metric_destroy(OstMetric **metric);

/* Collective. As ost_solver_solve; also fills the report's levels, level_unknowns and operator_complexity. */
OstStatus ost_metric_solve(OstMetric *metric, const double *f, double *u, OstSolveReport *report);

#endif
