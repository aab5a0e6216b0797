/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SADDLE_SADDLE_H
#define ORTHOSTAT_ALGEBRA_SADDLE_SADDLE_H

#include "algebra/krylov/preconditioner.h"
#include "algebra/saddle/factors.h"
#include "algebra/saddle/norm.h"

/* Collective. Improves u and p until the goal is reached or ended, preconditioned by M for A and by S for the
 * pressures' Schur complement, by the conjugate gradients of J. H. Bramble and J. E. Pasciak (A preconditioning
 * technique for indefinite systems resulting from mixed approximations of elliptic problems, Math. Comp. 50, 1988).
 * Multiplied by [ N^-1    0    ] [ S^-1 B N^-1  -S^-1 ],    N = M / tau, the system is symmetric and positive definite
 * in the product of diag(A - N, S), if A - N is positive definite: tau is a little more than 1 over the smallest
 * eigenvalue of M^-1 A, as the iteration sees it. A step takes one product with A and one application of M, as a step
 * of conjugate gradients for A alone; MINRES should take about twice the steps.
 *
 * Ours, because AztecOO has no product but the Euclidean one: its CG cannot take a preconditioned system that is
 * symmetric in another, and its GMRES keeps a vector for every step. Fills the report's condition and error estimates.
 */
OstStatus ost_saddle_solve(const OstCgSystem *system, const OstPreconditioner *preconditioner, const OstSaddle *saddle,
                           const double *f, double *u, OstGoal *goal, OstSolveReport *report);

/* Collective. The same by factors of both equations: corrections for the true residual until they no longer shrink.
 * The report's errors are the next correction, with some caution. */
OstStatus ost_saddle_correct(const OstCgSystem *system, const OstSaddleFactors *factors, const OstSaddle *saddle,
                             const double *f, double *u, OstGoal *goal, OstSolveReport *report);

#endif
