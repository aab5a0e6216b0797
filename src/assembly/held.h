/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_HELD_H
#define ORTHOSTAT_ASSEMBLY_HELD_H

#include "assembly/system.h"

/* Local. Turns the filled K into P K P + s(I - P) at nodes that are held in one or two directions; s is the mean of the
 * stiffnesses along the free directions of the node's diagonal block, so that what is added is of the node's own size.
 * Does nothing, and enters no account, where there are none. OST_EFFECT_SLIDING if that is on and a direction
 * held is not a coordinate's, else OST_LEDGER_SUPPORTS. */
void ost_system_apply_supports(OstSystem *system);

#endif
