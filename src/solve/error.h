/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_ERROR_H
#define ORTHOSTAT_SOLVE_ERROR_H

#include "algebra/solver.h"
#include "guard/guard.h"

/* Collective, after ost_solver_solve and while its stiffness lives. The errors of a displacement (3 × node_count,
 * ghosts included) in the problem's equations at t = 1: the solver finds what the residual f - K u leaves, with K u
 * summed tet by tet. That takes differences of displacements between the nodes of a tet, so it is far more exact than
 * the rounded entries of the stiffness: what rounding these has cost is found too. Takes one application of the
 * preconditioner where all errors come out below 1e-6, and some more steps elsewhere. errors->known: 0 where the solver
 * cannot tell. `once`: never more than the one application. */
OstStatus ost_find_errors(const OstProblem *problem, OstSolver *solver, const double *displacement, int once,
                          OstErrors *errors);

#endif
