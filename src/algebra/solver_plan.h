/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SOLVER_PLAN_H
#define ORTHOSTAT_ALGEBRA_SOLVER_PLAN_H

#include "orthostat/solver.h"

/* Local. Memory that factoring a body's stiffness takes, as a rule of thumb; MUMPS's analysis knows better. */
double ost_solver_factor_bytes(OstGlobal unknowns);

/* Local. As ost_solver_plan, where the analysis has found that a factorisation does not fit. */
void ost_solver_plan_without_factors(const OstSolverOptions *options, const OstSolverFacts *facts, OstSolverPlan *plan);

/* Local. May multigrid be what solves? A factorisation that is bounded may turn out not to fit, and then it takes its
 * place. */
int ost_solver_may_be_multigrid(const OstSolverPlan *plan);

#endif
