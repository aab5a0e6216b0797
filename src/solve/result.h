/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_RESULT_H
#define ORTHOSTAT_SOLVE_RESULT_H

#include "orthostat/problem.h"
#include "problem/result_data.h"

/* Collective. A result with room for the displacement. */
OstStatus ost_result_create(const OstProblem *problem, OstResult **result);

/* Collective. Copies the problem's load, and makes room for the reactions. */
OstStatus ost_result_take_load(OstResult *result, const OstProblem *problem);

/* Collective. Finds where the displacement is largest. */
OstStatus ost_result_find_largest(OstResult *result);

#endif
