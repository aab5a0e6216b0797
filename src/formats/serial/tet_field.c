/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/serial/formats.h"

#include <string.h>

OstStatus ost_tet_field_check(OstContext *ctx, const char *path, const char *name, int width)
{
    return width == 1 || width == 3 || width == 6 || width == 9
               ? OST_SUCCESS
               : OST_RAISE(ctx, OST_INVALID_INPUT,
                           "%s: the field '%s' has %d numbers a tet, expected 1, 3, 6 or 9 (a tensor)", path, name,
                           width);
}

OstStatus ost_tet_field_add(OstMeshChunk *chunk, const char *path, const char *name, int width, const double *values)
{
    const size_t before = (size_t)ost_tet_fields_width(&chunk->fields), after = before + (size_t)width;
    OstTetFields *fields = &chunk->fields;
    double *table = NULL;
    OST_TRY(ost_tet_field_check(chunk->ctx, path, name, width));
    if (fields->count == OST_MOST_TET_FIELDS)
        return OST_RAISE(chunk->ctx, OST_LIMIT_EXCEEDED, "%s: '%s' is one field too many; a case reads %d at most",
                         path, name, OST_MOST_TET_FIELDS);
    OST_TRY(OST_NEW(chunk->ctx, &table, after * (size_t)chunk->tet_count));
    for (size_t t = 0; t < (size_t)chunk->tet_count; t++) {
        if (before > 0)
            memcpy(table + after * t, chunk->tet_field + before * t, before * sizeof *table);
        memcpy(table + after * t + before, values + (size_t)width * t, (size_t)width * sizeof *table);
    }
    OST_FREE(chunk->tet_field);
    chunk->tet_field = table;
    fields->count++;
    fields->first[fields->count] = (int)after;
    return OST_SUCCESS;
}
