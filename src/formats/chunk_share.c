/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/chunk_share.h"

#include "core/error.h"
#include "core/memory.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

/* What every rank must know of the mesh that rank 0 has read. */
typedef struct Outline {
    OstGlobal nodes, tets;
    int nodes_per_tet;
    int region_count, boundary_count;
    int has_node_labels, has_tet_labels;
    int text_bytes; /* all names with their zeros, regions first */
} Outline;

static OstStatus broadcast(OstContext *ctx, void *data, size_t bytes)
{
    return OST_MPI(ctx, MPI_Bcast(data, (int)bytes, MPI_BYTE, 0, ost_comm(ctx)));
}

static OstStatus outline_chunk(const OstMeshChunk *chunk, Outline *outline)
{
    size_t bytes = 0;
    for (int i = 0; i < chunk->regions.count; i++)
        bytes += strlen(chunk->regions.name[i]) + 1;
    for (int b = 0; b < chunk->boundary_count; b++)
        bytes += strlen(chunk->boundaries[b].name) + 1;
    if (bytes > INT_MAX)
        return OST_RAISE(chunk->ctx, OST_LIMIT_EXCEEDED,
                         "the names of regions and boundaries take %zu bytes, at most "
                         "%d can be sent",
                         bytes, INT_MAX);
    outline->nodes = chunk->global_nodes;
    outline->tets = chunk->global_tets;
    outline->nodes_per_tet = chunk->nodes_per_tet;
    outline->region_count = chunk->regions.count;
    outline->boundary_count = chunk->boundary_count;
    outline->has_node_labels = chunk->node_label != NULL;
    outline->has_tet_labels = chunk->tet_label != NULL;
    outline->text_bytes = (int)bytes;
    return OST_SUCCESS;
}

static void pack_names(const OstMeshChunk *chunk, char *text, int *kind)
{
    for (int i = 0; i < chunk->regions.count; i++)
        text = stpcpy(text, chunk->regions.name[i]) + 1;
    for (int b = 0; b < chunk->boundary_count; b++) {
        text = stpcpy(text, chunk->boundaries[b].name) + 1;
        kind[2 * b] = chunk->boundaries[b].dimension;
        kind[2 * b + 1] = chunk->boundaries[b].nodes_per_item;
    }
}

/* Every array is there, with no entries, so that it may be handed to MPI like a full one. */
static OstStatus allocate_nothing(OstContext *ctx, const Outline *outline, OstMeshChunk *chunk)
{
    OST_TRY(OST_NEW(ctx, &chunk->coordinates, 0));
    OST_TRY(OST_NEW(ctx, &chunk->tet_nodes, 0));
    OST_TRY(OST_NEW(ctx, &chunk->tet_region, 0));
    if (outline->has_node_labels)
        OST_TRY(OST_NEW(ctx, &chunk->node_label, 0));
    if (outline->has_tet_labels)
        OST_TRY(OST_NEW(ctx, &chunk->tet_label, 0));
    return OST_SUCCESS;
}

static OstStatus unpack_names(OstContext *ctx, const Outline *outline, const char *text, const int *kind,
                              OstMeshChunk *chunk)
{
    OST_TRY(OST_NEW(ctx, &chunk->regions.name, outline->region_count));
    for (int i = 0; i < outline->region_count; i++) {
        OST_TRY(ost_copy_string(ctx, text, &chunk->regions.name[i]));
        chunk->regions.count++;
        text += strlen(text) + 1;
    }
    OST_TRY(OST_NEW(ctx, &chunk->boundaries, outline->boundary_count));
    chunk->boundary_count = outline->boundary_count;
    for (int b = 0; b < outline->boundary_count; b++) {
        OstBoundary *boundary = &chunk->boundaries[b];
        OST_TRY(ost_copy_string(ctx, text, &boundary->name));
        OST_TRY(OST_NEW(ctx, &boundary->nodes, 0));
        boundary->dimension = kind[2 * b];
        boundary->nodes_per_item = kind[2 * b + 1];
        text += strlen(text) + 1;
    }
    return OST_SUCCESS;
}

static OstStatus create_empty(OstContext *ctx, const Outline *outline, const char *text, const int *kind,
                              OstMeshChunk **chunk)
{
    OstMeshChunk *made = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY(OST_NEW(ctx, &made, 1));
    made->ctx = ctx;
    made->nodes_per_tet = outline->nodes_per_tet;
    made->global_nodes = made->first_node = outline->nodes;
    made->global_tets = made->first_tet = outline->tets;
    OST_TRY_DONE(allocate_nothing(ctx, outline, made));
    OST_TRY_DONE(unpack_names(ctx, outline, text, kind, made));
done:
    if (status != OST_SUCCESS)
        ost_chunk_destroy(&made);
    *chunk = made;
    return status;
}

OstStatus ost_chunk_share(OstContext *ctx, OstMeshChunk **chunk)
{
    Outline outline = {0};
    char *text = NULL;
    int *kind = NULL;
    OstStatus status = *chunk ? outline_chunk(*chunk, &outline) : OST_SUCCESS;
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(broadcast(ctx, &outline, sizeof outline));
    status = OST_NEW(ctx, &text, outline.text_bytes);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &kind, 2 * (size_t)outline.boundary_count);
    OST_TRY_DONE(ost_agree(ctx, status));
    if (*chunk)
        pack_names(*chunk, text, kind);
    OST_TRY_DONE(broadcast(ctx, text, (size_t)outline.text_bytes));
    OST_TRY_DONE(broadcast(ctx, kind, 2 * (size_t)outline.boundary_count * sizeof *kind));
    if (!*chunk)
        status = create_empty(ctx, &outline, text, kind, chunk);
    status = ost_agree(ctx, status);
done:
    OST_FREE(text);
    OST_FREE(kind);
    if (status != OST_SUCCESS)
        ost_chunk_destroy(chunk);
    return status;
}

static OstStatus create_materials(OstContext *ctx, int count, OstFileMaterials **materials)
{
    OST_TRY(OST_NEW(ctx, materials, 1));
    OST_TRY(OST_NEW(ctx, &(*materials)->material, count));
    OST_TRY(OST_NEW(ctx, &(*materials)->axes, 9 * (size_t)count));
    (*materials)->count = count;
    return OST_SUCCESS;
}

OstStatus ost_file_materials_share(OstContext *ctx, OstFileMaterials **materials)
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

void ost_file_materials_destroy(OstFileMaterials **materials)
{
    if (!*materials)
        return;
    OST_FREE((*materials)->material);
    OST_FREE((*materials)->axes);
    OST_FREE(*materials);
}

OstStatus ost_names_add(OstContext *ctx, OstNames *names, const char *text)
{
    OST_TRY(OST_RESIZE(ctx, &names->name, names->count + 1));
    OST_TRY(ost_copy_string(ctx, text, &names->name[names->count]));
    names->count++;
    return OST_SUCCESS;
}

OstStatus ost_names_add_unique(OstContext *ctx, OstNames *names, const char *text)
{
    char numbered[64];
    snprintf(numbered, sizeof numbered, "%s", text);
    for (int number = 2; ost_names_find(names, numbered) >= 0; number++)
        snprintf(numbered, sizeof numbered, "%.40s-%d", text, number);
    return ost_names_add(ctx, names, numbered);
}
