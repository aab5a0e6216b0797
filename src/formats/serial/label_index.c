/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/serial/label_index.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"

#include <stdlib.h>

static int counts_up(OstGlobal count, const OstGlobal *label)
{
    for (OstGlobal i = 1; i < count; i++)
        if (label[i] - 1 != label[i - 1])
            return 0;
    return 1;
}

OstStatus ost_label_index_create(OstContext *ctx, OstGlobal count, const OstGlobal *label, OstLabelIndex *index)
{
    *index = (OstLabelIndex){.count = count, .first = count > 0 ? label[0] : 0};
    if (counts_up(count, label))
        return OST_SUCCESS;
    OST_TRY(OST_NEW(ctx, &index->sorted, count));
    for (OstGlobal i = 0; i < count; i++)
        index->sorted[i] = (OstLabelledPosition){label[i], i};
    qsort(index->sorted, (size_t)count, sizeof *index->sorted, ost_compare_numbers);
    for (OstGlobal i = 1; i < count && !index->repeated; i++)
        if (index->sorted[i].label == index->sorted[i - 1].label) {
            index->repeated = 1;
            index->repeated_label = index->sorted[i].label;
        }
    return OST_SUCCESS;
}

void ost_label_index_clear(OstLabelIndex *index)
{
    OST_FREE(index->sorted);
    *index = (OstLabelIndex){0};
}

OstGlobal ost_label_index_find(const OstLabelIndex *index, OstGlobal label)
{
    if (!index->sorted)
        return label >= index->first && label - index->first < index->count ? label - index->first : -1;
    const OstLabelledPosition wanted = {label, 0};
    const OstLabelledPosition *found =
        bsearch(&wanted, index->sorted, (size_t)index->count, sizeof wanted, ost_compare_numbers);
    return found ? found->position : -1;
}
