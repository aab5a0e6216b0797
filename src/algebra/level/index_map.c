/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/index_map.h"

#include "core/error.h"
#include "core/memory.h"

#include <limits.h>
#include <stdlib.h>

enum { FIRST_SLOTS = 64 };

void ost_index_destroy(OstIndex **index)
{
    if (!*index)
        return;
    OST_FREE((*index)->key);
    OST_FREE((*index)->slot);
    OST_FREE(*index);
}

/* Where the search for a key starts: Fibonacci hashing (Knuth, volume 3, 6.4). */
static uint64_t first_slot(const OstIndex *index, OstGlobal key)
{
    const uint64_t mixed = (uint64_t)key * 0x9e3779b97f4a7c15u;
    return (mixed ^ (mixed >> 32)) & (index->slots - 1);
}

/* The slot that holds the key, or the empty one where it belongs. */
static uint64_t find_slot(const OstIndex *index, OstGlobal key)
{
    uint64_t s = first_slot(index, key);
    while (index->slot[s] >= 0 && index->key[index->slot[s]] != key)
        s = (s + 1) & (index->slots - 1);
    return s;
}

static OstStatus grow(OstIndex *index, uint64_t slots)
{
    OST_TRY(OST_RESIZE(index->ctx, &index->key, slots / 2));
    OST_TRY(OST_RESIZE(index->ctx, &index->slot, slots));
    index->slots = slots;
    for (uint64_t s = 0; s < slots; s++)
        index->slot[s] = -1;
    for (OstLocal k = 0; k < index->count; k++)
        index->slot[find_slot(index, index->key[k])] = k;
    return OST_SUCCESS;
}

OstStatus ost_index_create(OstContext *ctx, OstIndex **index)
{
    OST_TRY(OST_NEW(ctx, index, 1));
    (*index)->ctx = ctx;
    const OstStatus status = grow(*index, FIRST_SLOTS);
    if (status != OST_SUCCESS)
        ost_index_destroy(index);
    return status;
}

OstStatus ost_index_place(OstIndex *index, OstGlobal key, OstLocal *place)
{
    uint64_t s = find_slot(index, key);
    *place = index->slot[s];
    if (*place >= 0)
        return OST_SUCCESS;
    if (index->count == INT_MAX)
        return OST_RAISE(index->ctx, OST_LIMIT_EXCEEDED,
                         "a rank's part of a coarse matrix has 2^31 blocks; use more "
                         "ranks");
    if (2 * ((uint64_t)index->count + 1) > index->slots) {
        OST_TRY(grow(index, 2 * index->slots));
        s = find_slot(index, key);
    }
    *place = index->count;
    index->slot[s] = index->count;
    index->key[index->count++] = key;
    return OST_SUCCESS;
}

static int compare_numbers(const void *a, const void *b)
{
    const OstGlobal x = *(const OstGlobal *)a;
    const OstGlobal y = *(const OstGlobal *)b;
    return (x > y) - (x < y);
}

OstLocal ost_numbers_sort(OstLocal count, OstGlobal *number)
{
    OstLocal kept = 0;
    qsort(number, (size_t)count, sizeof *number, compare_numbers);
    for (OstLocal i = 0; i < count; i++)
        if (kept == 0 || number[i] != number[kept - 1])
            number[kept++] = number[i];
    return kept;
}

OstLocal ost_numbers_find(OstLocal count, const OstGlobal *number, OstGlobal wanted)
{
    const OstGlobal *found = bsearch(&wanted, number, (size_t)count, sizeof *number, compare_numbers);
    return (OstLocal)(found - number);
}
