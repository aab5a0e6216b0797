/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/exodus/exodus.h"
#include "formats/exodus/file.h"
#include "formats/exodus/parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* Variables of elements and of nodes. Each has a name, and one number an element or node; those of vectors end with the
 * axis. Elements come first, as in the other formats. */

enum { NAME = 64, AXES = 3 };

static const char *const endings[][AXES] = {{"_x", "_y", "_z"}, {"x", "y", "z"}};
enum { ENDINGS = sizeof endings / sizeof *endings };

typedef struct Field {
    OstExodus exodus;
    const char *name;
    const OstMeshChunk *chunk;
    OstFileField *out;
    OstLabelIndex rows; /* of tets, or of nodes, of the chunk */
    OstLocal variable[AXES];
} Field;

/* The number from 1 of the variable that is called `name` and `ending`; 0 if there is none. */
static OstStatus find_variable(const OstNetcdf *nc, int on_nodes, const char *name, const char *ending,
                               OstLocal *variable)
{
    OstLocal count = 0;
    const size_t length = strlen(name);
    *variable = 0;
    OST_TRY(ost_netcdf_dimension(nc, on_nodes ? "num_nod_var" : "num_elem_var", &count));
    for (OstLocal v = 0; v < count && *variable == 0; v++) {
        char text[OST_NETCDF_NAME];
        OST_TRY(ost_netcdf_text(nc, on_nodes ? "name_nod_var" : "name_elem_var", v, text));
        if (strncmp(text, name, length) == 0 && strcasecmp(text + length, ending) == 0)
            *variable = v + 1;
    }
    return OST_SUCCESS;
}

static OstStatus note_variables(Field *field)
{
    const OstNetcdf *nc = &field->exodus.nc;
    for (int on_nodes = 0; on_nodes < 2; on_nodes++) {
        OstLocal count = 0;
        OST_TRY(ost_netcdf_dimension(nc, on_nodes ? "num_nod_var" : "num_elem_var", &count));
        for (OstLocal v = 0; v < count; v++) {
            char text[OST_NETCDF_NAME];
            OST_TRY(ost_netcdf_text(nc, on_nodes ? "name_nod_var" : "name_elem_var", v, text));
            ost_tet_field_note(field->out, text, strlen(text));
        }
    }
    return OST_SUCCESS;
}

/* One variable of that name, or three. */
static OstStatus find_field(Field *field, int on_nodes)
{
    const OstNetcdf *nc = &field->exodus.nc;
    field->out->on_nodes = on_nodes;
    OST_TRY(find_variable(nc, on_nodes, field->name, "", &field->variable[0]));
    field->out->width = field->out->found = field->variable[0] > 0;
    for (int e = 0; e < ENDINGS && !field->out->found; e++) {
        for (int axis = 0; axis < AXES; axis++)
            OST_TRY(find_variable(nc, on_nodes, field->name, endings[e][axis], &field->variable[axis]));
        field->out->found = field->variable[0] > 0 && field->variable[1] > 0 && field->variable[2] > 0;
        field->out->width = AXES;
    }
    return OST_SUCCESS;
}

/* Where nothing is stated, NAN stays. */
static OstStatus make_room(Field *field, int width)
{
    const OstMeshChunk *chunk = field->chunk;
    OstFileField *out = field->out;
    if (out->values) /* of the parts before */
        return OST_SUCCESS;
    out->width = width;
    if (out->on_nodes)
        OST_TRY(ost_label_index_create(chunk->ctx, chunk->node_count, chunk->node_label, &field->rows));
    else if (chunk->relabelled)
        return OST_RAISE(chunk->ctx, OST_INVALID_INPUT,
                         "%s: the tets were numbered anew, as several had one number, so that the field '%s' cannot be "
                         "told tet by tet",
                         field->exodus.nc.path, field->name);
    else
        OST_TRY(ost_label_index_create(chunk->ctx, chunk->tet_count, chunk->tet_label, &field->rows));
    const size_t count = (size_t)field->rows.count * (size_t)width;
    OST_TRY(OST_NEW(chunk->ctx, &out->values, count));
    for (size_t i = 0; i < count; i++)
        out->values[i] = NAN;
    return OST_SUCCESS;
}

static void put_row(const Field *field, OstGlobal label, int column, int width, const double *value)
{
    const OstFileField *out = field->out;
    const OstGlobal row = label < 0 ? -1 : ost_label_index_find(&field->rows, label);
    for (int k = 0; row >= 0 && k < width && column + k < out->width; k++)
        out->values[row * out->width + column + k] = value[k];
}

/* Values of the elements of a block, whose first has the place `first` + 1, or of all nodes; into `column` and those
 * after it. */
static OstStatus read_values(Field *field, OstNetcdfRows *rows, OstLocal first, int column)
{
    const OstExodus *exodus = &field->exodus;
    OstFileField *out = field->out;
    do {
        OST_TRY(ost_netcdf_reals(rows));
        for (OstLocal i = 0; i < rows->count && !exodus->nc.dry; i++) {
            const OstGlobal place = first + rows->first + i + 1;
            const OstGlobal label = out->on_nodes ? ost_exodus_node(exodus, place) : ost_exodus_element(exodus, place);
            const double *value = rows->real + i * rows->width;
            if (!out->on_nodes && field->chunk->of_cells)
                for (int piece = 1; piece < OST_PIECE_LABELS; piece++)
                    put_row(field, OST_PIECE_LABELS * label + piece, column, rows->width, value);
            else
                put_row(field, label, column, rows->width, value);
        }
    } while (rows->count > 0);
    return OST_SUCCESS;
}

/* A variable of nodes may have several numbers in its array: meshio writes vectors so. */
static OstStatus read_on_nodes(Field *field)
{
    const OstNetcdf *nc = &field->exodus.nc;
    const int count = field->out->width;
    for (int c = 0; c < count; c++) {
        OstNetcdfRows rows;
        char name[NAME];
        snprintf(name, sizeof name, "vals_nod_var%d", field->variable[c]);
        OST_TRY(ost_netcdf_rows(nc, name, 1, -1, &rows));
        if (rows.total != field->exodus.nodes)
            return OST_RAISE(nc->ctx, OST_INVALID_INPUT, "%s: %s has %d rows, expected %d", nc->path, name, rows.total,
                             field->exodus.nodes);
        if (c == 0 && !nc->dry)
            OST_TRY(make_room(field, count > 1 || rows.width < 1 ? count : rows.width));
        OST_TRY(read_values(field, &rows, 0, c));
    }
    return OST_SUCCESS;
}

static OstStatus read_on_elements(Field *field)
{
    const OstExodus *exodus = &field->exodus;
    if (!exodus->nc.dry)
        OST_TRY(make_room(field, field->out->width));
    for (int c = 0; c < field->out->width; c++)
        for (OstLocal b = 0; b < exodus->block_count; b++) {
            OstNetcdfRows rows;
            char name[NAME];
            snprintf(name, sizeof name, "vals_elem_var%deb%d", field->variable[c], b + 1);
            OST_TRY(ost_netcdf_rows(&exodus->nc, name, 1, -1, &rows));
            if (rows.found && (rows.total != exodus->block[b].count || rows.width != 1))
                return OST_RAISE(exodus->nc.ctx, OST_INVALID_INPUT, "%s: %s has %d rows, expected %d", exodus->nc.path,
                                 name, rows.total, exodus->block[b].count);
            OST_TRY(read_values(field, &rows, exodus->block[b].first, c));
        }
    return OST_SUCCESS;
}

static OstStatus read_all(Field *field)
{
    OstLocal steps = 0;
    OST_TRY(find_field(field, 0));
    if (!field->out->found)
        OST_TRY(find_field(field, 1));
    if (!field->out->found)
        return note_variables(field);
    OST_TRY(ost_netcdf_dimension(&field->exodus.nc, "time_step", &steps));
    if (steps > 1 && !field->exodus.nc.dry && !field->out->values)
        ost_warn(field->chunk->ctx, "%s: the field '%s' has %d time steps; the last is taken", field->exodus.nc.path,
                 field->name, steps);
    return field->out->on_nodes ? read_on_nodes(field) : read_on_elements(field);
}

static OstStatus read_field(OstContext *ctx, const char *path, int parts, int dry, Field *field)
{
    OstStatus status = ost_exodus_open(ctx, path, parts, dry, &field->exodus);
    OST_THEN(read_all(field));
    ost_exodus_close(&field->exodus);
    return status;
}

static OstStatus try_field(OstContext *ctx, const char *path, const char *name)
{
    OstFileField none = {0};
    Field field = {.name = name, .out = &none};
    return read_field(ctx, path, 1, 1, &field);
}

OstStatus ost_exodus_read_field(OstContext *ctx, const char *path, const char *name, const OstMeshChunk *chunk,
                                OstFileField *out)
{
    Field field = {.name = name, .chunk = chunk, .out = out};
    OstExodusParts parts = {0};
    OstStatus status = ost_exodus_parts_find(ctx, path, &parts);
    for (int p = 0; p < parts.count && status == OST_SUCCESS && (p == 0 || out->found); p++) {
        status = ost_netcdf_dry_run(ctx, parts.path[p], try_field, name);
        OST_THEN(read_field(ctx, parts.path[p], parts.count, 0, &field));
    }
    ost_label_index_clear(&field.rows);
    ost_exodus_parts_free(&parts);
    return status;
}
