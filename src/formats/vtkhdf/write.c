/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/vtkhdf.h"

#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/write_aside.h"
#include "formats/vtkhdf/groups.h"
#include "formats/vtkhdf/piece.h"

#include <stdio.h>
#include <string.h>

/* --- writing --- */

/* What a field is, as attributes of its dataset. */
static OstStatus describe(OstHdf5 *h5, const char *dataset, const char *word)
{
    OstOutputField field;
    if (!ost_output_field_named(word, &field))
        return OST_SUCCESS;
    OST_TRY(ost_hdf5_write_text(h5, dataset, "Description", field.description));
    OST_TRY(ost_hdf5_write_text(h5, dataset, "Unit", field.unit));
    return *field.component_names ? ost_hdf5_write_text(h5, dataset, "Components", field.component_names) : OST_SUCCESS;
}

static OstStatus write_array(OstHdf5 *h5, OstPiece *piece, const OstOutputArray *array)
{
    const hid_t type[] = {[OST_VALUES_DOUBLE] = H5T_NATIVE_DOUBLE,
                          [OST_VALUES_INT32] = H5T_NATIVE_INT32,
                          [OST_VALUES_INT64] = H5T_NATIVE_INT64};
    char name[256];
    const int on_nodes = array->centring == OST_ON_NODES;
    snprintf(name, sizeof name, "/VTKHDF/%s/%s", on_nodes ? "PointData" : "CellData", array->name);
    OST_TRY(ost_hdf5_write_rows(
        h5, name, type[array->type], array->components, on_nodes ? &piece->points : &piece->tets,
        on_nodes ? ost_piece_gather(piece, ost_output_row_bytes(array), array->values) : array->values));
    return describe(h5, name, array->name);
}

/* Labels, and regions and axes unless the caller passes arrays of that name. */
static OstStatus write_own_arrays(OstHdf5 *h5, OstPiece *piece, int count, const OstOutputArray *arrays)
{
    const OstMesh *mesh = piece->mesh;
    const OstOutputArray region = {"region", OST_ON_TETS, OST_VALUES_INT32, 1, mesh->tet_region};
    const OstOutputArray axes = {"axes", OST_ON_TETS, OST_VALUES_DOUBLE, 9, mesh->tet_axes};
    OST_TRY(ost_hdf5_write_rows(h5, "/VTKHDF/PointData/vertex", H5T_NATIVE_INT64, 1, &piece->points,
                                ost_piece_gather(piece, sizeof(OstGlobal), mesh->node_label)));
    OST_TRY(ost_hdf5_write_rows(h5, "/VTKHDF/CellData/tet", H5T_NATIVE_INT64, 1, &piece->tets, mesh->tet_label));
    if (!ost_output_has_array(count, arrays, OST_ON_TETS, region.name))
        OST_TRY(write_array(h5, piece, &region));
    if (mesh->tet_axes && !ost_output_has_array(count, arrays, OST_ON_TETS, axes.name))
        OST_TRY(write_array(h5, piece, &axes));
    return OST_SUCCESS;
}

static OstStatus write_mark(OstHdf5 *h5, const OstOutputMark *mark)
{
    const int32_t yes = 1;
    const OstRows row = {.count = ost_rank(h5->ctx) == 0, .total = 1, .most = 1};
    OST_TRY(ost_hdf5_write_text(h5, "/VTKHDF", "Status", mark->status));
    OST_TRY(ost_hdf5_write_names(h5, "/Orthostat/Objections", mark->reason_count, mark->reasons));
    if (mark->unfinished)
        OST_TRY(ost_hdf5_write_rows(h5, "/VTKHDF/FieldData/unfinished", H5T_NATIVE_INT32, 1, &row, &yes));
    return ost_hdf5_write_rows(h5, "/VTKHDF/FieldData/refused", H5T_NATIVE_INT32, 1, &row, &yes);
}

static OstStatus write_contents(OstHdf5 *h5, OstPiece *piece, int count, const OstOutputArray *arrays,
                                const OstOutputMark *mark)
{
    const int version[2] = {1, 0};
    OST_TRY(ost_piece_write_shape(h5, piece));
    OST_TRY(ost_hdf5_write_integers(h5, "/VTKHDF", "Version", 2, version));
    OST_TRY(ost_hdf5_write_text(h5, "/VTKHDF", "Type", "UnstructuredGrid")); /* VTK asks for 16 bytes, no end mark */
    if (mark)
        OST_TRY(write_mark(h5, mark));
    OST_TRY(write_own_arrays(h5, piece, count, arrays));
    for (int a = 0; a < count; a++)
        OST_TRY(write_array(h5, piece, &arrays[a]));
    return ost_groups_write(h5, piece->mesh);
}

/* An upper bound, without what HDF5 needs for itself: all ghosts are counted, as some nodes are written twice. */
static double piece_bytes(const OstMesh *mesh, int count, const OstOutputArray *arrays)
{
    double node = 24.0 + 8.0;                                       /* place and label */
    double tet = 8.0 * mesh->nodes_per_tet + 8.0 + 1.0 + 8.0 + 4.0; /* nodes, offset, type, label, region */
    double names = 0.0;
    if (mesh->tet_axes)
        tet += 9.0 * 8.0;
    for (int a = 0; a < count; a++)
        *(arrays[a].centring == OST_ON_NODES ? &node : &tet) += (double)ost_output_row_bytes(&arrays[a]);
    for (int b = 0; b < mesh->boundary_count; b++)
        names += 8.0 * mesh->boundaries[b].nodes_per_item * (double)mesh->boundaries[b].count;
    return node * (double)mesh->node_count + tet * (double)mesh->owned_tets + names;
}

static OstStatus find_bytes(const OstMesh *mesh, int count, const OstOutputArray *arrays, OstGlobal *bytes)
{
    static const double for_hdf5 = 1 << 18; /* measured: 30 kB */
    double sum = piece_bytes(mesh, count, arrays);
    OST_TRY(ost_sum(mesh->ctx, 1, &sum));
    *bytes = (OstGlobal)(sum + for_hdf5);
    return OST_SUCCESS;
}

/* Tests for disk space before HDF5 writes anything, and reserves it until the file is written (HDF5 truncates it when
 * it closes it): Open MPI 4.1 does not report a full disk. The written file has holes, and HDF5 takes it for whole, or
 * crashes as it closes it. */
static OstStatus write_file(const OstAside *aside, OstPiece *piece, int count, const OstOutputArray *arrays,
                            const OstOutputMark *mark)
{
    OstContext *ctx = piece->mesh->ctx;
    OstHdf5 h5;
    OstGlobal bytes = 0;
    OST_TRY(find_bytes(piece->mesh, count, arrays, &bytes));
    OST_TRY(ost_aside_reserve(ctx, aside, bytes, 1));
    OstStatus status = ost_hdf5_create(ctx, aside->aside, &h5);
    OST_THEN(ost_aside_reserve(ctx, aside, bytes, 0));
    OST_THEN(write_contents(&h5, piece, count, arrays, mark));
    const OstStatus closed = ost_hdf5_close(&h5);
    return ost_agree(ctx, status != OST_SUCCESS ? status : closed);
}

OstStatus ost_vtkhdf_write(OstContext *ctx, const char *path, const OstMesh *mesh, int array_count,
                           const OstOutputArray *arrays, const OstOutputMark *mark)
{
    OstPiece piece = {0};
    OstAside aside = {0};
    size_t largest_row = 3 * sizeof(double);
    for (int a = 0; a < array_count; a++)
        largest_row = ost_output_row_bytes(&arrays[a]) > largest_row ? ost_output_row_bytes(&arrays[a]) : largest_row;
    OstStatus status = ost_agree(ctx, ost_output_check_arrays(mesh, path, array_count, arrays));
    OST_THEN(ost_piece_create(mesh, largest_row, &piece));
    OST_THEN(ost_aside_open_together(ctx, path, &aside));
    OST_THEN(ost_aside_finish_together(ctx, &aside, write_file(&aside, &piece, array_count, arrays, mark)));
    ost_piece_free(&piece);
    return status;
}
