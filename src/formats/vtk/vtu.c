/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/serial/input_file.h"
#include "formats/vtk/xml.h"

#include <ctype.h>
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* VTK's XML format for unstructured grids. Several pieces are put one after the other. */

typedef enum { NOWHERE, POINTS, CELLS, POINT_DATA, CELL_DATA } Section;

typedef struct Vtu {
    OstMshCursor *cursor;
    OstVtkGrid *grid;
    OstVtuStore store;
    Section section;
    OstGlobal points, cells; /* of the present piece */
    OstGlobal first_point, first_cell, first_connection;
    int seen; /* bits: what of POINTS and CELLS the piece has given */
} Vtu;

enum { HAS_POINTS = 1, HAS_CONNECTIVITY = 2, HAS_OFFSETS = 4, HAS_TYPES = 8, HAS_ALL = 15 };

/* Appended data begin after the first underscore behind their tag. */
static OstStatus find_appended(Vtu *vtu)
{
    static const char word[] = "<AppendedData";
    OstMshCursor at = *vtu->cursor;
    OstXmlTag tag;
    int found = 0;
    at.next = memmem(at.next, (size_t)(at.end - at.next), word, sizeof word - 1);
    if (!at.next)
        return OST_SUCCESS;
    OST_TRY(ost_xml_next(&at, &tag, &found));
    const char *encoding = ost_xml_value(&tag, "encoding");
    const char *start = memchr(at.next, '_', (size_t)(at.end - at.next));
    vtu->store.base64 = encoding && strcasecmp(encoding, "base64") == 0;
    vtu->store.appended = start ? start + 1 : NULL;
    return OST_SUCCESS;
}

static OstStatus begin_file(Vtu *vtu, const OstXmlTag *tag)
{
    const char *type = ost_xml_value(tag, "type"), *order = ost_xml_value(tag, "byte_order");
    const char *header = ost_xml_value(tag, "header_type"), *packed = ost_xml_value(tag, "compressor");
    const int one = 1;
    const int little = *(const char *)&one;
    if (!type || strcmp(type, "UnstructuredGrid") != 0)
        return OST_RAISE_MSH(vtu->cursor,
                             "a file of the type '%s', expected UnstructuredGrid (in ParaView: Tetrahedralize, then "
                             "File, Save Data as .vtu)",
                             type ? type : "");
    vtu->store.swapped = order && (strcmp(order, "LittleEndian") == 0) != little;
    vtu->store.header_bytes = header && strcmp(header, "UInt64") == 0 ? 8 : 4;
    vtu->store.packer = !packed || !packed[0]                          ? OST_VTU_PLAIN
                        : strcmp(packed, "vtkZLibDataCompressor") == 0 ? OST_VTU_ZLIB
                        : strcmp(packed, "vtkLZ4DataCompressor") == 0  ? OST_VTU_LZ4
                                                                       : OST_VTU_OTHER;
    return OST_SUCCESS;
}

/* A line "region 1: wood" of the comment. */
static OstStatus take_name(OstVtkGrid *grid, const char *line, const char *end)
{
    static const char *const kind[] = {"point ", "curve ", "surface ", "region "};
    for (int dimension = 0; dimension <= 3; dimension++) {
        const size_t length = strlen(kind[dimension]);
        if ((size_t)(end - line) <= length || memcmp(line, kind[dimension], length) != 0)
            continue;
        OstVtkName name = {.dimension = dimension};
        const char *at = line + length;
        while (at < end && *at >= '0' && *at <= '9' && name.number < OST_LARGEST_LABEL / 16)
            name.number = 10 * name.number + (*at++ - '0');
        if (at == line + length || end - at < 3 || at[0] != ':' || at[1] != ' ' || end - at - 2 >= OST_VTK_NAME)
            return OST_SUCCESS;
        memcpy(name.name, at + 2, (size_t)(end - at - 2));
        OST_TRY(OST_RESIZE(grid->ctx, &grid->name, grid->name_count + 1));
        grid->name[grid->name_count++] = name;
        return OST_SUCCESS;
    }
    return OST_SUCCESS;
}

/* The comment that Orthostat writes at the head has the names of regions and boundaries. */
static OstStatus read_names(OstMshCursor *cursor, OstVtkGrid *grid)
{
    static const char start[] = "<!--\n";
    const size_t length = sizeof start - 1;
    const char *at = cursor->next;
    while (at < cursor->end && isspace((unsigned char)*at))
        at++;
    if ((size_t)(cursor->end - at) < length || memcmp(at, start, length) != 0)
        return OST_SUCCESS;
    const char *end = memmem(at, (size_t)(cursor->end - at), "-->", 3);
    for (at += length; end && at < end;) {
        const char *line_end = memchr(at, '\n', (size_t)(end - at));
        OST_TRY(take_name(grid, at, line_end ? line_end : end));
        at = line_end ? line_end + 1 : end;
    }
    return OST_SUCCESS;
}

static OstStatus end_piece(Vtu *vtu)
{
    if (vtu->points == 0 && vtu->cells == 0)
        return OST_SUCCESS;
    return vtu->seen == HAS_ALL ? OST_SUCCESS
                                : OST_RAISE_MSH(vtu->cursor, "the piece has no points, connectivity, offsets or types");
}

static OstStatus begin_piece(Vtu *vtu, const OstXmlTag *tag)
{
    OstVtkGrid *grid = vtu->grid;
    OST_TRY(end_piece(vtu)); /* one that the file does not end */
    OST_TRY(ost_vtk_begin_piece(grid, grid->points));
    vtu->first_point = grid->points;
    vtu->first_cell = grid->cells;
    vtu->first_connection = grid->connections;
    vtu->seen = 0;
    OST_TRY(ost_xml_number(vtu->cursor, tag, "NumberOfPoints", 0, &vtu->points));
    return ost_xml_number(vtu->cursor, tag, "NumberOfCells", 0, &vtu->cells);
}

static OstStatus take_points(Vtu *vtu, const double *values)
{
    OstVtkGrid *grid = vtu->grid;
    for (OstGlobal i = 0; i < 3 * vtu->points; i++)
        if (!isfinite(values[i]))
            return OST_RAISE_MSH(vtu->cursor, "point %" PRId64 " has the coordinate %g, expected a finite number",
                                 i / 3, values[i]);
    OST_TRY(OST_RESIZE(grid->ctx, &grid->coordinates, 3 * (vtu->first_point + vtu->points)));
    if (vtu->points > 0)
        memcpy(grid->coordinates + 3 * vtu->first_point, values, 3 * (size_t)vtu->points * sizeof *values);
    grid->points = vtu->first_point + vtu->points;
    return OST_SUCCESS;
}

static OstStatus take_connectivity(Vtu *vtu, OstGlobal count, const double *values)
{
    OstVtkGrid *grid = vtu->grid;
    const OstGlobal first = vtu->first_connection;
    OST_TRY(OST_RESIZE(grid->ctx, &grid->connectivity, first + count));
    OST_TRY(ost_vtk_whole(vtu->cursor, "a point of a cell", count, values, OST_LARGEST_LABEL / 2,
                          grid->connectivity + first));
    for (OstGlobal i = 0; i < count; i++)
        grid->connectivity[first + i] += vtu->first_point;
    grid->connections = first + count;
    return OST_SUCCESS;
}

static OstStatus take_offsets(Vtu *vtu, const double *values)
{
    OstVtkGrid *grid = vtu->grid;
    OST_TRY(OST_RESIZE(grid->ctx, &grid->end, vtu->first_cell + vtu->cells));
    OST_TRY(ost_vtk_whole(vtu->cursor, "an offset", vtu->cells, values, OST_LARGEST_LABEL / 2,
                          grid->end + vtu->first_cell));
    for (OstGlobal c = 0; c < vtu->cells; c++)
        grid->end[vtu->first_cell + c] += vtu->first_connection;
    return OST_SUCCESS;
}

static OstStatus take_types(Vtu *vtu, const double *values)
{
    OstVtkGrid *grid = vtu->grid;
    OST_TRY(OST_RESIZE(grid->ctx, &grid->type, vtu->first_cell + vtu->cells));
    for (OstGlobal c = 0; c < vtu->cells; c++)
        grid->type[vtu->first_cell + c] = values[c] >= 0.0 && values[c] <= UCHAR_MAX ? (unsigned char)values[c] : 0;
    grid->cells = vtu->first_cell + vtu->cells;
    return OST_SUCCESS;
}

static OstStatus read_shape(Vtu *vtu, const OstXmlTag *tag, const char *name)
{
    double *values = NULL;
    OstGlobal count = vtu->cells;
    int what = 0;
    if (vtu->section == POINTS) {
        what = HAS_POINTS;
        count = 3 * vtu->points;
    } else if (strcmp(name, "connectivity") == 0) {
        what = HAS_CONNECTIVITY;
        count = -1;
    } else if (strcmp(name, "offsets") == 0)
        what = HAS_OFFSETS;
    else if (strcmp(name, "types") == 0)
        what = HAS_TYPES;
    if (what == 0)
        return OST_SUCCESS;
    if (vtu->seen & what)
        return OST_RAISE_MSH(vtu->cursor, "'%s' a second time in one piece", name);
    vtu->seen |= what;
    OstStatus status = ost_vtu_numbers(&vtu->store, tag, &count, &values);
    if (what == HAS_POINTS)
        OST_THEN(take_points(vtu, values));
    else if (what == HAS_CONNECTIVITY)
        OST_THEN(take_connectivity(vtu, count, values));
    else if (what == HAS_OFFSETS)
        OST_THEN(take_offsets(vtu, values));
    else
        OST_THEN(take_types(vtu, values));
    OST_FREE(values);
    return status;
}

static OstStatus read_data(Vtu *vtu, const OstXmlTag *tag, const char *name)
{
    const int on_points = vtu->section == POINT_DATA;
    const OstGlobal tuples = on_points ? vtu->points : vtu->cells;
    OstGlobal components = 1, count = 0;
    double *values = NULL;
    const char *type = ost_xml_value(tag, "type");
    OST_TRY(ost_xml_number(vtu->cursor, tag, "NumberOfComponents", 1, &components));
    if (!ost_vtk_wants(vtu->grid, name, type && strncmp(type, "Int", 3) == 0, components))
        return OST_SUCCESS;
    if (components < 1 || components > 1000)
        return OST_RAISE_MSH(vtu->cursor, "'%s' has %" PRId64 " components", name, components);
    count = components * tuples;
    OstStatus status = ost_vtu_numbers(&vtu->store, tag, &count, &values);
    OST_THEN(ost_vtk_add_array(vtu->grid, name, on_points, (int)components, tuples, &values));
    OST_FREE(values);
    return status;
}

static OstStatus read_array(Vtu *vtu, const OstXmlTag *tag)
{
    const char *name = ost_xml_value(tag, "Name");
    if (vtu->section == POINTS || vtu->section == CELLS)
        return read_shape(vtu, tag, name ? name : "");
    return vtu->section == NOWHERE || !name ? OST_SUCCESS : read_data(vtu, tag, name);
}

static OstStatus read_tag(Vtu *vtu, const OstXmlTag *tag)
{
    static const struct {
        const char *name;
        Section section;
    } sections[] = {{"Points", POINTS}, {"Cells", CELLS}, {"PointData", POINT_DATA}, {"CellData", CELL_DATA}};
    if (strcmp(tag->name, "Piece") == 0)
        return tag->closes == 1 ? end_piece(vtu) : begin_piece(vtu, tag);
    for (int s = 0; s < 4; s++)
        if (strcmp(tag->name, sections[s].name) == 0)
            vtu->section = tag->closes ? NOWHERE : sections[s].section;
    return strcmp(tag->name, "DataArray") == 0 && tag->closes != 1 ? read_array(vtu, tag) : OST_SUCCESS;
}

OstStatus ost_vtk_xml_grid(OstMshCursor *cursor, OstVtkGrid *grid)
{
    Vtu vtu = {.cursor = cursor, .grid = grid, .store = {.cursor = cursor}};
    OstXmlTag tag;
    int found = 0;
    OST_TRY(find_appended(&vtu));
    OST_TRY(ost_xml_next(cursor, &tag, &found));
    if (!found || strcmp(tag.name, "VTKFile") != 0)
        return OST_RAISE_MSH(cursor, "<VTKFile type=\"UnstructuredGrid\"> is expected");
    OST_TRY(begin_file(&vtu, &tag));
    OST_TRY(read_names(cursor, grid));
    for (;;) {
        OST_TRY(ost_xml_next(cursor, &tag, &found));
        if (!found || strcmp(tag.name, "AppendedData") == 0)
            return end_piece(&vtu);
        OST_TRY(read_tag(&vtu, &tag));
    }
}

static OstStatus read_part(OstMshCursor *list, const OstXmlTag *tag, OstVtkGrid *grid)
{
    char path[PATH_MAX], reason[PATH_MAX + 128];
    OstMshCursor cursor;
    const char *name = ost_xml_value(tag, "Source");
    if (!name)
        return OST_RAISE_MSH(list, "<Piece Source=\"part.vtu\"> is expected");
    ost_file_beside(list->path, name, path);
    if (ost_msh_open(list->ctx, path, &cursor) != OST_SUCCESS) {
        snprintf(reason, sizeof reason, "%s", ost_error_text(list->ctx));
        return OST_RAISE_MSH(list, "names a file that is to be read here: %s", reason);
    }
    grid->by_meshio |= ost_vtk_is_by_meshio(&cursor);
    const OstStatus status = ost_vtk_xml_grid(&cursor, grid);
    ost_msh_close(&cursor);
    return status;
}

OstStatus ost_vtk_parallel_grid(OstMshCursor *cursor, OstVtkGrid *grid)
{
    OstXmlTag tag;
    int found = 0;
    OST_TRY(ost_xml_next(cursor, &tag, &found));
    const char *type = found ? ost_xml_value(&tag, "type") : NULL;
    if (!type || strcmp(type, "PUnstructuredGrid") != 0)
        return OST_RAISE_MSH(cursor, "<VTKFile type=\"PUnstructuredGrid\"> is expected");
    while (found) {
        if (strcmp(tag.name, "Piece") == 0 && tag.closes != 1)
            OST_TRY(read_part(cursor, &tag, grid));
        OST_TRY(ost_xml_next(cursor, &tag, &found));
    }
    return OST_SUCCESS;
}
