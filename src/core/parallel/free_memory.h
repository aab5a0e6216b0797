/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_PARALLEL_FREE_MEMORY_H
#define ORTHOSTAT_CORE_PARALLEL_FREE_MEMORY_H

#include "orthostat/context.h"

/* Bytes that the ranks of a machine need together, and that it has free: of the machine where the shortage is worst. */
typedef struct OstMemoryDemand {
    double wanted, free;
} OstMemoryDemand;

/* Collective. `mine` is what this rank needs. */
OstStatus ost_memory_demand(OstContext *ctx, double mine, OstMemoryDemand *demand);

/* Collective. Free memory of all machines that run ranks, each counted once. */
OstStatus ost_memory_free(OstContext *ctx, double *bytes);

/* Collective. Memory of all machines that run ranks, or the limit of their containers, each counted once; INFINITY if
 * it is not known. */
OstStatus ost_memory_installed(OstContext *ctx, double *bytes);

/* Collective. Raises OST_OUT_OF_MEMORY if a rank cannot allocate another `bytes`. Call it before a library that would
 * abort the process without them; `who` names that library. */
OstStatus ost_memory_foresee(OstContext *ctx, double bytes, const char *who);

#endif
