/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/distribution/share.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/gather.h"

#include <string.h>

/* What every rank must know of rank 0's chunk. */
typedef struct Outline {
    OstGlobal nodes, tets;
    int nodes_per_tet;
    int region_count, boundary_count;
    int has_node_labels, has_tet_labels, of_cells, of_arrays;
    size_t text_bytes; /* of all names with their terminating zeros, regions first */
} Outline;

static void outline_chunk(const OstMeshChunk *chunk, Outline *outline)
{
    for (int i = 0; i < chunk->regions.count; i++)
        outline->text_bytes += strlen(chunk->regions.name[i]) + 1;
    for (int b = 0; b < chunk->boundary_count; b++)
        outline->text_bytes += strlen(chunk->boundaries[b].name) + 1;
    outline->nodes = chunk->global_nodes;
    outline->tets = chunk->global_tets;
    outline->nodes_per_tet = chunk->nodes_per_tet;
    outline->region_count = chunk->regions.count;
    outline->boundary_count = chunk->boundary_count;
    outline->has_node_labels = chunk->node_label != NULL;
    outline->has_tet_labels = chunk->tet_label != NULL;
    outline->of_cells = chunk->of_cells;
    outline->of_arrays = chunk->of_arrays;
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

/* Arrays of no entries, since MPI gets their addresses like those of full ones. */
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
    made->of_cells = outline->of_cells;
    made->of_arrays = outline->of_arrays;
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

/* A rank must list the same names as rank 0, in the same order: from here on only their numbers are used. */
static OstStatus compare_names(const OstMeshChunk *chunk, const Outline *outline, const char *text, const int *kind)
{
    OstContext *ctx = chunk->ctx;
    if (chunk->regions.count != outline->region_count || chunk->boundary_count != outline->boundary_count)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "rank %d brings %d regions and %d boundaries, rank 0 %d and %d; every rank must list the same",
                         ost_rank(ctx), chunk->regions.count, chunk->boundary_count, outline->region_count,
                         outline->boundary_count);
    for (int i = 0; i < outline->region_count; i++, text += strlen(text) + 1)
        if (strcmp(chunk->regions.name[i], text) != 0)
            return OST_RAISE(ctx, OST_INVALID_INPUT,
                             "region %d is '%.80s' on rank %d and '%.80s' on rank 0; every rank must list the same", i,
                             chunk->regions.name[i], ost_rank(ctx), text);
    for (int b = 0; b < outline->boundary_count; b++, text += strlen(text) + 1) {
        const OstBoundary *mine = &chunk->boundaries[b];
        if (strcmp(mine->name, text) != 0 || mine->dimension != kind[2 * b])
            return OST_RAISE(
                ctx, OST_INVALID_INPUT,
                "boundary %d is '%.80s' of dimension %d on rank %d, and '%.80s' of dimension %d on rank 0; "
                "every rank must list the same",
                b, mine->name, mine->dimension, ost_rank(ctx), text, kind[2 * b]);
    }
    return OST_SUCCESS;
}

OstStatus ost_chunk_share(OstContext *ctx, OstMeshChunk **chunk)
{
    Outline outline = {0};
    char *text = NULL;
    int *kind = NULL;
    OstStatus status = OST_SUCCESS;
    if (*chunk)
        outline_chunk(*chunk, &outline);
    OST_TRY_DONE(ost_broadcast(ctx, sizeof outline, &outline));
    status = OST_NEW(ctx, &text, outline.text_bytes);
    OST_THEN(OST_NEW(ctx, &kind, 2 * (size_t)outline.boundary_count));
    OST_TRY_DONE(ost_agree(ctx, status));
    if (ost_rank(ctx) == 0)
        pack_names(*chunk, text, kind);
    OST_TRY_DONE(ost_broadcast(ctx, outline.text_bytes, text));
    OST_TRY_DONE(ost_broadcast(ctx, 2 * (size_t)outline.boundary_count * sizeof *kind, kind));
    if (*chunk)
        status = compare_names(*chunk, &outline, text, kind);
    else
        status = create_empty(ctx, &outline, text, kind, chunk);
    status = ost_agree(ctx, status);
done:
    OST_FREE(text, kind);
    if (status != OST_SUCCESS)
        ost_chunk_destroy(chunk);
    return status;
}
