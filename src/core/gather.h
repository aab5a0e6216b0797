/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_GATHER_H
#define ORTHOSTAT_CORE_GATHER_H

#include "orthostat/context.h"

/* Collective. The items of all ranks on each, in the order of the ranks, in memory from the context that the caller
 * frees; meant for few. Raises OST_LIMIT_EXCEEDED with `too_many` where MPI cannot count them. */
OstStatus ost_gather_items(OstContext *ctx, size_t item_bytes, OstLocal count, const void *items, const char *too_many,
                           void **all, OstLocal *total);

#endif
