/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SOLVER_SECONDS_H
#define ORTHOSTAT_ALGEBRA_SOLVER_SECONDS_H

#include "orthostat/solver.h"

/* Local. Seconds that quadratic tets take, setup and solve, by a factorisation and by multigrid: rates of the machine
 * on which docs/performance.md was made, of which only the ratio matters. `facts` must have the thickness. */
double ost_solver_factor_seconds(const OstSolverFacts *facts);
double ost_solver_multigrid_seconds(const OstSolverFacts *facts);

#endif
