/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SOLVER_OPTIONS_H
#define ORTHOSTAT_ALGEBRA_SOLVER_OPTIONS_H

#include "orthostat/solver.h"

/* Local. OST_INVALID_INPUT naming the option that is out of range. */
OstStatus ost_solver_check_options(OstContext *ctx, const OstSolverOptions *options);

/* Local. The options of the strategy for `method`, from the planned ones. */
void ost_solver_strategy_options(const OstSolverOptions *planned, OstMethod method, OstSolverOptions *options);

#endif
