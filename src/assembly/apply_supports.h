/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_APPLY_SUPPORTS_H
#define ORTHOSTAT_ASSEMBLY_APPLY_SUPPORTS_H

#include "assembly/system.h"

/* Local. Turns the filled K into P K P + s(I - P) at nodes that are constrained in one or two directions. s is the mean
 * stiffness of the node's diagonal block along its free directions, so that the added entries have the node's own
 * scale. Without such nodes it does nothing and enters no account. Booked to OST_EFFECT_SLIDING if that effect is on
 * and a constrained direction is not a coordinate axis, otherwise to OST_LEDGER_SUPPORTS. */
void ost_system_apply_supports(OstSystem *system);

#endif
