/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_CG_RUN_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_CG_RUN_H

#include "algebra/krylov/lanczos.h"
#include "algebra/krylov/preconditioner.h"
#include "algebra/krylov/refine.h"

/* A run of conjugate gradients for A' u' = r', in scaled unknowns. */
typedef struct OstCgRun {
    OstContext *ctx;
    const OstCgSystem *system;
    const OstPreconditioner *preconditioner;
    size_t n;           /* unknowns this rank owns */
    double *residual;   /* r', of order 1: preconditioners work in single precision too */
    double size;        /* the power of two that r' was divided by for that */
    double *unscaled;   /* S^T p, with room for ghosts */
    const double *base; /* what the runs improve */
    OstLanczos lanczos; /* coefficients of the first run since it was last emptied */
    int runs;           /* runs since then */
} OstCgRun;

/* Collective. Improves u', which is 0 on entry, until the goal is reached or ended; overwrites r'. Raises
 * OST_NOT_CONVERGED if p·Ap is negative beyond rounding: the matrix is indefinite. AztecOO's
 * (algebra/trilinos/conjugate_gradients.c) needs a fixed, symmetric and positive definite preconditioner, and raises
 * OST_OUT_OF_MEMORY if there is no room for AztecOO's four vectors (it would end the process); our own
 * (own_cg.c) are for the factors of A and for tasks that run together. */
OstStatus ost_cg_run_by_aztec(OstCgRun *run, double *u, OstGoal *goal);
OstStatus ost_cg_run_by_own(OstCgRun *run, double *u, OstGoal *goal);

/* Collective over neighbours. y = A' p = S (A (S^T p)); leaves S^T p in run->unscaled. */
OstStatus ost_cg_multiply(OstCgRun *run, const double *p, double *y);

/* Collective, after each step of the first run. Estimates the error of base + u, if goal->stop wants it, and ends the
 * goal (goal->enough) if that says so. Overwrites run->unscaled. */
OstStatus ost_cg_judge_error(OstCgRun *run, const double *u, OstGoal *goal);

/* Local. This rank's part of ||r||² / run->size², r being the unscaled residual. */
double ost_cg_square(const OstCgRun *run, const double *residual);

/* Collective. p·Dp of the p last multiplied, D being the diagonal of A. Up to ost_cg_rounding times this, p·Ap is
 * rounding, and so may be its sign. */
OstStatus ost_cg_rounding_scale(const OstCgRun *run, double *scale);
extern const double ost_cg_rounding;

/* Collective. Ends a run in which p·Ap = energy is not positive: raises OST_NOT_CONVERGED if the matrix is indefinite;
 * ends with OST_END_STALLED if it is singular to rounding. */
OstStatus ost_cg_judge_energy(const OstCgRun *run, double energy, OstGoal *goal);

#endif
