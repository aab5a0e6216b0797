/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "formats/vtk/grid.h"
#include "formats/vtk/vtk.h"
#include "formats/vtkhdf/dry_run.h"
#include "formats/vtkhdf/kind.h"
#include "formats/vtkhdf/points.h"
#include "formats/vtkhdf/steps.h"

#include <inttypes.h>
#include <stdio.h>

/* VTKHDF files of other programs that hold other cells than tets. Files of tets alone, and those of Orthostat, are read
 * by all ranks (formats/vtkhdf). */

enum { VTK_TETRA = 10, VTK_QUADRATIC_TETRA = 24, LONGEST_NAME = OST_VTK_NAME + 32 };

/* Counts of each piece of the file. */
typedef struct Pieces {
    OstGlobal count;
    OstGlobal *points, *cells, *connections;
} Pieces;

static OstStatus read_piece_counts(const OstHdf5 *h5, const char *name, OstGlobal pieces, OstGlobal **counts,
                                   OstGlobal *total)
{
    OST_TRY(OST_NEW(h5->ctx, counts, pieces));
    OST_TRY(ost_hdf5_read_rows(h5, name, H5T_NATIVE_INT64, 1, pieces, 0, pieces, *counts));
    *total = 0;
    for (OstGlobal p = 0; p < pieces; p++) {
        if ((*counts)[p] < 0 || (*counts)[p] > INT32_MAX - *total)
            return OST_RAISE(h5->ctx, OST_INVALID_INPUT,
                             "%s: %s of piece %" PRId64 " is %" PRId64 ", and all together may be %d at most", h5->path,
                             name, p, (*counts)[p], INT32_MAX);
        *total += (*counts)[p];
    }
    return OST_SUCCESS;
}

static OstStatus read_counts(const OstHdf5 *h5, OstVtkGrid *grid, Pieces *pieces)
{
    int components = 0;
    OST_TRY(ost_hdf5_shape(h5, "/VTKHDF/NumberOfPoints", &pieces->count, &components));
    OST_TRY(read_piece_counts(h5, "/VTKHDF/NumberOfPoints", pieces->count, &pieces->points, &grid->points));
    OST_TRY(read_piece_counts(h5, "/VTKHDF/NumberOfCells", pieces->count, &pieces->cells, &grid->cells));
    return read_piece_counts(h5, "/VTKHDF/NumberOfConnectivityIds", pieces->count, &pieces->connections,
                             &grid->connections);
}

/* A piece has one offset more than cells, and counts from 0. */
static OstStatus place_pieces(OstVtkGrid *grid, const Pieces *pieces, const OstGlobal *offset)
{
    OstGlobal point = 0, cell = 0, connection = 0;
    for (OstGlobal p = 0; p < pieces->count; p++) {
        OST_TRY(ost_vtk_begin_piece(grid, point));
        for (OstGlobal c = 0; c < pieces->cells[p]; c++) {
            const OstGlobal end = offset[cell + p + c + 1];
            if (end < 0 || end > pieces->connections[p])
                return OST_RAISE(grid->ctx, OST_INVALID_INPUT,
                                 "%s: cell %" PRId64 " ends at entry %" PRId64 " of a connectivity of %" PRId64,
                                 grid->path, cell + c, end, pieces->connections[p]);
            grid->end[cell + c] = connection + end;
        }
        for (OstGlobal i = connection; i < connection + pieces->connections[p]; i++) {
            if (grid->connectivity[i] < 0 || grid->connectivity[i] >= pieces->points[p])
                return OST_RAISE(grid->ctx, OST_INVALID_INPUT,
                                 "%s: point %" PRId64 " of a piece of %" PRId64 " is used", grid->path,
                                 grid->connectivity[i], pieces->points[p]);
            grid->connectivity[i] += point;
        }
        point += pieces->points[p];
        cell += pieces->cells[p];
        connection += pieces->connections[p];
    }
    return OST_SUCCESS;
}

static OstStatus read_cells(const OstHdf5 *h5, OstVtkGrid *grid, const Pieces *pieces)
{
    const OstGlobal offsets = grid->cells + pieces->count;
    OstGlobal *offset = NULL;
    OST_TRY(OST_NEW(grid->ctx, &grid->coordinates, 3 * grid->points));
    OST_TRY(OST_NEW(grid->ctx, &grid->type, grid->cells));
    OST_TRY(OST_NEW(grid->ctx, &grid->end, grid->cells));
    OST_TRY(OST_NEW(grid->ctx, &grid->connectivity, grid->connections));
    OST_TRY(ost_hdf5_read_rows(h5, "/VTKHDF/Points", H5T_NATIVE_DOUBLE, 3, grid->points, 0, grid->points,
                               grid->coordinates));
    OST_TRY(ost_hdf5_read_rows(h5, "/VTKHDF/Types", H5T_NATIVE_UCHAR, 1, grid->cells, 0, grid->cells, grid->type));
    OST_TRY(ost_hdf5_read_rows(h5, "/VTKHDF/Connectivity", H5T_NATIVE_INT64, 1, grid->connections, 0, grid->connections,
                               grid->connectivity));
    OST_TRY(OST_NEW(grid->ctx, &offset, offsets));
    OstStatus status = ost_hdf5_read_rows(h5, "/VTKHDF/Offsets", H5T_NATIVE_INT64, 1, offsets, 0, offsets, offset);
    OST_THEN(place_pieces(grid, pieces, offset));
    OST_FREE(offset);
    return status;
}

/* A field on cells or points: of the step that its name may state, else of the last. */
static OstStatus take_array(const OstHdf5 *h5, OstVtkGrid *grid, int on_points, const char *word)
{
    static const char *const group[] = {"CellData", "PointData"};
    const OstGlobal count = on_points ? grid->points : grid->cells;
    OstGlobal rows = 0, first = 0;
    double *values = NULL;
    int components = 0;
    char name[LONGEST_NAME], field[OST_LONGEST_FIELD], step[OST_LONGEST_FIELD];
    ost_steps_split(h5, word, field, step);
    snprintf(name, sizeof name, "/VTKHDF/%s/%s", group[on_points], field);
    if (!ost_hdf5_has(h5, name))
        return OST_SUCCESS;
    OST_TRY(ost_hdf5_shape(h5, name, &rows, &components));
    if (grid->wanted)
        OST_TRY(ost_steps_find(h5, group[on_points], field, step, count, &rows, &first));
    else if (rows != count || components != 1)
        return OST_SUCCESS; /* says no region */
    OST_TRY(OST_NEW(grid->ctx, &values, (size_t)count * (size_t)components));
    OstStatus status = ost_hdf5_read_rows(h5, name, H5T_NATIVE_DOUBLE, components, rows, first, count, values);
    OST_THEN(ost_vtk_add_array(grid, word, on_points, components, count, &values));
    OST_FREE(values);
    return status;
}

static OstStatus read_all(const OstHdf5 *h5, OstVtkGrid *grid)
{
    Pieces pieces = {0};
    OstStatus status = ost_vtkhdf_check_kind(h5);
    OST_THEN(read_counts(h5, grid, &pieces));
    OST_THEN(read_cells(h5, grid, &pieces));
    for (int on_points = 0; on_points < 2 && grid->wanted; on_points++)
        OST_THEN(take_array(h5, grid, on_points, grid->wanted));
    if (grid->field && grid->array_count == 0)
        ost_vtkhdf_note_fields(h5, grid->field);
    for (int n = 0; ost_vtk_region_name(n) && !grid->wanted; n++)
        OST_THEN(take_array(h5, grid, 0, ost_vtk_region_name(n)));
    if (!grid->wanted)
        OST_THEN(take_array(h5, grid, 0, ost_vtk_ghosts));
    for (int n = 1; ost_point_labels[n] && !grid->wanted && pieces.count > 1; n++)
        OST_THEN(take_array(h5, grid, 1, ost_point_labels[n]));
    OST_FREE(pieces.points, pieces.cells, pieces.connections);
    return status;
}

static OstStatus open_and_read(OstContext *ctx, const char *path, OstVtkGrid *grid)
{
    OstHdf5 h5 = {.file = H5I_INVALID_HID};
    OstStatus status = ost_hdf5_open(ctx, path, &h5);
    OST_THEN(read_all(&h5, grid));
    ost_hdf5_close(&h5);
    return status;
}

static OstStatus dry_run(OstContext *ctx, const char *path, const char *wanted)
{
    OstVtkGrid grid = {.ctx = ctx, .path = path, .wanted = wanted};
    const OstStatus status = open_and_read(ctx, path, &grid);
    ost_vtk_clear(&grid);
    return status;
}

OstStatus ost_vtk_hdf_grid(OstVtkGrid *grid)
{
    OST_TRY(ost_hdf5_dry_run(grid->ctx, grid->path, dry_run, grid->wanted));
    return open_and_read(grid->ctx, grid->path, grid);
}

/* --- is it of this kind? --- */

static OstStatus look_at_types(OstContext *ctx, const char *path, int *others)
{
    OstHdf5 h5 = {.file = H5I_INVALID_HID};
    OstGlobal cells = 0;
    unsigned char *type = NULL;
    int components = 0;
    OstStatus status = ost_hdf5_open(ctx, path, &h5);
    *others = 0;
    if (status == OST_SUCCESS && !ost_hdf5_has(&h5, "/Orthostat")) {
        status = ost_hdf5_shape(&h5, "/VTKHDF/Types", &cells, &components);
        OST_THEN(OST_NEW(ctx, &type, cells));
        OST_THEN(ost_hdf5_read_rows(&h5, "/VTKHDF/Types", H5T_NATIVE_UCHAR, 1, cells, 0, cells, type));
        *others = ost_hdf5_has(&h5, "/VTKHDF/CellData/vtkGhostType");
        for (OstGlobal c = 0; c < cells && status == OST_SUCCESS && !*others; c++)
            *others = type[c] != VTK_TETRA && type[c] != VTK_QUADRATIC_TETRA;
    }
    OST_FREE(type);
    ost_hdf5_close(&h5);
    return status;
}

static OstStatus try_types(OstContext *ctx, const char *path, const char *unused)
{
    int others = 0;
    (void)unused;
    return look_at_types(ctx, path, &others);
}

OstStatus ost_vtk_hdf_has_others(OstContext *ctx, const char *path, int *others)
{
    *others = 0;
    if (ost_rank(ctx) == 0 && ost_hdf5_dry_run(ctx, path, try_types, NULL) == OST_SUCCESS &&
        look_at_types(ctx, path, others) != OST_SUCCESS)
        *others = 0; /* the reader of tets says what is wrong */
    return ost_max_ints(ctx, 1, others);
}
