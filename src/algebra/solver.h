/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SOLVER_H
#define ORTHOSTAT_ALGEBRA_SOLVER_H

#include "algebra/matrix/geometry.h"
#include "orthostat/solver.h"

typedef struct OstSolver OstSolver;

/* Collective. Plans (ost_solver_plan) and builds the first rung (account OST_LEDGER_HIERARCHY), or, with AUTO, the next
 * one that can be built. The matrix stays the caller's, unchanged, and is used until the solver is destroyed, as is
 * what the geometry points to. Raises OST_INVALID_INPUT naming an option out of range or a row whose diagonal block is
 * not positive definite, OST_NOT_CONVERGED if a factorisation finds the matrix singular or indefinite,
 * OST_OUT_OF_MEMORY if one does not fit, OST_LIMIT_EXCEEDED if it is more than the libraries below can number. */
OstStatus ost_solver_create(OstContext *ctx, const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                            const OstSolverOptions *options, OstSolver **solver);
void ost_solver_destroy(OstSolver **solver);

/* Collective. Solves A u = f from u = 0 until ||f - A u|| <= options.relative_residual ||f|| in the unscaled 2-norm,
 * recomputed from A, u, f at the end (and iterated on if the recursive residual had drifted). f and u have 3 × rows
 * numbers of any unit (account OST_LEDGER_SOLVE).
 *
 * With AUTO a rung that would need more than options.patience further iterations, whose preconditioner is not positive
 * definite (r·z <= 0), or that gains nothing more, is left for the one above, which goes on from the u there is; where
 * that one does not fit into memory, the fastest of those before goes on to the last iteration. The next right-hand
 * side starts on the rung reached. A pinned recipe does not climb.
 *
 * Returns OST_NOT_CONVERGED with the residual reached and all that was tried: at the top; after max_iterations; as soon
 * as p·Ap < 0 shows an indefinite matrix; or when no more is left than rounding in double precision allows
 * (report.attainable_residual), where climbing would be in vain. u and the report are filled either way. */
OstStatus ost_solver_solve(OstSolver *solver, const double *f, double *u, OstSolveReport *report);

#endif
