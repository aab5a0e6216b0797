/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "core/parallel/halo.h"
#include "core/parallel/numbering.h"
#include "core/parallel/reduce.h"
#include "core/parallel/route.h"
#include "core/small.h"
#include "mesh/check/check.h"
#include "mesh/coincident.h"
#include "mesh/distribution/share.h"
#include "mesh/distribution/slab.h"

#include <float.h>
#include <string.h>

typedef struct Merge {
    OstMeshChunk *chunk;
    OstPoints points;
    Slab *slab;
    OstGlobal *lowest; /* of this rank's vertices: see ost_coincident_find */
    OstGlobal *number; /* new numbers, of the slab's nodes and ghosts */
    OstGlobal new_first, new_total;
} Merge;

/* The shortest edge, and the lowest label of a tet with it. */
static OstStatus find_shortest_edge(const Merge *merge, double *shortest, OstGlobal *label)
{
    const OstMeshChunk *chunk = merge->chunk;
    const Slab *slab = merge->slab;
    OstContext *ctx = chunk->ctx;
    double *x = NULL;
    double mine = DBL_MAX;
    OstGlobal at = INT64_MAX;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &x, 3 * ((size_t)slab->node_count + (size_t)slab->ghost_count)));
    if (status != OST_SUCCESS)
        goto done;
    if (chunk->node_count > 0)
        memcpy(x, chunk->coordinates, 3 * (size_t)chunk->node_count * sizeof *x);
    OST_TRY_DONE(ost_agree(ctx, ost_halo_import(slab->halo, 3 * sizeof *x, x)));
    for (OstLocal t = 0; t < chunk->tet_count; t++) {
        const OstLocal *nodes = slab->tet_nodes + (size_t)t * (size_t)chunk->nodes_per_tet;
        for (int e = 0; e < 6; e++) {
            const double *a = x + 3 * (size_t)nodes[ost_tet_edge[e][0]];
            const double *b = x + 3 * (size_t)nodes[ost_tet_edge[e][1]];
            const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
            if (ost_norm3(d) >= mine)
                continue;
            mine = ost_norm3(d);
            at = chunk->tet_label ? chunk->tet_label[t] : chunk->first_tet + t + 1;
        }
    }
    *shortest = mine;
    OST_TRY_DONE(ost_min(ctx, 1, shortest));
    *label = mine > *shortest ? INT64_MAX : at;
    OST_TRY_DONE(ost_min_numbers(ctx, 1, label));
done:
    OST_FREE(x);
    return status;
}

static OstStatus check_tolerance(const Merge *merge, double tolerance)
{
    double shortest = 0.0;
    OstGlobal label = 0;
    OST_TRY(find_shortest_edge(merge, &shortest, &label));
    if (tolerance < shortest)
        return OST_SUCCESS;
    if (shortest == 0.0)
        return OST_RAISE(
            merge->chunk->ctx, OST_INVALID_INPUT,
            "merge: two nodes of tet %lld lie in one place; give both corners the same node in the mesh file",
            (long long)label);
    return OST_RAISE(
        merge->chunk->ctx, OST_INVALID_INPUT,
        "merge: %g would join vertices of tet %lld, which has an edge of length %g; give a smaller distance", tolerance,
        (long long)label, shortest);
}

/* Numbers the vertices that stay, contiguously over ranks. */
static OstStatus number_kept(Merge *merge)
{
    OstContext *ctx = merge->chunk->ctx;
    OstGlobal kept = 0;
    for (OstLocal i = 0; i < merge->points.count; i++)
        kept += merge->lowest[i] == merge->points.first + i;
    OST_TRY(ost_number_from(ctx, kept, &merge->new_first, &merge->new_total));
    OstGlobal next = merge->new_first;
    for (OstLocal i = 0; i < merge->points.count; i++)
        merge->number[i] = merge->lowest[i] == merge->points.first + i ? next++ : -1;
    return OST_SUCCESS;
}

/* Gets the new numbers of the vertices `asked` for from the ranks that have them; -1 for a vertex that is removed. */
static OstStatus ask_holders(const Merge *merge, OstLocal count, const OstGlobal *asked, OstGlobal *number)
{
    OstContext *ctx = merge->chunk->ctx;
    OstGlobal *end = NULL, *arrived = NULL;
    int *to = NULL;
    OstRoute *route = NULL;
    OstStatus status = OST_NEW(ctx, &end, ost_size(ctx));
    OST_THEN(OST_NEW(ctx, &to, count));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_number_ends(ctx, merge->points.first + merge->points.count, end));
    for (OstLocal i = 0; i < count; i++)
        to[i] = ost_number_holder(end, ost_size(ctx), asked[i]);
    OST_TRY_DONE(ost_route_create(ctx, count, 1, to, &route));
    OST_TRY_DONE(ost_route_carry(route, sizeof *asked, asked, (void **)&arrived));
    for (OstLocal i = 0; i < route->receives; i++)
        arrived[i] = merge->number[arrived[i] - merge->points.first];
    OST_TRY_DONE(ost_route_answer(route, sizeof *number, arrived, number));
done:
    OST_FREE(end, arrived, to);
    ost_route_destroy(&route);
    return status;
}

static OstStatus raise_chain(const Merge *merge, OstLocal local, double tolerance)
{
    const OstMeshChunk *chunk = merge->chunk;
    return OST_RAISE(
        chunk->ctx, OST_INVALID_INPUT,
        "merge: %g joins vertex %lld with one that is joined with another, farther off; give a smaller distance",
        tolerance, (long long)(chunk->node_label ? chunk->node_label[local] : merge->points.first + local + 1));
}

/* Gives each removed vertex the number of the vertex that replaces it, which may be on another rank. */
static OstStatus number_merged(Merge *merge, double tolerance)
{
    OstContext *ctx = merge->chunk->ctx;
    OstGlobal *asked = NULL, *number = NULL;
    OstLocal count = 0;
    OstStatus status = OST_NEW(ctx, &asked, merge->points.count);
    OST_THEN(OST_NEW(ctx, &number, merge->points.count));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (OstLocal i = 0; i < merge->points.count; i++)
        if (merge->number[i] < 0)
            asked[count++] = merge->lowest[i];
    OST_TRY_DONE(ask_holders(merge, count, asked, number));
    count = 0;
    for (OstLocal i = 0; i < merge->points.count && status == OST_SUCCESS; i++)
        if (merge->number[i] < 0) {
            merge->number[i] = number[count++];
            if (merge->number[i] < 0)
                status = raise_chain(merge, i, tolerance);
        }
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_agree(ctx, ost_halo_import(merge->slab->halo, sizeof *merge->number, merge->number)));
done:
    OST_FREE(asked, number);
    return status;
}

static void renumber(const Merge *merge, size_t count, OstGlobal *nodes)
{
    for (size_t i = 0; i < count; i++)
        nodes[i] = merge->number[ost_slab_local(merge->slab, nodes[i])];
}

static void renumber_all(const Merge *merge)
{
    OstMeshChunk *chunk = merge->chunk;
    renumber(merge, (size_t)chunk->tet_count * (size_t)chunk->nodes_per_tet, chunk->tet_nodes);
    for (int b = 0; b < chunk->boundary_count; b++) {
        OstBoundary *boundary = &chunk->boundaries[b];
        renumber(merge, (size_t)boundary->count * (size_t)boundary->nodes_per_item, boundary->nodes);
        if (boundary->dimension == 0)
            boundary->count = ost_numbers_sort(boundary->count, boundary->nodes);
    }
}

static void drop_merged(Merge *merge)
{
    OstMeshChunk *chunk = merge->chunk;
    OstLocal kept = 0;
    for (OstLocal i = 0; i < chunk->node_count; i++) {
        if (merge->lowest[i] != chunk->first_node + i)
            continue;
        memmove(chunk->coordinates + 3 * (size_t)kept, chunk->coordinates + 3 * (size_t)i, 3 * sizeof(double));
        chunk->node_label[kept++] = chunk->node_label[i];
    }
    chunk->node_count = kept;
    chunk->first_node = merge->new_first;
}

static OstStatus merge_vertices(Merge *merge, double tolerance, OstGlobal *merged)
{
    OstMeshChunk *chunk = merge->chunk;
    OstContext *ctx = chunk->ctx;
    OST_TRY(ost_slab_create(chunk, &merge->slab));
    OST_TRY(check_tolerance(merge, tolerance));
    OstStatus status = OST_NEW(ctx, &merge->lowest, chunk->node_count);
    OST_THEN(OST_NEW(ctx, &merge->number, (size_t)merge->slab->node_count + (size_t)merge->slab->ghost_count));
    OST_THEN(ost_chunk_label_nodes(chunk));
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(ost_coincident_find(&merge->points, tolerance, merge->lowest));
    OST_TRY(number_kept(merge));
    OST_TRY(number_merged(merge, tolerance));
    renumber_all(merge);
    drop_merged(merge);
    *merged = chunk->global_nodes - merge->new_total;
    chunk->global_nodes = merge->new_total;
    return OST_SUCCESS;
}

OstStatus ost_chunk_merge(OstMeshChunk *chunk, double tolerance, OstGlobal *merged)
{
    *merged = 0;
    ost_ledger_enter(chunk->ctx, OST_LEDGER_MESH);
    OstStatus status = ost_check_chunk(chunk);
    Merge merge = {.chunk = chunk, .points = {chunk->ctx, chunk->first_node, chunk->node_count, chunk->coordinates}};
    OST_THEN(merge_vertices(&merge, tolerance, merged));
    OST_FREE(merge.lowest, merge.number);
    ost_slab_destroy(&merge.slab);
    ost_ledger_leave(chunk->ctx);
    return status;
}
