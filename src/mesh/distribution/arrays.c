/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/numbering.h"
#include "mesh/check/check.h"
#include "mesh/distribution/share.h"

#include <string.h>

static OstStatus copy(OstContext *ctx, const char *what, size_t count, size_t size, const void *from, void **to)
{
    if (count > 0 && !from)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "mesh from arrays: %s is NULL on rank %d, expected %zu numbers", what,
                         ost_rank(ctx), count);
    OST_TRY(ost_allocate(ctx, count, size, to));
    if (count > 0)
        memcpy(*to, from, count * size);
    return OST_SUCCESS;
}

static OstStatus check_name(OstContext *ctx, const char *what, int number, const char *name)
{
    if (!name || name[0] == '\0')
        return OST_RAISE(ctx, OST_INVALID_INPUT, "mesh from arrays: %s %d (counted from 0) has no name; give it one",
                         what, number);
    return ost_name_is_plain(name)
               ? OST_SUCCESS
               : OST_RAISE(ctx, OST_INVALID_INPUT,
                           "mesh from arrays: the name of %s %d (counted from 0) holds a control character, or is not "
                           "UTF-8; choose another",
                           what, number);
}

static OstStatus check_counts(OstContext *ctx, const OstMeshArrays *arrays)
{
    if (arrays->nodes_per_tet != 4 && arrays->nodes_per_tet != 10)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "mesh from arrays: nodes_per_tet is %d, expected 4 or 10",
                         arrays->nodes_per_tet);
    if (arrays->node_count < 0 || arrays->tet_count < 0 || arrays->region_count < 0 || arrays->boundary_count < 0)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "mesh from arrays: %d nodes, %d tets, %d regions and %d boundaries on rank %d; no count may "
                         "be negative",
                         arrays->node_count, arrays->tet_count, arrays->region_count, arrays->boundary_count,
                         ost_rank(ctx));
    return OST_SUCCESS;
}

static OstStatus copy_regions(const OstMeshArrays *arrays, OstMeshChunk *chunk)
{
    OstContext *ctx = chunk->ctx;
    if (arrays->region_count == 0)
        OST_TRY(ost_names_add(ctx, &chunk->regions, "body"));
    for (int r = 0; r < arrays->region_count; r++) {
        const char *name = arrays->region_names ? arrays->region_names[r] : NULL;
        OST_TRY(check_name(ctx, "region", r, name));
        if (ost_names_find(&chunk->regions, name) >= 0)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "mesh from arrays: two regions are called '%.80s'", name);
        OST_TRY(ost_names_add(ctx, &chunk->regions, name));
    }
    if (!arrays->tet_region) /* all tets are in the first region */
        return OST_NEW(ctx, &chunk->tet_region, chunk->tet_count);
    return copy(ctx, "tet_region", (size_t)chunk->tet_count, sizeof(int32_t), arrays->tet_region,
                (void **)&chunk->tet_region);
}

static OstStatus copy_boundary(const OstMeshArrays *arrays, int b, OstMeshChunk *chunk)
{
    OstContext *ctx = chunk->ctx;
    const OstBoundaryArrays *from = &arrays->boundaries[b];
    OST_TRY(check_name(ctx, "boundary", b, from->name));
    for (int i = 0; i < b; i++)
        if (strcmp(arrays->boundaries[i].name, from->name) == 0)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "mesh from arrays: two boundaries are called '%.80s'", from->name);
    if (from->dimension < 0 || from->dimension > 2 || from->count < 0)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "mesh from arrays: boundary '%.80s' has dimension %d and %d items, expected dimension 0 "
                         "(points), 1 (curves) or 2 (faces) and no negative count",
                         from->name, from->dimension, from->count);
    OstBoundary *to = &chunk->boundaries[b];
    to->dimension = from->dimension;
    to->nodes_per_item = from->dimension == 0         ? 1
                         : arrays->nodes_per_tet == 4 ? from->dimension + 1
                                                      : 3 * from->dimension;
    to->count = from->count;
    OST_TRY(ost_copy_string(ctx, from->name, &to->name));
    return copy(ctx, "a boundary's nodes", (size_t)from->count * (size_t)to->nodes_per_item, sizeof(OstGlobal),
                from->nodes, (void **)&to->nodes);
}

static OstStatus copy_share(const OstMeshArrays *arrays, OstMeshChunk *chunk)
{
    OstContext *ctx = chunk->ctx;
    const size_t nodes = (size_t)arrays->node_count;
    const size_t tets = (size_t)arrays->tet_count;
    chunk->nodes_per_tet = arrays->nodes_per_tet;
    chunk->node_count = arrays->node_count;
    chunk->tet_count = arrays->tet_count;
    OST_TRY(copy(ctx, "coordinates", 3 * nodes, sizeof(double), arrays->coordinates, (void **)&chunk->coordinates));
    OST_TRY(copy(ctx, "tet_nodes", tets * (size_t)arrays->nodes_per_tet, sizeof(OstGlobal), arrays->tet_nodes,
                 (void **)&chunk->tet_nodes));
    if (arrays->tet_axes)
        OST_TRY(copy(ctx, "tet_axes", 9 * tets, sizeof(double), arrays->tet_axes, (void **)&chunk->tet_axes));
    OST_TRY(copy_regions(arrays, chunk));
    if (arrays->boundary_count > 0 && !arrays->boundaries)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "mesh from arrays: boundaries is NULL on rank %d, expected %d",
                         ost_rank(ctx), arrays->boundary_count);
    OST_TRY(OST_NEW(ctx, &chunk->boundaries, arrays->boundary_count));
    for (int b = 0; b < arrays->boundary_count; b++) {
        chunk->boundary_count = b + 1;
        OST_TRY(copy_boundary(arrays, b, chunk));
    }
    return OST_SUCCESS;
}

/* A rank may have no arrays, except rank 0, which tells the others regions and boundaries. */
static OstStatus create_share(OstContext *ctx, const OstMeshArrays *arrays, OstMeshChunk **chunk)
{
    if (!arrays && ost_rank(ctx) == 0)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "mesh from arrays: rank 0 must have arrays, which may be empty");
    if (!arrays)
        return OST_SUCCESS;
    OST_TRY(check_counts(ctx, arrays));
    OST_TRY(OST_NEW(ctx, chunk, 1));
    (*chunk)->ctx = ctx;
    (*chunk)->of_arrays = 1;
    return copy_share(arrays, *chunk);
}

/* Numbers the shares contiguously over ranks. */
static OstStatus number_share(OstContext *ctx, OstMeshChunk *chunk)
{
    OstMeshChunk none = {0}; /* of a rank without arrays */
    OstMeshChunk *mine = chunk ? chunk : &none;
    OST_TRY(ost_number_from(ctx, mine->node_count, &mine->first_node, &mine->global_nodes));
    return ost_number_from(ctx, mine->tet_count, &mine->first_tet, &mine->global_tets);
}

OstStatus ost_chunk_create_from_arrays(OstContext *ctx, const OstMeshArrays *arrays, OstMeshChunk **chunk)
{
    OstStatus status = OST_SUCCESS;
    *chunk = NULL;
    ost_ledger_enter(ctx, OST_LEDGER_MESH);
    OST_TRY_DONE(ost_agree(ctx, create_share(ctx, arrays, chunk)));
    OST_TRY_DONE(number_share(ctx, *chunk));
    OST_TRY_DONE(ost_chunk_share(ctx, chunk));
    OST_TRY_DONE(ost_check_chunk(*chunk));
done:
    if (status != OST_SUCCESS)
        ost_chunk_destroy(chunk);
    ost_ledger_leave(ctx);
    return status;
}
