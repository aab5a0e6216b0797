/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/index_map.h"

#include "core/error.h"
#include "core/memory.h"

#include <limits.h>

enum { FIRST_SLOTS = 64 };

OstStatus ost_index_create(OstContext *ctx, int words, OstIndex **index)
{
    OST_TRY(OST_NEW(ctx, index, 1));
    (*index)->ctx = ctx;
    (*index)->words = words;
    return OST_SUCCESS;
}

void ost_index_destroy(OstIndex **index)
{
    if (!*index)
        return;
    OST_FREE((*index)->key, (*index)->slot);
    OST_FREE(*index);
}

/* Where the search for a key starts: Fibonacci hashing (Knuth, volume 3, 6.4), word by word. */
static uint64_t first_slot(const OstIndex *index, const OstGlobal *key)
{
    uint64_t hash = 0;
    for (int w = 0; w < index->words; w++) {
        hash = (hash ^ (uint64_t)key[w]) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash & (index->slots - 1);
}

static int is_at(const OstIndex *index, OstLocal place, const OstGlobal *key)
{
    const OstGlobal *there = index->key + (size_t)place * (size_t)index->words;
    for (int w = 0; w < index->words; w++)
        if (there[w] != key[w])
            return 0;
    return 1;
}

/* The slot that holds the key, or the empty one where it belongs. */
static uint64_t find_slot(const OstIndex *index, const OstGlobal *key)
{
    uint64_t s = first_slot(index, key);
    while (index->slot[s] >= 0 && !is_at(index, index->slot[s], key))
        s = (s + 1) & (index->slots - 1);
    return s;
}

static OstStatus grow(OstIndex *index)
{
    const uint64_t slots = index->slots == 0 ? FIRST_SLOTS : 2 * index->slots;
    OST_TRY(OST_RESIZE(index->ctx, &index->key, slots / 2 * (uint64_t)index->words));
    OST_TRY(OST_RESIZE(index->ctx, &index->slot, slots));
    index->slots = slots;
    for (uint64_t s = 0; s < slots; s++)
        index->slot[s] = -1;
    for (OstLocal k = 0; k < index->count; k++)
        index->slot[find_slot(index, index->key + (size_t)k * (size_t)index->words)] = k;
    return OST_SUCCESS;
}

OstLocal ost_index_find(const OstIndex *index, const OstGlobal *key)
{
    return index->slots == 0 ? -1 : index->slot[find_slot(index, key)];
}

OstStatus ost_index_place(OstIndex *index, const OstGlobal *key, OstLocal *place)
{
    if (index->slots == 0)
        OST_TRY(grow(index));
    uint64_t s = find_slot(index, key);
    *place = index->slot[s];
    if (*place >= 0)
        return OST_SUCCESS;
    if (index->count == INT_MAX)
        return OST_RAISE(index->ctx, OST_LIMIT_EXCEEDED,
                         "a rank would number more than 2^31 - 1 points, or blocks of a coarse matrix; use more ranks");
    if (2 * ((uint64_t)index->count + 1) > index->slots) {
        OST_TRY(grow(index));
        s = find_slot(index, key);
    }
    *place = index->count;
    for (int w = 0; w < index->words; w++)
        index->key[(size_t)index->count * (size_t)index->words + (size_t)w] = key[w];
    index->slot[s] = index->count++;
    return OST_SUCCESS;
}
