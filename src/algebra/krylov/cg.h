/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_CG_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_CG_H

#include "algebra/krylov/preconditioner.h"
#include "algebra/krylov/refine.h"

/* Collective. Improves u towards A u = f by preconditioned conjugate gradients (AztecOO's, or our own
 * where the preconditioner is factors), as ost_refine, in the unscaled norm.
 * Fills the report's condition_estimate, from the first run's coefficients, error_estimate, rounding_error and its
 * spread. Raises OST_NOT_CONVERGED where p·Ap is negative beyond rounding: the matrix is indefinite, which no
 * preconditioner mends. Where rounding hides p·Ap, factors are believed, which makes it iterative refinement; others
 * stall. */
OstStatus ost_cg_solve(const OstCgSystem *system, const OstPreconditioner *preconditioner, const double *f, double *u,
                       OstGoal *goal, OstSolveReport *report);

#endif
