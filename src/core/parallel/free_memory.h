/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_PARALLEL_FREE_MEMORY_H
#define ORTHOSTAT_CORE_PARALLEL_FREE_MEMORY_H

#include "orthostat/context.h"

/* Bytes that the ranks of a machine want together, and that it has free: of the machine that is shortest of it. */
typedef struct OstMemoryDemand {
    double wanted, free;
} OstMemoryDemand;

/* Collective. `mine` is what this rank wants. */
OstStatus ost_memory_demand(OstContext *ctx, double mine, OstMemoryDemand *demand);

/* Collective. What all machines of the ranks have free, each counted once. */
OstStatus ost_memory_free(OstContext *ctx, double *bytes);

/* Collective. What all machines of the ranks have, or their containers allow, each counted once; INFINITY where nothing
 * tells. */
OstStatus ost_memory_installed(OstContext *ctx, double *bytes);

/* Collective. Raises OST_OUT_OF_MEMORY where a rank cannot have `bytes` more: asked before a library is called that
 * would end the process. `who` wants them. */
OstStatus ost_memory_foresee(OstContext *ctx, double bytes, const char *who);

#endif
