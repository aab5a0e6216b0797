/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/vtkhdf.h"

#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/write_aside.h"
#include "formats/vtkhdf/groups.h"
#include "formats/vtkhdf/piece.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static size_t row_bytes(const OstOutputArray *array)
{
    return (size_t)array->components * (array->type == OST_VALUES_DOUBLE ? sizeof(double) : sizeof(int32_t));
}

static int has_array(int count, const OstOutputArray *arrays, OstCentring centring, const char *name)
{
    for (int a = 0; a < count; a++)
        if (arrays[a].centring == centring && strcmp(arrays[a].name, name) == 0)
            return 1;
    return 0;
}

/* --- what may be written --- */

static OstStatus check_names(OstContext *ctx, const char *path, int count, const OstOutputArray *arrays)
{
    for (int a = 0; a < count; a++) {
        const OstOutputArray *array = &arrays[a];
        const char *reserved = array->centring == OST_ON_NODES ? "vertex" : "tet";
        if (!*array->name || strlen(array->name) > 200 || strchr(array->name, '/') || strcmp(array->name, ".") == 0)
            return OST_RAISE(ctx, OST_INVALID_INPUT,
                             "%s: '%.250s' cannot name an array; expected 1 to 200 characters and no '/'", path,
                             array->name);
        if (strcmp(array->name, reserved) == 0 || has_array(a, arrays, array->centring, array->name))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: the file has an array '%s' already; choose another name",
                             path, array->name);
        if (array->components < 1)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: array '%s' has %d components", path, array->name,
                             array->components);
    }
    return OST_SUCCESS;
}

static OstStatus raise_not_finite(OstContext *ctx, const char *path, const OstOutputArray *array, size_t at,
                                  const OstMesh *mesh)
{
    const double value = ((const double *)array->values)[at];
    const size_t row = at / (size_t)array->components;
    const int on_nodes = array->centring == OST_ON_NODES;
    return OST_RAISE(ctx, OST_CHECK_FAILED,
                     "%s: '%s' is %g at %s %lld (component %zu of %d); expected finite numbers, so nothing was written",
                     path, array->name, value, on_nodes ? "vertex" : "tet",
                     (long long)(on_nodes ? mesh->node_label : mesh->tet_label)[row],
                     at % (size_t)array->components + 1, array->components);
}

/* x - x is 0 for finite x only; a sum can be vectorised, a loop with an exit cannot. */
static int all_finite(size_t count, const double *values)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++)
        sum += fabs(values[i] - values[i]);
    return sum == 0.0;
}

static OstStatus check_finite(const OstMesh *mesh, const char *path, const OstOutputArray *array)
{
    if (array->type != OST_VALUES_DOUBLE)
        return OST_SUCCESS;
    const OstLocal rows = array->centring == OST_ON_NODES ? mesh->node_count : mesh->owned_tets;
    const size_t count = (size_t)rows * (size_t)array->components;
    if (all_finite(count, array->values))
        return OST_SUCCESS;
    size_t at = 0;
    while (isfinite(((const double *)array->values)[at]))
        at++;
    return raise_not_finite(mesh->ctx, path, array, at, mesh);
}

static OstStatus check_arrays(const OstMesh *mesh, const char *path, int count, const OstOutputArray *arrays)
{
    const OstOutputArray coordinates = {"coordinates", OST_ON_NODES, OST_VALUES_DOUBLE, 3, mesh->coordinates};
    OST_TRY(check_names(mesh->ctx, path, count, arrays));
    OST_TRY(check_finite(mesh, path, &coordinates));
    for (int a = 0; a < count; a++)
        OST_TRY(check_finite(mesh, path, &arrays[a]));
    return OST_SUCCESS;
}

/* --- writing --- */

static OstStatus write_array(OstHdf5 *h5, OstPiece *piece, const OstOutputArray *array)
{
    char name[256];
    const int on_nodes = array->centring == OST_ON_NODES;
    snprintf(name, sizeof name, "/VTKHDF/%s/%s", on_nodes ? "PointData" : "CellData", array->name);
    return ost_hdf5_write_rows(h5, name, array->type == OST_VALUES_DOUBLE ? H5T_NATIVE_DOUBLE : H5T_NATIVE_INT32,
                               array->components, on_nodes ? &piece->points : &piece->tets,
                               on_nodes ? ost_piece_gather(piece, row_bytes(array), array->values) : array->values);
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
    if (!has_array(count, arrays, OST_ON_TETS, region.name))
        OST_TRY(write_array(h5, piece, &region));
    if (mesh->tet_axes && !has_array(count, arrays, OST_ON_TETS, axes.name))
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
        *(arrays[a].centring == OST_ON_NODES ? &node : &tet) += (double)row_bytes(&arrays[a]);
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

/* Returns 0, or errno. A file that cannot be opened is left to the writer, whose message is better. */
static int allocate(const char *path, OstGlobal bytes, int empties)
{
    int reason = 0;
    const int descriptor = open(path, O_WRONLY);
    if (descriptor < 0)
        return 0;
    do
        reason = fallocate(descriptor, 0, 0, (off_t)bytes) == 0 ? 0 : errno;
    while (reason == EINTR);
    if (empties && ftruncate(descriptor, 0) != 0 && reason == 0)
        reason = errno;
    close(descriptor);
    return reason == EOPNOTSUPP || reason == ENOSYS ? 0 : reason;
}

/* Is there room on disk for this many bytes (as rank 0 gives them)? Asks the file system to reserve them, which
 * respects quotas and limits too; then empties the file again, or leaves them reserved, so that no other program takes
 * them while the file is written (HDF5 truncates it when it closes it). Needed because Open MPI 4.1 does not report a
 * full disk: the written file has holes, and HDF5 takes it for whole, or crashes as it closes it. A file system that
 * cannot reserve space is trusted. */
static OstStatus reserve_space(OstContext *ctx, const OstAside *file, OstGlobal bytes, int empties)
{
    const int reason = ost_rank(ctx) == 0 ? allocate(file->aside, bytes, empties) : 0;
    return ost_agree(ctx, reason == 0 ? OST_SUCCESS
                                      : OST_RAISE(ctx, OST_FILE_FAILED,
                                                  "%s: needs %.3g MiB of disk space, which cannot be reserved: %s",
                                                  file->path, (double)bytes / 1048576.0, strerror(reason)));
}

/* Tests for disk space before HDF5 writes anything, and reserves it until the file is written. */
static OstStatus write_file(const OstAside *aside, OstPiece *piece, int count, const OstOutputArray *arrays,
                            const OstOutputMark *mark)
{
    OstContext *ctx = piece->mesh->ctx;
    OstHdf5 h5;
    OstGlobal bytes = 0;
    OST_TRY(find_bytes(piece->mesh, count, arrays, &bytes));
    OST_TRY(reserve_space(ctx, aside, bytes, 1));
    OstStatus status = ost_hdf5_create(ctx, aside->aside, &h5);
    OST_THEN(reserve_space(ctx, aside, bytes, 0));
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
        largest_row = row_bytes(&arrays[a]) > largest_row ? row_bytes(&arrays[a]) : largest_row;
    OstStatus status = ost_agree(ctx, check_arrays(mesh, path, array_count, arrays));
    OST_THEN(ost_piece_create(mesh, largest_row, &piece));
    OST_THEN(ost_aside_open_together(ctx, path, &aside));
    OST_THEN(ost_aside_finish_together(ctx, &aside, write_file(&aside, &piece, array_count, arrays, mark)));
    ost_piece_free(&piece);
    return status;
}
