/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/serial/formats.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "formats/mesh_formats.h"
#include "formats/vtk/vtk.h"
#include "formats/vtkhdf/vtkhdf.h"
#include "mesh/distribution/share.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

void ost_file_materials_destroy(OstFileMaterials **materials)
{
    if (!*materials)
        return;
    OST_FREE((*materials)->material, (*materials)->axes);
    OST_FREE(*materials);
}

static OstStatus create_materials(OstContext *ctx, int count, OstFileMaterials **materials)
{
    OST_TRY(OST_NEW(ctx, materials, 1));
    OST_TRY(OST_NEW(ctx, &(*materials)->material, count));
    OST_TRY(OST_NEW(ctx, &(*materials)->axes, 9 * (size_t)count));
    (*materials)->count = count;
    return OST_SUCCESS;
}

/* Collective. Broadcasts rank 0's materials. */
static OstStatus share_materials(OstContext *ctx, OstFileMaterials **materials)
{
    OstStatus status = OST_SUCCESS;
    int count = *materials ? (*materials)->count : 0;
    OST_TRY_DONE(ost_broadcast(ctx, sizeof count, &count));
    if (!*materials)
        status = create_materials(ctx, count, materials);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_broadcast(ctx, (size_t)count * sizeof(OstMaterial), (*materials)->material));
    OST_TRY_DONE(ost_broadcast(ctx, 9 * (size_t)count * sizeof(double), (*materials)->axes));
done:
    if (status != OST_SUCCESS)
        ost_file_materials_destroy(materials);
    return status;
}

static size_t length_without_digits(const char *path, size_t length)
{
    while (length > 0 && isdigit((unsigned char)path[length - 1]))
        length--;
    return length;
}

/* Gmsh calls versions of its format .msh1 to .msh41; parts of an Exodus file end with .4.0 to .4.3. */
static size_t length_without_version(const char *path)
{
    const size_t length = strlen(path), bare = length_without_digits(path, length);
    if (bare >= 4 && strncasecmp(path + bare - 4, ".msh", 4) == 0)
        return bare;
    if (bare == length || bare < 2 || path[bare - 1] != '.')
        return length;
    const size_t rest = length_without_digits(path, bare - 1);
    return rest >= 2 && rest < bare - 1 && path[rest - 1] == '.' ? rest - 1 : length;
}

static int ends_with(const char *path, const char *ending)
{
    const size_t length = length_without_version(path), tail = strlen(ending);
    return length >= tail && strncasecmp(path + length - tail, ending, tail) == 0;
}

static const OstMeshFormat *find_format(const char *path)
{
    for (int f = 0; f < ost_mesh_format_count; f++)
        if (ends_with(path, ost_mesh_formats[f].ending))
            return &ost_mesh_formats[f];
    return NULL;
}

static OstStatus read_alone(OstContext *ctx, const OstMeshFormat *format, const char *path, OstMeshChunk **chunk,
                            OstFileMaterials **materials)
{
    if (format->read_with_materials)
        return format->read_with_materials(ctx, path, chunk, materials);
    OST_TRY(OST_NEW(ctx, materials, 1));
    return format->read(ctx, path, chunk);
}

static OstStatus read_serial(OstContext *ctx, const OstMeshFormat *format, const char *path, OstMeshChunk **chunk,
                             OstFileMaterials **materials)
{
    OstStatus status = OST_SUCCESS;
    if (ost_rank(ctx) == 0)
        status = read_alone(ctx, format, path, chunk, materials);
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(ost_chunk_share(ctx, chunk));
    return share_materials(ctx, materials);
}

OstStatus ost_mesh_file_check_name(OstContext *ctx, const char *path)
{
    char advice[512];
    if (find_format(path))
        return OST_SUCCESS;
    ost_mesh_format_advice(path, advice, sizeof advice);
    return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: %s", path, advice);
}

int ost_mesh_file_reads(OstContext *ctx, const char *path, const char *sought)
{
    struct stat a, b;
    if (ends_with(path, ".veg"))
        return ost_veg_reads(ctx, path, sought);
    return stat(path, &a) == 0 && stat(sought, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

/* Do all ranks read it? */
static OstStatus is_parallel(OstContext *ctx, const OstMeshFormat *format, const char *path, int *parallel)
{
    int others = 0;
    if (format->parallel)
        OST_TRY(ost_vtk_hdf_has_others(ctx, path, &others));
    *parallel = format->parallel && !others;
    return OST_SUCCESS;
}

/* Names go into JSON and XML, and case files, which are UTF-8, name them. */
static OstStatus make_names_plain(const char *path, OstMeshChunk *chunk)
{
    OstContext *ctx = chunk->ctx;
    for (int r = 0; r < chunk->regions.count; r++) {
        OST_TRY(ost_name_plain(ctx, &chunk->regions.name[r]));
        if (ost_names_find(&chunk->regions, chunk->regions.name[r]) != r)
            return OST_RAISE(ctx, OST_INVALID_INPUT,
                             "%s: two regions are called '%.80s', but for control characters or the encoding of their "
                             "letters; rename one",
                             path, chunk->regions.name[r]);
    }
    for (int b = 0; b < chunk->boundary_count; b++)
        OST_TRY(ost_name_plain(ctx, &chunk->boundaries[b].name));
    return OST_SUCCESS;
}

static OstStatus read_file(OstContext *ctx, const char *path, OstMeshChunk **chunk, OstFileMaterials **materials)
{
    OstStatus status = OST_SUCCESS;
    int parallel = 0;
    *chunk = NULL;
    *materials = NULL;
    const OstMeshFormat *format = find_format(path);
    if (!format)
        return ost_mesh_file_check_name(ctx, path);
    OST_TRY(is_parallel(ctx, format, path, &parallel));
    if (parallel) {
        status = ost_agree(ctx, OST_NEW(ctx, materials, 1));
        OST_THEN(ost_vtkhdf_read(ctx, path, chunk));
    } else
        status = read_serial(ctx, format, path, chunk, materials);
    OST_THEN(ost_agree(ctx, make_names_plain(path, *chunk)));
    OST_THEN(ost_agree(ctx, ost_copy_string(ctx, path, &(*chunk)->file)));
    if (status != OST_SUCCESS) {
        ost_chunk_destroy(chunk);
        ost_file_materials_destroy(materials);
    }
    return status;
}

OstStatus ost_mesh_file_read(OstContext *ctx, const char *path, OstMeshChunk **chunk, OstFileMaterials **materials)
{
    ost_ledger_enter(ctx, OST_LEDGER_MESH);
    const OstStatus status = read_file(ctx, path, chunk, materials);
    ost_ledger_leave(ctx);
    return status;
}

/* Rank 0 has all tets. */
static OstStatus read_field_alone(OstContext *ctx, const OstMeshFormat *format, const char *path, const char *name,
                                  unsigned use, OstMeshChunk *chunk)
{
    OstFileField field = {0};
    OstStatus status = format->read_field(ctx, path, name, chunk, &field);
    if (status == OST_SUCCESS && !field.found)
        status = ost_tet_field_raise(ctx, path, name, &field);
    OST_THEN(ost_tet_field_of_nodes(chunk, use, &field));
    OST_THEN(ost_tet_field_add(chunk, path, name, &field));
    if (status == OST_SUCCESS)
        ost_tet_field_warn(ctx, path, name, field.misses);
    OST_FREE(field.values);
    return status;
}

static OstStatus read_field(OstContext *ctx, const char *path, const char *name, unsigned use, OstMeshChunk *chunk)
{
    const OstMeshFormat *format = find_format(path);
    if (!format)
        return ost_mesh_file_check_name(ctx, path);
    int parallel = 0;
    OST_TRY(is_parallel(ctx, format, path, &parallel));
    if (parallel)
        return ost_vtkhdf_read_field(ctx, path, name, use, chunk);
    if (!format->read_field)
        return OST_RAISE(
            ctx, OST_INVALID_INPUT,
            "%s: no fields are read from a %s file, and '%s' is asked for; use .vtu, .vtk, .msh or .vtkhdf", path,
            format->ending, name);
    OST_TRY(ost_agree(ctx, ost_rank(ctx) == 0 ? read_field_alone(ctx, format, path, name, use, chunk) : OST_SUCCESS));
    OST_TRY(ost_broadcast(ctx, sizeof chunk->fields, &chunk->fields));
    return ost_agree(ctx, ost_rank(ctx) == 0 || chunk->tet_field ? OST_SUCCESS : OST_NEW(ctx, &chunk->tet_field, 0));
}

OstStatus ost_mesh_file_read_field(OstContext *ctx, const char *path, const char *name, unsigned use,
                                   OstMeshChunk *chunk)
{
    ost_ledger_enter(ctx, OST_LEDGER_MESH);
    const OstStatus status = read_field(ctx, path, name, use, chunk);
    ost_ledger_leave(ctx);
    return status;
}

OstStatus ost_chunk_read(OstContext *ctx, const char *path, OstMeshChunk **chunk)
{
    OstFileMaterials *materials = NULL;
    const OstStatus status = ost_mesh_file_read(ctx, path, chunk, &materials);
    ost_file_materials_destroy(&materials);
    return status;
}
