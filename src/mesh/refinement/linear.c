/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/numbering.h"
#include "mesh/refinement/divide.h"
#include "orthostat/refine.h"

#include <string.h>

enum { IS_VERTEX = 1, IS_MIDDLE = 2 };

/* Numbers the vertices among the nodes, in their order; mid-edge nodes get -1. */
static OstStatus number_vertices(const OstMesh *quadratic, OstLocal *vertex, OstMesh *linear)
{
    for (OstLocal n = 0; n < quadratic->node_count; n++)
        vertex[n] = 0;
    for (OstLocal t = 0; t < quadratic->tet_count; t++)
        for (int v = 0; v < 10; v++)
            vertex[quadratic->tet_nodes[10 * (size_t)t + (size_t)v]] |= v < 4 ? IS_VERTEX : IS_MIDDLE;
    for (OstLocal n = 0; n < quadratic->node_count; n++) {
        if (vertex[n] == (IS_VERTEX | IS_MIDDLE))
            return OST_RAISE(
                quadratic->ctx, OST_INVALID_INPUT,
                "node %lld is a vertex of one tet and halfway along an edge of another; make the tets meet "
                "in whole edges",
                (long long)ost_mesh_node_number(quadratic, n));
        const int is_vertex = vertex[n] == IS_VERTEX;
        vertex[n] = is_vertex ? linear->node_count++ : -1;
        if (is_vertex && n < quadratic->owned_nodes)
            linear->owned_nodes++;
    }
    return OST_SUCCESS;
}

static OstStatus fill_nodes(const OstMesh *quadratic, const OstLocal *vertex, OstMesh *linear)
{
    OST_TRY(OST_NEW(linear->ctx, &linear->coordinates, 3 * (size_t)linear->node_count));
    OST_TRY(OST_NEW(linear->ctx, &linear->node_label, linear->node_count));
    linear->node_shift = quadratic->node_shift;
    OST_TRY(OST_NEW(linear->ctx, &linear->node_number, linear->node_count));
    for (OstLocal n = 0; n < quadratic->node_count; n++) {
        if (vertex[n] < 0)
            continue;
        linear->node_label[vertex[n]] = quadratic->node_label[n];
        memcpy(linear->coordinates + 3 * (size_t)vertex[n], quadratic->coordinates + 3 * (size_t)n, 3 * sizeof(double));
    }
    return OST_SUCCESS;
}

static OstStatus fill_tets(const OstMesh *quadratic, const OstLocal *vertex, OstMesh *linear)
{
    const size_t count = (size_t)quadratic->tet_count;
    linear->tet_count = quadratic->tet_count;
    linear->owned_tets = quadratic->owned_tets;
    linear->global_tets = quadratic->global_tets;
    OST_TRY(OST_NEW(linear->ctx, &linear->tet_nodes, 4 * count));
    OST_TRY(OST_NEW(linear->ctx, &linear->tet_label, count));
    OST_TRY(OST_NEW(linear->ctx, &linear->tet_region, count));
    if (quadratic->tet_axes)
        OST_TRY(OST_NEW(linear->ctx, &linear->tet_axes, 9 * count));
    const size_t field = (size_t)ost_tet_fields_width(&quadratic->fields) * count;
    linear->fields = quadratic->fields;
    if (field > 0) {
        OST_TRY(OST_NEW(linear->ctx, &linear->tet_field, field));
        memcpy(linear->tet_field, quadratic->tet_field, field * sizeof(double));
    }
    for (size_t t = 0; t < count; t++)
        for (size_t v = 0; v < 4; v++)
            linear->tet_nodes[4 * t + v] = vertex[quadratic->tet_nodes[10 * t + v]];
    if (count > 0) {
        memcpy(linear->tet_label, quadratic->tet_label, count * sizeof *linear->tet_label);
        memcpy(linear->tet_region, quadratic->tet_region, count * sizeof *linear->tet_region);
    }
    if (linear->tet_axes && count > 0)
        memcpy(linear->tet_axes, quadratic->tet_axes, 9 * count * sizeof *linear->tet_axes);
    return OST_SUCCESS;
}

/* Keeps the items with an owned vertex; drops points at mid-edge nodes. */
static OstStatus fill_boundary(const OstBoundary *from, const OstLocal *vertex, const OstMesh *linear, OstBoundary *to)
{
    const size_t width = (size_t)to->nodes_per_item;
    OST_TRY(OST_NEW(linear->ctx, &to->nodes, (size_t)from->count * width));
    for (OstLocal i = 0; i < from->count; i++) {
        OstGlobal *nodes = to->nodes + (size_t)to->count * width;
        int touches = 0;
        for (size_t v = 0; v < width; v++) {
            nodes[v] = vertex[from->nodes[(size_t)i * (size_t)from->nodes_per_item + v]];
            touches |= nodes[v] >= 0 && nodes[v] < linear->owned_nodes;
        }
        to->count += touches;
    }
    return OST_SUCCESS;
}

static OstStatus make_piece(const OstMesh *quadratic, OstLocal **vertex, OstMesh **linear)
{
    OST_TRY(ost_mesh_inherit(quadratic, 4, linear));
    OST_TRY(OST_NEW(quadratic->ctx, vertex, quadratic->node_count));
    OST_TRY(number_vertices(quadratic, *vertex, *linear));
    OST_TRY(fill_nodes(quadratic, *vertex, *linear));
    OST_TRY(fill_tets(quadratic, *vertex, *linear));
    for (int b = 0; b < quadratic->boundary_count; b++)
        OST_TRY(fill_boundary(&quadratic->boundaries[b], *vertex, *linear, &(*linear)->boundaries[b]));
    return ost_halo_subset(quadratic->halo, *vertex, &(*linear)->halo);
}

static OstStatus number_globally(OstMesh *linear)
{
    OST_TRY(ost_number_from(linear->ctx, linear->owned_nodes, &linear->first_node, &linear->global_nodes));
    for (OstLocal n = 0; n < linear->owned_nodes; n++)
        linear->node_number[n] = linear->first_node + n;
    return ost_agree(linear->ctx, ost_halo_import(linear->halo, sizeof *linear->node_number, linear->node_number));
}

static OstStatus list_nodes(const OstMesh *quadratic, const OstLocal *vertex, const OstMesh *linear, OstLocal **nodes)
{
    OST_TRY(OST_NEW(linear->ctx, nodes, linear->node_count));
    for (OstLocal n = 0; n < quadratic->node_count; n++)
        if (vertex[n] >= 0)
            (*nodes)[vertex[n]] = n;
    return OST_SUCCESS;
}

static OstStatus make_linear(const OstMesh *quadratic, OstMesh **linear, OstLocal **node_of_vertex)
{
    OstContext *ctx = quadratic->ctx;
    if (quadratic->nodes_per_tet != 10)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "the mesh to make linear has tets of %d nodes, expected 10",
                         quadratic->nodes_per_tet);
    OstLocal *vertex = NULL;
    OstStatus status = make_piece(quadratic, &vertex, linear);
    if (status == OST_SUCCESS && node_of_vertex)
        status = list_nodes(quadratic, vertex, *linear, node_of_vertex);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(number_globally(*linear));
done:
    OST_FREE(vertex);
    return status;
}

OstStatus ost_mesh_linear(const OstMesh *quadratic, OstMesh **linear, OstLocal **node_of_vertex)
{
    *linear = NULL;
    if (node_of_vertex)
        *node_of_vertex = NULL;
    ost_ledger_enter(quadratic->ctx, OST_LEDGER_MESH);
    const OstStatus status = make_linear(quadratic, linear, node_of_vertex);
    if (status != OST_SUCCESS) {
        ost_mesh_destroy(linear);
        if (node_of_vertex)
            OST_FREE(*node_of_vertex);
    }
    ost_ledger_leave(quadratic->ctx);
    return status;
}

OstStatus ost_mesh_parents(const OstMesh *quadratic, const OstMesh *linear, OstLocal *parents)
{
    const size_t count = (size_t)quadratic->tet_count;
    if (quadratic->nodes_per_tet != 10 || linear->nodes_per_tet != 4 || linear->tet_count != quadratic->tet_count ||
        memcmp(linear->tet_label, quadratic->tet_label, count * sizeof *linear->tet_label) != 0)
        return OST_RAISE(quadratic->ctx, OST_INVALID_INPUT,
                         "the meshes are not of the same tets, once with 10 and once with 4 nodes; make one of the "
                         "other by ost_mesh_raise or ost_mesh_linear");
    for (size_t t = 0; t < count; t++) {
        const OstLocal *vertex = linear->tet_nodes + 4 * t;
        const OstLocal *node = quadratic->tet_nodes + 10 * t;
        for (int v = 0; v < 4; v++)
            parents[2 * (size_t)node[v]] = parents[2 * (size_t)node[v] + 1] = vertex[v];
        for (int e = 0; e < 6; e++)
            for (size_t end = 0; end < 2; end++)
                parents[2 * (size_t)node[4 + e] + end] = vertex[ost_tet_edge[e][end]];
    }
    return OST_SUCCESS;
}
