/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_STIFFNESS_SOLVER_H
#define ORTHOSTAT_SOLVE_STIFFNESS_SOLVER_H

#include "algebra/solver.h"
#include "problem/coarse_space.h"
#include "problem/problem.h"

/* The problem's stiffness with a solver on it. */
typedef struct OstStiffnessSolver {
    OstProblem *problem;
    OstSolverOptions options;
    OstRowGeometry rows;
    OstLinearSpace *coarse; /* of the linear tets under quadratic ones, or NULL */
    OstSolverFacts facts;
    OstSolver *solver; /* NULL until ost_stiffness_solver_solver */
} OstStiffnessSolver;

/* Collective. What a solver needs to know of the rows, once the problem's stiffness is there. Clears on failure. */
OstStatus ost_stiffness_solver_create(OstProblem *problem, const OstSolverOptions *options,
                                      OstStiffnessSolver *stiffness);

/* Collective. Makes the solver, and the linear space where it needs one, on the stiffness at u = 0. */
OstStatus ost_stiffness_solver_make(OstStiffnessSolver *stiffness);

/* Collective. Rebuilds the solver on the stiffness at `displacement` (3 × node_count), which the problem has been
 * filled with. The near-null space becomes the rigid motions of that shape, and the linear space gets its stiffness
 * there. Aggregates stay those of the reference shape, in which the material's metric is given. */
OstStatus ost_stiffness_solver_rebuild(OstStiffnessSolver *stiffness, const double *displacement);

void ost_stiffness_solver_release(OstStiffnessSolver *stiffness);

#endif
