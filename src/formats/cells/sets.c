/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "formats/cells/cells.h"

#include <stdlib.h>

/* A short range is put as it is. A long one may claim more than there is: it is looked for in what has been read. */
static const OstGlobal short_range = 1000;

static int compare_items(const void *a, const void *b)
{
    const OstGlobal x = *(const OstGlobal *)a, y = *(const OstGlobal *)b;
    return (x > y) - (x < y);
}

/* Sets that hold sets would grow without end if an item could come twice. */
void ost_cells_keep_once(OstCells *cells, int number)
{
    OstCellSet *set = &cells->set[number];
    OstLocal kept = 0;
    if (set->count > 0)
        qsort(set->item, (size_t)set->count, sizeof *set->item, compare_items);
    for (OstLocal i = 0; i < set->count; i++)
        if (i == 0 || set->item[i] != set->item[i - 1])
            set->item[kept++] = set->item[i];
    set->count = kept;
}

OstStatus ost_cells_put_set(OstCells *cells, int set, int from)
{
    const OstLocal count = set == from ? 0 : cells->set[from].count;
    for (OstLocal i = 0; i < count; i++)
        OST_TRY(ost_cells_put(cells, set, cells->set[from].item[i]));
    ost_cells_keep_once(cells, set);
    return OST_SUCCESS;
}

static OstStatus put_labels(OstCells *cells, int set, OstLocal count, const OstGlobal *label, const OstGlobal range[3])
{
    for (OstLocal i = 0; i < count; i++)
        if (label[i] >= range[0] && label[i] <= range[1] && (label[i] - range[0]) % range[2] == 0)
            OST_TRY(ost_cells_put(cells, set, label[i]));
    return OST_SUCCESS;
}

OstStatus ost_cells_put_range(OstCells *cells, int set, OstGlobal first, OstGlobal last, OstGlobal step)
{
    const OstGlobal range[3] = {first, last, step};
    if ((last - first) / step < short_range) {
        for (OstGlobal item = first; item <= last; item += step)
            OST_TRY(ost_cells_put(cells, set, item));
        return OST_SUCCESS;
    }
    if (cells->set[set].kind == OST_SET_OF_NODES)
        return put_labels(cells, set, cells->chunk->node_count, cells->chunk->node_label, range);
    for (int k = 0; k < OST_CELL_KINDS; k++)
        OST_TRY(put_labels(cells, set, cells->list[k].count, cells->list[k].label, range));
    return OST_SUCCESS;
}
