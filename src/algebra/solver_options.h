/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SOLVER_OPTIONS_H
#define ORTHOSTAT_ALGEBRA_SOLVER_OPTIONS_H

#include "orthostat/solver.h"

/* Local. OST_INVALID_INPUT naming the option that is out of range. */
OstStatus ost_solver_check_options(OstContext *ctx, const OstSolverOptions *options);

/* Local. What a rung makes of the planned options. */
void ost_solver_rung_options(const OstSolverOptions *planned, OstRecipe rung, OstSolverOptions *options);

#endif
