/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/vtk/grid.h"

#include <ctype.h>
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* VTK's legacy format, by its manual: a title, ASCII or BINARY, DATASET UNSTRUCTURED_GRID, then keywords with numbers.
 * Bytes are big endian. Until version 4 a cell is its number of points and the points; since 5 there are offsets and a
 * connectivity. */

enum { WORD = OST_VTK_NAME };

typedef struct Legacy {
    OstMshCursor *cursor;
    OstVtkGrid *grid;
    int binary;
    OstGlobal tuples; /* of the data that follows, on points or on cells */
    int on_points;    /* -1: of neither */
} Legacy;

/* The next word of the text; "" at the end. */
static void next_word(OstMshCursor *cursor, char word[WORD])
{
    size_t length = 0;
    while (cursor->next < cursor->end && strchr(" \t\r\n\v\f", *cursor->next) && *cursor->next)
        cursor->next++;
    cursor->place = cursor->next;
    while (cursor->next < cursor->end && (*cursor->next == '\0' || !strchr(" \t\r\n\v\f", *cursor->next))) {
        if (length + 1 < WORD)
            word[length++] = *cursor->next;
        cursor->next++;
    }
    word[length] = '\0';
}

/* The next word as a name, in which VTK writes blanks and the like as %20. */
static void next_name(OstMshCursor *cursor, char name[WORD])
{
    char *to = name;
    next_word(cursor, name);
    for (const char *from = name; *from; from++) {
        const char digits[] = {from[0] == '%' ? from[1] : '\0', from[1] ? from[2] : '\0', '\0'};
        const int coded = isxdigit((unsigned char)digits[0]) && isxdigit((unsigned char)digits[1]);
        *to++ = coded ? (char)strtol(digits, NULL, 16) : *from;
        from += coded ? 2 : 0;
    }
    *to = '\0';
}

static OstStatus read_type(Legacy *legacy, const char *word, OstVtkType *type)
{
    static const struct {
        const char *word;
        OstVtkType type;
    } types[] = {
        {"double", {OST_VTK_FLOAT, 8}},
        {"float", {OST_VTK_FLOAT, 4}},
        {"int", {OST_VTK_SIGNED, 4}},
        {"vtkidtype", {OST_VTK_SIGNED, 4}},
        {"long", {OST_VTK_SIGNED, 8}},
        {"vtktypeint64", {OST_VTK_SIGNED, 8}},
        {"unsigned_int", {OST_VTK_UNSIGNED, 4}},
        {"unsigned_long", {OST_VTK_UNSIGNED, 8}},
        {"short", {OST_VTK_SIGNED, 2}},
        {"unsigned_short", {OST_VTK_UNSIGNED, 2}},
        {"char", {OST_VTK_SIGNED, 1}},
        {"unsigned_char", {OST_VTK_UNSIGNED, 1}},
        {"vtktypeuint64", {OST_VTK_UNSIGNED, 8}},
        {"vtktypeint32", {OST_VTK_SIGNED, 4}},
        {"vtktypeuint32", {OST_VTK_UNSIGNED, 4}},
        {"vtktypeint16", {OST_VTK_SIGNED, 2}},
        {"vtktypeint8", {OST_VTK_SIGNED, 1}},
        {"vtktypeuint8", {OST_VTK_UNSIGNED, 1}},
        {"vtktypefloat64", {OST_VTK_FLOAT, 8}},
        {"vtktypefloat32", {OST_VTK_FLOAT, 4}},
    };
    for (size_t t = 0; t < sizeof types / sizeof *types; t++)
        if (strcasecmp(word, types[t].word) == 0) {
            *type = types[t].type;
            return OST_SUCCESS;
        }
    return OST_RAISE_MSH(legacy->cursor, "'%s' found, expected a type of numbers such as double or int", word);
}

/* One number as text. */
static OstStatus read_text(OstMshCursor *cursor, const char *what, double *value)
{
    char word[WORD], *end = NULL;
    next_word(cursor, word);
    *value = strtod(word, &end);
    if (word[0] == '\0' || *end != '\0')
        return OST_RAISE_MSH(cursor, "'%s' found, expected %s", word, what);
    return OST_SUCCESS;
}

/* Values follow their line: text, or as many bytes. `values` NULL: skips them. */
static OstStatus read_numbers(Legacy *legacy, const char *what, OstVtkType type, OstGlobal count, double *values)
{
    OstMshCursor *cursor = legacy->cursor;
    double value = 0.0;
    if (!legacy->binary) {
        for (OstGlobal i = 0; i < count; i++) {
            OST_TRY(read_text(cursor, what, &value));
            if (values)
                values[i] = value;
        }
        return OST_SUCCESS;
    }
    OST_TRY(ost_msh_check_count(cursor, what, count, type.bytes));
    for (OstGlobal i = 0; values && i < count; i++)
        values[i] = ost_vtk_number(type, 1, cursor->next + i * type.bytes);
    cursor->next += count * type.bytes;
    return OST_SUCCESS;
}

/* A count of values in the text, of which at least a byte each follows. */
static OstStatus read_count(Legacy *legacy, const char *what, OstGlobal *count)
{
    OST_TRY(ost_msh_size(legacy->cursor, what, count));
    return ost_msh_check_count(legacy->cursor, what, *count, 1);
}

static OstStatus read_line_type(Legacy *legacy, OstVtkType *type)
{
    char word[WORD];
    next_word(legacy->cursor, word);
    OST_TRY(read_type(legacy, word, type));
    ost_msh_rest_of_line(legacy->cursor);
    return OST_SUCCESS;
}

static OstStatus once(Legacy *legacy, const void *array, const char *what)
{
    return array ? OST_RAISE_MSH(legacy->cursor, "%s a second time", what) : OST_SUCCESS;
}

static OstStatus read_points(Legacy *legacy)
{
    OstVtkGrid *grid = legacy->grid;
    OstVtkType type;
    OST_TRY(once(legacy, grid->coordinates, "POINTS"));
    OST_TRY(read_count(legacy, "the number of points", &grid->points));
    OST_TRY(read_line_type(legacy, &type));
    OST_TRY(ost_msh_check_count(legacy->cursor, "coordinates", grid->points, 3));
    OST_TRY(OST_NEW(grid->ctx, &grid->coordinates, 3 * grid->points));
    OST_TRY(read_numbers(legacy, "a coordinate", type, 3 * grid->points, grid->coordinates));
    for (OstGlobal i = 0; i < 3 * grid->points; i++)
        if (!isfinite(grid->coordinates[i]))
            return OST_RAISE_MSH(legacy->cursor, "point %" PRId64 " has the coordinate %g, expected a finite number",
                                 i / 3, grid->coordinates[i]);
    return OST_SUCCESS;
}

/* --- cells --- */

/* Whole numbers of a type, 0 to `largest`. */
static OstStatus read_whole(Legacy *legacy, const char *what, OstVtkType type, OstGlobal count, OstGlobal largest,
                            OstGlobal *numbers)
{
    double *values = NULL;
    OstStatus status = OST_NEW(legacy->grid->ctx, &values, count);
    OST_THEN(read_numbers(legacy, what, type, count, values));
    OST_THEN(ost_vtk_whole(legacy->cursor, what, count, values, largest, numbers));
    OST_FREE(values);
    return status;
}

/* Version 5: OFFSETS, which begin with 0, and CONNECTIVITY. */
static OstStatus read_offsets(Legacy *legacy, OstGlobal offsets, OstGlobal connections)
{
    OstVtkGrid *grid = legacy->grid;
    OstVtkType type;
    char word[WORD];
    OstGlobal *start = NULL;
    OST_TRY(read_line_type(legacy, &type));
    OST_TRY(OST_NEW(grid->ctx, &start, offsets + 1));
    OstStatus status = read_whole(legacy, "an offset", type, offsets, connections, start);
    OST_THEN(OST_NEW(grid->ctx, &grid->end, offsets));
    for (OstGlobal c = 0; c + 1 < offsets && status == OST_SUCCESS; c++)
        grid->end[c] = start[c + 1];
    OST_FREE(start);
    OST_TRY(status);
    next_word(legacy->cursor, word);
    if (strcasecmp(word, "CONNECTIVITY") != 0)
        return OST_RAISE_MSH(legacy->cursor, "'%s' found, expected CONNECTIVITY", word);
    OST_TRY(read_line_type(legacy, &type));
    grid->cells = offsets > 0 ? offsets - 1 : 0;
    grid->connections = connections;
    OST_TRY(OST_NEW(grid->ctx, &grid->connectivity, connections));
    return read_whole(legacy, "a point of a cell", type, connections, OST_LARGEST_LABEL - 1, grid->connectivity);
}

/* Before: each cell is a count and as many points. */
static OstStatus split_cells(Legacy *legacy, const OstGlobal *numbers, OstGlobal count)
{
    OstVtkGrid *grid = legacy->grid;
    OstGlobal at = 0;
    for (OstGlobal c = 0; c < grid->cells; c++) {
        const OstGlobal points = at < count ? numbers[at++] : count;
        if (points > count - at)
            return OST_RAISE_MSH(legacy->cursor, "cell %" PRId64 " goes beyond the end of CELLS", c);
        for (OstGlobal i = 0; i < points; i++)
            grid->connectivity[grid->connections++] = numbers[at++];
        grid->end[c] = grid->connections;
    }
    return OST_SUCCESS;
}

static OstStatus read_old_cells(Legacy *legacy, OstGlobal cells, OstGlobal count)
{
    OstVtkGrid *grid = legacy->grid;
    OstGlobal *numbers = NULL;
    grid->cells = cells;
    OstStatus status = OST_NEW(grid->ctx, &numbers, count);
    OST_THEN(OST_NEW(grid->ctx, &grid->end, cells));
    OST_THEN(OST_NEW(grid->ctx, &grid->connectivity, count));
    OST_THEN(read_whole(legacy, "a number of a cell", (OstVtkType){OST_VTK_SIGNED, 4}, count, OST_LARGEST_LABEL - 1,
                        numbers));
    OST_THEN(split_cells(legacy, numbers, count));
    OST_FREE(numbers);
    return status;
}

static OstStatus read_cells(Legacy *legacy)
{
    OstMshCursor *cursor = legacy->cursor;
    OstGlobal cells = 0, count = 0;
    char word[WORD];
    OST_TRY(once(legacy, legacy->grid->end, "CELLS"));
    OST_TRY(read_count(legacy, "the number of cells", &cells));
    OST_TRY(read_count(legacy, "the length of CELLS", &count));
    ost_msh_rest_of_line(cursor);
    const char *line = cursor->next;
    next_word(cursor, word);
    if (strcasecmp(word, "OFFSETS") == 0)
        return read_offsets(legacy, cells, count);
    cursor->next = line;
    return read_old_cells(legacy, cells, count);
}

static OstStatus read_types(Legacy *legacy)
{
    OstVtkGrid *grid = legacy->grid;
    OstGlobal count = 0, *types = NULL;
    OST_TRY(once(legacy, grid->type, "CELL_TYPES"));
    OST_TRY(read_count(legacy, "the number of cell types", &count));
    ost_msh_rest_of_line(legacy->cursor);
    if (count != grid->cells)
        return OST_RAISE_MSH(legacy->cursor, "%" PRId64 " types of %" PRId64 " cells", count, grid->cells);
    OST_TRY(OST_NEW(grid->ctx, &types, count));
    OstStatus status =
        read_whole(legacy, "the type of a cell", (OstVtkType){OST_VTK_SIGNED, 4}, count, UCHAR_MAX, types);
    OST_THEN(OST_NEW(grid->ctx, &grid->type, count));
    for (OstGlobal c = 0; c < count && status == OST_SUCCESS; c++)
        grid->type[c] = (unsigned char)types[c];
    OST_FREE(types);
    return status;
}

/* --- data --- */

static OstStatus read_array(Legacy *legacy, const char *name, OstVtkType type, OstGlobal components, OstGlobal tuples)
{
    OstVtkGrid *grid = legacy->grid;
    double *values = NULL;
    if (components < 1 || components > INT_MAX || tuples > (legacy->cursor->end - legacy->cursor->bytes) / components)
        return OST_RAISE_MSH(legacy->cursor,
                             "'%s' has %" PRId64 " components and %" PRId64 " entries, more than the file", name,
                             components, tuples);
    if (legacy->on_points < 0 || !ost_vtk_wants(grid, name, type.kind == OST_VTK_SIGNED, components))
        return read_numbers(legacy, name, type, components * tuples, NULL);
    OstStatus status = OST_NEW(grid->ctx, &values, components * tuples);
    OST_THEN(read_numbers(legacy, name, type, components * tuples, values));
    OST_THEN(ost_vtk_add_array(grid, name, legacy->on_points, (int)components, tuples, &values));
    OST_FREE(values);
    return status;
}

/* After COLOR_SCALARS or LOOKUP_TABLE: name, components or entries, then a byte or, in text, a number for each. */
static OstStatus skip_colours(Legacy *legacy, OstGlobal times)
{
    char name[WORD];
    OstGlobal count = 0;
    const OstVtkType byte = {OST_VTK_UNSIGNED, 1};
    next_word(legacy->cursor, name);
    OST_TRY(read_count(legacy, "a count of colours", &count));
    ost_msh_rest_of_line(legacy->cursor);
    OST_TRY(ost_msh_check_count(legacy->cursor, "colours", count, times > 0 ? times : 1));
    return read_numbers(legacy, "a colour", byte, count * times, NULL);
}

/* SCALARS name type [components], then LOOKUP_TABLE name. */
static OstStatus read_scalars(Legacy *legacy)
{
    char name[WORD], word[WORD];
    OstVtkType type;
    OstMshCursor *cursor = legacy->cursor;
    next_name(cursor, name);
    next_word(cursor, word);
    OST_TRY(read_type(legacy, word, &type));
    const OstMshText rest = ost_msh_rest_of_line(cursor);
    const int components = rest.length > 0 ? atoi(rest.start) : 1;
    const char *line = cursor->next;
    next_word(cursor, word);
    if (strcasecmp(word, "LOOKUP_TABLE") == 0)
        ost_msh_rest_of_line(cursor);
    else
        cursor->next = line;
    return read_array(legacy, name, type, components, legacy->tuples);
}

/* Name and type; before the type `components`, if 0. */
static OstStatus read_attribute(Legacy *legacy, OstGlobal components)
{
    char name[WORD];
    OstVtkType type;
    next_name(legacy->cursor, name);
    if (components == 0)
        OST_TRY(ost_msh_size(legacy->cursor, "the number of components", &components));
    OST_TRY(read_line_type(legacy, &type));
    return read_array(legacy, name, type, components, legacy->tuples);
}

/* After the word METADATA: skips the rest of its line, and lines up to a blank one. */
static void skip_metadata(OstMshCursor *cursor)
{
    OstMshText line = ost_msh_rest_of_line(cursor);
    do {
        line = ost_msh_rest_of_line(cursor);
    } while (line.length > 0 && cursor->next < cursor->end);
}

/* FIELD name count, then arrays: name components tuples type. */
static OstStatus read_fields(Legacy *legacy)
{
    OstMshCursor *cursor = legacy->cursor;
    OstGlobal count = 0;
    char name[WORD], word[WORD];
    next_name(cursor, name);
    OST_TRY(read_count(legacy, "the number of arrays", &count));
    ost_msh_rest_of_line(cursor);
    for (OstGlobal a = 0; a < count; a++) {
        OstGlobal components = 0, tuples = 0;
        OstVtkType type;
        next_name(cursor, name);
        if (strcasecmp(name, "METADATA") == 0) {
            skip_metadata(cursor);
            next_name(cursor, name);
        }
        OST_TRY(ost_msh_size(cursor, "the number of components", &components));
        OST_TRY(ost_msh_size(cursor, "the number of entries", &tuples));
        next_word(cursor, word);
        if (strcasecmp(word, "string") == 0)
            return OST_RAISE_MSH(cursor, "the array '%s' holds strings, which are not read; remove it", name);
        OST_TRY(read_type(legacy, word, &type));
        ost_msh_rest_of_line(cursor);
        OST_TRY(read_array(legacy, name, type, components, tuples));
    }
    return OST_SUCCESS;
}

/* --- the file --- */

static OstStatus begin_data(Legacy *legacy, int on_points)
{
    legacy->on_points = on_points;
    OST_TRY(ost_msh_size(legacy->cursor, "the number of entries", &legacy->tuples));
    const OstGlobal expected = on_points ? legacy->grid->points : legacy->grid->cells;
    return legacy->tuples == expected ? OST_SUCCESS
                                      : OST_RAISE_MSH(legacy->cursor, "data of %" PRId64 " %s, and there are %" PRId64,
                                                      legacy->tuples, on_points ? "points" : "cells", expected);
}

static const struct {
    const char *word;
    int components; /* 0: the file says */
} attributes[] = {{"VECTORS", 3},    {"NORMALS", 3},      {"TENSORS", 9},    {"TENSORS6", 6},
                  {"GLOBAL_IDS", 1}, {"PEDIGREE_IDS", 1}, {"EDGE_FLAGS", 1}, {"TEXTURE_COORDINATES", 0}};

static OstStatus read_keyword(Legacy *legacy, const char *word)
{
    char name[WORD];
    if (strcasecmp(word, "DATASET") == 0) {
        next_word(legacy->cursor, name);
        return strcasecmp(name, "UNSTRUCTURED_GRID") == 0
                   ? OST_SUCCESS
                   : OST_RAISE_MSH(
                         legacy->cursor,
                         "a data set of the kind '%s', expected UNSTRUCTURED_GRID (in ParaView: Tetrahedralize, "
                         "then File, Save Data as .vtu)",
                         name);
    }
    if (strcasecmp(word, "POINTS") == 0)
        return read_points(legacy);
    if (strcasecmp(word, "CELLS") == 0)
        return read_cells(legacy);
    if (strcasecmp(word, "CELL_TYPES") == 0)
        return read_types(legacy);
    if (strcasecmp(word, "CELL_DATA") == 0)
        return begin_data(legacy, 0);
    if (strcasecmp(word, "POINT_DATA") == 0)
        return begin_data(legacy, 1);
    if (strcasecmp(word, "FIELD") == 0)
        return read_fields(legacy);
    if (strcasecmp(word, "SCALARS") == 0)
        return read_scalars(legacy);
    for (size_t a = 0; a < sizeof attributes / sizeof *attributes; a++)
        if (strcasecmp(word, attributes[a].word) == 0)
            return read_attribute(legacy, attributes[a].components);
    if (strcasecmp(word, "COLOR_SCALARS") == 0)
        return skip_colours(legacy, legacy->tuples);
    if (strcasecmp(word, "LOOKUP_TABLE") == 0)
        return skip_colours(legacy, 4);
    if (strcasecmp(word, "METADATA") == 0) {
        skip_metadata(legacy->cursor);
        return OST_SUCCESS;
    }
    return OST_RAISE_MSH(legacy->cursor,
                         "'%s' found, which is not known here; write the file again, as an unstructured "
                         "grid with scalars, vectors, tensors and fields alone",
                         word);
}

OstStatus ost_vtk_legacy_grid(OstMshCursor *cursor, OstVtkGrid *grid)
{
    Legacy legacy = {.cursor = cursor, .grid = grid, .on_points = -1};
    char word[WORD];
    const OstMshText first = ost_msh_rest_of_line(cursor);
    if (first.length < 5 || strncasecmp(first.start, "# vtk", 5) != 0)
        return OST_RAISE_MSH(cursor, "'# vtk DataFile Version …' is expected");
    ost_msh_rest_of_line(cursor); /* the title */
    next_word(cursor, word);
    legacy.binary = strcasecmp(word, "BINARY") == 0;
    if (!legacy.binary && strcasecmp(word, "ASCII") != 0)
        return OST_RAISE_MSH(cursor, "'%s' found, expected ASCII or BINARY", word);
    for (next_word(cursor, word); word[0]; next_word(cursor, word))
        OST_TRY(read_keyword(&legacy, word));
    return OST_SUCCESS;
}
