/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_PARALLEL_GATHER_H
#define ORTHOSTAT_CORE_PARALLEL_GATHER_H

#include "orthostat/context.h"

/* Collective. Gives every rank the items of all ranks (`count` here, of `size` bytes), in the order of ranks: *total
 * items in *all, which the caller frees. Raises OST_LIMIT_EXCEEDED with the message `too_many` if there are more than
 * 2^31 - 1. On failure *all is NULL. */
OstStatus ost_gather_items(OstContext *ctx, size_t size, const void *items, OstLocal count, const char *too_many,
                           void **all, OstLocal *total);

/* Collective. Gives every rank what rank 0 has in `data`; `bytes` is the same on all. */
OstStatus ost_broadcast(OstContext *ctx, size_t bytes, void *data);

#endif
