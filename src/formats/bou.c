/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/sort.h"
#include "formats/line_reader.h"
#include "orthostat/mesh_file.h"

#include <inttypes.h>

/* A range of a few characters can name any number of vertices. */
static const OstGlobal most_labels = (OstGlobal)1 << 24;

typedef struct LabelList {
    OstGlobal count, capacity;
    OstGlobal *label;
} LabelList;

static OstStatus add_range(OstLineReader *reader, LabelList *list, OstGlobal first, OstGlobal last)
{
    if (first < 0 || last < first)
        return OST_RAISE_LINE(reader, "vertices %" PRId64 " to %" PRId64 " found, expected numbers from 0 that ascend",
                              first, last);
    if (last - first >= most_labels - list->count)
        return OST_RAISE_LINE(
            reader, "the list names more than %" PRId64 " vertices; select them by their place instead", most_labels);
    const OstGlobal count = list->count + last - first + 1;
    if (count > list->capacity) {
        const OstGlobal capacity = count > 2 * list->capacity ? count : 2 * list->capacity;
        OST_TRY(OST_RESIZE(reader->ctx, &list->label, capacity));
        list->capacity = capacity;
    }
    for (OstGlobal label = first; label <= last; label++)
        list->label[list->count++] = label;
    return OST_SUCCESS;
}

static OstStatus read_line(OstLineReader *reader, LabelList *list)
{
    while (!ost_lines_ended(reader)) {
        OstGlobal first = 0;
        OST_TRY(ost_lines_integer(reader, "a vertex number", &first));
        OstGlobal last = first;
        if (ost_lines_take(reader, ':'))
            OST_TRY(ost_lines_integer(reader, "the end of a range", &last));
        OST_TRY(add_range(reader, list, first, last));
    }
    return OST_SUCCESS;
}

static void sort_labels(LabelList *list)
{
    OstGlobal kept = 0;
    ost_sort_numbers((size_t)list->count, list->label);
    for (OstGlobal i = 0; i < list->count; i++)
        if (kept == 0 || list->label[i] != list->label[kept - 1])
            list->label[kept++] = list->label[i];
    list->count = kept;
}

static OstStatus read_list(OstContext *ctx, const char *path, LabelList *list)
{
    OstLineReader reader;
    OstStatus status = OST_SUCCESS;
    int found = 0;
    OST_TRY(ost_lines_open(ctx, path, &reader));
    OST_TRY_DONE(ost_lines_next(&reader, &found));
    while (found) {
        OST_TRY_DONE(read_line(&reader, list));
        OST_TRY_DONE(ost_lines_next(&reader, &found));
    }
    if (list->count == 0)
        status = OST_RAISE(ctx, OST_INVALID_INPUT, "%s: names no vertex", path);
    else
        sort_labels(list);
done:
    ost_lines_close(&reader);
    return status;
}

OstStatus ost_vertex_list_read(OstContext *ctx, const char *path, OstGlobal *count, OstGlobal **labels)
{
    LabelList list = {0};
    OstStatus status = OST_SUCCESS;
    if (ost_rank(ctx) == 0)
        status = read_list(ctx, path, &list);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(OST_MPI(ctx, MPI_Bcast(&list.count, 1, MPI_INT64_T, 0, ost_comm(ctx))));
    OST_TRY_DONE(ost_agree(ctx, OST_RESIZE(ctx, &list.label, list.count)));
    OST_TRY_DONE(OST_MPI(ctx, MPI_Bcast(list.label, (int)list.count, MPI_INT64_T, 0, ost_comm(ctx))));
done:
    if (status != OST_SUCCESS) {
        OST_FREE(list.label);
        list.count = 0;
    }
    *count = list.count;
    *labels = list.label;
    return status;
}
