/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_REFINE_H
#define ORTHOSTAT_ALGEBRA_REFINE_H

#include "algebra/block_matrix.h"
#include "orthostat/solver.h"

/* What an iterative solver works towards, and how far it is; norms are of the unscaled residual. */
typedef struct OstGoal {
    OstContext *ctx;
    double start;  /* ||f|| */
    double target; /* relative_residual × ||f|| */
    int iterations;
    int most_iterations;
} OstGoal;

/* Collective. Finds u with ||r - A u|| <= goal->target by the solver's own, recursive residual, or stops when
 * goal->iterations reaches the most; counts its iterations in the goal. r and u have 3 × rows numbers, u comes as 0. On
 * failure u holds what was reached. */
typedef OstStatus (*OstInnerSolve)(void *data, const double *r, double *u, OstGoal *goal);

/* Collective. Solves A u = f by `inner` to options->relative_residual, judged by f - A u as A, u and f give it: what a
 * recursive residual hid is solved for again. Fills the report's iterations and relative_residual, also on failure.
 * Returns OST_NOT_CONVERGED with the residual reached, and what rounding allows if it holds no more. */
OstStatus ost_refine(const OstBlockMatrix *matrix, OstInnerSolve inner, void *data, const double *f, double *u,
                     const OstSolverOptions *options, OstSolveReport *report);

/* Local. Shows how far a residual of this norm is on the way. */
void ost_goal_progress(const OstGoal *goal, double norm);

/* Local. Raises OST_NOT_CONVERGED unless `value`, the quadratic form `form` ("r·z"), is a positive number, as it must
 * be if `what` is positive definite. */
OstStatus ost_goal_require_positive(const OstGoal *goal, double value, const char *form, const char *what);

#endif
