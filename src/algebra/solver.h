/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SOLVER_H
#define ORTHOSTAT_ALGEBRA_SOLVER_H

#include "algebra/krylov/error_of_residual.h"
#include "algebra/krylov/gmres.h"
#include "algebra/matrix/geometry.h"
#include "algebra/solver_aim.h"

/* Collective. Plans (ost_solver_plan) and builds the first strategy (account OST_LEDGER_HIERARCHY), or, with AUTO, the
 * next one that can be built. The matrix stays the caller's, unchanged, and is used until the solver is destroyed, as
 * is what the geometry points to. Raises OST_INVALID_INPUT naming an option out of range or a row whose diagonal block
 * is not positive definite, OST_NOT_CONVERGED if a factorisation finds the matrix singular or indefinite,
 * OST_OUT_OF_MEMORY if the factors do not fit, OST_LIMIT_EXCEEDED if a library cannot number the unknowns. */
OstStatus ost_solver_create(OstContext *ctx, const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                            const OstSolverOptions *options, OstSolver **solver);
void ost_solver_destroy(OstSolver **solver);

/* Collective. To be called after the values of the matrix have changed on the same pattern. OST_UPDATE_REBUILD plans
 * and builds the first strategy again, as ost_solver_create. OST_UPDATE_KEEP keeps a multigrid hierarchy as
 * preconditioner of the new matrix, which pays if the values have changed little; the solution is that of the new
 * matrix either way. Where such an old hierarchy is too slow, a solve ends with OST_NOT_CONVERGED: a new one comes
 * before another strategy. PLAIN's hierarchy and factors are always rebuilt. Raises what ost_solver_create raises; the
 * solver is then without a strategy and can only be destroyed or updated again. */
typedef enum { OST_UPDATE_REBUILD, OST_UPDATE_KEEP } OstSolverUpdate;
OstStatus ost_solver_update(OstSolver *solver, OstSolverUpdate how);

/* Local. How later solves go about it. */
void ost_solver_aim(OstSolver *solver, OstSolverAim aim);

/* Collective. Solves A u = f from u = 0 (but see OstSolverAim) until ||f - A u|| <= options.relative_residual ||f|| in
 * the unscaled 2-norm. The residual is recomputed from A, u and f; if the recursive one has drifted from it, the
 * iteration continues. f and u have 3 × rows numbers of any unit (account OST_LEDGER_SOLVE). May be called for any
 * number of right-hand sides.
 *
 * With AUTO the solver gives up a strategy that would need more than options.patience further iterations, whose
 * preconditioner is not positive definite (r·z <= 0), or that gains nothing more. The next one continues from the
 * current u; if it does not fit into memory, the fastest so far continues up to max_iterations. The next right-hand
 * side starts with the strategy reached. A method that the user has chosen is never changed.
 *
 * Returns OST_NOT_CONVERGED with the residual reached and all that was tried: after the last strategy; after
 * max_iterations; as soon as p·Ap < 0 shows an indefinite matrix; or when rounding in double precision allows no
 * smaller residual (report.attainable_residual), where another strategy cannot help. u and the report are filled either
 * way. */
OstStatus ost_solver_solve(OstSolver *solver, const double *f, double *u, OstSolveReport *report);

/* Collective. Solves a mixed form, of which A is the first block, from u = 0 and p = 0 (but see OstSolverAim.goes_on),
 * as ost_solver_solve: the same strategies precondition A, and are left for the same reasons. Norms are those of
 * ost_saddle_goal, in the report too. `saddle`: NULL for none. */
OstStatus ost_solver_solve_mixed(OstSolver *solver, const OstSaddle *saddle, const double *f, double *u,
                                 OstSolveReport *report);

/* Collective. How many eigenvalues of a mixed form's stiffness are negative (ost_saddle_factors_negative), or of A
 * alone
 * (`coupling` NULL), with A as it now is. *known: 0 if the factors that tell do not fit into memory. */
OstStatus ost_solver_count_negative(OstSolver *solver, const OstCoupling *coupling, OstGlobal *negative, int *known);

/* Collective. Factors A as it now is, with the mixed form's second equation where `coupling` is not NULL, though it be
 * indefinite: until the next update, ost_solver_solve_unsymmetric is preconditioned by these. *found: 0 if they do not
 * fit into memory. */
OstStatus ost_solver_factor_indefinite(OstSolver *solver, const OstCoupling *coupling, int *found);

/* Collective. Solves (A + S) u = f from u = 0 by GMRES (ost_gmres_solve), preconditioned by the strategy that the
 * solver was last built with, of whatever matrix that was: A may be indefinite, S unsymmetric. The report has method,
 * iterations and ||M^-1 r|| / ||M^-1 f||, which may be larger than `relative` after many iterations. `saddle`: what
 * stands beside A in a mixed form, or NULL; the further part then has u and p. */
OstStatus ost_solver_solve_unsymmetric(OstSolver *solver, const OstSaddle *saddle, const OstFurtherPart *further,
                                       double relative, const double *f, double *u, OstSolveReport *report);

/* Collective, after ost_solver_solve. The error that this residual leaves in u, by the strategy that the solve ended
 * with (ost_error_of_residual; account OST_LEDGER_SOLVE). *found: 0 also if that strategy's eigenvalues are not known.
 */
OstStatus ost_solver_error(OstSolver *solver, double missing, const double *residual, double *error, int *found);

/* Collective. The same of a mixed form, of residuals of both its equations, by factors of both or iterations, as
 * above; the saddle has r_p for g, and its p, which has room for ghosts, becomes the error of p. */
OstStatus ost_solver_mixed_error(OstSolver *solver, double missing, const OstSaddle *saddle, const double *r_u,
                                 double *e_u, int *found);

/* Local. Has the last solve of a mixed form found so small an eigenvalue of M^-1 A that one application of M may leave
 * out most of an error? */
int ost_solver_mixed_is_poor(const OstSolver *solver);

/* Collective. z = M^-1 r, M the current strategy's preconditioner of A, in the units of A; 3 × rows numbers each.
 * Of multigrid a part of a cycle may be taken: half, which may be unsymmetric, or the brief half. *found: 0 if the
 * solver has no strategy. */
typedef enum { OST_CYCLE_WHOLE, OST_CYCLE_HALF, OST_CYCLE_BRIEF } OstCyclePart;
OstStatus ost_solver_precondition(OstSolver *solver, OstCyclePart part, const double *r, double *z, int *found);

/* Local. A solver for a task of its own (core/together): it uses what this one has built, and must be destroyed first.
 * It never changes the strategy: a solve that would ends with OST_NOT_CONVERGED. Only where ost_solver_shares: with a
 * multigrid hierarchy, which serves several vectors at once. */
int ost_solver_shares(const OstSolver *solver);
OstStatus ost_solver_share(const OstSolver *solver, OstSolver **shared);

/* Local. Takes over what solves of another that uses the same have found of the smallest eigenvalue. */
void ost_solver_learn(OstSolver *solver, const OstSolver *other);

#endif
