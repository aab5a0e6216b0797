/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/msh/msh.h"
#include "formats/serial/formats.h"

#include <math.h>
#include <string.h>

/* $ElementData, by Gmsh's manual: strings, the first of which is the name; numbers, the first the time; integers, the
 * step, the components and the elements; then a line, or record, for each element: its tag and the components. */

typedef struct Field {
    OstMsh msh; /* its cursor and version alone are used */
    const char *name;
    OstMeshChunk *chunk;
    OstLabelIndex tets;
    int found, step, later; /* is it there; its step; are there further ones? */
} Field;

enum { STEP, COMPONENTS, ELEMENTS, INTEGERS };

static OstStatus skip_lines(OstMshCursor *cursor, const char *what)
{
    OstGlobal count = 0;
    OST_TRY(ost_msh_count_line(cursor, what, &count));
    OST_TRY(ost_msh_check_count(cursor, what, count, 1));
    for (OstGlobal i = 0; i < count; i++)
        ost_msh_rest_of_line(cursor);
    return OST_SUCCESS;
}

/* The strings; is it the field's name? */
static OstStatus read_name(Field *field, int *wanted)
{
    OstMshCursor *cursor = &field->msh.cursor;
    OstGlobal count = 0;
    const size_t length = strlen(field->name);
    *wanted = 0;
    OST_TRY(ost_msh_count_line(cursor, "the number of string tags", &count));
    OST_TRY(ost_msh_check_count(cursor, "string tags", count, 1));
    for (OstGlobal i = 0; i < count; i++) {
        OstMshText text = ost_msh_rest_of_line(cursor);
        if (text.length >= 2 && text.start[0] == '"' && text.start[text.length - 1] == '"')
            text = (OstMshText){text.start + 1, text.length - 2};
        if (i == 0)
            *wanted = (size_t)text.length == length && memcmp(text.start, field->name, length) == 0;
    }
    return OST_SUCCESS;
}

static OstStatus read_integers(OstMshCursor *cursor, int integer[INTEGERS])
{
    OstGlobal count = 0;
    OST_TRY(ost_msh_count_line(cursor, "the number of integer tags", &count));
    OST_TRY(ost_msh_check_count(cursor, "integer tags", count, 1));
    if (count < INTEGERS)
        return OST_RAISE_MSH(cursor, "%d integer tags found, expected 3: step, components and elements", (int)count);
    for (OstGlobal i = 0; i < count; i++) {
        int value;
        OST_TRY(ost_msh_int(cursor, "an integer tag", &value));
        if (i < INTEGERS)
            integer[i] = value;
    }
    ost_msh_rest_of_line(cursor);
    return integer[ELEMENTS] >= 0 ? OST_SUCCESS
                                  : OST_RAISE_MSH(cursor, "%d elements found, expected 0 or more", integer[ELEMENTS]);
}

static OstStatus make_room(Field *field, int width)
{
    OstMeshChunk *chunk = field->chunk;
    OST_TRY(ost_tet_field_check(chunk->ctx, field->msh.cursor.path, field->name, width));
    if (field->found && width != chunk->field_width)
        return OST_RAISE_MSH(&field->msh.cursor, "'%s' has %d components here, and %d before", field->name, width,
                             chunk->field_width);
    if (field->found)
        return OST_SUCCESS;
    chunk->field_width = width;
    OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_field, (size_t)chunk->tet_count * (size_t)width));
    for (size_t i = 0; i < (size_t)chunk->tet_count * (size_t)width; i++)
        chunk->tet_field[i] = NAN;
    return OST_SUCCESS;
}

/* Elements that are no tets of the mesh are passed over. */
static OstStatus read_values(Field *field, int width, int count)
{
    OstMshCursor *cursor = &field->msh.cursor;
    OST_TRY(ost_msh_check_count(cursor, "elements with data", count, 1 + width));
    for (int i = 0; i < count; i++) {
        int tag;
        OST_TRY(ost_msh_int(cursor, "the tag of an element", &tag));
        const OstGlobal tet = ost_label_index_find(&field->tets, tag);
        for (int k = 0; k < width; k++) {
            double value;
            OST_TRY(ost_msh_double(cursor, "a value of an element", &value));
            if (tet >= 0)
                field->chunk->tet_field[(size_t)tet * (size_t)width + (size_t)k] = value;
        }
    }
    return OST_SUCCESS;
}

/* Partitions and appended views may state a field in several sections of one step. */
static OstStatus read_data(Field *field)
{
    OstMshCursor *cursor = &field->msh.cursor;
    const int binary = cursor->binary;
    int wanted = 0, integer[INTEGERS] = {0};
    cursor->binary = 0;
    OstStatus status = read_name(field, &wanted);
    OST_THEN(skip_lines(cursor, "real tags"));
    OST_THEN(read_integers(cursor, integer));
    cursor->binary = binary;
    OST_TRY(status);
    field->later |= wanted && field->found && integer[STEP] != field->step;
    if (!wanted || (field->found && integer[STEP] != field->step))
        return OST_SUCCESS;
    OST_TRY(make_room(field, integer[COMPONENTS]));
    field->found = 1;
    field->step = integer[STEP];
    return read_values(field, integer[COMPONENTS], integer[ELEMENTS]);
}

static OstStatus read_sections(Field *field)
{
    OstMshCursor *cursor = &field->msh.cursor;
    char name[OST_MSH_LONGEST_NAME];
    while (cursor->next < cursor->end) {
        const OstMshText line = ost_msh_rest_of_line(cursor);
        if (line.length == 0 || line.start[0] != '$')
            continue;
        ost_msh_section_name(line, name);
        if (strcmp(name, "MeshFormat") == 0 && field->msh.version == 0)
            OST_TRY(ost_msh_format(&field->msh));
        else if (strcmp(name, "ElementData") == 0)
            OST_TRY(read_data(field));
        OST_TRY(ost_msh_skip_section(cursor, name));
        ost_msh_rest_of_line(cursor); /* its end */
    }
    return OST_SUCCESS;
}

static OstStatus index_tets(Field *field)
{
    const OstMeshChunk *chunk = field->chunk;
    const char *path = field->msh.cursor.path;
    if (chunk->relabelled)
        return OST_RAISE(chunk->ctx, OST_INVALID_INPUT,
                         "%s: the tets were numbered anew, as several had one tag, so that the field '%s' cannot be "
                         "told tet by tet; give each element its own tag",
                         path, field->name);
    return ost_label_index_create(chunk->ctx, chunk->tet_count, chunk->tet_label, &field->tets);
}

OstStatus ost_msh_read_field(OstContext *ctx, const char *path, const char *name, OstMeshChunk *chunk)
{
    Field field = {.name = name, .chunk = chunk};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_msh_open(ctx, path, &field.msh.cursor));
    OST_TRY_DONE(index_tets(&field));
    OST_TRY_DONE(read_sections(&field));
    if (!field.found)
        status = OST_RAISE(ctx, OST_INVALID_INPUT, "%s: there is no $ElementData of the name '%s'", path, name);
    else if (field.later)
        ost_warn(ctx, "%s: the field '%s' has several time steps; step %d, the first, is taken", path, name,
                 field.step);
done:
    ost_label_index_clear(&field.tets);
    ost_msh_close(&field.msh.cursor);
    return status;
}
