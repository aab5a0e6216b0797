/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_FUZZ_READ_MESH_H
#define ORTHOSTAT_TESTS_FUZZ_READ_MESH_H

#include "formats/serial/formats.h"

/* A mesh file, and if it is taken the checks that any mesh meets. */
static void read_mesh(OstContext *ctx, const char *path)
{
    OstMeshChunk *chunk = NULL;
    OstFileMaterials *materials = NULL;
    OstMesh *mesh = NULL;
    if (ost_mesh_file_read(ctx, path, &chunk, &materials) == OST_SUCCESS)
        ost_mesh_distribute(ctx, &chunk, &mesh);
    ost_mesh_destroy(&mesh);
    ost_chunk_destroy(&chunk);
    ost_file_materials_destroy(&materials);
}

#endif
