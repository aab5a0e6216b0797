/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_PARALLEL_REDUCE_H
#define ORTHOSTAT_CORE_PARALLEL_REDUCE_H

#include "orthostat/context.h"

/* Collective. Sum, maximum or minimum over all ranks, in place, of each of `count` values. */
OstStatus ost_sum(OstContext *ctx, int count, double *values);
OstStatus ost_max(OstContext *ctx, int count, double *values);
OstStatus ost_min(OstContext *ctx, int count, double *values);
OstStatus ost_sum_numbers(OstContext *ctx, int count, OstGlobal *numbers);
OstStatus ost_max_numbers(OstContext *ctx, int count, OstGlobal *numbers);
OstStatus ost_min_numbers(OstContext *ctx, int count, OstGlobal *numbers);
OstStatus ost_max_ints(OstContext *ctx, int count, int *numbers);

#endif
