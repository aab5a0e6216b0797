/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_NUMBER_SET_H
#define ORTHOSTAT_MESH_NUMBER_SET_H

#include "orthostat/context.h"

/* A sorted set of global numbers, collected one by one. Start from {0}. */
typedef struct NumberSet {
    OstGlobal *number;
    size_t count;
    size_t capacity;
} NumberSet;

/* Adds a number; repetitions are removed by ost_number_set_close, which sorts and after which the set is whole. */
OstStatus ost_number_set_add(OstContext *ctx, NumberSet *set, OstGlobal number);
OstStatus ost_number_set_close(OstContext *ctx, NumberSet *set);
void ost_number_set_clear(NumberSet *set);

/* Position of a number in a sorted array, or -1. */
OstLocal ost_number_find(const OstGlobal *sorted, OstLocal count, OstGlobal number);

#endif
