/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_PARALLEL_NUMBERING_H
#define ORTHOSTAT_CORE_PARALLEL_NUMBERING_H

#include "orthostat/context.h"

/* Things of all ranks, numbered contiguously: first those of rank 0, then those of rank 1, ... */

/* Collective. Of `count` things here: the number of the first one, and how many there are on all ranks. */
OstStatus ost_number_from(OstContext *ctx, OstGlobal count, OstGlobal *first, OstGlobal *total);

/* Collective. Where each rank's numbers end (one past its last): `end` has an entry for each rank. */
OstStatus ost_number_ends(OstContext *ctx, OstGlobal my_end, OstGlobal *end);

/* Local. The rank that has a number, given where each of `ranks` ranks ends; the last rank for a number beyond all. */
int ost_number_holder(const OstGlobal *end, int ranks, OstGlobal number);

#endif
