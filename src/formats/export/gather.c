/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/route.h"
#include "formats/export/export.h"
#include "formats/serial/label_index.h"

#include <stdlib.h>
#include <string.h>

/* Items of this rank, which all go to rank 0. */
static OstStatus route_to_first(OstContext *ctx, OstLocal count, OstRoute **route)
{
    int *to = NULL;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &to, count)); /* zeros */
    OST_THEN(ost_route_create(ctx, count, 1, to, route));
    OST_FREE(to);
    return status;
}

static OstStatus gather_nodes(const OstMesh *mesh, OstMeshChunk *whole)
{
    OstRoute *route = NULL;
    OstStatus status = route_to_first(mesh->ctx, mesh->owned_nodes, &route);
    OST_THEN(ost_route_carry(route, 3 * sizeof(double), mesh->coordinates, (void **)&whole->coordinates));
    OST_THEN(ost_route_carry(route, sizeof(OstGlobal), mesh->node_label, (void **)&whole->node_label));
    if (status == OST_SUCCESS)
        whole->node_count = route->receives;
    ost_route_destroy(&route);
    return status;
}

static OstStatus gather_tets(const OstMesh *mesh, OstMeshChunk *whole)
{
    OstRoute *route = NULL;
    const size_t width = (size_t)mesh->nodes_per_tet, count = (size_t)mesh->owned_tets;
    OstGlobal *nodes = NULL;
    OstStatus status = ost_agree(mesh->ctx, OST_NEW(mesh->ctx, &nodes, width * count));
    for (size_t i = 0; i < width * count && status == OST_SUCCESS; i++)
        nodes[i] = mesh->node_number[mesh->tet_nodes[i]];
    OST_THEN(route_to_first(mesh->ctx, mesh->owned_tets, &route));
    OST_THEN(ost_route_carry(route, width * sizeof *nodes, nodes, (void **)&whole->tet_nodes));
    OST_THEN(ost_route_carry(route, sizeof(OstGlobal), mesh->tet_label, (void **)&whole->tet_label));
    OST_THEN(ost_route_carry(route, sizeof(int32_t), mesh->tet_region, (void **)&whole->tet_region));
    if (mesh->tet_axes)
        OST_THEN(ost_route_carry(route, 9 * sizeof(double), mesh->tet_axes, (void **)&whole->tet_axes));
    if (status == OST_SUCCESS)
        whole->tet_count = route->receives;
    ost_route_destroy(&route);
    OST_FREE(nodes);
    return status;
}

static OstStatus gather_boundary(const OstMesh *mesh, const OstBoundary *here, OstBoundary *there)
{
    OstRoute *route = NULL;
    const size_t width = (size_t)here->nodes_per_item;
    OstGlobal *nodes = NULL;
    OstLocal owned = 0;
    OstStatus status = ost_agree(mesh->ctx, OST_NEW(mesh->ctx, &nodes, width * (size_t)here->count));
    for (OstLocal i = 0; i < here->count && status == OST_SUCCESS; i++) {
        const OstGlobal *item = here->nodes + width * (size_t)i;
        if (!ost_mesh_owns(mesh, here->nodes_per_item, item))
            continue;
        for (size_t k = 0; k < width; k++)
            nodes[width * (size_t)owned + k] = mesh->node_number[item[k]];
        owned++;
    }
    OST_THEN(route_to_first(mesh->ctx, owned, &route));
    OST_THEN(ost_route_carry(route, width * sizeof *nodes, nodes, (void **)&there->nodes));
    if (status == OST_SUCCESS)
        there->count = route->receives;
    there->dimension = here->dimension;
    there->nodes_per_item = here->nodes_per_item;
    ost_route_destroy(&route);
    OST_FREE(nodes);
    return status;
}

static OstStatus copy_names(const OstMesh *mesh, OstMeshChunk *whole)
{
    for (int r = 0; r < mesh->regions.count; r++)
        OST_TRY(ost_names_add(mesh->ctx, &whole->regions, mesh->regions.name[r]));
    OST_TRY(OST_NEW(mesh->ctx, &whole->boundaries, mesh->boundary_count));
    for (whole->boundary_count = 0; whole->boundary_count < mesh->boundary_count; whole->boundary_count++)
        OST_TRY(ost_copy_string(mesh->ctx, mesh->boundaries[whole->boundary_count].name,
                                &whole->boundaries[whole->boundary_count].name));
    return OST_SUCCESS;
}

/* --- the order of labels --- */

/* The position of each item when all are in the order of their labels; and, the other way round, which item is where.
 */
static OstStatus find_order(OstContext *ctx, OstLocal count, const OstGlobal *label, OstGlobal **place,
                            OstGlobal **item)
{
    OstLabelIndex index = {0};
    OstStatus status = ost_label_index_create(ctx, count, label, &index);
    OST_THEN(OST_NEW(ctx, place, count));
    OST_THEN(OST_NEW(ctx, item, count));
    for (OstLocal i = 0; i < count && status == OST_SUCCESS; i++) {
        const OstGlobal from = index.sorted ? index.sorted[i].position : i;
        (*item)[i] = from;
        (*place)[from] = i;
    }
    ost_label_index_clear(&index);
    return status;
}

static OstStatus reorder(OstContext *ctx, OstLocal count, const OstGlobal *item, size_t size, void **values)
{
    char *ordered = NULL;
    OST_TRY(ost_allocate(ctx, (size_t)count, size, (void **)&ordered));
    for (OstLocal i = 0; i < count; i++)
        memcpy(ordered + (size_t)i * size, (char *)*values + (size_t)item[i] * size, size);
    ost_free_memory(*values);
    *values = ordered;
    return OST_SUCCESS;
}

static OstStatus order_nodes(OstMeshChunk *whole)
{
    OstContext *ctx = whole->ctx;
    OstGlobal *place = NULL, *item = NULL;
    OstStatus status = find_order(ctx, whole->node_count, whole->node_label, &place, &item);
    OST_THEN(reorder(ctx, whole->node_count, item, 3 * sizeof(double), (void **)&whole->coordinates));
    OST_THEN(reorder(ctx, whole->node_count, item, sizeof(OstGlobal), (void **)&whole->node_label));
    for (size_t i = 0; i < (size_t)whole->tet_count * (size_t)whole->nodes_per_tet && status == OST_SUCCESS; i++)
        whole->tet_nodes[i] = place[whole->tet_nodes[i]];
    for (int b = 0; b < whole->boundary_count && status == OST_SUCCESS; b++) {
        OstBoundary *boundary = &whole->boundaries[b];
        for (size_t i = 0; i < (size_t)boundary->count * (size_t)boundary->nodes_per_item; i++)
            boundary->nodes[i] = place[boundary->nodes[i]];
    }
    OST_FREE(place, item);
    return status;
}

/* By their nodes, one after the other; `width` points to how many they are. */
static int compare_items(const void *a, const void *b, void *width)
{
    const OstGlobal *x = a, *y = b;
    int k = 0;
    while (k < *(const int *)width - 1 && x[k] == y[k])
        k++;
    return (x[k] > y[k]) - (x[k] < y[k]);
}

/* The order in which ranks have them says nothing. */
static void order_items(OstMeshChunk *whole)
{
    for (int b = 0; b < whole->boundary_count; b++) {
        OstBoundary *boundary = &whole->boundaries[b];
        if (boundary->count > 0)
            qsort_r(boundary->nodes, (size_t)boundary->count,
                    (size_t)boundary->nodes_per_item * sizeof *boundary->nodes, compare_items,
                    &boundary->nodes_per_item);
    }
}

static OstStatus order_tets(OstMeshChunk *whole)
{
    OstContext *ctx = whole->ctx;
    OstGlobal *place = NULL, *item = NULL;
    OstStatus status = find_order(ctx, whole->tet_count, whole->tet_label, &place, &item);
    OST_THEN(reorder(ctx, whole->tet_count, item, sizeof(OstGlobal) * (size_t)whole->nodes_per_tet,
                     (void **)&whole->tet_nodes));
    OST_THEN(reorder(ctx, whole->tet_count, item, sizeof(OstGlobal), (void **)&whole->tet_label));
    OST_THEN(reorder(ctx, whole->tet_count, item, sizeof(int32_t), (void **)&whole->tet_region));
    if (whole->tet_axes)
        OST_THEN(reorder(ctx, whole->tet_count, item, 9 * sizeof(double), (void **)&whole->tet_axes));
    OST_FREE(place, item);
    return status;
}

OstStatus ost_mesh_gather(const OstMesh *mesh, OstMeshChunk **whole)
{
    OstContext *ctx = mesh->ctx;
    OstMeshChunk *made = NULL;
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS) {
        made->ctx = ctx;
        made->nodes_per_tet = mesh->nodes_per_tet;
        made->global_nodes = mesh->global_nodes;
        made->global_tets = mesh->global_tets;
        status = copy_names(mesh, made);
    }
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(gather_nodes(mesh, made));
    OST_TRY_DONE(gather_tets(mesh, made));
    for (int b = 0; b < mesh->boundary_count; b++)
        OST_TRY_DONE(gather_boundary(mesh, &mesh->boundaries[b], &made->boundaries[b]));
    status = order_nodes(made);
    OST_THEN(order_tets(made));
    order_items(made);
    OST_TRY_DONE(ost_agree(ctx, status));
    *whole = made;
    return OST_SUCCESS;
done:
    ost_chunk_destroy(&made);
    return status;
}
