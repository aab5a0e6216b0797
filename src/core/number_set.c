/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/number_set.h"

#include "core/error.h"
#include "core/memory.h"

#include <stdlib.h>

int ost_compare_numbers(const void *a, const void *b)
{
    const OstGlobal x = *(const OstGlobal *)a;
    const OstGlobal y = *(const OstGlobal *)b;
    return (x > y) - (x < y);
}

OstLocal ost_numbers_sort(OstLocal count, OstGlobal *numbers)
{
    OstLocal kept = 0;
    if (count > 0)
        qsort(numbers, (size_t)count, sizeof *numbers, ost_compare_numbers);
    for (OstLocal i = 0; i < count; i++)
        if (kept == 0 || numbers[i] != numbers[kept - 1])
            numbers[kept++] = numbers[i];
    return kept;
}

OstLocal ost_numbers_below(OstLocal count, const OstGlobal *sorted, OstGlobal number)
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
    return low;
}

OstLocal ost_numbers_find(OstLocal count, const OstGlobal *sorted, OstGlobal number)
{
    const OstLocal place = ost_numbers_below(count, sorted, number);
    return place < count && sorted[place] == number ? place : -1;
}

/* Most numbers are added many times. Removing repetitions before the array grows keeps it near the size of the set. */
static OstStatus make_room(OstContext *ctx, OstNumberSet *set)
{
    ost_number_set_close(set);
    if (set->count < set->capacity / 2)
        return OST_SUCCESS;
    const OstGlobal capacity = 2 * (OstGlobal)set->capacity + 1024;
    if (set->count == INT32_MAX)
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED,
                         "a rank would hold copies of more than the %d nodes that it can number; use more ranks",
                         INT32_MAX);
    set->capacity = capacity < INT32_MAX ? (OstLocal)capacity : INT32_MAX;
    return OST_RESIZE(ctx, &set->number, set->capacity);
}

OstStatus ost_number_set_add(OstContext *ctx, OstNumberSet *set, OstGlobal number)
{
    if (set->count == set->capacity)
        OST_TRY(make_room(ctx, set));
    set->number[set->count++] = number;
    return OST_SUCCESS;
}

void ost_number_set_close(OstNumberSet *set)
{
    set->count = ost_numbers_sort(set->count, set->number);
}

void ost_number_set_clear(OstNumberSet *set)
{
    OST_FREE(set->number);
    *set = (OstNumberSet){0};
}
