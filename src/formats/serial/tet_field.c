/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/serial/formats.h"

#include <stdio.h>
#include <string.h>

void ost_tet_field_note(OstFileField *field, const char *name, size_t length)
{
    char quoted[80];
    const size_t used = strlen(field->others);
    snprintf(quoted, sizeof quoted, "'%.*s'", (int)(length < sizeof quoted - 3 ? length : sizeof quoted - 3), name);
    if (!strstr(field->others, quoted) && used + strlen(quoted) + 3 < sizeof field->others)
        snprintf(field->others + used, sizeof field->others - used, "%s%s", used ? ", " : "", quoted);
}

OstStatus ost_tet_field_raise(OstContext *ctx, const char *path, const char *name, const OstFileField *field)
{
    return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: there is no field '%s' on the elements, or on the nodes; there is %s",
                     path, name, field->others[0] ? field->others : "none");
}

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

/* The mean of a tet's vertices. Directions are turned as the first vertex's before: a fibre has no sense. */
static void mean_of_vertices(const OstFileField *field, const OstGlobal *nodes, OstFieldUse use, double *mean)
{
    const size_t width = (size_t)field->width;
    const double *first = field->values + width * (size_t)nodes[0];
    memset(mean, 0, width * sizeof *mean);
    for (int v = 0; v < 4; v++) {
        const double *value = field->values + width * (size_t)nodes[v];
        double along = 0.0;
        for (size_t k = 0; k < width && use == OST_FIELD_OF_DIRECTIONS; k++)
            along += value[k] * first[k];
        for (size_t k = 0; k < width; k++)
            mean[k] += (along < 0.0 ? -0.25 : 0.25) * value[k];
    }
}

OstStatus ost_tet_field_mean(const OstMeshChunk *chunk, OstFieldUse use, OstFileField *field)
{
    double *mean = NULL;
    if (!field->on_nodes)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(chunk->ctx, &mean, (size_t)chunk->tet_count * (size_t)field->width));
    for (size_t t = 0; t < (size_t)chunk->tet_count; t++)
        mean_of_vertices(field, chunk->tet_nodes + t * (size_t)chunk->nodes_per_tet, use,
                         mean + t * (size_t)field->width);
    OST_FREE(field->values);
    field->values = mean;
    return OST_SUCCESS;
}
