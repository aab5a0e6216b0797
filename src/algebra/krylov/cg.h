/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_KRYLOV_CG_H
#define ORTHOSTAT_ALGEBRA_KRYLOV_CG_H

#include "algebra/krylov/preconditioner.h"
#include "algebra/krylov/refine.h"

/* Collective. Improves u towards A u = f by iterative refinement (ost_refine), whose inner solves are preconditioned
 * conjugate gradients: AztecOO's, or our own if the preconditioner is factors. Norms are unscaled. Fills the report's
 * condition_estimate, error_estimate, energy_error, rounding_error and rounding_spread. Raises OST_NOT_CONVERGED if
 * p·Ap is negative beyond rounding: the matrix is indefinite, and no other preconditioner helps. Where rounding hides
 * p·Ap, a step by factors is taken whole (plain iterative refinement); other preconditioners end with OST_END_STALLED.
 */
OstStatus ost_cg_solve(const OstCgSystem *system, const OstPreconditioner *preconditioner, const double *f, double *u,
                       OstGoal *goal, OstSolveReport *report);

#endif
