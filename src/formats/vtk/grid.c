/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtk/grid.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "formats/serial/input_file.h"
#include "formats/vtk/vtk.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* Names of cell arrays that say which region or boundary a cell is in, as programs write them; the first that a file
 * has counts. */
static const char *const region_names[] = {
    "region", "regions", "gmsh:physical", "medit:ref", "CellEntityIds", "cell_tags", "MaterialIDs", "MaterialID",
    "material", "mat", "attribute", "attributes", "physical", "PartID", "part", "label", "labels", "GeometryIds",
    "ElementBlockIds",
    /* what meshio, FEBio Studio, sfepy, libMesh, CGAL and ParaView call them */
    "netgen:index", "avsucd:material", "su2:tag", "tetgen:ref", "ugrid:ref", "nastran:ref", "part_id", "material_id",
    "mat_id", "subdomain_id", "MeshDomain", "ObjectId"};
enum { REGION_NAMES = sizeof region_names / sizeof *region_names };

const char ost_vtk_ghosts[] = "vtkGhostType";
enum { VTK_DUPLICATE_CELL = 1, VTK_HIDDEN_CELL = 32 };

/* What VTK's cell types are here. */
enum { VTK_TYPES = 82 };
typedef struct CellType {
    OstCellKind kind; /* where `nodes` is not 0 */
    int nodes, dimension;
} CellType;
enum { VTK_PIXEL = 8, VTK_VOXEL = 11, VTK_LAGRANGE_HEXAHEDRON = 72 };
static const CellType cell_types[VTK_TYPES] = {
    [1] = {OST_CELL_POINT, 1, 0},
    [3] = {OST_CELL_LINE2, 2, 1},
    [5] = {OST_CELL_TRIANGLE3, 3, 2},
    [10] = {OST_CELL_TET4, 4, 3},
    [21] = {OST_CELL_LINE3, 3, 1},
    [22] = {OST_CELL_TRIANGLE6, 6, 2},
    [24] = {OST_CELL_TET10, 10, 3},
    [68] = {OST_CELL_LINE3, 3, 1}, /* Lagrange's, of second order */
    [69] = {OST_CELL_TRIANGLE6, 6, 2},
    [71] = {OST_CELL_TET10, 10, 3},
    [VTK_VOXEL] = {OST_CELL_HEX8, 8, 3},
    [12] = {OST_CELL_HEX8, 8, 3},
    [13] = {OST_CELL_WEDGE6, 6, 3},
    [14] = {OST_CELL_PYRAMID5, 5, 3},
    [25] = {OST_CELL_HEX20, 20, 3},
    [26] = {OST_CELL_WEDGE15, 15, 3},
    [27] = {OST_CELL_PYRAMID13, 13, 3},
    [29] = {OST_CELL_HEX27, 27, 3},
    [32] = {OST_CELL_WEDGE18, 18, 3},
    [VTK_LAGRANGE_HEXAHEDRON] = {OST_CELL_HEX27, 27, 3},
    [73] = {OST_CELL_WEDGE18, 18, 3},
    [VTK_PIXEL] = {OST_CELL_QUAD4, 4, 2},
    [9] = {OST_CELL_QUAD4, 4, 2},
    [23] = {OST_CELL_QUAD8, 8, 2},
    [28] = {OST_CELL_QUAD9, 9, 2},
    [70] = {OST_CELL_QUAD9, 9, 2},
    [15] = {.dimension = 3},
    [16] = {.dimension = 3},
    [31] = {.dimension = 3},
    [33] = {.dimension = 3},
    [37] = {.dimension = 3},
    [41] = {.dimension = 3},
    [42] = {.dimension = 3},
    [74] = {.dimension = 3},
    [78] = {.dimension = 3},
    [79] = {.dimension = 3},
    [80] = {.dimension = 3},
    [81] = {.dimension = 3},
};

void ost_vtk_clear(OstVtkGrid *grid)
{
    for (int a = 0; a < grid->array_count; a++)
        OST_FREE(grid->array[a].values);
    OST_FREE(grid->array, grid->name, grid->coordinates, grid->end, grid->connectivity, grid->type, grid->piece_start,
             grid->same);
}

const char *ost_vtk_region_name(int number)
{
    return number < REGION_NAMES ? region_names[number] : NULL;
}

int ost_vtk_wants(const OstVtkGrid *grid, const char *name, int is_whole, OstGlobal components)
{
    if (grid->wanted && strcmp(grid->wanted, name) == 0)
        return 1;
    if (grid->wanted) {
        ost_tet_field_note(grid->field, name, strlen(name));
        return 0;
    }
    for (int n = 0; n < REGION_NAMES; n++)
        if (strcasecmp(region_names[n], name) == 0)
            return 1;
    if ((ost_vtk_numbers_points(name) || strcmp(name, ost_vtk_ghosts) == 0) && components == 1)
        return 1;
    return grid->by_meshio && is_whole && components == 1;
}

/* A further piece's values follow those before. */
static OstStatus extend(OstVtkGrid *grid, OstVtkArray *array, int components, OstGlobal tuples, const double *values)
{
    const size_t before = (size_t)array->tuples * (size_t)components, more = (size_t)tuples * (size_t)components;
    if (components != array->components)
        return OST_RAISE(grid->ctx, OST_INVALID_INPUT, "%s: '%s' has %d components in one place and %d in another",
                         grid->path, array->name, array->components, components);
    OST_TRY(OST_RESIZE(grid->ctx, &array->values, before + more));
    if (more > 0)
        memcpy(array->values + before, values, more * sizeof *values);
    array->tuples += tuples;
    return OST_SUCCESS;
}

OstStatus ost_vtk_add_array(OstVtkGrid *grid, const char *name, int on_points, int components, OstGlobal tuples,
                            double **values)
{
    for (int a = 0; a < grid->array_count; a++)
        if (grid->array[a].on_points == on_points && strcmp(grid->array[a].name, name) == 0)
            return extend(grid, &grid->array[a], components, tuples, *values);
    OST_TRY(OST_RESIZE(grid->ctx, &grid->array, grid->array_count + 1));
    OstVtkArray *last = &grid->array[grid->array_count++];
    *last = (OstVtkArray){.on_points = on_points, .components = components, .tuples = tuples, .values = *values};
    strncpy(last->name, name, OST_VTK_NAME - 1);
    *values = NULL;
    return OST_SUCCESS;
}

double ost_vtk_number(OstVtkType type, int swapped, const char *bytes)
{
    unsigned char b[8] = {0};
    const int n = type.bytes;
    uint64_t bits = 0;
    for (int i = 0; i < n; i++)
        b[i] = (unsigned char)bytes[swapped ? n - 1 - i : i];
    memcpy(&bits, b, sizeof bits);
    if (type.kind == OST_VTK_FLOAT) {
        float single;
        double value;
        memcpy(&single, b, sizeof single);
        memcpy(&value, b, sizeof value);
        return n == 4 ? (double)single : value;
    }
    if (type.kind == OST_VTK_SIGNED && n < 8 && bits >> (8 * n - 1) & 1U)
        bits |= ~(uint64_t)0 << (8 * n);
    return type.kind == OST_VTK_SIGNED ? (double)(int64_t)bits : (double)bits;
}

OstStatus ost_vtk_whole(OstMshCursor *cursor, const char *what, OstGlobal count, const double *values,
                        OstGlobal largest, OstGlobal *numbers)
{
    for (OstGlobal i = 0; i < count; i++) {
        if (!(values[i] >= 0.0 && values[i] <= (double)largest) || values[i] != floor(values[i]))
            return OST_RAISE_MSH(cursor, "%g found as %s, expected a whole number from 0 to %" PRId64, values[i], what,
                                 largest);
        numbers[i] = (OstGlobal)values[i];
    }
    return OST_SUCCESS;
}

/* --- the mesh --- */

/* The array of whole numbers that says which region a cell is in, or NULL. */
static const OstVtkArray *region_array(const OstVtkGrid *grid)
{
    for (int n = 0; n < REGION_NAMES; n++)
        for (int a = 0; a < grid->array_count; a++) {
            const OstVtkArray *array = &grid->array[a];
            OstGlobal whole = 0;
            if (array->on_points || array->components != 1 || array->tuples != grid->cells ||
                strcasecmp(array->name, region_names[n]) != 0)
                continue;
            while (whole < array->tuples && array->values[whole] == floor(array->values[whole]) &&
                   fabs(array->values[whole]) < 1e15)
                whole++;
            if (whole == array->tuples)
                return array;
        }
    return NULL;
}

static void swap(OstGlobal *a, OstGlobal *b)
{
    const OstGlobal kept = *a;
    *a = *b;
    *b = kept;
}

/* 0 if a point is none of the file, which is refused later. */
static double distance_from_middle(const OstVtkGrid *grid, const OstGlobal *nodes, int middle, int a, int b)
{
    double off[3];
    if (nodes[middle] > grid->points || nodes[a] > grid->points || nodes[b] > grid->points)
        return 0.0;
    for (int d = 0; d < 3; d++)
        off[d] = grid->coordinates[3 * (nodes[middle] - 1) + d] -
                 0.5 * (grid->coordinates[3 * (nodes[a] - 1) + d] + grid->coordinates[3 * (nodes[b] - 1) + d]);
    return ost_norm3(off);
}

/* Pixels and voxels go row by row. Before its format 2.2 VTK had the last two edges of a Lagrange hexahedron the other
 * way round, and not all programs state the format that they write. */
static void reorder(const OstVtkGrid *grid, int type, OstGlobal *nodes)
{
    if (type == VTK_PIXEL || type == VTK_VOXEL)
        swap(&nodes[2], &nodes[3]);
    if (type == VTK_VOXEL)
        swap(&nodes[6], &nodes[7]);
    if (type == VTK_LAGRANGE_HEXAHEDRON &&
        distance_from_middle(grid, nodes, 18, 3, 7) < distance_from_middle(grid, nodes, 18, 2, 6))
        swap(&nodes[18], &nodes[19]);
}

static OstStatus add_cell(const OstVtkGrid *grid, OstGlobal cell, OstGlobal group, OstCells *cells)
{
    const OstGlobal start = cell > 0 ? grid->end[cell - 1] : 0, count = grid->end[cell] - start;
    const int type = grid->type[cell];
    const CellType *facts = type < VTK_TYPES ? &cell_types[type] : &cell_types[0];
    OstGlobal nodes[27];
    char what[32];
    snprintf(what, sizeof what, "of VTK's type %d", type);
    if (facts->nodes == 0 || (count != facts->nodes && type >= 68)) {
        ost_cells_skip(cells, facts->dimension, what);
        return OST_SUCCESS;
    }
    if (count != facts->nodes)
        return OST_RAISE(grid->ctx, OST_INVALID_INPUT,
                         "%s: cell %" PRId64 " of VTK's type %d has %" PRId64 " points, expected %d", grid->path, cell,
                         type, count, facts->nodes);
    for (OstGlobal i = 0; i < count; i++)
        nodes[i] = grid->connectivity[start + i] + 1;
    reorder(grid, type, nodes);
    return ost_cells_add(cells, facts->kind, cell + 1, group, nodes);
}

/* The group of a cell; -1 is meshio's word for no set. */
static OstGlobal group_of(const OstVtkArray *region, int is_of_sets, OstGlobal cell)
{
    if (!region || (is_of_sets && region->values[cell] < 0.0))
        return OST_NO_GROUP;
    return (OstGlobal)region->values[cell];
}

static const OstVtkArray *ghost_array(const OstVtkGrid *grid)
{
    for (int a = 0; a < grid->array_count; a++)
        if (!grid->array[a].on_points && grid->array[a].components == 1 && grid->array[a].tuples == grid->cells &&
            strcmp(grid->array[a].name, ost_vtk_ghosts) == 0)
            return &grid->array[a];
    return NULL;
}

/* Duplicates are another piece's; hidden cells are none. */
static int is_ghost(const OstVtkArray *ghosts, OstGlobal cell)
{
    const double mark = ghosts ? ghosts->values[cell] : 0.0;
    return mark > 0.0 && mark < 256.0 && ((int)mark & (VTK_DUPLICATE_CELL | VTK_HIDDEN_CELL)) != 0;
}

static OstStatus add_cells(const OstVtkGrid *grid, const OstVtkArray *region, int is_of_sets, OstCells *cells)
{
    const OstVtkArray *ghosts = ghost_array(grid);
    OstGlobal left_out = 0;
    for (OstGlobal c = 0; c < grid->cells; c++) {
        const int ghost = is_ghost(ghosts, c);
        left_out += ghost;
        if (!ghost)
            OST_TRY(add_cell(grid, c, group_of(region, is_of_sets, c), cells));
    }
    if (left_out > 0)
        ost_warn(grid->ctx, "%s: cells left out that vtkGhostType marks as hidden or as another piece's: %" PRId64,
                 grid->path, left_out);
    return OST_SUCCESS;
}

static OstStatus add_all(const OstVtkGrid *grid, OstCells *cells)
{
    char sign;
    const OstVtkArray *region = region_array(grid);
    const OstVtkArray *sets = region ? NULL : ost_vtk_sets(grid, 0, &sign);
    if (region)
        ost_log(grid->ctx, OST_LOG_VERBOSE, "%s: regions are the numbers '%s' of cells", grid->path, region->name);
    if (sets)
        OST_TRY(ost_vtk_name_sets(grid, sets, sign, cells));
    for (int n = 0; n < grid->name_count; n++)
        OST_TRY(ost_cells_name(cells, grid->name[n].dimension, grid->name[n].number, grid->name[n].name));
    for (OstGlobal p = 0; p < grid->points; p++)
        if (!grid->same || grid->same[p] == p)
            OST_TRY(ost_cells_add_node(cells, p + 1, grid->coordinates + 3 * p));
    OST_TRY(add_cells(grid, sets ? sets : region, sets != NULL, cells));
    return ost_vtk_take_point_sets(grid, cells);
}

static OstStatus check_grid(const OstVtkGrid *grid)
{
    if (grid->cells == 0 || !grid->type || !grid->end || !grid->coordinates)
        return OST_RAISE(grid->ctx, OST_INVALID_INPUT, "%s: holds no cells; an unstructured grid of tets is expected",
                         grid->path);
    for (OstGlobal c = 0; c < grid->cells; c++)
        if (grid->end[c] < (c > 0 ? grid->end[c - 1] : 0) || grid->end[c] > grid->connections)
            return OST_RAISE(grid->ctx, OST_INVALID_INPUT,
                             "%s: cell %" PRId64 " ends at entry %" PRId64 " of a connectivity of %" PRId64, grid->path,
                             c, grid->end[c], grid->connections);
    return OST_SUCCESS;
}

static OstStatus read_text_or_xml(OstVtkGrid *grid)
{
    OstMshCursor cursor;
    OST_TRY(ost_msh_open(grid->ctx, grid->path, &cursor));
    grid->by_meshio = ost_vtk_is_by_meshio(&cursor);
    const OstStatus status = ost_has_ending(grid->path, ".vtu")    ? ost_vtk_xml_grid(&cursor, grid)
                             : ost_has_ending(grid->path, ".pvtu") ? ost_vtk_parallel_grid(&cursor, grid)
                                                                   : ost_vtk_legacy_grid(&cursor, grid);
    ost_msh_close(&cursor);
    return status;
}

static OstStatus read_grid(OstContext *ctx, const char *path, const char *wanted, OstFileField *field, OstVtkGrid *grid)
{
    *grid = (OstVtkGrid){.ctx = ctx, .path = path, .wanted = wanted, .field = field};
    OST_TRY(ost_has_ending(path, ".vtkhdf") || ost_has_ending(path, ".hdf") ? ost_vtk_hdf_grid(grid)
                                                                            : read_text_or_xml(grid));
    return check_grid(grid);
}

OstStatus ost_vtk_read(OstContext *ctx, const char *path, OstMeshChunk **chunk)
{
    OstVtkGrid grid;
    OstCells cells = {0};
    OstStatus status = read_grid(ctx, path, NULL, NULL, &grid);
    OST_THEN(ost_vtk_join_pieces(&grid));
    OST_THEN(ost_cells_open(ctx, path, &cells));
    OST_THEN(add_all(&grid, &cells));
    ost_vtk_clear(&grid);
    OST_THEN(ost_cells_finish(&cells, chunk));
    ost_cells_close(&cells);
    return status;
}

/* --- a field --- */

static OstStatus take_field(const OstVtkGrid *grid, const OstMeshChunk *chunk, OstFileField *field)
{
    const OstVtkArray *array = NULL;
    for (int a = 0; a < grid->array_count; a++)
        if (array == NULL || !grid->array[a].on_points)
            array = &grid->array[a];
    if (!array)
        return OST_SUCCESS;
    const OstGlobal count = array->on_points ? chunk->node_count : chunk->tet_count;
    const OstGlobal *labels = array->on_points ? chunk->node_label : chunk->tet_label;
    const size_t width = (size_t)array->components;
    field->found = 1;
    field->on_nodes = array->on_points;
    field->width = array->components;
    OST_TRY(OST_NEW(grid->ctx, &field->values, (size_t)count * width));
    for (OstGlobal i = 0; i < count; i++) {
        const OstGlobal label = array->on_points ? labels[i] : ost_cell_label(chunk->of_cells, labels[i]);
        if (array->on_points && label > grid->points)
            continue; /* a node in the middle of a diagonal: a tet takes the mean of its vertices */
        if (label < 1 || label > array->tuples)
            return OST_RAISE(grid->ctx, OST_INVALID_INPUT,
                             "%s: '%s' has %" PRId64 " entries, and entry %" PRId64 " is asked for", grid->path,
                             array->name, array->tuples, label);
        memcpy(field->values + (size_t)i * width, array->values + (size_t)(label - 1) * width, width * sizeof(double));
    }
    return OST_SUCCESS;
}

OstStatus ost_vtk_read_field(OstContext *ctx, const char *path, const char *name, const OstMeshChunk *chunk,
                             OstFileField *field)
{
    OstVtkGrid grid;
    OstStatus status = read_grid(ctx, path, name, field, &grid);
    OST_THEN(take_field(&grid, chunk, field));
    ost_vtk_clear(&grid);
    return status;
}
