/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/msh/msh.h"
#include "formats/serial/formats.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* $ElementData and $NodeData, by Gmsh's manual: strings, the first of which is the name; numbers, the first the time;
 * integers, the step, the components and the elements; then a line, or record, for each element or node: its tag and
 * the components. */

typedef struct Field {
    OstMsh msh; /* its cursor and version alone are used */
    const char *name;
    const OstMeshChunk *chunk;
    OstFileField *out;
    OstLabelIndex rows; /* of tets, or of nodes */
    int step, later;    /* its step; are there further ones? */
} Field;

enum { STEP, COMPONENTS, ELEMENTS, INTEGERS, MOST_COMPONENTS = 9 };

static OstStatus skip_lines(OstMshCursor *cursor, const char *what)
{
    OstGlobal count = 0;
    OST_TRY(ost_msh_count_line(cursor, what, &count));
    OST_TRY(ost_msh_check_count(cursor, what, count, 1));
    for (OstGlobal i = 0; i < count; i++)
        ost_msh_rest_of_line(cursor);
    return OST_SUCCESS;
}

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
        if (i == 0 && !*wanted)
            ost_tet_field_note(field->out, text.start, (size_t)text.length);
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

/* Tags of what the section is on. */
static OstStatus index_rows(Field *field, int on_nodes)
{
    const OstMeshChunk *chunk = field->chunk;
    if (on_nodes)
        return ost_label_index_create(chunk->ctx, chunk->node_count, chunk->node_label, &field->rows);
    if (chunk->relabelled)
        return OST_RAISE(chunk->ctx, OST_INVALID_INPUT,
                         "%s: the tets were numbered anew, as several had one tag, so that the field '%s' cannot be "
                         "told tet by tet; give each element its own tag",
                         field->msh.cursor.path, field->name);
    return ost_label_index_create(chunk->ctx, chunk->tet_count, chunk->tet_label, &field->rows);
}

static OstStatus make_room(Field *field, int on_nodes, int width)
{
    OstContext *ctx = field->chunk->ctx;
    OstFileField *out = field->out;
    OST_TRY(ost_tet_field_check(ctx, field->msh.cursor.path, field->name, width));
    if (out->found && (width != out->width || on_nodes != out->on_nodes))
        return OST_RAISE_MSH(&field->msh.cursor, "'%s' has %d components on %s here, and %d on %s before", field->name,
                             width, on_nodes ? "nodes" : "elements", out->width, out->on_nodes ? "nodes" : "elements");
    if (out->found)
        return OST_SUCCESS;
    OST_TRY(index_rows(field, on_nodes));
    out->width = width;
    out->on_nodes = on_nodes;
    const size_t count = (size_t)field->rows.count * (size_t)width;
    OST_TRY(OST_NEW(ctx, &out->values, count));
    for (size_t i = 0; i < count; i++)
        out->values[i] = NAN;
    return OST_SUCCESS;
}

static void put_row(const Field *field, OstGlobal label, int width, const double *value)
{
    const OstGlobal row = ost_label_index_find(&field->rows, label);
    if (row >= 0)
        memcpy(field->out->values + (size_t)row * (size_t)width, value, (size_t)width * sizeof *value);
}

/* Elements that are no tets of the mesh, and nodes of no tet, are passed over. */
static OstStatus read_values(Field *field, int width, int count)
{
    OstMshCursor *cursor = &field->msh.cursor;
    double value[MOST_COMPONENTS];
    OST_TRY(ost_msh_check_count(cursor, "entries of data", count, 1 + width));
    for (int i = 0; i < count; i++) {
        OstGlobal tag;
        OST_TRY(ost_msh_tag(cursor, "the tag of an element or node", &tag));
        for (int k = 0; k < width; k++)
            OST_TRY(ost_msh_double(cursor, "a value of an element or node", &value[k]));
        if (!field->out->on_nodes && field->chunk->of_cells)
            for (int piece = 1; piece < OST_PIECE_LABELS && tag < OST_LARGEST_LABEL / OST_PIECE_LABELS; piece++)
                put_row(field, OST_PIECE_LABELS * tag + piece, width, value);
        else
            put_row(field, tag, width, value);
    }
    return OST_SUCCESS;
}

/* Partitions and appended views may state a field in several sections of one step. */
static OstStatus read_data(Field *field, int on_nodes)
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
    field->later |= wanted && field->out->found && integer[STEP] != field->step;
    if (!wanted || (field->out->found && integer[STEP] != field->step))
        return OST_SUCCESS;
    OST_TRY(make_room(field, on_nodes, integer[COMPONENTS]));
    field->out->found = 1;
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
        else if (strcmp(name, "ElementData") == 0 || strcmp(name, "NodeData") == 0)
            OST_TRY(read_data(field, name[0] == 'N'));
        OST_TRY(ost_msh_skip_section(cursor, name));
        ost_msh_rest_of_line(cursor); /* its end */
    }
    return OST_SUCCESS;
}

OstStatus ost_msh_read_field(OstContext *ctx, const char *path, const char *name, const OstMeshChunk *chunk,
                             OstFileField *out)
{
    Field field = {.name = name, .chunk = chunk, .out = out};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_msh_open(ctx, path, &field.msh.cursor));
    OST_TRY_DONE(read_sections(&field));
    if (field.later)
        ost_warn(ctx, "%s: the field '%s' has several time steps; step %d, the first, is taken", path, name,
                 field.step);
done:
    ost_label_index_clear(&field.rows);
    ost_msh_close(&field.msh.cursor);
    return status;
}
