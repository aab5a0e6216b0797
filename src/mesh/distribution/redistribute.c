/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "core/parallel/reduce.h"
#include "core/parallel/route.h"
#include "mesh/distribution/partition.h"

#include <string.h>

/* New global numbers of the slab's nodes: part after part, each in the old order. */
static OstStatus number_nodes(const Slab *slab, const int *part, OstGlobal *number, OstGlobal *my_first)
{
    OstContext *ctx = slab->ctx;
    const int size = ost_size(ctx);
    OstGlobal *mine = NULL; /* per part: this rank's nodes in it, those of the ranks before, those of all */
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &mine, 3 * (size_t)size)));
    OstGlobal *before = mine + size;
    OstGlobal *total = before + size;
    OstStatus status = OST_SUCCESS;
    for (OstLocal i = 0; i < slab->node_count; i++)
        mine[part[i]]++;
    OST_TRY_DONE(OST_MPI(ctx, MPI_Exscan(mine, before, size, MPI_INT64_T, MPI_SUM, ost_comm(ctx))));
    OST_TRY_DONE(OST_MPI(ctx, MPI_Allreduce(mine, total, size, MPI_INT64_T, MPI_SUM, ost_comm(ctx))));
    if (ost_rank(ctx) == 0)
        memset(before, 0, (size_t)size * sizeof *before);
    OstGlobal first = 0;
    for (int p = 0; p < size; p++) {
        if (p == ost_rank(ctx))
            *my_first = first;
        before[p] += first;
        first += total[p];
    }
    for (OstLocal i = 0; i < slab->node_count; i++)
        number[i] = before[part[i]]++;
    OST_TRY_DONE(ost_halo_import(slab->halo, sizeof *number, number));
done:
    OST_FREE(mine);
    return status;
}

static OstStatus send_nodes(OstMeshChunk *chunk, const int *part, OstMesh *mesh)
{
    OstContext *ctx = chunk->ctx;
    OstRoute *route = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_route_create(ctx, chunk->node_count, 1, part, &route));
    OST_TRY_DONE(ost_route_carry(route, 3 * sizeof(double), chunk->coordinates, (void **)&mesh->coordinates));
    OST_FREE(chunk->coordinates);
    OST_TRY_DONE(ost_route_carry(route, sizeof(OstGlobal), chunk->node_label, (void **)&mesh->node_label));
    OST_FREE(chunk->node_label);
    mesh->owned_nodes = route->receives;
done:
    ost_route_destroy(&route);
    return status;
}

/* The mesh has axes if any rank has: after a serial read, the other ranks have neither tets nor axes. */
static OstStatus has_axes(const OstMeshChunk *chunk, int *axes)
{
    *axes = chunk->tet_axes != NULL;
    OST_TRY(ost_max_ints(chunk->ctx, 1, axes));
    OstStatus status = OST_SUCCESS;
    if (*axes && !chunk->tet_axes && chunk->tet_count > 0)
        status = OST_RAISE(chunk->ctx, OST_INVALID_INPUT, "tets %lld and on come without axes, but others have them",
                           (long long)chunk->tet_label[0]);
    return ost_agree(chunk->ctx, status);
}

/* Carries the tets' arrays; `nodes` receives their nodes by new global number. */
static OstStatus carry_tets(OstMeshChunk *chunk, const OstRoute *route, OstMesh *mesh, OstGlobal **nodes)
{
    int axes = 0;
    OST_TRY(has_axes(chunk, &axes));
    OST_TRY(ost_route_carry(route, (size_t)chunk->nodes_per_tet * sizeof(OstGlobal), chunk->tet_nodes, (void **)nodes));
    OST_FREE(chunk->tet_nodes);
    OST_TRY(ost_route_carry(route, sizeof(OstGlobal), chunk->tet_label, (void **)&mesh->tet_label));
    OST_FREE(chunk->tet_label);
    OST_TRY(ost_route_carry(route, sizeof(int32_t), chunk->tet_region, (void **)&mesh->tet_region));
    OST_FREE(chunk->tet_region);
    if (axes)
        OST_TRY(ost_route_carry(route, 9 * sizeof(double), chunk->tet_axes, (void **)&mesh->tet_axes));
    OST_FREE(chunk->tet_axes);
    const size_t field = (size_t)ost_tet_fields_width(&mesh->fields);
    if (field > 0)
        OST_TRY(ost_route_carry(route, field * sizeof(double), chunk->tet_field, (void **)&mesh->tet_field));
    OST_FREE(chunk->tet_field);
    mesh->tet_count = route->receives;
    return OST_SUCCESS;
}

static OstStatus send_tets(OstMeshChunk *chunk, const Slab *slab, const int *part, const OstGlobal *number,
                           OstMesh *mesh, OstGlobal **nodes)
{
    OstContext *ctx = chunk->ctx;
    const size_t entries = (size_t)chunk->tet_count * (size_t)chunk->nodes_per_tet;
    int *to = NULL;
    OstRoute *route = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &to, entries)));
    for (size_t i = 0; i < entries; i++) {
        to[i] = part[slab->tet_nodes[i]];
        chunk->tet_nodes[i] = number[slab->tet_nodes[i]];
    }
    OST_TRY_DONE(ost_route_create(ctx, chunk->tet_count, chunk->nodes_per_tet, to, &route));
    OST_FREE(to);
    OST_TRY_DONE(carry_tets(chunk, route, mesh, nodes));
done:
    OST_FREE(to);
    ost_route_destroy(&route);
    return status;
}

static int is_owned_number(const OstMesh *mesh, OstGlobal number)
{
    return number >= mesh->first_node && number < mesh->first_node + mesh->owned_nodes;
}

static int owns_tet(const OstMesh *mesh, const OstGlobal *nodes)
{
    OstGlobal lowest = nodes[0];
    for (int v = 1; v < mesh->nodes_per_tet; v++)
        if (nodes[v] < lowest)
            lowest = nodes[v];
    return is_owned_number(mesh, lowest);
}

/* Replaces an array by its items in another order. */
static OstStatus reorder(OstContext *ctx, OstLocal count, const OstLocal *order, size_t size, void **array)
{
    char *ordered = NULL;
    OST_TRY(ost_allocate(ctx, (size_t)count, size, (void **)&ordered));
    for (OstLocal i = 0; i < count; i++)
        memcpy(ordered + (size_t)i * size, (const char *)*array + (size_t)order[i] * size, size);
    OST_FREE(*array);
    *array = ordered;
    return OST_SUCCESS;
}

static OstStatus put_owned_tets_first(OstMesh *mesh, OstGlobal **nodes)
{
    OstContext *ctx = mesh->ctx;
    const OstLocal count = mesh->tet_count;
    const size_t width = (size_t)mesh->nodes_per_tet;
    OstLocal *order = NULL;
    OstLocal next = 0;
    OST_TRY(OST_NEW(ctx, &order, count));
    for (int owned = 1; owned >= 0; owned--) {
        for (OstLocal t = 0; t < count; t++)
            if (owns_tet(mesh, *nodes + (size_t)t * width) == owned)
                order[next++] = t;
        if (owned)
            mesh->owned_tets = next;
    }
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(reorder(ctx, count, order, width * sizeof(OstGlobal), (void **)nodes));
    OST_TRY_DONE(reorder(ctx, count, order, sizeof(OstGlobal), (void **)&mesh->tet_label));
    OST_TRY_DONE(reorder(ctx, count, order, sizeof(int32_t), (void **)&mesh->tet_region));
    if (mesh->tet_axes)
        OST_TRY_DONE(reorder(ctx, count, order, 9 * sizeof(double), (void **)&mesh->tet_axes));
    if (mesh->tet_field)
        OST_TRY_DONE(reorder(ctx, count, order, (size_t)ost_tet_fields_width(&mesh->fields) * sizeof(double),
                             (void **)&mesh->tet_field));
done:
    OST_FREE(order);
    return status;
}

/* The tets' nodes that are not owned become ghosts. Ascending numbers are grouped by owner, as the halo needs them. */
static OstStatus number_ghosts(OstMesh *mesh, const OstGlobal *nodes)
{
    const size_t entries = (size_t)mesh->tet_count * (size_t)mesh->nodes_per_tet;
    OstNumberSet ghosts = {0};
    OstStatus status = OST_SUCCESS;
    for (size_t i = 0; i < entries; i++)
        if (!is_owned_number(mesh, nodes[i]))
            OST_TRY_DONE(ost_number_set_add(mesh->ctx, &ghosts, nodes[i]));
    ost_number_set_close(&ghosts);
    if (mesh->owned_nodes + (OstGlobal)ghosts.count > INT32_MAX)
        OST_TRY_DONE(OST_RAISE(mesh->ctx, OST_LIMIT_EXCEEDED, "a rank would hold more than %d nodes; use more ranks",
                               INT32_MAX));
    mesh->node_count = mesh->owned_nodes + ghosts.count;
    OST_TRY_DONE(OST_NEW(mesh->ctx, &mesh->node_number, mesh->node_count));
    for (OstLocal i = 0; i < mesh->owned_nodes; i++)
        mesh->node_number[i] = mesh->first_node + i;
    if (ghosts.count > 0)
        memcpy(mesh->node_number + mesh->owned_nodes, ghosts.number, (size_t)ghosts.count * sizeof(OstGlobal));
done:
    ost_number_set_clear(&ghosts);
    return status;
}

static OstStatus number_locally(OstMesh *mesh, OstGlobal **nodes)
{
    const size_t entries = (size_t)mesh->tet_count * (size_t)mesh->nodes_per_tet;
    OST_TRY(put_owned_tets_first(mesh, nodes));
    OST_TRY(number_ghosts(mesh, *nodes));
    OST_TRY(OST_NEW(mesh->ctx, &mesh->tet_nodes, entries));
    for (size_t i = 0; i < entries; i++)
        mesh->tet_nodes[i] = ost_mesh_local(mesh, (*nodes)[i]);
    OST_TRY(OST_RESIZE(mesh->ctx, &mesh->coordinates, 3 * (size_t)mesh->node_count));
    return OST_RESIZE(mesh->ctx, &mesh->node_label, mesh->node_count);
}

/* From new global numbers to local ones. If a node is not here, no tet has all nodes of the item. */
static OstStatus number_items(OstBoundary *boundary, const OstMesh *mesh)
{
    const size_t width = (size_t)boundary->nodes_per_item;
    for (size_t i = 0; i < (size_t)boundary->count * width; i++) {
        const OstLocal local = ost_mesh_local(mesh, boundary->nodes[i]);
        if (local < 0)
            return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                             "boundary '%s' has a %s that is no %s of any tet; remove it or mesh the body with it",
                             boundary->name, boundary->dimension == 1 ? "curve" : "face",
                             boundary->dimension == 1 ? "edge" : "face");
        boundary->nodes[i] = local;
    }
    return OST_SUCCESS;
}

/* Collective. Moves one boundary's items to the ranks that own their nodes, and turns these into the mesh's local
 * numbers. `number`: new global numbers of the slab's nodes and ghosts. */
static OstStatus redistribute_boundary(OstBoundary *boundary, const Slab *slab, const int *part,
                                       const OstGlobal *number, const OstMesh *mesh)
{
    OstContext *ctx = mesh->ctx;
    const size_t width = (size_t)boundary->nodes_per_item;
    const size_t entries = (size_t)boundary->count * width;
    int *to = NULL;
    OstRoute *route = NULL;
    OstGlobal *arrived = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &to, entries)));
    for (size_t i = 0; i < entries; i++) {
        const OstLocal local = ost_slab_local(slab, boundary->nodes[i]);
        to[i] = part[local];
        boundary->nodes[i] = number[local];
    }
    OST_TRY_DONE(ost_route_create(ctx, boundary->count, boundary->nodes_per_item, to, &route));
    OST_TRY_DONE(ost_route_carry(route, width * sizeof(OstGlobal), boundary->nodes, (void **)&arrived));
    OST_FREE(boundary->nodes);
    boundary->nodes = arrived;
    boundary->count = route->receives;
    OST_TRY_DONE(ost_agree(ctx, number_items(boundary, mesh)));
done:
    OST_FREE(to);
    ost_route_destroy(&route);
    return status;
}

OstStatus ost_mesh_redistribute(OstMeshChunk *chunk, const Slab *slab, const int *part, OstMesh *mesh)
{
    OstContext *ctx = chunk->ctx;
    OstGlobal *number = NULL;
    OstGlobal *nodes = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &number, (size_t)slab->node_count + (size_t)slab->ghost_count)));
    OST_TRY_DONE(number_nodes(slab, part, number, &mesh->first_node));
    OST_TRY_DONE(send_nodes(chunk, part, mesh));
    OST_TRY_DONE(send_tets(chunk, slab, part, number, mesh, &nodes));
    OST_TRY_DONE(ost_agree(ctx, number_locally(mesh, &nodes)));
    OST_FREE(nodes);
    OST_TRY_DONE(ost_mesh_connect(mesh));
    for (int b = 0; b < mesh->boundary_count; b++)
        OST_TRY_DONE(redistribute_boundary(&mesh->boundaries[b], slab, part, number, mesh));
done:
    OST_FREE(number, nodes);
    return status;
}
