/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_CHECKS_H
#define ORTHOSTAT_SOLVE_CHECKS_H

#include "assembly/supports.h"
#include "orthostat/result.h"

/* Collective. Computes the reactions and result->checks from displacement and loads, with internal forces summed tet by
 * tet, without the assembled matrix, so that a mistake in it cannot hide. `rhs_norm` is the norm of the right-hand side
 * solved for. Raises OST_CHECK_FAILED with the numbers when one does not hold: finite values, the true residual, forces
 * and moments in balance, strain energy equal to the work (Clapeyron), no tet turned inside out. */
OstStatus ost_result_check(OstResult *result, const OstSupports *supports, double requested_residual, double rhs_norm);

#endif
