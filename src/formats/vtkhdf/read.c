/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/vtkhdf.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "formats/vtkhdf/dry_run.h"
#include "formats/vtkhdf/groups.h"
#include "formats/vtkhdf/kind.h"
#include "formats/vtkhdf/points.h"
#include "formats/vtkhdf/steps.h"

#include <stdio.h>
#include <string.h>

/* VTK's numbers of the cell types we know. */
enum { VTK_TETRA = 10, VTK_QUADRATIC_TETRA = 24 };

/* A file while it is read. Every rank reads its own share of points and tets. */
typedef struct Reader {
    OstHdf5 h5;
    OstFilePoints points;
    OstGlobal *tet_start; /* points.piece_count + 1: first tet of each piece */
    OstMeshChunk *chunk;
} Reader;

OstStatus ost_vtkhdf_check_kind(const OstHdf5 *h5)
{
    char type[64] = "";
    int version[2] = {0, 0};
    if (!ost_hdf5_has(h5, "/VTKHDF"))
        return OST_RAISE(
            h5->ctx, OST_INVALID_INPUT,
            "%s: an HDF5 file, but it has no group VTKHDF; if it is of MED (Salome), name it .med, and of Exodus .e",
            h5->path);
    OST_TRY(ost_hdf5_read_text(h5, "/VTKHDF", "Type", type, sizeof type));
    if (strcmp(type, "UnstructuredGrid") != 0)
        return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: holds VTKHDF of type '%s'; expected UnstructuredGrid",
                         h5->path, type);
    OST_TRY(ost_hdf5_read_integers(h5, "/VTKHDF", "Version", 2, version));
    if (version[0] != 1 && version[0] != 2)
        return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: VTKHDF version %d.%d; expected 1 or 2", h5->path, version[0],
                         version[1]);
    return ost_steps_check(h5);
}

/* The first entry of each piece, from the pieces' counts; and one more, the total. */
static OstStatus read_starts(const OstHdf5 *h5, const char *name, OstGlobal pieces, OstGlobal **start)
{
    OST_TRY(OST_NEW(h5->ctx, start, pieces + 1));
    OST_TRY(ost_hdf5_read_rows(h5, name, H5T_NATIVE_INT64, 1, pieces, 0, pieces, *start + 1));
    for (OstGlobal p = 0; p < pieces; p++) {
        OstGlobal *end = *start + p + 1;
        if (*end < 0 || *end > INT64_MAX / 64 - (*start)[p])
            return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: %s of piece %lld is %lld; the file is damaged", h5->path,
                             name, (long long)p, (long long)*end);
        *end += (*start)[p];
    }
    return OST_SUCCESS;
}

/* Rank r's share of `total` entries begins at total·r/size; refused if a share exceeds 2^31 - 1. */
static OstStatus take_share(const OstHdf5 *h5, const char *what, OstGlobal total, OstGlobal *first, OstLocal *count)
{
    const OstGlobal size = ost_size(h5->ctx), rank = ost_rank(h5->ctx);
    const OstGlobal even = total / size, rest = total % size;
    *first = even * rank + (rank < rest ? rank : rest);
    if (even >= INT32_MAX)
        return OST_RAISE(h5->ctx, OST_LIMIT_EXCEEDED, "%s: %lld %s on %lld ranks are more than 2^31 - 1 each; use more",
                         h5->path, (long long)total, what, (long long)size);
    *count = (OstLocal)(even + (rank < rest));
    return OST_SUCCESS;
}

static OstStatus read_counts(Reader *reader)
{
    const OstHdf5 *h5 = &reader->h5;
    OstFilePoints *points = &reader->points;
    OstMeshChunk *chunk = reader->chunk;
    int components = 0;
    OST_TRY(ost_hdf5_shape(h5, "/VTKHDF/NumberOfPoints", &points->piece_count, &components));
    OST_TRY(read_starts(h5, "/VTKHDF/NumberOfPoints", points->piece_count, &points->piece_start));
    OST_TRY(read_starts(h5, "/VTKHDF/NumberOfCells", points->piece_count, &reader->tet_start));
    points->total = points->piece_start[points->piece_count];
    chunk->global_tets = reader->tet_start[points->piece_count];
    if (chunk->global_tets == 0)
        return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: holds no cells; expected tets", h5->path);
    OST_TRY(take_share(h5, "points", points->total, &points->first, &points->count));
    return take_share(h5, "tets", chunk->global_tets, &chunk->first_tet, &chunk->tet_count);
}

static OstStatus read_labels(Reader *reader)
{
    const OstHdf5 *h5 = &reader->h5;
    OstFilePoints *points = &reader->points;
    for (int i = 0; ost_point_labels[i] && (i == 0 || points->piece_count > 1); i++) {
        char name[64];
        snprintf(name, sizeof name, "/VTKHDF/PointData/%s", ost_point_labels[i]);
        if (!ost_hdf5_has(h5, name))
            continue;
        points->labelled = ost_point_labels[i];
        OST_TRY(OST_NEW(h5->ctx, &points->label, points->count));
        return ost_hdf5_read_rows(h5, name, H5T_NATIVE_INT64, 1, points->total, points->first, points->count,
                                  points->label);
    }
    return OST_SUCCESS;
}

static OstStatus read_points(Reader *reader)
{
    const OstHdf5 *h5 = &reader->h5;
    OstFilePoints *points = &reader->points;
    OstGlobal rows = 0;
    int components = 0;
    OST_TRY(ost_hdf5_shape(h5, "/VTKHDF/Points", &rows, &components)); /* before memory is allocated for them */
    if (rows != points->total || components != 3)
        return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: Points has %lld rows of %d; the pieces count %lld of 3",
                         h5->path, (long long)rows, components, (long long)points->total);
    OST_TRY(OST_NEW(h5->ctx, &points->coordinates, 3 * (size_t)points->count));
    OST_TRY(ost_hdf5_read_rows(h5, "/VTKHDF/Points", H5T_NATIVE_DOUBLE, 3, points->total, points->first, points->count,
                               points->coordinates));
    return read_labels(reader);
}

static OstStatus read_types(Reader *reader)
{
    const OstHdf5 *h5 = &reader->h5;
    OstMeshChunk *chunk = reader->chunk;
    OstGlobal rows = 0;
    int components = 0;
    unsigned char *types = NULL;
    OST_TRY(ost_hdf5_shape(h5, "/VTKHDF/Types", &rows, &components));
    if (rows != chunk->global_tets || components != 1)
        return OST_RAISE(h5->ctx, OST_INVALID_INPUT, "%s: Types has %lld rows; the pieces count %lld cells", h5->path,
                         (long long)rows, (long long)chunk->global_tets);
    OST_TRY(OST_NEW(h5->ctx, &types, chunk->tet_count));
    OstStatus status = ost_hdf5_read_rows(h5, "/VTKHDF/Types", H5T_NATIVE_UCHAR, 1, chunk->global_tets,
                                          chunk->first_tet, chunk->tet_count, types);
    for (OstLocal t = 0; t < chunk->tet_count && status == OST_SUCCESS; t++) {
        const int nodes = types[t] == VTK_TETRA ? 4 : types[t] == VTK_QUADRATIC_TETRA ? 10 : 0;
        if (nodes == 0)
            status =
                OST_RAISE(h5->ctx, OST_INVALID_INPUT,
                          "%s: cell %lld has VTK's type %d; expected tets only, type 10 (4 nodes) or 24 (10 nodes)",
                          h5->path, (long long)(chunk->first_tet + t), types[t]);
        else if (t > 0 && nodes != chunk->nodes_per_tet)
            status = OST_RAISE(h5->ctx, OST_INVALID_INPUT,
                               "%s: cell %lld has %d nodes, others have %d; expected tets of one kind", h5->path,
                               (long long)(chunk->first_tet + t), nodes, chunk->nodes_per_tet);
        chunk->nodes_per_tet = nodes;
    }
    OST_FREE(types);
    return status;
}

/* Collective. All ranks must have the same kind of tets; a rank without tets takes it from the others. */
static OstStatus agree_on_kind(Reader *reader)
{
    OstMeshChunk *chunk = reader->chunk;
    int range[2] = {chunk->tet_count > 0 ? -chunk->nodes_per_tet : -INT32_MAX, chunk->nodes_per_tet};
    OST_TRY(ost_max_ints(chunk->ctx, 2, range));
    chunk->nodes_per_tet = range[1];
    if (-range[0] != range[1])
        return OST_RAISE(chunk->ctx, OST_INVALID_INPUT, "%s: tets of %d and of %d nodes are mixed; expected one kind",
                         reader->h5.path, -range[0], range[1]);
    return OST_SUCCESS;
}

static OstGlobal piece_of_tet(const Reader *reader, OstGlobal piece, OstGlobal tet)
{
    while (tet >= reader->tet_start[piece + 1])
        piece++;
    return piece;
}

/* A piece has one offset more than tets, so tet t of piece p has entries t + p and t + p + 1. */
static OstStatus check_offsets(const Reader *reader, const OstGlobal *offset, OstGlobal first_piece)
{
    const OstMeshChunk *chunk = reader->chunk;
    const OstGlobal n = chunk->nodes_per_tet;
    OstGlobal piece = first_piece;
    for (OstLocal t = 0; t < chunk->tet_count; t++) {
        const OstGlobal tet = chunk->first_tet + t;
        piece = piece_of_tet(reader, piece, tet);
        const OstGlobal *entry = offset + t + (piece - first_piece);
        const OstGlobal expected = n * (tet - reader->tet_start[piece]);
        if (entry[0] != expected || entry[1] != expected + n)
            return OST_RAISE(chunk->ctx, OST_INVALID_INPUT,
                             "%s: Offsets of cell %lld are %lld and %lld; expected %lld and %lld", reader->h5.path,
                             (long long)tet, (long long)entry[0], (long long)entry[1], (long long)expected,
                             (long long)(expected + n));
    }
    return OST_SUCCESS;
}

static OstStatus read_offsets(const Reader *reader)
{
    const OstMeshChunk *chunk = reader->chunk;
    if (chunk->tet_count == 0)
        return OST_SUCCESS;
    const OstGlobal last = chunk->first_tet + chunk->tet_count - 1;
    const OstGlobal first_piece = piece_of_tet(reader, 0, chunk->first_tet);
    const OstGlobal last_piece = piece_of_tet(reader, first_piece, last);
    const OstGlobal count = chunk->tet_count + last_piece - first_piece + 1;
    OstGlobal *offset = NULL;
    OST_TRY(OST_NEW(chunk->ctx, &offset, count));
    OstStatus status = ost_hdf5_read_rows(&reader->h5, "/VTKHDF/Offsets", H5T_NATIVE_INT64, 1,
                                          chunk->global_tets + reader->points.piece_count,
                                          chunk->first_tet + first_piece, count, offset);
    OST_THEN(check_offsets(reader, offset, first_piece));
    OST_FREE(offset);
    return status;
}

/* The tets' nodes as points of the file, numbered over all pieces. */
static OstStatus read_connectivity(Reader *reader)
{
    OstMeshChunk *chunk = reader->chunk;
    const OstFilePoints *points = &reader->points;
    const OstGlobal n = chunk->nodes_per_tet;
    OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_nodes, n * chunk->tet_count));
    OST_TRY(ost_hdf5_read_rows(&reader->h5, "/VTKHDF/Connectivity", H5T_NATIVE_INT64, 1, n * chunk->global_tets,
                               n * chunk->first_tet, n * chunk->tet_count, chunk->tet_nodes));
    OstGlobal piece = 0;
    for (OstLocal t = 0; t < chunk->tet_count; t++) {
        piece = piece_of_tet(reader, piece, chunk->first_tet + t);
        const OstGlobal size = points->piece_start[piece + 1] - points->piece_start[piece];
        OstGlobal *nodes = chunk->tet_nodes + n * t;
        for (OstGlobal k = 0; k < n; k++) {
            if (nodes[k] < 0 || nodes[k] >= size)
                return OST_RAISE(chunk->ctx, OST_INVALID_INPUT,
                                 "%s: cell %lld uses point %lld of its piece, which has %lld", reader->h5.path,
                                 (long long)(chunk->first_tet + t), (long long)nodes[k], (long long)size);
            nodes[k] += points->piece_start[piece];
        }
    }
    return OST_SUCCESS;
}

/* Rows of a cell array into new memory. */
static OstStatus read_tet_array(const Reader *reader, const char *name, hid_t type, int components, size_t size,
                                void **values)
{
    const OstMeshChunk *chunk = reader->chunk;
    OST_TRY(ost_allocate(chunk->ctx, (size_t)chunk->tet_count * (size_t)components, size, values));
    return ost_hdf5_read_rows(&reader->h5, name, type, components, chunk->global_tets, chunk->first_tet,
                              chunk->tet_count, *values);
}

/* In a file without our group an array called region may be anything: the mesh is then one region. */
static OstStatus read_regions(Reader *reader)
{
    static const char name[] = "/VTKHDF/CellData/region";
    const OstHdf5 *h5 = &reader->h5;
    OstMeshChunk *chunk = reader->chunk;
    const int named = ost_hdf5_has(h5, "/Orthostat");
    OST_TRY(ost_groups_read_regions(h5, chunk));
    if (!named || !ost_hdf5_has(h5, name))
        return OST_NEW(chunk->ctx, &chunk->tet_region, chunk->tet_count);
    OST_TRY(read_tet_array(reader, name, H5T_NATIVE_INT32, 1, sizeof(int32_t), (void **)&chunk->tet_region));
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        if (chunk->tet_region[t] < 0 || chunk->tet_region[t] >= chunk->regions.count)
            return OST_RAISE(chunk->ctx, OST_INVALID_INPUT, "%s: cell %lld is of region %d; the file names %d regions",
                             h5->path, (long long)(chunk->first_tet + t), chunk->tet_region[t], chunk->regions.count);
    return OST_SUCCESS;
}

static OstStatus read_tets(Reader *reader)
{
    static const char tet[] = "/VTKHDF/CellData/tet";
    static const char axes[] = "/VTKHDF/CellData/axes";
    OstMeshChunk *chunk = reader->chunk;
    OST_TRY(read_offsets(reader));
    OST_TRY(read_connectivity(reader));
    OST_TRY(read_regions(reader));
    if (ost_hdf5_has(&reader->h5, tet))
        OST_TRY(read_tet_array(reader, tet, H5T_NATIVE_INT64, 1, sizeof(int64_t), (void **)&chunk->tet_label));
    OstGlobal rows = 0;
    int components = 0;
    if (ost_hdf5_has(&reader->h5, axes))
        OST_TRY(ost_hdf5_shape(&reader->h5, axes, &rows, &components));
    if (components == 9)
        OST_TRY(read_tet_array(reader, axes, H5T_NATIVE_DOUBLE, 9, sizeof(double), (void **)&chunk->tet_axes));
    return OST_SUCCESS;
}

/* Local. Opens the file and reads what does not need other ranks. */
static OstStatus open_and_read(OstContext *ctx, const char *path, Reader *reader)
{
    OST_TRY(OST_NEW(ctx, &reader->chunk, 1));
    reader->chunk->ctx = ctx;
    OST_TRY(ost_hdf5_open(ctx, path, &reader->h5));
    OST_TRY(ost_vtkhdf_check_kind(&reader->h5));
    OST_TRY(read_counts(reader));
    OST_TRY(read_types(reader));
    return read_points(reader);
}

/* Local. Makes HDF5 do all that reading will ask of it, but with few of the numbers. It goes on after an array that
 * HDF5 refuses, because the real reading has another order. */
static OstStatus dry_run(OstContext *ctx, const char *path, const char *name)
{
    const struct {
        const char *name;
        hid_t type;
    } arrays[] = {{"/VTKHDF/NumberOfPoints", H5T_NATIVE_INT64}, {"/VTKHDF/NumberOfCells", H5T_NATIVE_INT64},
                  {"/VTKHDF/Points", H5T_NATIVE_DOUBLE},        {"/VTKHDF/Types", H5T_NATIVE_UCHAR},
                  {"/VTKHDF/Offsets", H5T_NATIVE_INT64},        {"/VTKHDF/Connectivity", H5T_NATIVE_INT64},
                  {"/VTKHDF/CellData/tet", H5T_NATIVE_INT64},   {"/VTKHDF/CellData/region", H5T_NATIVE_INT32},
                  {"/VTKHDF/CellData/axes", H5T_NATIVE_DOUBLE}};
    Reader reader = {.h5.file = H5I_INVALID_HID};
    (void)name;
    OstStatus status = ost_hdf5_open(ctx, path, &reader.h5);
    OST_THEN(ost_steps_try(&reader.h5, NULL, NULL));
    OST_THEN(ost_vtkhdf_check_kind(&reader.h5));
    const int can_be_read = status == OST_SUCCESS;
    for (int i = 0; ost_point_labels[i] && can_be_read && status != OST_OUT_OF_MEMORY; i++) {
        char label[64];
        snprintf(label, sizeof label, "/VTKHDF/PointData/%s", ost_point_labels[i]);
        const OstStatus one = ost_hdf5_try_rows(&reader.h5, label, H5T_NATIVE_INT64);
        status = one == OST_SUCCESS ? status : one;
    }
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays && can_be_read && status != OST_OUT_OF_MEMORY; i++) {
        const OstStatus one = ost_hdf5_try_rows(&reader.h5, arrays[i].name, arrays[i].type);
        status = one == OST_SUCCESS ? status : one;
    }
    if (can_be_read && status != OST_OUT_OF_MEMORY)
        status = ost_groups_try(&reader.h5);
    ost_hdf5_close(&reader.h5);
    return status;
}

OstStatus ost_vtkhdf_read(OstContext *ctx, const char *path, OstMeshChunk **chunk)
{
    Reader reader = {.h5.file = H5I_INVALID_HID};
    OstStatus status = OST_SUCCESS;
    *chunk = NULL;
    OST_TRY_DONE(ost_agree(ctx, ost_hdf5_dry_run(ctx, path, dry_run, NULL)));
    OST_TRY_DONE(ost_agree(ctx, open_and_read(ctx, path, &reader)));
    OST_TRY_DONE(agree_on_kind(&reader));
    OST_TRY_DONE(ost_agree(ctx, read_tets(&reader)));
    OST_TRY_DONE(ost_file_points_merge(&reader.h5, &reader.points, reader.chunk));
    OST_TRY_DONE(ost_file_points_to_nodes(ctx, &reader.points,
                                          (size_t)reader.chunk->tet_count * (size_t)reader.chunk->nodes_per_tet,
                                          reader.chunk->tet_nodes));
    OST_TRY_DONE(ost_groups_read_boundaries(&reader.h5, reader.chunk));
    *chunk = reader.chunk;
    reader.chunk = NULL;
done:
    if (reader.h5.ctx)
        ost_hdf5_close(&reader.h5);
    ost_file_points_free(&reader.points);
    OST_FREE(reader.tet_start);
    if (reader.chunk)
        ost_chunk_destroy(&reader.chunk);
    return status;
}

/* --- a field on the tets, or on their points --- */

enum { LONGEST_NAME = 256 };

/* Where a field may be; both names are asked for in a dry run. */
static const char *const data_group[] = {"CellData", "PointData"};

static void name_in(int on_points, const char *field, char name[LONGEST_NAME])
{
    snprintf(name, LONGEST_NAME, "/VTKHDF/%s/%s", data_group[on_points], field);
}

static OstStatus try_field(OstContext *ctx, const char *path, const char *field)
{
    OstHdf5 h5 = {.file = H5I_INVALID_HID};
    char name[LONGEST_NAME], word[OST_LONGEST_FIELD], step[OST_LONGEST_FIELD];
    OstStatus status = ost_hdf5_open(ctx, path, &h5);
    if (status == OST_SUCCESS)
        ost_steps_split(&h5, field, word, step);
    for (int on_points = 0; on_points < 2; on_points++) {
        name_in(on_points, word, name);
        OST_THEN(ost_hdf5_try_rows(&h5, name, H5T_NATIVE_DOUBLE));
        OST_THEN(ost_steps_try(&h5, data_group[on_points], word));
    }
    ost_hdf5_close(&h5);
    return status;
}

/* The field's name, and that of a step if there is one. */
typedef struct Sought {
    char field[OST_LONGEST_FIELD], step[OST_LONGEST_FIELD];
} Sought;

/* Its rows first .. first + n - 1 of the `count` that the field has in a step. */
static OstStatus read_of_step(const OstHdf5 *h5, const Sought *sought, OstFileField *field, OstGlobal count,
                              OstGlobal first, OstLocal n)
{
    OstGlobal rows = 0, begin = 0;
    int components = 0;
    char name[LONGEST_NAME];
    name_in(field->on_nodes, sought->field, name);
    OST_TRY(ost_hdf5_shape(h5, name, &rows, &components));
    OST_TRY(ost_steps_find(h5, data_group[field->on_nodes], sought->field, sought->step, count, &rows, &begin));
    OST_TRY(OST_NEW(h5->ctx, &field->values, (size_t)n * (size_t)field->width));
    return ost_hdf5_read_rows(h5, name, H5T_NATIVE_DOUBLE, field->width, rows, begin + first, n, field->values);
}

/* The reader's tets again, of which the chunk has the nodes, with the file's points counted from the first that one of
 * them uses; of these points the field. */
static OstStatus read_of_points(Reader *reader, const Sought *sought, OstFileField *field)
{
    OstMeshChunk *tets = reader->chunk;
    OstGlobal first = INT64_MAX, last = -1;
    OST_TRY(read_counts(reader));
    OST_TRY(read_connectivity(reader));
    const size_t count = (size_t)tets->tet_count * (size_t)tets->nodes_per_tet;
    for (size_t i = 0; i < count; i++) {
        first = tets->tet_nodes[i] < first ? tets->tet_nodes[i] : first;
        last = tets->tet_nodes[i] > last ? tets->tet_nodes[i] : last;
    }
    first = count > 0 ? first : 0;
    if (last - first >= INT32_MAX)
        return OST_RAISE(tets->ctx, OST_LIMIT_EXCEEDED,
                         "%s: a rank's tets lie among more than 2^31 - 1 points; use more ranks", reader->h5.path);
    for (size_t i = 0; i < count; i++)
        tets->tet_nodes[i] -= first;
    return read_of_step(&reader->h5, sought, field, reader->points.total, first, (OstLocal)(last + 1 - first));
}

void ost_vtkhdf_note_fields(const OstHdf5 *h5, OstFileField *field)
{
    for (int on_nodes = 0; on_nodes < 2; on_nodes++) {
        char group[LONGEST_NAME];
        H5G_info_t info = {0};
        snprintf(group, sizeof group, "/VTKHDF/%s", data_group[on_nodes]);
        if (!ost_hdf5_has(h5, group) || H5Gget_info_by_name(h5->file, group, &info, H5P_DEFAULT) < 0)
            continue;
        for (hsize_t n = 0; n < info.nlinks; n++) {
            char name[OST_LONGEST_FIELD];
            const ssize_t length =
                H5Lget_name_by_idx(h5->file, group, H5_INDEX_NAME, H5_ITER_INC, n, name, sizeof name, H5P_DEFAULT);
            if (length > 0 && length < (ssize_t)sizeof name)
                ost_tet_field_note(field, name, (size_t)length);
        }
    }
}

static OstStatus read_field(Reader *reader, const char *word, unsigned use, OstMeshChunk *chunk, double *misses)
{
    const OstHdf5 *h5 = &reader->h5;
    OstGlobal rows = 0;
    OstFileField field = {0};
    char name[LONGEST_NAME];
    Sought sought;
    ost_steps_split(h5, word, sought.field, sought.step);
    for (; !field.found && field.on_nodes < 2; field.on_nodes++) {
        name_in(field.on_nodes, sought.field, name);
        field.found = ost_hdf5_has(h5, name);
    }
    field.on_nodes--;
    if (!field.found) {
        ost_vtkhdf_note_fields(h5, &field);
        return ost_tet_field_raise(chunk->ctx, h5->path, word, &field);
    }
    OST_TRY(ost_hdf5_shape(h5, name, &rows, &field.width));
    OST_TRY(ost_tet_field_check(chunk->ctx, h5->path, word, field.width));
    OstStatus status = field.on_nodes
                           ? read_of_points(reader, &sought, &field)
                           : read_of_step(h5, &sought, &field, chunk->global_tets, chunk->first_tet, chunk->tet_count);
    OST_THEN(ost_tet_field_of_nodes(reader->chunk, use, &field));
    OST_THEN(ost_tet_field_add(chunk, h5->path, word, &field));
    OST_FREE(field.values);
    *misses = field.misses;
    return status;
}

OstStatus ost_vtkhdf_read_field(OstContext *ctx, const char *path, const char *field, unsigned use, OstMeshChunk *chunk)
{
    Reader reader = {.h5.file = H5I_INVALID_HID};
    double misses = 0.0;
    OST_TRY(ost_agree(ctx, ost_hdf5_dry_run(ctx, path, try_field, field)));
    OstStatus status = OST_NEW(ctx, &reader.chunk, 1);
    OST_THEN(ost_hdf5_open(ctx, path, &reader.h5));
    if (status == OST_SUCCESS) {
        reader.chunk->ctx = ctx;
        reader.chunk->nodes_per_tet = chunk->nodes_per_tet;
        status = read_field(&reader, field, use, chunk, &misses);
    }
    ost_hdf5_close(&reader.h5);
    ost_file_points_free(&reader.points);
    OST_FREE(reader.tet_start);
    ost_chunk_destroy(&reader.chunk);
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(ost_sum(ctx, 1, &misses));
    ost_tet_field_warn(ctx, path, field, misses);
    return OST_SUCCESS;
}
