/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_CYCLE_COLUMNS_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_CYCLE_COLUMNS_H

#include "algebra/matrix/columns.h"
#include "algebra/multigrid/cycle_data.h"

/* The cycle for several vectors at once: ML runs it over the same levels, whose vectors are OST_COLUMNS times as long
 * (algebra/level/level_columns.h). */

/* Local. Can this cycle be? Not of one level, nor where levels need more than single precision. */
int ost_cycle_columns_fit(const OstCycle *cycle);

/* Collective. z[k] = the cycle on r[k], or half of it, for up to OST_COLUMNS vectors of the rows. The first call
 * allocates; raises OST_OUT_OF_MEMORY. */
OstStatus ost_cycle_columns_apply(OstCycle *cycle, int half, int count, const double *const *r, double *const *z);

void ost_cycle_columns_destroy(OstCycleColumns **columns);

#endif
