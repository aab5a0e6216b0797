/* SPDX-License-Identifier: BSD-3-Clause */
#include "fuzz.h"
#include "read_mesh.h"

/* The mesh, and a variable of elements and one of nodes. */
static void read_with_fields(OstContext *ctx, const char *path)
{
    OstMeshChunk *chunk = NULL;
    OstFileMaterials *materials = NULL;
    if (ost_mesh_file_read(ctx, path, &chunk, &materials) == OST_SUCCESS) {
        (void)ost_mesh_file_read_field(ctx, path, "fibre", OST_FIELD_OF_DIRECTIONS, chunk);
        (void)ost_mesh_file_read_field(ctx, path, "density", OST_FIELD_OF_NUMBERS, chunk);
    }
    ost_chunk_destroy(&chunk);
    ost_file_materials_destroy(&materials);
    read_mesh(ctx, path);
}

/* HDF5's caches, as for .vtkhdf; netCDF keeps what it reads once. */
const FuzzTarget fuzz_target = {
    .file = "mesh.exo", .read = read_with_fields, .constant = 64 << 20, .library_caches = 1};
