/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_PARALLEL_GATHER_H
#define ORTHOSTAT_CORE_PARALLEL_GATHER_H

#include "orthostat/context.h"

/* Collective. Every rank's `count` items of `size` bytes on each, in the order of ranks: *total of them, in memory from
 * ost_allocate that the caller frees. Raises OST_LIMIT_EXCEEDED with the words `too_many` if the total is more than 32
 * bits can count. On failure *all is NULL. */
OstStatus ost_gather_items(OstContext *ctx, size_t size, const void *items, OstLocal count, const char *too_many,
                           void **all, OstLocal *total);

#endif
