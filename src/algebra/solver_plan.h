/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SOLVER_PLAN_H
#define ORTHOSTAT_ALGEBRA_SOLVER_PLAN_H

#include "orthostat/solver.h"

/* Local. Rule of thumb for the bytes that factoring a stiffness takes; MUMPS's analysis is more accurate. */
double ost_solver_factor_bytes(OstGlobal unknowns);

/* Local. As ost_solver_plan, after the analysis has found that a factorisation does not fit into memory. */
void ost_solver_plan_without_factors(const OstSolverOptions *options, const OstSolverFacts *facts, OstSolverPlan *plan);

/* Local. Is the solver planned to start with multigrid, or to fall back on it if the factors exceed factor_memory? */
int ost_solver_may_be_multigrid(const OstSolverPlan *plan);

#endif
