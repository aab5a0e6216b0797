/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_MEMORY_H
#define ORTHOSTAT_CORE_MEMORY_H

#include "orthostat/context.h"

/* Local. Zeroed memory, booked to the ledger's innermost account until it is freed. A count of 0 gives a valid pointer.
 * Raises OST_OUT_OF_MEMORY with the size asked for. */
OstStatus ost_allocate(OstContext *ctx, size_t count, size_t size, void **memory);

/* Local. The same, with any content: for large arrays that are written as a whole before they are read. */
OstStatus ost_allocate_uncleared(OstContext *ctx, size_t count, size_t size, void **memory);

/* Local. Resizes an array from ost_allocate (or NULL) to `count` items; new items are zeroed. On failure the old array
 * is unchanged. */
OstStatus ost_reallocate(OstContext *ctx, size_t count, size_t size, void **memory);

/* Local. Makes room for `count` items. An array that is too short gets room for half as many more, so that it may grow
 * item by item. */
OstStatus ost_grow(OstContext *ctx, size_t count, size_t size, void **memory);

/* Local. Returns to the system the freed memory that ost_keep_freed_memory makes malloc keep. */
void ost_return_freed_memory(void);

/* Local. A copy of a string in memory from ost_allocate. */
OstStatus ost_copy_string(OstContext *ctx, const char *text, char **copy);

#define OST_NEW(ctx, pointer, count) ost_allocate((ctx), (size_t)(count), sizeof **(pointer), (void **)(pointer))
#define OST_NEW_UNCLEARED(ctx, pointer, count) \
    ost_allocate_uncleared((ctx), (size_t)(count), sizeof **(pointer), (void **)(pointer))
#define OST_RESIZE(ctx, pointer, count) ost_reallocate((ctx), (size_t)(count), sizeof **(pointer), (void **)(pointer))
#define OST_GROW(ctx, pointer, count) ost_grow((ctx), (size_t)(count), sizeof **(pointer), (void **)(pointer))

/* Frees up to eight pointers, one after the other, and makes them NULL. */
#define OST_FREE_1(pointer) (ost_free_memory((void *)(pointer)), (void)((pointer) = NULL))
#define OST_FREE_2(pointer, ...) OST_FREE_1(pointer), OST_FREE_1(__VA_ARGS__)
#define OST_FREE_3(pointer, ...) OST_FREE_1(pointer), OST_FREE_2(__VA_ARGS__)
#define OST_FREE_4(pointer, ...) OST_FREE_1(pointer), OST_FREE_3(__VA_ARGS__)
#define OST_FREE_5(pointer, ...) OST_FREE_1(pointer), OST_FREE_4(__VA_ARGS__)
#define OST_FREE_6(pointer, ...) OST_FREE_1(pointer), OST_FREE_5(__VA_ARGS__)
#define OST_FREE_7(pointer, ...) OST_FREE_1(pointer), OST_FREE_6(__VA_ARGS__)
#define OST_FREE_8(pointer, ...) OST_FREE_1(pointer), OST_FREE_7(__VA_ARGS__)
#define OST_FREE_BY(_1, _2, _3, _4, _5, _6, _7, _8, macro, ...) macro
#define OST_FREE(...)                                                                                             \
    (OST_FREE_BY(__VA_ARGS__, OST_FREE_8, OST_FREE_7, OST_FREE_6, OST_FREE_5, OST_FREE_4, OST_FREE_3, OST_FREE_2, \
                 OST_FREE_1, )(__VA_ARGS__))

/* Frees the first `count` pointers of a list, then the list, which may be NULL. */
#define OST_FREE_EACH(count, list)                                \
    do {                                                          \
        for (size_t i_ = 0; (list) && i_ < (size_t)(count); i_++) \
            OST_FREE((list)[i_]);                                 \
        OST_FREE(list);                                           \
    } while (0)

#endif
