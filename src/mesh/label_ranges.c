/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/label_ranges.h"

#include <stdlib.h>

static int compare_ranges(const void *a, const void *b)
{
    const OstGlobal x = ((const OstLabelRange *)a)->first;
    const OstGlobal y = ((const OstLabelRange *)b)->first;
    return (x > y) - (x < y);
}

void ost_ranges_sort(OstGlobal count, OstLabelRange *ranges)
{
    if (count > 1)
        qsort(ranges, (size_t)count, sizeof *ranges, compare_ranges);
}

OstGlobal ost_ranges_join(OstGlobal count, OstLabelRange *ranges)
{
    OstGlobal kept = 0;
    ost_ranges_sort(count, ranges);
    for (OstGlobal i = 0; i < count; i++)
        if (kept == 0 || ranges[i].first > ranges[kept - 1].last + 1)
            ranges[kept++] = ranges[i];
        else if (ranges[i].last > ranges[kept - 1].last)
            ranges[kept - 1].last = ranges[i].last;
    return kept;
}

OstGlobal ost_ranges_total(OstGlobal count, const OstLabelRange *ranges)
{
    OstGlobal total = 0;
    for (OstGlobal i = 0; i < count; i++)
        total += ranges[i].last - ranges[i].first + 1;
    return total;
}

static int compare_with_range(const void *key, const void *range)
{
    const OstGlobal label = *(const OstGlobal *)key;
    const OstLabelRange *in = range;
    return (label > in->last) - (label < in->first);
}

OstGlobal ost_ranges_find(OstGlobal count, const OstLabelRange *ranges, OstGlobal label)
{
    const OstLabelRange *found =
        count > 0 ? bsearch(&label, ranges, (size_t)count, sizeof *ranges, compare_with_range) : NULL;
    return found ? found - ranges : -1;
}
