/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/serial/formats.h"

#include "core/error.h"
#include "core/memory.h"
#include "formats/vtkhdf/vtkhdf.h"
#include "mesh/distribution/share.h"

#include <limits.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

void ost_file_materials_destroy(OstFileMaterials **materials)
{
    if (!*materials)
        return;
    OST_FREE((*materials)->material);
    OST_FREE((*materials)->axes);
    OST_FREE(*materials);
}

static OstStatus broadcast(OstContext *ctx, void *data, size_t bytes)
{
    return OST_MPI(ctx, MPI_Bcast(data, (int)bytes, MPI_BYTE, 0, ost_comm(ctx)));
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
    OST_TRY_DONE(broadcast(ctx, &count, sizeof count));
    if ((size_t)count > INT_MAX / sizeof(OstMaterial))
        status = OST_RAISE(ctx, OST_LIMIT_EXCEEDED, "%d materials in a mesh file, at most %zu can be sent", count,
                           INT_MAX / sizeof(OstMaterial));
    else if (!*materials)
        status = create_materials(ctx, count, materials);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(broadcast(ctx, (*materials)->material, (size_t)count * sizeof(OstMaterial)));
    OST_TRY_DONE(broadcast(ctx, (*materials)->axes, 9 * (size_t)count * sizeof(double)));
done:
    if (status != OST_SUCCESS)
        ost_file_materials_destroy(materials);
    return status;
}

static OstStatus read_msh(OstContext *ctx, const char *path, OstMeshChunk **chunk, OstFileMaterials **materials)
{
    OST_TRY(OST_NEW(ctx, materials, 1));
    return ost_msh_read(ctx, path, chunk);
}

static const struct {
    const char *ending;
    OstStatus (*read)(OstContext *ctx, const char *path, OstMeshChunk **chunk, OstFileMaterials **materials);
} serial_format[] = {{".msh", read_msh}, {".msh.gz", read_msh}, {".veg", ost_veg_read}};

enum { SERIAL_FORMATS = sizeof serial_format / sizeof *serial_format };

static int ends_with(const char *path, const char *ending)
{
    const size_t length = strlen(path), tail = strlen(ending);
    return length >= tail && strcasecmp(path + length - tail, ending) == 0;
}

/* Number of the serial format with this ending, or SERIAL_FORMATS. */
static int find_format(const char *path)
{
    int format = 0;
    while (format < SERIAL_FORMATS && !ends_with(path, serial_format[format].ending))
        format++;
    return format;
}

static OstStatus read_serial(OstContext *ctx, int format, const char *path, OstMeshChunk **chunk,
                             OstFileMaterials **materials)
{
    OstStatus status = OST_SUCCESS;
    if (ost_rank(ctx) == 0)
        status = serial_format[format].read(ctx, path, chunk, materials);
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(ost_chunk_share(ctx, chunk));
    return share_materials(ctx, materials);
}

static const char *ending_of(const char *path)
{
    const char *name = strrchr(path, '/');
    const char *ending = strrchr(name ? name : path, '.');
    return ending ? ending : "";
}

int ost_mesh_file_reads(OstContext *ctx, const char *path, const char *sought)
{
    struct stat a, b;
    if (ends_with(path, ".veg"))
        return ost_veg_reads(ctx, path, sought);
    return stat(path, &a) == 0 && stat(sought, &b) == 0 && a.st_dev == b.st_dev && a.st_ino == b.st_ino;
}

OstStatus ost_mesh_file_read(OstContext *ctx, const char *path, OstMeshChunk **chunk, OstFileMaterials **materials)
{
    OstStatus status = OST_SUCCESS;
    *chunk = NULL;
    *materials = NULL;
    const int format = find_format(path);
    if (format < SERIAL_FORMATS)
        status = read_serial(ctx, format, path, chunk, materials);
    else if (ends_with(path, ".vtkhdf")) {
        status = ost_agree(ctx, OST_NEW(ctx, materials, 1));
        OST_THEN(ost_vtkhdf_read(ctx, path, chunk));
    } else
        status = OST_RAISE(ctx, OST_INVALID_INPUT,
                           "%s: the ending '%s' is not that of a mesh file; known are .msh and .msh.gz "
                           "(Gmsh), .veg (Vega FEM) and .vtkhdf",
                           path, ending_of(path));
    if (status != OST_SUCCESS) {
        ost_chunk_destroy(chunk);
        ost_file_materials_destroy(materials);
    }
    return status;
}

/* Rank 0 has all tets. */
static OstStatus read_msh_field(OstContext *ctx, const char *path, const char *name, OstMeshChunk *chunk)
{
    OST_TRY(ost_agree(ctx, ost_rank(ctx) == 0 ? ost_msh_read_field(ctx, path, name, chunk) : OST_SUCCESS));
    OST_TRY(broadcast(ctx, &chunk->field_width, sizeof chunk->field_width));
    return ost_agree(ctx, ost_rank(ctx) == 0 ? OST_SUCCESS : OST_NEW(ctx, &chunk->tet_field, 0));
}

OstStatus ost_mesh_file_read_field(OstContext *ctx, const char *path, const char *name, OstMeshChunk *chunk)
{
    const int format = find_format(path);
    if (format < SERIAL_FORMATS && serial_format[format].read == read_msh)
        return read_msh_field(ctx, path, name, chunk);
    if (format == SERIAL_FORMATS)
        return ost_vtkhdf_read_field(ctx, path, name, chunk);
    return OST_RAISE(ctx, OST_INVALID_INPUT,
                     "%s: a .veg file has no fields, and '%s' is asked for; use .msh or .vtkhdf", path, name);
}

OstStatus ost_chunk_read(OstContext *ctx, const char *path, OstMeshChunk **chunk)
{
    OstFileMaterials *materials = NULL;
    const OstStatus status = ost_mesh_file_read(ctx, path, chunk, &materials);
    ost_file_materials_destroy(&materials);
    return status;
}
