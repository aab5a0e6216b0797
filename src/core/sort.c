/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/sort.h"

#include <stdlib.h>

int ost_compare_numbers(const void *a, const void *b)
{
    const OstGlobal x = *(const OstGlobal *)a;
    const OstGlobal y = *(const OstGlobal *)b;
    return (x > y) - (x < y);
}

void ost_sort_numbers(size_t count, OstGlobal *numbers)
{
    if (count > 1)
        qsort(numbers, count, sizeof *numbers, ost_compare_numbers);
}
