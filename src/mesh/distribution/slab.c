/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/distribution/slab.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "core/parallel/numbering.h"

void ost_slab_destroy(Slab **slab)
{
    if (!*slab)
        return;
    OST_FREE((*slab)->ghost_number, (*slab)->tet_nodes);
    ost_halo_destroy(&(*slab)->halo);
    OST_FREE(*slab);
}

static int is_mine(const Slab *slab, OstGlobal node)
{
    return node >= slab->first_node && node < slab->first_node + slab->node_count;
}

OstLocal ost_slab_local(const Slab *slab, OstGlobal node)
{
    if (is_mine(slab, node))
        return (OstLocal)(node - slab->first_node);
    return slab->node_count + ost_numbers_find(slab->ghost_count, slab->ghost_number, node);
}

static OstStatus add_ghosts(const Slab *slab, size_t count, const OstGlobal *nodes, OstNumberSet *ghosts)
{
    for (size_t i = 0; i < count; i++)
        if (!is_mine(slab, nodes[i]))
            OST_TRY(ost_number_set_add(slab->ctx, ghosts, nodes[i]));
    return OST_SUCCESS;
}

/* `chunk` is NULL where there are no boundaries. */
static OstStatus find_ghosts(const OstMeshChunk *chunk, size_t entries, const OstGlobal *tet_nodes, Slab *slab)
{
    OstNumberSet ghosts = {0};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(add_ghosts(slab, entries, tet_nodes, &ghosts));
    for (int b = 0; chunk && b < chunk->boundary_count; b++) {
        const OstBoundary *boundary = &chunk->boundaries[b];
        OST_TRY_DONE(
            add_ghosts(slab, (size_t)boundary->count * (size_t)boundary->nodes_per_item, boundary->nodes, &ghosts));
    }
    ost_number_set_close(&ghosts);
    slab->ghost_count = ghosts.count;
    slab->ghost_number = ghosts.number;
    return OST_SUCCESS;
done:
    ost_number_set_clear(&ghosts);
    return status;
}

static OstStatus number_locally(const OstMeshChunk *chunk, const OstGlobal *tet_nodes, Slab *slab)
{
    const size_t entries = (size_t)slab->tet_count * (size_t)slab->nodes_per_tet;
    OST_TRY(find_ghosts(chunk, entries, tet_nodes, slab));
    if ((OstGlobal)slab->node_count + slab->ghost_count > INT32_MAX)
        return OST_RAISE(slab->ctx, OST_LIMIT_EXCEEDED,
                         "a rank would hold more than %d nodes before partition; use more ranks", INT32_MAX);
    OST_TRY(OST_NEW(slab->ctx, &slab->tet_nodes, entries));
    for (size_t i = 0; i < entries; i++)
        slab->tet_nodes[i] = ost_slab_local(slab, tet_nodes[i]);
    return OST_SUCCESS;
}

/* Makes the arrays of a slab whose counts are known, from the global numbers of its tets' nodes. */
static OstStatus complete(const OstMeshChunk *chunk, const OstGlobal *tet_nodes, Slab *slab)
{
    OST_TRY(ost_agree(slab->ctx, number_locally(chunk, tet_nodes, slab)));
    return ost_halo_create(slab->ctx, slab->node_count, slab->first_node, slab->ghost_count, slab->ghost_number,
                           &slab->halo);
}

OstStatus ost_slab_create(const OstMeshChunk *chunk, Slab **slab)
{
    OstContext *ctx = chunk->ctx;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, slab, 1)));
    **slab = (Slab){.ctx = ctx,
                    .global_nodes = chunk->global_nodes,
                    .first_node = chunk->first_node,
                    .node_count = chunk->node_count,
                    .nodes_per_tet = chunk->nodes_per_tet,
                    .tet_count = chunk->tet_count};
    return complete(chunk, chunk->tet_nodes, *slab);
}

/* Sends each tet to the ranks that get nodes of it, with their new numbers. */
static OstStatus send_tets(const Slab *slab, const int *to, const OstGlobal *number, Slab *moved, OstGlobal **nodes)
{
    OstContext *ctx = slab->ctx;
    const size_t width = (size_t)slab->nodes_per_tet;
    const size_t entries = (size_t)slab->tet_count * width;
    int *rank = NULL;
    OstGlobal *sent = NULL;
    OstRoute *route = NULL;
    OstStatus status = OST_NEW(ctx, &rank, entries);
    OST_THEN(OST_NEW(ctx, &sent, entries));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (size_t i = 0; i < entries; i++) {
        rank[i] = to[slab->tet_nodes[i]];
        sent[i] = number[slab->tet_nodes[i]];
    }
    OST_TRY_DONE(ost_route_create(ctx, slab->tet_count, slab->nodes_per_tet, rank, &route));
    OST_TRY_DONE(ost_route_carry(route, width * sizeof *sent, sent, (void **)nodes));
    moved->tet_count = route->receives;
done:
    OST_FREE(rank, sent);
    ost_route_destroy(&route);
    return status;
}

/* New global numbers of the old slab's nodes and ghosts: in the order in which they arrive. */
static OstStatus number_anew(const Slab *slab, const OstRoute *route, Slab *moved, OstGlobal *number)
{
    OstContext *ctx = slab->ctx;
    OstGlobal *arrived = NULL;
    OST_TRY(ost_number_from(ctx, moved->node_count, &moved->first_node, &moved->global_nodes));
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &arrived, moved->node_count)));
    for (OstLocal i = 0; i < moved->node_count; i++)
        arrived[i] = moved->first_node + i;
    OstStatus status = ost_route_answer(route, sizeof *number, arrived, number);
    OST_THEN(ost_halo_import(slab->halo, sizeof *number, number));
    OST_FREE(arrived);
    return status;
}

OstStatus ost_slab_move(const Slab *slab, const OstRoute *route, const int *to, Slab **moved)
{
    OstContext *ctx = slab->ctx;
    OstGlobal *number = NULL, *nodes = NULL;
    OstStatus status = OST_NEW(ctx, moved, 1);
    OST_THEN(OST_NEW(ctx, &number, (size_t)slab->node_count + (size_t)slab->ghost_count));
    OST_TRY_DONE(ost_agree(ctx, status));
    **moved = (Slab){.ctx = ctx, .node_count = route->receives, .nodes_per_tet = slab->nodes_per_tet};
    OST_TRY_DONE(number_anew(slab, route, *moved, number));
    OST_TRY_DONE(send_tets(slab, to, number, *moved, &nodes));
    OST_TRY_DONE(complete(NULL, nodes, *moved));
done:
    OST_FREE(number, nodes);
    return status;
}
