/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_LOAD_BALANCE_H
#define ORTHOSTAT_GUARD_LOAD_BALANCE_H

#include "mesh/mesh_data.h"

/* Collective. Raises OST_INVALID_INPUT with the numbers unless the loads (3 × owned nodes) balance each other in force
 * and moment, as they must on an unconstrained body. OST_EFFECT_FREE_BODY. */
OstStatus ost_load_balance_check(const OstMesh *mesh, const double *force, const char *where);

#endif
