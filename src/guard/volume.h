/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_VOLUME_H
#define ORTHOSTAT_GUARD_VOLUME_H

#include "problem/problem.h"
#include "problem/result_data.h"

/* What is left of a mixed form's second equation, m'(strain - e0) = looseness p, summed tet by tet. */
typedef struct OstVolumeError {
    double force; /* squared 2-norm over free directions: the forces of the pressure that it is worth */
    double work;  /* sum of the absolute work of each pressure's share of it on that pressure */
} OstVolumeError;

/* Collective. Of an answer of `problem`, whose field has the answer's pressure (ost_problem_at_pressure); zeros without
 * a mixed form. Both are sums over all ranks. */
OstStatus ost_guard_volume_error(const OstProblem *problem, const OstResult *result, OstVolumeError *error);

#endif
