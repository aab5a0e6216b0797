/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_METRIC_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_METRIC_H

#include "algebra/krylov/preconditioner.h"
#include "algebra/krylov/refine.h"
#include "algebra/matrix/geometry.h"

/* Metric multigrid (the methods METRIC, STRONG and TWO_LEVEL): conjugate gradients on the matrix scaled by its diagonal
 * blocks, preconditioned by smoothed aggregation on aggregates that are round in the material metric, with block
 * Chebyshev smoothing. */
typedef struct OstMetric OstMetric;

/* Quadratic tets whose edges are further off the stiff directions go over vertices that turn, not over linear tets. */
extern const double ost_metric_misaligned;

/* Up to this length over the thickness of the body vertices that turn are a good coarse level, once factored. */
extern const double ost_metric_longest_of_vertices;

/* Collective. Fills in the facts of quadratic tets that are measured: misalignment, and slenderness. */
OstStatus ost_metric_measure(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry, OstSolverFacts *facts);

/* Collective. The matrix stays the caller's and must outlive the solver. Raises OST_INVALID_INPUT if a coordinate or
 * metric is not usable or a diagonal block is not positive definite. */
OstStatus ost_metric_create(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                            const OstSolverOptions *options, OstMetric **metric);
void ost_metric_destroy(OstMetric **metric);

/* Local. Are linear tets the first coarse level of quadratic ones? */
int ost_metric_is_over_linear(const OstMetric *metric);

/* Local. Takes the smoother's degree and ratio from `options` and raises the eigenvalue estimates; the levels and the
 * smoothers' blocks stay. */
void ost_metric_strengthen(OstMetric *metric, const OstSolverOptions *options);

/* Local. What conjugate gradients iterate on, and what preconditions it; both live as long as the metric. */
void ost_metric_system(const OstMetric *metric, OstCgSystem *system, OstPreconditioner *cycle);

/* Local. Fills the report's levels and operator complexity. */
void ost_metric_report(const OstMetric *metric, OstSolveReport *report);

/* Collective. As ost_cg_solve; fills the report's levels, complexity and condition estimate. */
OstStatus ost_metric_improve(OstMetric *metric, const double *f, double *u, OstGoal *goal, OstSolveReport *report);

#endif
