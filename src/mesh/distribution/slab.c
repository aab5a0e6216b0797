/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/distribution/slab.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "core/parallel/numbering.h"
#include "core/parallel/route.h"

void ost_slab_destroy(Slab **slab)
{
    if (!*slab)
        return;
    OST_FREE((*slab)->ghost_number);
    OST_FREE((*slab)->tet_nodes);
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

/* Sends each tet to the other ranks that have nodes of it; receives the global node numbers of this rank's ghost tets.
 */
static OstStatus exchange_ghost_tets(const OstMeshChunk *chunk, const Slab *slab, OstLocal *count, OstGlobal **nodes)
{
    OstContext *ctx = chunk->ctx;
    const size_t width = (size_t)chunk->nodes_per_tet;
    OstGlobal *end = NULL;
    int *to = NULL;
    OstRoute *route = NULL;
    OstStatus status = OST_NEW(ctx, &end, ost_size(ctx));
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &to, (size_t)chunk->tet_count * width);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_number_ends(ctx, chunk->first_node + chunk->node_count, end));
    for (size_t i = 0; i < (size_t)chunk->tet_count * width; i++)
        to[i] = is_mine(slab, chunk->tet_nodes[i]) ? -1 : ost_number_holder(end, ost_size(ctx), chunk->tet_nodes[i]);
    OST_TRY_DONE(ost_route_create(ctx, chunk->tet_count, chunk->nodes_per_tet, to, &route));
    OST_TRY_DONE(ost_route_carry(route, width * sizeof(OstGlobal), chunk->tet_nodes, (void **)nodes));
    *count = route->receives;
done:
    OST_FREE(end);
    OST_FREE(to);
    ost_route_destroy(&route);
    return status;
}

static OstStatus add_ghosts(const Slab *slab, size_t count, const OstGlobal *nodes, OstNumberSet *ghosts)
{
    for (size_t i = 0; i < count; i++)
        if (!is_mine(slab, nodes[i]))
            OST_TRY(ost_number_set_add(slab->ctx, ghosts, nodes[i]));
    return OST_SUCCESS;
}

static OstStatus find_ghosts(const OstMeshChunk *chunk, Slab *slab, OstLocal ghost_tets,
                             const OstGlobal *ghost_tet_nodes)
{
    const size_t width = (size_t)chunk->nodes_per_tet;
    OstNumberSet ghosts = {0};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(add_ghosts(slab, (size_t)chunk->tet_count * width, chunk->tet_nodes, &ghosts));
    OST_TRY_DONE(add_ghosts(slab, (size_t)ghost_tets * width, ghost_tet_nodes, &ghosts));
    for (int b = 0; b < chunk->boundary_count; b++) {
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

static OstStatus number_locally(const OstMeshChunk *chunk, Slab *slab, OstLocal ghost_tets,
                                const OstGlobal *ghost_tet_nodes)
{
    const size_t width = (size_t)chunk->nodes_per_tet;
    const size_t own = (size_t)chunk->tet_count * width;
    if ((OstGlobal)chunk->tet_count + ghost_tets > INT32_MAX ||
        (OstGlobal)chunk->node_count + slab->ghost_count > INT32_MAX)
        return OST_RAISE(slab->ctx, OST_LIMIT_EXCEEDED,
                         "a rank would hold more than %d tets or nodes before partition; use more ranks", INT32_MAX);
    slab->tet_count = chunk->tet_count + ghost_tets;
    OST_TRY(OST_NEW(slab->ctx, &slab->tet_nodes, (size_t)slab->tet_count * width));
    for (size_t i = 0; i < own; i++)
        slab->tet_nodes[i] = ost_slab_local(slab, chunk->tet_nodes[i]);
    for (size_t i = 0; i < (size_t)ghost_tets * width; i++)
        slab->tet_nodes[own + i] = ost_slab_local(slab, ghost_tet_nodes[i]);
    return OST_SUCCESS;
}

OstStatus ost_slab_create(const OstMeshChunk *chunk, Slab **slab)
{
    OstContext *ctx = chunk->ctx;
    OstGlobal *ghost_tet_nodes = NULL;
    OstLocal ghost_tets = 0;
    Slab *made = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &made, 1)));
    made->ctx = ctx;
    made->global_nodes = chunk->global_nodes;
    made->first_node = chunk->first_node;
    made->node_count = chunk->node_count;
    made->nodes_per_tet = chunk->nodes_per_tet;
    OST_TRY_DONE(exchange_ghost_tets(chunk, made, &ghost_tets, &ghost_tet_nodes));
    status = find_ghosts(chunk, made, ghost_tets, ghost_tet_nodes);
    if (status == OST_SUCCESS)
        status = number_locally(chunk, made, ghost_tets, ghost_tet_nodes);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(
        ost_halo_create(ctx, made->node_count, made->first_node, made->ghost_count, made->ghost_number, &made->halo));
done:
    OST_FREE(ghost_tet_nodes);
    if (status != OST_SUCCESS)
        ost_slab_destroy(&made);
    *slab = made;
    return status;
}
