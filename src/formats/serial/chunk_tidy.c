/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/serial/chunk_tidy.h"

#include "core/error.h"
#include "core/index_map.h"
#include "core/memory.h"
#include "core/small.h"
#include "formats/serial/label_index.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>

static OstStatus permute(OstContext *ctx, const OstLabelIndex *index, size_t size, void **values)
{
    char *permuted = NULL;
    OST_TRY(ost_allocate(ctx, (size_t)index->count, size, (void **)&permuted));
    for (OstGlobal i = 0; i < index->count; i++)
        memcpy(permuted + (size_t)i * size, (char *)*values + (size_t)index->sorted[i].position * size, size);
    ost_free_memory(*values);
    *values = permuted;
    return OST_SUCCESS;
}

static void number_by_position(OstMeshChunk *chunk, const char *path, OstGlobal repeated)
{
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        chunk->tet_label[t] = t + 1;
    chunk->relabelled = 1;
    chunk->of_cells = 0;
    ost_warn(chunk->ctx, "%s: element tag %" PRId64 " is given to several tets; tets are numbered from 1 as they come",
             path, repeated);
}

OstStatus ost_tets_sort(OstMeshChunk *chunk, const char *path)
{
    OstLabelIndex index = {0};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_label_index_create(chunk->ctx, chunk->tet_count, chunk->tet_label, &index));
    if (index.repeated)
        number_by_position(chunk, path, index.repeated_label);
    if (index.repeated || !index.sorted)
        goto done;
    OST_TRY_DONE(
        permute(chunk->ctx, &index, sizeof(OstGlobal) * (size_t)chunk->nodes_per_tet, (void **)&chunk->tet_nodes));
    OST_TRY_DONE(permute(chunk->ctx, &index, sizeof *chunk->tet_label, (void **)&chunk->tet_label));
    OST_TRY_DONE(permute(chunk->ctx, &index, sizeof *chunk->tet_region, (void **)&chunk->tet_region));
done:
    ost_label_index_clear(&index);
    return status;
}

static double volume(const OstMeshChunk *chunk, const OstGlobal *nodes)
{
    double edge[9];
    const double *x = chunk->coordinates;
    for (int e = 0; e < 3; e++)
        for (int d = 0; d < 3; d++)
            edge[3 * e + d] = x[3 * nodes[e + 1] + d] - x[3 * nodes[0] + d];
    return ost_determinant3(edge);
}

static void swap(OstGlobal *a, OstGlobal *b)
{
    const OstGlobal kept = *a;
    *a = *b;
    *b = kept;
}

/* Exchanges vertices 1 and 2, and so the mid-edge nodes 01 with 02 and 13 with 23. */
static void reorder(OstGlobal *nodes, int nodes_per_tet)
{
    swap(&nodes[1], &nodes[2]);
    if (nodes_per_tet == 10) {
        swap(&nodes[4], &nodes[6]);
        swap(&nodes[8], &nodes[9]);
    }
}

void ost_tets_turn(OstMeshChunk *chunk, const char *path)
{
    const size_t width = (size_t)chunk->nodes_per_tet, count = (size_t)chunk->tet_count;
    int inverted = 0;
    for (size_t t = 0; t < count; t++) {
        const double signed_volume = volume(chunk, chunk->tet_nodes + t * width);
        if (!(signed_volume <= 0.0))
            return;
        inverted |= signed_volume < 0.0;
    }
    if (!inverted)
        return;
    for (size_t t = 0; t < count; t++)
        reorder(chunk->tet_nodes + t * width, chunk->nodes_per_tet);
    ost_warn(chunk->ctx, "%s: all tets are inverted; their vertices were reordered", path);
}

OstStatus ost_tets_orient(OstMeshChunk *chunk, const char *path, OstLocal *turned)
{
    const size_t width = (size_t)chunk->nodes_per_tet;
    *turned = 0;
    if (chunk->tet_count > 0 && chunk->node_count != chunk->global_nodes)
        return OST_RAISE(chunk->ctx, OST_INVALID_INPUT, "%s: tets of this file are oriented on one rank only", path);
    for (size_t t = 0; t < (size_t)chunk->tet_count; t++)
        if (volume(chunk, chunk->tet_nodes + t * width) < 0.0) {
            reorder(chunk->tet_nodes + t * width, chunk->nodes_per_tet);
            ++*turned;
        }
    return OST_SUCCESS;
}

/* Numbers the nodes that tets use, in their order; -1 for the others. Returns how many are used. */
static OstLocal number_used(const OstMeshChunk *chunk, OstLocal *number)
{
    OstLocal used = 0;
    for (size_t i = 0; i < (size_t)chunk->tet_count * (size_t)chunk->nodes_per_tet; i++)
        number[chunk->tet_nodes[i]] = 1;
    for (OstLocal n = 0; n < chunk->node_count; n++)
        number[n] = number[n] ? used++ : -1;
    return used;
}

static void move_nodes(OstMeshChunk *chunk, const OstLocal *number)
{
    for (OstLocal n = 0; n < chunk->node_count; n++) {
        if (number[n] < 0)
            continue;
        chunk->node_label[number[n]] = chunk->node_label[n];
        for (int d = 0; d < 3; d++)
            chunk->coordinates[3 * (size_t)number[n] + (size_t)d] = chunk->coordinates[3 * (size_t)n + (size_t)d];
    }
    for (size_t i = 0; i < (size_t)chunk->tet_count * (size_t)chunk->nodes_per_tet; i++)
        chunk->tet_nodes[i] = number[chunk->tet_nodes[i]];
}

/* Returns the number of items left out. */
static OstLocal move_items(OstBoundary *boundary, const OstLocal *number)
{
    const OstLocal before = boundary->count;
    const size_t width = (size_t)boundary->nodes_per_item;
    boundary->count = 0;
    for (OstLocal i = 0; i < before; i++) {
        const OstGlobal *from = boundary->nodes + (size_t)i * width;
        OstGlobal *to = boundary->nodes + (size_t)boundary->count * width;
        size_t used = 0;
        for (; used < width && number[from[used]] >= 0; used++)
            to[used] = number[from[used]];
        boundary->count += used == width;
    }
    return before - boundary->count;
}

static void key_of(const OstMeshChunk *chunk, OstLocal node, OstGlobal key[3])
{
    double place[3];
    for (int d = 0; d < 3; d++)
        place[d] = chunk->coordinates[3 * (size_t)node + (size_t)d] + 0.0; /* -0 becomes 0 */
    memcpy(key, place, sizeof place);
}

/* Shells and sets may have nodes of their own at the very places of the tets'. Finds the number of the one that a tet
 * has there; -1 where there is none, or more than one. */
static OstStatus find_twins(const OstMeshChunk *chunk, const OstLocal *number, OstLocal *twin)
{
    OstIndex *index = NULL;
    OstLocal *at = NULL; /* of each place */
    OstGlobal key[3];
    OstStatus status = ost_index_create(chunk->ctx, 3, &index);
    OST_THEN(OST_NEW(chunk->ctx, &at, chunk->node_count));
    for (OstLocal n = 0; n < chunk->node_count && status == OST_SUCCESS; n++) {
        OstLocal k = 0;
        if (number[n] < 0)
            continue;
        const OstLocal known = index->count;
        key_of(chunk, n, key);
        status = ost_index_place(index, key, &k);
        at[k] = k == known ? number[n] : -1;
    }
    for (OstLocal n = 0; n < chunk->node_count && status == OST_SUCCESS; n++) {
        key_of(chunk, n, key);
        const OstLocal k = number[n] < 0 ? ost_index_find(index, key) : -1;
        twin[n] = k >= 0 ? at[k] : -1;
    }
    ost_index_destroy(&index);
    OST_FREE(at);
    return status;
}

OstStatus ost_nodes_leave_out(OstMeshChunk *chunk, const char *path)
{
    OstLocal *number = NULL, *twin = NULL;
    const OstLocal all = chunk->node_count;
    char more[80] = "";
    OstGlobal items = 0;
    OstStatus status = OST_NEW(chunk->ctx, &number, all);
    OST_THEN(OST_NEW(chunk->ctx, &twin, all));
    const OstLocal used = status == OST_SUCCESS ? number_used(chunk, number) : all;
    if (used < all)
        OST_THEN(find_twins(chunk, number, twin));
    if (status != OST_SUCCESS)
        goto done;
    move_nodes(chunk, number);
    for (OstLocal n = 0; n < all; n++)
        number[n] = number[n] < 0 ? twin[n] : number[n];
    for (int b = 0; b < chunk->boundary_count; b++)
        items += move_items(&chunk->boundaries[b], number);
    chunk->global_nodes = chunk->node_count = used;
    if (items > 0)
        snprintf(more, sizeof more, ", and %" PRId64 " points, curves and faces of boundaries with them", items);
    if (used < all)
        ost_warn(chunk->ctx, "%s: %d %s used by no tet and left out%s", path, all - used,
                 all - used == 1 ? "vertex is" : "vertices are", more);
done:
    OST_FREE(number, twin);
    return status;
}
