/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "formats/serial/formats.h"
#include "formats/serial/line_reader.h"
#include "mesh/label_ranges.h"

#include <inttypes.h>

typedef struct RangeList {
    OstGlobal count, capacity;
    OstLabelRange *range;
} RangeList;

enum { FIRST_CAPACITY = 64 };

/* A full list is first merged, so that a file cannot fill it with the same few numbers again and again. */
static OstStatus make_room(OstLineReader *reader, RangeList *list)
{
    if (list->count < list->capacity)
        return OST_SUCCESS;
    list->count = ost_ranges_join(list->count, list->range);
    if (list->capacity > 0 && list->count <= list->capacity / 2)
        return OST_SUCCESS;
    const OstGlobal capacity = list->capacity > 0 ? 2 * list->capacity : FIRST_CAPACITY;
    OST_TRY(OST_RESIZE(reader->ctx, &list->range, capacity));
    list->capacity = capacity;
    return OST_SUCCESS;
}

static OstStatus add_range(OstLineReader *reader, RangeList *list, OstGlobal first, OstGlobal last)
{
    if (first < 0 || last < first || last > OST_LARGEST_LABEL)
        return OST_RAISE_LINE(
            reader, "vertices %" PRId64 " to %" PRId64 " found, expected numbers from 0 to %" PRId64 " that ascend",
            first, last, OST_LARGEST_LABEL);
    OST_TRY(make_room(reader, list));
    list->range[list->count++] = (OstLabelRange){first, last};
    return OST_SUCCESS;
}

static OstStatus read_line(OstLineReader *reader, RangeList *list)
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

static OstStatus read_list(OstContext *ctx, const char *path, RangeList *list)
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
        list->count = ost_ranges_join(list->count, list->range);
done:
    ost_lines_close(&reader);
    return status;
}

OstStatus ost_vertex_list_read(OstContext *ctx, const char *path, OstGlobal *count, OstLabelRange **ranges)
{
    RangeList list = {0};
    OstStatus status = OST_SUCCESS;
    if (ost_rank(ctx) == 0)
        status = read_list(ctx, path, &list);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_broadcast(ctx, sizeof list.count, &list.count));
    OST_TRY_DONE(ost_agree(ctx, OST_RESIZE(ctx, &list.range, list.count)));
    OST_TRY_DONE(ost_broadcast(ctx, (size_t)list.count * sizeof *list.range, list.range));
done:
    if (status != OST_SUCCESS) {
        OST_FREE(list.range);
        list.count = 0;
    }
    *count = list.count;
    *ranges = list.range;
    return status;
}
