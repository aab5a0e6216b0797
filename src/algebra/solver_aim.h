/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SOLVER_AIM_H
#define ORTHOSTAT_ALGEBRA_SOLVER_AIM_H

#include "algebra/krylov/goal.h"
#include "algebra/saddle/saddle.h"
#include "orthostat/solver.h"

typedef struct OstSolver OstSolver;

/* How solves go about it, in place of the options' relative residual: Newton's method needs little at first. `stop`:
 * ends a solve by multigrid before that, where the error in the norm of the energy is small enough; it lives as long as
 * the aim. `goes_on`: solves begin with the u given and not with 0. `crude`: the error of the solution
 * is not estimated. `probing`: the matrix may be indefinite, and the first sign of it ends update and solve with
 * OST_NOT_CONVERGED or OST_INVALID_INPUT, where other strategies would be tried otherwise. */
typedef struct OstSolverAim {
    double relative_residual; /* 0: the options' */
    int crude, probing;
    OstMethod first; /* an update that rebuilds begins with this strategy, or a later one that the plan names */
    const OstErrorStop *stop; /* NULL: none */
    int goes_on;
    const OstCoupling *coupling; /* of the mixed form that is solved; NULL: none, or A is definite */
} OstSolverAim;

#endif
