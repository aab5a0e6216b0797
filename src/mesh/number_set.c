/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/number_set.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/sort.h"

/* Numbers are mentioned many times over: sorting when the array is full keeps it near the size of the set. */
static void remove_repetitions(NumberSet *set)
{
    if (set->count == 0)
        return;
    ost_sort_numbers(set->count, set->number);
    size_t kept = 1;
    for (size_t i = 1; i < set->count; i++)
        if (set->number[i] != set->number[kept - 1])
            set->number[kept++] = set->number[i];
    set->count = kept;
}

OstStatus ost_number_set_add(OstContext *ctx, NumberSet *set, OstGlobal number)
{
    if (set->count == set->capacity) {
        remove_repetitions(set);
        if (2 * set->count >= set->capacity) {
            const size_t capacity = 2 * set->capacity + 1024;
            OST_TRY(OST_RESIZE(ctx, &set->number, capacity));
            set->capacity = capacity;
        }
    }
    set->number[set->count++] = number;
    return OST_SUCCESS;
}

OstStatus ost_number_set_close(OstContext *ctx, NumberSet *set)
{
    remove_repetitions(set);
    if (set->count > INT32_MAX)
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED,
                         "a rank would hold copies of %zu nodes, more than the %d it can number; use more ranks",
                         set->count, INT32_MAX);
    return OST_SUCCESS;
}

void ost_number_set_clear(NumberSet *set)
{
    OST_FREE(set->number);
    set->count = 0;
    set->capacity = 0;
}

OstLocal ost_number_find(const OstGlobal *sorted, OstLocal count, OstGlobal number)
{
    OstLocal low = 0;
    OstLocal high = count;
    while (low < high) {
        const OstLocal middle = low + (high - low) / 2;
        if (sorted[middle] < number)
            low = middle + 1;
        else
            high = middle;
    }
    return low < count && sorted[low] == number ? low : -1;
}
