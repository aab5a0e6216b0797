/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_NUMBER_SET_H
#define ORTHOSTAT_CORE_NUMBER_SET_H

#include "orthostat/context.h"

/* Sorted sets of numbers. Local. */

/* For qsort and bsearch, of items that begin with an OstGlobal, by that. */
int ost_compare_numbers(const void *a, const void *b);

/* Sorts numbers, ascending, and keeps each once; returns how many are left. */
OstLocal ost_numbers_sort(OstLocal count, OstGlobal *numbers);

/* How many numbers of a sorted set are below one. */
OstLocal ost_numbers_below(OstLocal count, const OstGlobal *sorted, OstGlobal number);

/* The place of a number in a sorted set, or -1. */
OstLocal ost_numbers_find(OstLocal count, const OstGlobal *sorted, OstGlobal number);

/* A set that grows number by number. Start from {0}. */
typedef struct OstNumberSet {
    OstLocal count;
    OstLocal capacity;
    OstGlobal *number; /* sorted, each once, after ost_number_set_close */
} OstNumberSet;

/* Raises OST_LIMIT_EXCEEDED beyond 2^31 - 1 different numbers. */
OstStatus ost_number_set_add(OstContext *ctx, OstNumberSet *set, OstGlobal number);
void ost_number_set_close(OstNumberSet *set);
void ost_number_set_clear(OstNumberSet *set);

#endif
