/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_MEMORY_H
#define ORTHOSTAT_CORE_MEMORY_H

#include "orthostat/context.h"

/* Local. Zeroed memory, booked to the ledger's innermost account until it is freed. A count of 0 gives a valid pointer.
 * Raises OST_OUT_OF_MEMORY with the size asked for. */
OstStatus ost_allocate(OstContext *ctx, size_t count, size_t size, void **memory);

/* Local. Resizes an array from ost_allocate (or NULL) to `count` items; new items are zeroed. On failure the old array
 * is unchanged. */
OstStatus ost_reallocate(OstContext *ctx, size_t count, size_t size, void **memory);

/* Local. Returns to the system the freed memory that ost_keep_freed_memory makes malloc keep. */
void ost_return_freed_memory(void);

/* Local. A copy of a string in memory from ost_allocate. */
OstStatus ost_copy_string(OstContext *ctx, const char *text, char **copy);

#define OST_NEW(ctx, pointer, count) ost_allocate((ctx), (size_t)(count), sizeof **(pointer), (void **)(pointer))
#define OST_RESIZE(ctx, pointer, count) ost_reallocate((ctx), (size_t)(count), sizeof **(pointer), (void **)(pointer))
#define OST_FREE(pointer)                   \
    do {                                    \
        ost_free_memory((void *)(pointer)); \
        (pointer) = NULL;                   \
    } while (0)

#endif
