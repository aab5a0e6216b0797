/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_NUMBER_RANGE_H
#define ORTHOSTAT_SOLVE_NUMBER_RANGE_H

#include "assembly/system.h"

/* Collective. Are stiffness and right-hand side (3 × rows) such that nothing on the way to the answer leaves the range
 * of double precision? Norms and energies are sums of squares, which hold 1e-308 to 1e308: displacements must stay
 * within 1e-150 to 1e150, and so their factors, loads and stiffness, within 1e-75 to 1e75. Beyond, a norm vanishes
 * and zero would pass for an answer. Raises OST_INVALID_INPUT with the number and what to do. A right-hand side of
 * zeros is fine. */
OstStatus ost_number_range_check(const OstSystem *system, const double *rhs, const char *where);

#endif
