/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtu/vtu.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/numbering.h"
#include "core/write_aside.h"
#include "formats/vtu/heading.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { VTK_TETRA = 10, VTK_QUADRATIC_TETRA = 24 };
enum { OWN_ARRAYS = 4, MOST_FIELDS = OST_FIELD_COUNT + 4, MOST_ARRAYS = MOST_FIELDS + OWN_ARRAYS };

static const char ending[] = "\n</AppendedData>\n</VTKFile>\n";

/* A file as all ranks write it: a rank's rows of each array lie behind those of the ranks before. */
typedef struct Vtu {
    OstContext *ctx;
    const OstMesh *mesh;
    const char *path;    /* for messages */
    int descriptor;      /* of the temporary file */
    OstGlobal first_tet; /* this rank's, in the file */
    int count;
    OstOutputArray array[MOST_ARRAYS]; /* the fields, with labels, regions and axes */
    OstGlobal offset[MOST_ARRAYS + OST_VTU_SHAPE_ARRAYS];
    OstGlobal numbers; /* bytes of all arrays */
    char *heading;
    size_t heading_bytes;
} Vtu;

static OstGlobal rows_of(const OstMesh *mesh, OstCentring centring)
{
    return centring == OST_ON_NODES ? mesh->global_nodes : mesh->global_tets;
}

/* The fields, and what the file of any of this mesh's results has. */
static void list_arrays(Vtu *vtu, int count, const OstOutputArray *arrays)
{
    const OstMesh *mesh = vtu->mesh;
    const OstOutputArray own[OWN_ARRAYS] = {
        {"vertex", OST_ON_NODES, OST_VALUES_INT64, 1, mesh->node_label},
        {"tet", OST_ON_TETS, OST_VALUES_INT64, 1, mesh->tet_label},
        {"region", OST_ON_TETS, OST_VALUES_INT32, 1, mesh->tet_region},
        {"axes", OST_ON_TETS, OST_VALUES_DOUBLE, 9, mesh->tet_axes},
    };
    for (vtu->count = 0; vtu->count < count; vtu->count++)
        vtu->array[vtu->count] = arrays[vtu->count];
    for (int i = 0; i < (mesh->tet_axes ? OWN_ARRAYS : OWN_ARRAYS - 1); i++)
        if (!ost_output_has_array(vtu->count, vtu->array, own[i].centring, own[i].name))
            vtu->array[vtu->count++] = own[i];
}

/* Each array is a count of its bytes and then its rows. */
static void place_arrays(Vtu *vtu)
{
    const OstMesh *mesh = vtu->mesh;
    const OstGlobal shape[OST_VTU_SHAPE_ARRAYS] = {
        [OST_VTU_POINTS] = 24 * mesh->global_nodes,
        [OST_VTU_CONNECTIVITY] = 8 * mesh->nodes_per_tet * mesh->global_tets,
        [OST_VTU_OFFSETS] = 8 * mesh->global_tets,
        [OST_VTU_TYPES] = mesh->global_tets,
    };
    for (int a = 0; a < vtu->count + OST_VTU_SHAPE_ARRAYS; a++) {
        vtu->offset[a] = vtu->numbers;
        vtu->numbers += 8 + (a < vtu->count ? (OstGlobal)ost_output_row_bytes(&vtu->array[a]) *
                                                  rows_of(mesh, vtu->array[a].centring)
                                            : shape[a - vtu->count]);
    }
}

static OstStatus write_heading_text(Vtu *vtu, const OstOutputMark *mark)
{
    FILE *text = open_memstream(&vtu->heading, &vtu->heading_bytes);
    if (text)
        ost_vtu_heading(text, vtu->mesh, vtu->count, vtu->array, mark, vtu->offset);
    return text && fclose(text) == 0
               ? OST_SUCCESS
               : OST_RAISE(vtu->ctx, OST_OUT_OF_MEMORY, "%s: no memory for its heading", vtu->path);
}

/* Writes all bytes at a place of the file, or says why not. */
static OstStatus write_at(const Vtu *vtu, OstGlobal place, size_t bytes, const void *from)
{
    const char *next = from;
    while (bytes > 0) {
        const ssize_t done = pwrite(vtu->descriptor, next, bytes, (off_t)place);
        if (done < 0 && errno == EINTR)
            continue;
        if (done <= 0)
            return OST_RAISE(vtu->ctx, OST_FILE_FAILED, "cannot write '%s': %s", vtu->path,
                             done < 0 ? strerror(errno) : "nothing more is taken");
        next += done;
        place += done;
        bytes -= (size_t)done;
    }
    return OST_SUCCESS;
}

/* This rank's rows of an array; rank 0 also writes how many bytes all of them are. */
static OstStatus write_rows(const Vtu *vtu, int array, size_t row_bytes, OstGlobal total, OstGlobal first,
                            OstGlobal count, const void *rows)
{
    const uint64_t bytes = row_bytes * (uint64_t)total;
    const OstGlobal place = (OstGlobal)vtu->heading_bytes + vtu->offset[array];
    if (ost_rank(vtu->ctx) == 0)
        OST_TRY(write_at(vtu, place, sizeof bytes, &bytes));
    return write_at(vtu, place + (OstGlobal)sizeof bytes + first * (OstGlobal)row_bytes, row_bytes * (size_t)count,
                    rows);
}

static OstStatus write_fields(const Vtu *vtu)
{
    const OstMesh *mesh = vtu->mesh;
    for (int a = 0; a < vtu->count; a++) {
        const OstOutputArray *array = &vtu->array[a];
        const int on_nodes = array->centring == OST_ON_NODES;
        OST_TRY(write_rows(vtu, a, ost_output_row_bytes(array), rows_of(mesh, array->centring),
                           on_nodes ? mesh->first_node : vtu->first_tet,
                           on_nodes ? mesh->owned_nodes : mesh->owned_tets, array->values));
    }
    return OST_SUCCESS;
}

static OstStatus write_shape(const Vtu *vtu)
{
    const OstMesh *mesh = vtu->mesh;
    const OstGlobal tets = mesh->owned_tets, total = mesh->global_tets, first = vtu->first_tet;
    const OstGlobal n = mesh->nodes_per_tet;
    OstGlobal *numbers = NULL;
    OST_TRY(write_rows(vtu, vtu->count + OST_VTU_POINTS, 3 * sizeof(double), mesh->global_nodes, mesh->first_node,
                       mesh->owned_nodes, mesh->coordinates));
    OstStatus status = OST_NEW(vtu->ctx, &numbers, tets * n);
    OST_TRY_DONE(status);
    for (OstGlobal i = 0; i < tets * n; i++)
        numbers[i] = mesh->node_number[mesh->tet_nodes[i]];
    OST_TRY_DONE(
        write_rows(vtu, vtu->count + OST_VTU_CONNECTIVITY, (size_t)n * sizeof *numbers, total, first, tets, numbers));
    for (OstGlobal t = 0; t < tets; t++)
        numbers[t] = n * (first + t + 1);
    OST_TRY_DONE(write_rows(vtu, vtu->count + OST_VTU_OFFSETS, sizeof *numbers, total, first, tets, numbers));
    if (tets > 0)
        memset(numbers, n == 4 ? VTK_TETRA : VTK_QUADRATIC_TETRA, (size_t)tets);
    status = write_rows(vtu, vtu->count + OST_VTU_TYPES, 1, total, first, tets, numbers);
done:
    OST_FREE(numbers);
    return status;
}

/* Local: what one rank has to write. Errors of a network's file system may show at the end alone. */
static OstStatus write_part(Vtu *vtu, const char *aside)
{
    vtu->descriptor = open(aside, O_WRONLY | O_CLOEXEC);
    if (vtu->descriptor < 0)
        return OST_RAISE(vtu->ctx, OST_FILE_FAILED, "cannot write '%s': %s", vtu->path, strerror(errno));
    OstStatus status = OST_SUCCESS;
    if (ost_rank(vtu->ctx) == 0) {
        status = write_at(vtu, 0, vtu->heading_bytes, vtu->heading);
        OST_THEN(write_at(vtu, (OstGlobal)vtu->heading_bytes + vtu->numbers, strlen(ending), ending));
    }
    OST_THEN(write_fields(vtu));
    OST_THEN(write_shape(vtu));
    if (close(vtu->descriptor) != 0 && status == OST_SUCCESS)
        status = OST_RAISE(vtu->ctx, OST_FILE_FAILED, "cannot write '%s': %s", vtu->path, strerror(errno));
    return status;
}

static OstStatus write_file(Vtu *vtu, const OstOutputMark *mark)
{
    OstContext *ctx = vtu->ctx;
    OstAside aside = {0};
    OST_TRY(ost_agree(ctx, write_heading_text(vtu, mark)));
    OST_TRY(ost_aside_open_together(ctx, vtu->path, &aside));
    OstStatus status =
        ost_aside_reserve(ctx, &aside, (OstGlobal)vtu->heading_bytes + vtu->numbers + (OstGlobal)strlen(ending), 0);
    OST_THEN(ost_agree(ctx, write_part(vtu, aside.aside)));
    return ost_aside_finish_together(ctx, &aside, status);
}

OstStatus ost_vtu_write(OstContext *ctx, const char *path, const OstMesh *mesh, int array_count,
                        const OstOutputArray *arrays, const OstOutputMark *mark)
{
    Vtu vtu = {.ctx = ctx, .mesh = mesh, .path = path};
    OstGlobal all;
    OstStatus status = ost_output_check_arrays(mesh, path, array_count, arrays);
    if (status == OST_SUCCESS && array_count > MOST_FIELDS)
        status = OST_RAISE(ctx, OST_LIMIT_EXCEEDED, "%s: %d arrays; at most %d are possible", path, array_count,
                           MOST_FIELDS);
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(ost_number_from(ctx, mesh->owned_tets, &vtu.first_tet, &all));
    list_arrays(&vtu, array_count, arrays);
    place_arrays(&vtu);
    status = write_file(&vtu, mark);
    free(vtu.heading);
    return status;
}

/* --- .pvtu --- */

void ost_pvtu_piece(const char *path, size_t size, char *piece)
{
    size_t stem;
    ost_result_form(path, &stem);
    snprintf(piece, size, "%.*s.vtu", (int)stem, path);
}

static OstStatus write_text(FILE *file, const void *content)
{
    const Vtu *vtu = content;
    const char *slash = strrchr(vtu->path, '/');
    ost_pvtu_text(file, slash ? slash + 1 : vtu->path, vtu->count, vtu->array);
    return OST_SUCCESS;
}

OstStatus ost_pvtu_write(OstContext *ctx, const char *path, const OstMesh *mesh, int array_count,
                         const OstOutputArray *arrays, const OstOutputMark *mark)
{
    char piece[4096];
    ost_pvtu_piece(path, sizeof piece, piece);
    OST_TRY(ost_vtu_write(ctx, piece, mesh, array_count, arrays, mark));
    Vtu vtu = {.mesh = mesh, .path = piece};
    list_arrays(&vtu, array_count, arrays);
    return ost_agree(ctx, ost_rank(ctx) == 0 ? ost_write_aside(ctx, path, write_text, &vtu) : OST_SUCCESS);
}
