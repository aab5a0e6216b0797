/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/vtkhdf.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/write_aside.h"
#include "formats/vtkhdf/groups.h"
#include "formats/vtkhdf/piece.h"
#include "formats/vtkhdf/steps.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* An array of the file; its name is the file's own, and its values are those of no step. */
typedef struct Written {
    OstOutputArray array;
    int is_of_body; /* the same in all steps, and written once */
    int steps;      /* of which it is written */
} Written;

struct OstStepsFile {
    OstContext *ctx;
    char *path;
    const OstMesh *mesh; /* of all steps; NULL before the first */
    int is_series, most;
    OstPiece piece;
    size_t row_bytes; /* of the largest row that the piece gathers */
    OstAside aside;
    OstHdf5 h5;
    int array_count;
    Written *arrays;
    OstStepList list;
    OstStatus failed; /* what a failed writing leaves is not built upon */
};

static OstStatus start(OstContext *ctx, const char *path, int is_series, int most, OstStepsFile **file)
{
    OST_TRY(OST_NEW(ctx, file, 1));
    **file = (OstStepsFile){.ctx = ctx, .is_series = is_series, .most = most, .h5.file = H5I_INVALID_HID};
    return ost_copy_string(ctx, path, &(*file)->path);
}

static void destroy(OstStepsFile **file)
{
    for (int a = 0; *file && a < (*file)->array_count; a++) {
        char *name = (char *)(*file)->arrays[a].array.name;
        OST_FREE(name);
    }
    if (*file) {
        OST_FREE((*file)->arrays);
        ost_step_list_free(&(*file)->list);
        ost_piece_free(&(*file)->piece);
        OST_FREE((*file)->path);
    }
    OST_FREE(*file);
}

/* --- one array --- */

static const char *group_of(const Written *written, int is_offset)
{
    static const char *const group[2][2] = {{"PointData", "CellData"}, {"PointDataOffsets", "CellDataOffsets"}};
    return group[is_offset][written->array.centring == OST_ON_TETS];
}

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

static const OstRows *rows_of(const OstStepsFile *file, const Written *written)
{
    return written->array.centring == OST_ON_NODES ? &file->piece.points : &file->piece.tets;
}

/* Its rows, by point or tet, in the next step. */
static OstStatus write_next(OstStepsFile *file, Written *written, const void *rows)
{
    const hid_t type[] = {[OST_VALUES_DOUBLE] = H5T_NATIVE_DOUBLE,
                          [OST_VALUES_INT32] = H5T_NATIVE_INT32,
                          [OST_VALUES_INT64] = H5T_NATIVE_INT64};
    const OstOutputArray *array = &written->array;
    const int step = written->steps++;
    char name[256];
    snprintf(name, sizeof name, "/VTKHDF/%s/%s", group_of(written, 0), array->name);
    OST_TRY(ost_hdf5_write_step(&file->h5, name, type[array->type], array->components, rows_of(file, written), step,
                                written->is_of_body ? 1 : file->most, rows));
    return step == 0 ? describe(&file->h5, name, array->name) : OST_SUCCESS;
}

/* Up to this step it is in none: NaN says so. */
static OstStatus write_unknown(OstStepsFile *file, Written *written, int step)
{
    const size_t count = (size_t)rows_of(file, written)->count * (size_t)written->array.components;
    double *unknown = NULL;
    if (written->is_of_body || written->steps >= step)
        return OST_SUCCESS;
    if (written->array.type != OST_VALUES_DOUBLE)
        return OST_RAISE(file->ctx, OST_INVALID_INPUT, "%s: some steps have an array '%s' and others do not",
                         file->path, written->array.name);
    OstStatus status = ost_agree(file->ctx, OST_NEW(file->ctx, &unknown, count));
    for (size_t i = 0; i < count && status == OST_SUCCESS; i++)
        unknown[i] = NAN;
    while (status == OST_SUCCESS && written->steps < step)
        status = write_next(file, written, unknown);
    OST_FREE(unknown);
    return status;
}

/* --- the arrays of a step --- */

enum { OWN_ARRAYS = 4 };

/* Labels, and regions and axes unless the caller passes arrays of that name. */
static int list_own_arrays(const OstMesh *mesh, int count, const OstOutputArray *arrays, OstOutputArray *own)
{
    const OstOutputArray all[OWN_ARRAYS] = {{"vertex", OST_ON_NODES, OST_VALUES_INT64, 1, mesh->node_label},
                                            {"tet", OST_ON_TETS, OST_VALUES_INT64, 1, mesh->tet_label},
                                            {"region", OST_ON_TETS, OST_VALUES_INT32, 1, mesh->tet_region},
                                            {"axes", OST_ON_TETS, OST_VALUES_DOUBLE, 9, mesh->tet_axes}};
    int listed = 0;
    for (int i = 0; i < (mesh->tet_axes ? OWN_ARRAYS : OWN_ARRAYS - 1); i++)
        if (!ost_output_has_array(count, arrays, all[i].centring, all[i].name))
            own[listed++] = all[i];
    return listed;
}

static Written *find(const OstStepsFile *file, const OstOutputArray *array)
{
    for (int a = 0; a < file->array_count; a++)
        if (file->arrays[a].array.centring == array->centring && strcmp(file->arrays[a].array.name, array->name) == 0)
            return &file->arrays[a];
    return NULL;
}

/* Local. The file is to have this array. */
static OstStatus take_array(OstStepsFile *file, const OstOutputArray *array)
{
    const Written *known = find(file, array);
    char *name = NULL;
    if (known && known->array.type == array->type && known->array.components == array->components)
        return OST_SUCCESS;
    if (known || (file->piece.mesh && ost_output_row_bytes(array) > file->row_bytes))
        return OST_RAISE(file->ctx, OST_INVALID_INPUT, "%s: array '%s' has other components in another step",
                         file->path, array->name);
    OST_TRY(OST_RESIZE(file->ctx, &file->arrays, file->array_count + 1));
    OST_TRY(ost_copy_string(file->ctx, array->name, &name));
    file->arrays[file->array_count++] = (Written){
        .array = {name, array->centring, array->type, array->components, NULL},
        .is_of_body = ost_output_field_is_of_body(name),
    };
    return OST_SUCCESS;
}

static OstStatus write_array(OstStepsFile *file, const OstOutputArray *array)
{
    Written *written = find(file, array);
    if (written->is_of_body && written->steps > 0)
        return OST_SUCCESS;
    OST_TRY(write_unknown(file, written, file->list.count));
    return write_next(file, written,
                      array->centring == OST_ON_NODES
                          ? ost_piece_gather(&file->piece, ost_output_row_bytes(array), array->values)
                          : array->values);
}

/* --- the file --- */

/* An upper bound, without what HDF5 needs for itself: all ghosts are counted, as some nodes are written twice. */
static double piece_bytes(const OstStepsFile *file)
{
    const OstMesh *mesh = file->mesh;
    double node = 24.0;                                 /* place */
    double tet = 8.0 * mesh->nodes_per_tet + 8.0 + 1.0; /* nodes, offset, type */
    double names = 0.0;
    for (int a = 0; a < file->array_count; a++) {
        const Written *written = &file->arrays[a];
        *(written->array.centring == OST_ON_NODES ? &node : &tet) +=
            (double)ost_output_row_bytes(&written->array) * (written->is_of_body ? 1 : file->most);
    }
    for (int b = 0; b < mesh->boundary_count; b++)
        names += 8.0 * mesh->boundaries[b].nodes_per_item * (double)mesh->boundaries[b].count;
    return node * (double)mesh->node_count + tet * (double)mesh->owned_tets + names;
}

/* Tests for disk space before HDF5 writes anything, and reserves it until the file is written (HDF5 truncates it when
 * it closes it): Open MPI 4.1 does not report a full disk. The written file has holes, and HDF5 takes it for whole, or
 * crashes as it closes it. */
static OstStatus reserve(const OstStepsFile *file, int is_empty)
{
    static const double for_hdf5 = 1 << 18; /* measured: 30 kB */
    double sum = piece_bytes(file);
    OST_TRY(ost_sum(file->ctx, 1, &sum));
    return ost_aside_reserve(file->ctx, &file->aside, (OstGlobal)(sum + for_hdf5), is_empty);
}

static OstStatus write_mesh(OstStepsFile *file)
{
    const int version[2] = {file->is_series ? 2 : 1, 0};
    OstHdf5 *h5 = &file->h5;
    OST_TRY(ost_piece_write_shape(h5, &file->piece));
    OST_TRY(ost_hdf5_write_integers(h5, "/VTKHDF", "Version", 2, version));
    OST_TRY(ost_hdf5_write_text(h5, "/VTKHDF", "Type", "UnstructuredGrid")); /* VTK asks for 16 bytes, no end mark */
    return ost_groups_write(h5, file->mesh);
}

/* The first step brings the mesh. */
static OstStatus create(OstStepsFile *file)
{
    file->row_bytes = 3 * sizeof(double); /* of the points themselves */
    for (int a = 0; a < file->array_count; a++) {
        const size_t row = ost_output_row_bytes(&file->arrays[a].array);
        file->row_bytes = row > file->row_bytes ? row : file->row_bytes;
    }
    OST_TRY(ost_piece_create(file->mesh, file->row_bytes, &file->piece));
    OST_TRY(ost_aside_open_together(file->ctx, file->path, &file->aside));
    OST_TRY(reserve(file, 1));
    OST_TRY(ost_hdf5_create(file->ctx, file->aside.aside, &file->h5));
    OST_TRY(reserve(file, 0));
    return write_mesh(file);
}

static OstStatus take_step(OstStepsFile *file, const OstMesh *mesh, int count, const OstOutputArray *arrays)
{
    const int known = file->array_count;
    OstOutputArray own[OWN_ARRAYS];
    const int own_count = list_own_arrays(mesh, count, arrays, own);
    OstStatus status = ost_output_check_arrays(mesh, file->path, count, arrays);
    for (int a = 0; a < own_count; a++)
        OST_THEN(take_array(file, &own[a]));
    for (int a = 0; a < count; a++)
        OST_THEN(take_array(file, &arrays[a]));
    OST_TRY(ost_agree(file->ctx, status));
    const int is_first = !file->mesh;
    file->mesh = mesh;
    if (is_first)
        OST_TRY(create(file));
    else if (file->array_count > known)
        OST_TRY(reserve(file, 0));
    for (int a = 0; a < own_count; a++)
        OST_TRY(write_array(file, &own[a]));
    for (int a = 0; a < count; a++)
        OST_TRY(write_array(file, &arrays[a]));
    for (int a = 0; a < file->array_count; a++)
        OST_TRY(write_unknown(file, &file->arrays[a], file->list.count + 1));
    return OST_SUCCESS;
}

OstStatus ost_vtkhdf_add(OstStepsFile *file, const OstMesh *mesh, double value, const char *name, int array_count,
                         const OstOutputArray *arrays, const OstOutputMark *mark)
{
    OST_TRY(file->failed);
    if (file->list.count == file->most || (file->mesh && file->mesh != mesh))
        return file->failed = OST_RAISE(file->ctx, OST_INVALID_INPUT, "%s: a file of %d steps of one mesh takes no %s",
                                        file->path, file->most, file->list.count == file->most ? "more" : "other mesh");
    OstStatus status = take_step(file, mesh, array_count, arrays);
    OST_THEN(ost_agree(file->ctx, ost_step_list_add(file->ctx, &file->list, value, name, mark)));
    file->failed = status;
    return status;
}

int ost_vtkhdf_has_step(const OstStepsFile *file)
{
    return file->list.count > 0;
}

static OstStatus write_steps(OstStepsFile *file)
{
    OST_TRY(ost_step_list_write_marks(&file->h5, &file->list));
    if (!file->is_series)
        return OST_SUCCESS;
    OST_TRY(ost_step_list_write(&file->h5, &file->list, ost_size(file->ctx)));
    for (int a = 0; a < file->array_count; a++) {
        const Written *written = &file->arrays[a];
        OST_TRY(ost_step_list_write_offsets(&file->h5, &file->list, group_of(written, 1), written->array.name,
                                            written->is_of_body ? 0 : rows_of(file, written)->total));
    }
    return OST_SUCCESS;
}

static OstStatus write_names(const OstStepsFile *file)
{
    if (!file->is_series || ost_rank(file->ctx) != 0)
        return OST_SUCCESS;
    return ost_step_list_add_names(file->ctx, &file->list, file->aside.aside);
}

OstStatus ost_steps_file_finish(OstStepsFile **file)
{
    OstStepsFile *finished = *file;
    if (!finished)
        return OST_SUCCESS;
    OstContext *ctx = finished->ctx;
    OstStatus status = finished->failed;
    if (finished->h5.ctx) {
        OST_THEN(write_steps(finished));
        const OstStatus closed = ost_hdf5_close(&finished->h5);
        status = ost_agree(ctx, status != OST_SUCCESS ? status : closed);
        OST_THEN(ost_agree(ctx, write_names(finished)));
    }
    if (finished->aside.path)
        status = ost_aside_finish_together(ctx, &finished->aside, status);
    destroy(file);
    return status;
}

OstStatus ost_steps_file_create(OstContext *ctx, const char *path, int most, OstStepsFile **file)
{
    *file = NULL;
    const OstStatus status = ost_agree(ctx, start(ctx, path, 1, most, file));
    if (status != OST_SUCCESS)
        destroy(file);
    return status;
}

OstStatus ost_vtkhdf_write(OstContext *ctx, const char *path, const OstMesh *mesh, int array_count,
                           const OstOutputArray *arrays, const OstOutputMark *mark)
{
    OstStepsFile *file = NULL;
    OstStatus status = ost_agree(ctx, start(ctx, path, 0, 1, &file));
    if (status != OST_SUCCESS)
        destroy(&file);
    OST_THEN(ost_vtkhdf_add(file, mesh, 0.0, NULL, array_count, arrays, mark));
    const OstStatus finished = ost_steps_file_finish(&file);
    return status != OST_SUCCESS ? status : finished;
}
