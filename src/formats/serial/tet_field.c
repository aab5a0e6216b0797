/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/serial/formats.h"

#include <math.h>
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

OstStatus ost_tet_field_add(OstMeshChunk *chunk, const char *path, const char *name, const OstFileField *field)
{
    const size_t columns = (size_t)field->width * (field->at_vertices ? 4U : 1U);
    const size_t before = (size_t)ost_tet_fields_width(&chunk->fields), after = before + columns;
    OstTetFields *fields = &chunk->fields;
    double *table = NULL;
    OST_TRY(ost_tet_field_check(chunk->ctx, path, name, field->width));
    if (fields->count == OST_MOST_TET_FIELDS)
        return OST_RAISE(chunk->ctx, OST_LIMIT_EXCEEDED, "%s: '%s' is one field too many; a case reads %d at most",
                         path, name, OST_MOST_TET_FIELDS);
    OST_TRY(OST_NEW(chunk->ctx, &table, after * (size_t)chunk->tet_count));
    for (size_t t = 0; t < (size_t)chunk->tet_count; t++) {
        if (before > 0)
            memcpy(table + after * t, chunk->tet_field + before * t, before * sizeof *table);
        memcpy(table + after * t + before, field->values + columns * t, columns * sizeof *table);
    }
    OST_FREE(chunk->tet_field);
    chunk->tet_field = table;
    fields->at_vertices[fields->count++] = (char)field->at_vertices;
    fields->first[fields->count] = (int)after;
    return OST_SUCCESS;
}

static double dot(size_t width, const double *a, const double *b)
{
    double sum = 0.0;
    for (size_t k = 0; k < width; k++)
        sum += a[k] * b[k];
    return sum;
}

/* Of directions, three numbers each: their lengths say nothing, but would weigh them where a tet's vertices are added.
 */
static void make_unit(size_t width, double *directions)
{
    for (size_t k = 0; k + 3 <= width; k += 3) {
        const double length = sqrt(dot(3, directions + k, directions + k));
        for (size_t i = k; i < k + 3 && length > 0.0; i++)
            directions[i] /= length;
    }
}

/* What a field has at the vertices of a tet. Directions are turned as the first one that there is: a fibre has no
 * sense. Returns whether a direction is missing. */
static int take_vertices(const OstFileField *field, const OstGlobal *nodes, unsigned use, double *at_vertices)
{
    const size_t width = (size_t)field->width;
    const double *first = NULL;
    int misses = 0;
    for (int v = 0; v < 4; v++) {
        const double *value = field->values + width * (size_t)nodes[v];
        double sense = 1.0;
        if ((use & OST_FIELD_OF_DIRECTIONS) != 0) {
            const int is_zero = dot(width, value, value) == 0.0;
            misses |= is_zero;
            first = first || is_zero ? first : value;
            sense = first && dot(width, value, first) < 0.0 ? -1.0 : 1.0;
        }
        for (size_t k = 0; k < width; k++)
            at_vertices[width * (size_t)v + k] = sense * value[k];
        if ((use & OST_FIELD_OF_DIRECTIONS) != 0)
            make_unit(width, at_vertices + width * (size_t)v);
    }
    return misses;
}

OstStatus ost_tet_field_of_nodes(const OstMeshChunk *chunk, unsigned use, OstFileField *field)
{
    const size_t width = (size_t)field->width, kept = (use & OST_FIELD_AT_VERTICES) != 0 ? 4 * width : width;
    double *of_tets = NULL, at_vertices[4 * 9];
    if (!field->on_nodes || width > 9)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(chunk->ctx, &of_tets, (size_t)chunk->tet_count * kept));
    for (size_t t = 0; t < (size_t)chunk->tet_count; t++) {
        field->misses += take_vertices(field, chunk->tet_nodes + t * (size_t)chunk->nodes_per_tet, use, at_vertices);
        for (size_t k = 0; k < kept && kept > width; k++)
            of_tets[kept * t + k] = at_vertices[k];
        for (size_t k = 0; k < 4 * width && kept == width; k++)
            of_tets[width * t + k % width] += 0.25 * at_vertices[k];
    }
    OST_FREE(field->values);
    field->values = of_tets;
    field->at_vertices = kept > width;
    return OST_SUCCESS;
}

void ost_tet_field_warn(OstContext *ctx, const char *path, const char *name, double misses)
{
    if (misses > 0.0)
        ost_warn(
            ctx,
            "%s: the field '%s' is zero at vertices of %.0f tet%s, as where data is missing: the other vertices of a "
            "tet give its direction",
            path, name, misses, misses > 1.0 ? "s" : "");
}
