/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_PARALLEL_NUMBERING_H
#define ORTHOSTAT_CORE_PARALLEL_NUMBERING_H

#include "orthostat/context.h"

/* A contiguous numbering over ranks: rank 0 has the first numbers, rank 1 the next, ... */

/* Collective. The first of this rank's `count` numbers, and the count of all ranks. */
OstStatus ost_number_from(OstContext *ctx, OstGlobal count, OstGlobal *first, OstGlobal *total);

/* Collective. One past the last number of each rank: `end` has an entry for each. */
OstStatus ost_number_ends(OstContext *ctx, OstGlobal my_end, OstGlobal *end);

/* Local. The rank that has a number, from ost_number_ends; the last rank for a number beyond all. */
int ost_number_holder(const OstGlobal *end, int ranks, OstGlobal number);

#endif
