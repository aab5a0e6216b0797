/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_INDEX_MAP_H
#define ORTHOSTAT_ALGEBRA_LEVEL_INDEX_MAP_H

#include "orthostat/context.h"

/* Numbers keys in the order in which they first appear: a hash table with open addressing. */
typedef struct OstIndex {
    OstContext *ctx;
    OstLocal count;
    OstGlobal *key; /* count, in that order */
    OstLocal *slot; /* slots: number of the key there, or -1 */
    uint64_t slots; /* a power of 2, at least twice the count */
} OstIndex;

/* Local, as is everything here. */
OstStatus ost_index_create(OstContext *ctx, OstIndex **index);
void ost_index_destroy(OstIndex **index);

/* The number of a key, which is appended if it is new. */
OstStatus ost_index_place(OstIndex *index, OstGlobal key, OstLocal *place);

/* Sorts a list of numbers and keeps each once; returns how many are left. */
OstLocal ost_numbers_sort(OstLocal count, OstGlobal *number);

/* The place of a number in a sorted list that contains it. */
OstLocal ost_numbers_find(OstLocal count, const OstGlobal *number, OstGlobal wanted);

#endif
