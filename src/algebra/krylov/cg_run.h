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
    double size;        /* what r' was divided by for that, a power of two */
    double *unscaled;   /* S^T p, with room for ghosts */
    OstLanczos lanczos; /* the coefficients of the first run since it was emptied */
    int runs;           /* since then */
} OstCgRun;

/* Collective. Improves u' (which comes as 0) until the goal is reached or ends otherwise; r' is used up. Raises
 * OST_NOT_CONVERGED where p·Ap is negative beyond rounding: the matrix is indefinite. By AztecOO, with a fixed,
 * symmetric and definite preconditioner: */
OstStatus ost_cg_run_by_aztec(OstCgRun *run, double *u, OstGoal *goal);

/* Our own, where the preconditioner is the factors of A. */
OstStatus ost_cg_run_by_factors(OstCgRun *run, double *u, OstGoal *goal);

/* Local. y = A' p = S (A (S^T p)), which leaves S^T p in run->unscaled. */
OstStatus ost_cg_multiply(OstCgRun *run, const double *p, double *y);

/* Local. This rank's part of the square of the unscaled residual that belongs to r', over run->size squared. */
double ost_cg_square(const OstCgRun *run, const double *residual);

/* Collective. p·Dp of the p last multiplied, D being A's diagonal: rounding leaves up to ost_cg_rounding times this of
 * p·Ap, and may turn its sign. */
OstStatus ost_cg_rounding_scale(const OstCgRun *run, double *scale);
extern const double ost_cg_rounding;

/* Collective. Ends a run whose p·Ap = energy is not positive: the matrix is indefinite, or singular to rounding. */
OstStatus ost_cg_judge_energy(const OstCgRun *run, double energy, OstGoal *goal);

#endif
