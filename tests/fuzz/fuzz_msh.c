/* SPDX-License-Identifier: BSD-3-Clause */
#include "fuzz.h"
#include "read_mesh.h"

/* The mesh, and the field of it that the corpus has. */
static void read_mesh_and_field(OstContext *ctx, const char *path)
{
    OstMeshChunk *chunk = NULL;
    OstFileMaterials *materials = NULL;
    if (ost_mesh_file_read(ctx, path, &chunk, &materials) == OST_SUCCESS)
        (void)ost_mesh_file_read_field(ctx, path, "swelling", OST_FIELD_OF_NUMBERS, chunk);
    ost_chunk_destroy(&chunk);
    ost_file_materials_destroy(&materials);
    read_mesh(ctx, path);
}

/* A packed file may unpack to fifty times its size. */
const FuzzTarget fuzz_target = {.file = "mesh.msh", .read = read_mesh_and_field, .constant = 16 << 20};
