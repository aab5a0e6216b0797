/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_INDEX_MAP_H
#define ORTHOSTAT_CORE_INDEX_MAP_H

#include "orthostat/context.h"

/* Numbers keys in the order in which they are first added: a hash table with open addressing. A key is one or more
 * 64-bit words. */
typedef struct OstIndex {
    OstContext *ctx;
    int words;
    OstLocal count;
    OstGlobal *key; /* count × words, in their order */
    OstLocal *slot; /* slots: number of the key in it, or -1 */
    uint64_t slots; /* a power of 2, at least twice the count */
} OstIndex;

/* Local, as is everything here. */
OstStatus ost_index_create(OstContext *ctx, int words, OstIndex **index);
void ost_index_destroy(OstIndex **index);

/* The number of a key, which is added if it is new. Raises OST_LIMIT_EXCEEDED beyond 2^31 - 1 keys. */
OstStatus ost_index_place(OstIndex *index, const OstGlobal *key, OstLocal *place);

/* The number of a key, or -1. */
OstLocal ost_index_find(const OstIndex *index, const OstGlobal *key);

#endif
