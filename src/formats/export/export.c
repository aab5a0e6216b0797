/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/export/export.h"

#include "core/error.h"
#include "core/write_aside.h"
#include "formats/serial/input_file.h"
#include "formats/vtkhdf/vtkhdf.h"

#include <string.h>

/* The formats that rank 0 writes. */
static const struct {
    const char *ending;
    OstStatus (*write)(FILE *file, const void *whole);
} writers[] = {{".msh", ost_msh_write}, {".inp", ost_abaqus_write}, {".vtu", ost_vtu_mesh_write}};
enum { WRITERS = sizeof writers / sizeof *writers };

OstStatus ost_mesh_export_check(OstContext *ctx, const char *path)
{
    for (int w = 0; w < WRITERS; w++)
        if (ost_has_ending(path, writers[w].ending))
            return OST_SUCCESS;
    return ost_has_ending(path, ".vtkhdf") || ost_has_ending(path, ".hdf")
               ? OST_SUCCESS
               : OST_RAISE(
                     ctx, OST_INVALID_USAGE,
                     "'%s': a mesh is written as .msh (Gmsh, which converts it further), .inp (Abaqus), .vtu (VTK) or "
                     ".vtkhdf",
                     path);
}

static OstStatus write_alone(const OstMesh *mesh, const char *path, OstStatus (*write)(FILE *file, const void *whole))
{
    OstMeshChunk *whole = NULL;
    OST_TRY(ost_mesh_gather(mesh, &whole));
    const OstStatus status = ost_rank(mesh->ctx) == 0 ? ost_write_aside(mesh->ctx, path, write, whole) : OST_SUCCESS;
    ost_chunk_destroy(&whole);
    return ost_agree(mesh->ctx, status);
}

/* In .msh and .inp files a name ends with its second double quote. */
static OstStatus check_quotes(const OstMesh *mesh, const char *path)
{
    const char *name = NULL;
    for (int r = 0; r < mesh->regions.count; r++)
        name = strchr(mesh->regions.name[r], '"') ? mesh->regions.name[r] : name;
    for (int b = 0; b < mesh->boundary_count; b++)
        name = strchr(mesh->boundaries[b].name, '"') ? mesh->boundaries[b].name : name;
    if (!name || (!ost_has_ending(path, ".msh") && !ost_has_ending(path, ".inp")))
        return OST_SUCCESS;
    return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                     "%s: cannot hold the name '%s', which has a double quote; write a .vtkhdf or .vtu file", path,
                     name);
}

OstStatus ost_mesh_export(const OstMesh *mesh, const char *path)
{
    OST_TRY(ost_mesh_export_check(mesh->ctx, path));
    OST_TRY(check_quotes(mesh, path));
    if (mesh->tet_axes && ost_has_ending(path, ".inp"))
        ost_warn(mesh->ctx, "%s: the material axes of the tets are left out; a .vtkhdf, .vtu or .msh file holds them",
                 path);
    for (int w = 0; w < WRITERS; w++)
        if (ost_has_ending(path, writers[w].ending))
            return write_alone(mesh, path, writers[w].write);
    const OstOutputArray region = {"region", OST_ON_TETS, OST_VALUES_INT32, 1, mesh->tet_region};
    return ost_vtkhdf_write(mesh->ctx, path, mesh, 1, &region, NULL);
}
