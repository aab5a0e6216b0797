/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/refinement/divide.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"

#include <stdlib.h>
#include <string.h>

const int ost_tet_turn[3][10] = {
    {0, 1, 2, 3, 4, 5, 6, 7, 8, 9}, {0, 3, 1, 2, 7, 8, 4, 6, 9, 5}, {0, 2, 3, 1, 6, 9, 7, 4, 5, 8}};

/* Nodes of an item of a dimension (0-2) on a mesh of linear or quadratic tets. */
static int nodes_per_item(int nodes_per_tet, int dimension)
{
    static const int nodes[2][3] = {{1, 2, 3}, {1, 3, 6}};
    return nodes[nodes_per_tet == 10][dimension];
}

static OstStatus copy_names(OstContext *ctx, const OstNames *from, OstNames *to)
{
    OST_TRY(OST_NEW(ctx, &to->name, from->count));
    for (; to->count < from->count; to->count++)
        OST_TRY(ost_copy_string(ctx, from->name[to->count], &to->name[to->count]));
    return OST_SUCCESS;
}

OstStatus ost_mesh_inherit(const OstMesh *parent, int nodes_per_tet, OstMesh **mesh)
{
    OstContext *ctx = parent->ctx;
    OST_TRY(OST_NEW(ctx, mesh, 1));
    OstMesh *made = *mesh;
    made->ctx = ctx;
    made->nodes_per_tet = nodes_per_tet;
    made->straighten = parent->straighten;
    made->cut_off = parent->cut_off;
    OST_TRY(copy_names(ctx, &parent->regions, &made->regions));
    OST_TRY(OST_NEW(ctx, &made->boundaries, parent->boundary_count));
    for (; made->boundary_count < parent->boundary_count; made->boundary_count++) {
        const OstBoundary *from = &parent->boundaries[made->boundary_count];
        OstBoundary *to = &made->boundaries[made->boundary_count];
        to->dimension = from->dimension;
        to->nodes_per_item = nodes_per_item(nodes_per_tet, from->dimension);
        OST_TRY(ost_copy_string(ctx, from->name, &to->name));
    }
    return OST_SUCCESS;
}

/* The division of a mesh, under way. */
typedef struct Making {
    const MidNodes *mid;
    const Division *division;
    const unsigned char *turn;
    OstMesh *mesh;
    OstLocal *origin; /* tet_count: parent × children + child */
    OstLocal *local;  /* of the new nodes: 1 + the mesh's local number, or 0 where no tet here has them */
} Making;

/* Vertices and mid-edge nodes of a tet, in its selected order. */
static void gather_tet(const Making *making, OstLocal tet, OstLocal nodes[10])
{
    const MidNodes *mid = making->mid;
    const OstMesh *parent = mid->mesh;
    const int *turn = ost_tet_turn[making->turn ? making->turn[tet] : 0];
    OstLocal own[10];
    memcpy(own, parent->tet_nodes + (size_t)tet * (size_t)parent->nodes_per_tet, 4 * sizeof *own);
    for (int e = 0; e < 6; e++)
        own[4 + e] = parent->node_count + mid->edges.of_tet[6 * (size_t)tet + (size_t)e];
    for (int v = 0; v < 10; v++)
        nodes[v] = own[turn[v]];
}

/* Vertices and mid-edge nodes of a point, curve or face. */
static OstStatus gather_item(const Making *making, const OstBoundary *boundary, OstLocal item, OstLocal nodes[6])
{
    const OstMesh *parent = making->mid->mesh;
    const OstGlobal *own = boundary->nodes + (size_t)item * (size_t)boundary->nodes_per_item;
    const int vertices = boundary->dimension + 1;
    const int edges = boundary->dimension == 2 ? 3 : boundary->dimension;
    for (int v = 0; v < vertices; v++)
        nodes[v] = (OstLocal)own[v];
    for (int e = 0; e < edges; e++) {
        const OstLocal edge = ost_edge_find(&making->mid->edges, parent, nodes[e], nodes[(e + 1) % vertices]);
        if (edge < 0)
            return OST_RAISE(parent->ctx, OST_INVALID_INPUT,
                             "boundary '%s' has an item between vertices %lld and %lld, which no tet's edge joins",
                             boundary->name, (long long)ost_mesh_node_number(parent, nodes[e]),
                             (long long)ost_mesh_node_number(parent, nodes[(e + 1) % vertices]));
        nodes[vertices + e] = parent->node_count + edge;
    }
    return OST_SUCCESS;
}

/* A child is kept where it touches an owned node; the owner of its node with the lowest number owns it. */
typedef enum { ELSEWHERE, GHOST, OWNED } Place;

static Place place_of(const MidNodes *mid, const Pattern *pattern, int child, const OstLocal *nodes)
{
    const int *of_child = pattern->node + child * pattern->nodes;
    OstLocal lowest = nodes[of_child[0]];
    int touches = 0;
    for (int j = 0; j < pattern->nodes; j++) {
        const OstLocal node = nodes[of_child[j]];
        touches |= ost_mid_nodes_owns(mid, node);
        lowest = mid->number[node] < mid->number[lowest] ? node : lowest;
    }
    return !touches ? ELSEWHERE : ost_mid_nodes_owns(mid, lowest) ? OWNED : GHOST;
}

/* Appends the children of one kind of place to `origin`, which has `count` already; with origin NULL only counts. */
static OstGlobal list_tets(const Making *making, Place place, OstGlobal count, OstLocal *origin)
{
    const Pattern *pattern = &making->division->tet;
    OstLocal nodes[10];
    for (OstLocal t = 0; t < making->mid->mesh->tet_count; t++) {
        gather_tet(making, t, nodes);
        for (int k = 0; k < pattern->children; k++) {
            if (place_of(making->mid, pattern, k, nodes) != place)
                continue;
            if (origin)
                origin[count] = t * pattern->children + k;
            count++;
        }
    }
    return count;
}

static OstStatus choose_tets(Making *making)
{
    OstContext *ctx = making->mesh->ctx;
    const OstGlobal parents = making->mid->mesh->tet_count;
    if (parents * making->division->tet.children > INT32_MAX)
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED,
                         "%lld tets on a rank would become %d each, more than the %d it can number; use more ranks",
                         (long long)parents, making->division->tet.children, INT32_MAX);
    const OstGlobal owned = list_tets(making, OWNED, 0, NULL);
    const OstGlobal all = list_tets(making, GHOST, owned, NULL);
    OST_TRY(OST_NEW(ctx, &making->origin, all));
    list_tets(making, OWNED, 0, making->origin);
    list_tets(making, GHOST, owned, making->origin);
    making->mesh->owned_tets = (OstLocal)owned;
    making->mesh->tet_count = (OstLocal)all;
    return OST_SUCCESS;
}

/* Where the vertices of a tet of the new mesh are in its parent. */
static void child_places(const Making *making, OstLocal tet, double place[4][4])
{
    const Pattern *pattern = &making->division->tet;
    const OstLocal parent = making->origin[tet] / pattern->children;
    const int *of_child = pattern->node + making->origin[tet] % pattern->children * pattern->nodes;
    const int *turn = ost_tet_turn[making->turn ? making->turn[parent] : 0];
    for (int v = 0; v < 4; v++)
        ost_tet_node_place(turn[of_child[v]], place[v]);
}

/* The nodes of a tet of the new mesh; returns its parent. */
static OstLocal child_nodes(const Making *making, OstLocal tet, OstLocal nodes[10])
{
    const Pattern *pattern = &making->division->tet;
    const OstLocal parent = making->origin[tet] / pattern->children;
    const int *of_child = pattern->node + making->origin[tet] % pattern->children * pattern->nodes;
    OstLocal all[10];
    gather_tet(making, parent, all);
    for (int j = 0; j < pattern->nodes; j++)
        nodes[j] = all[of_child[j]];
    return parent;
}

typedef struct Numbered {
    OstGlobal number;
    OstLocal node;
} Numbered;

/* Marks all nodes of this rank's tets, and lists those that other ranks own, by ascending number. */
static OstStatus list_ghosts(const Making *making, Numbered **ghost, OstLocal *count)
{
    const MidNodes *mid = making->mid;
    OstLocal nodes[10];
    for (OstLocal t = 0; t < making->mesh->tet_count; t++) {
        child_nodes(making, t, nodes);
        for (int j = 0; j < making->mesh->nodes_per_tet; j++) {
            *count += making->local[nodes[j]] == 0 && !ost_mid_nodes_owns(mid, nodes[j]);
            making->local[nodes[j]] = 1;
        }
    }
    OST_TRY(OST_NEW(making->mesh->ctx, ghost, *count));
    Numbered *next = *ghost;
    for (OstLocal n = 0; n < mid->count; n++)
        if (making->local[n] != 0 && !ost_mid_nodes_owns(mid, n))
            *next++ = (Numbered){mid->number[n], n};
    qsort(*ghost, (size_t)*count, sizeof **ghost, ost_compare_numbers);
    return OST_SUCCESS;
}

static OstStatus number_nodes(Making *making)
{
    const MidNodes *mid = making->mid;
    OstMesh *mesh = making->mesh;
    Numbered *ghost = NULL;
    OstLocal ghosts = 0;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(mesh->ctx, &making->local, mid->count));
    OST_TRY_DONE(list_ghosts(making, &ghost, &ghosts));
    mesh->first_node = mid->first_node;
    mesh->owned_nodes = mid->owned_nodes;
    mesh->node_count = mid->owned_nodes + ghosts;
    OST_TRY_DONE(OST_NEW(mesh->ctx, &mesh->node_number, mesh->node_count));
    for (OstLocal n = 0; n < mid->count; n++)
        if (ost_mid_nodes_owns(mid, n))
            making->local[n] = 1 + (OstLocal)(mid->number[n] - mid->first_node);
    for (OstLocal i = 0; i < mesh->owned_nodes; i++)
        mesh->node_number[i] = mid->first_node + i;
    for (OstLocal g = 0; g < ghosts; g++) {
        making->local[ghost[g].node] = 1 + mesh->owned_nodes + g;
        mesh->node_number[mesh->owned_nodes + g] = ghost[g].number;
    }
done:
    OST_FREE(ghost);
    return status;
}

static OstStatus fill_nodes(Making *making)
{
    const MidNodes *mid = making->mid;
    OstMesh *mesh = making->mesh;
    OST_TRY(OST_NEW(mesh->ctx, &mesh->coordinates, 3 * (size_t)mesh->node_count));
    OST_TRY(OST_NEW(mesh->ctx, &mesh->node_label, mesh->node_count));
    mesh->node_shift = making->mid->mesh->node_shift;
    for (OstLocal n = 0; n < mid->count; n++) {
        const OstLocal i = making->local[n] - 1;
        if (i < 0)
            continue;
        memcpy(mesh->coordinates + 3 * (size_t)i, mid->coordinates + 3 * (size_t)n, 3 * sizeof(double));
        mesh->node_label[i] = mid->label[n];
    }
    return OST_SUCCESS;
}

static OstStatus fill_tets(Making *making)
{
    const OstMesh *parent = making->mid->mesh;
    OstMesh *mesh = making->mesh;
    const int children = making->division->tet.children;
    const size_t width = (size_t)mesh->nodes_per_tet;
    OST_TRY(OST_NEW(mesh->ctx, &mesh->tet_nodes, width * (size_t)mesh->tet_count));
    OST_TRY(OST_NEW(mesh->ctx, &mesh->tet_label, mesh->tet_count));
    OST_TRY(OST_NEW(mesh->ctx, &mesh->tet_region, mesh->tet_count));
    if (parent->tet_axes)
        OST_TRY(OST_NEW(mesh->ctx, &mesh->tet_axes, 9 * (size_t)mesh->tet_count));
    const size_t field = (size_t)ost_tet_fields_width(&parent->fields);
    mesh->fields = parent->fields;
    if (field > 0)
        OST_TRY(OST_NEW(mesh->ctx, &mesh->tet_field, field * (size_t)mesh->tet_count));
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        OstLocal nodes[10];
        const OstLocal from = child_nodes(making, t, nodes);
        for (size_t j = 0; j < width; j++)
            mesh->tet_nodes[(size_t)t * width + j] = making->local[nodes[j]] - 1;
        mesh->tet_label[t] = children * (parent->tet_label[from] - 1) + making->origin[t] % children + 1;
        mesh->tet_region[t] = parent->tet_region[from];
        if (parent->tet_axes)
            memcpy(mesh->tet_axes + 9 * (size_t)t, parent->tet_axes + 9 * (size_t)from, 9 * sizeof(double));
        if (field > 0) {
            double place[4][4];
            child_places(making, t, place);
            ost_tet_fields_inherit(&parent->fields, parent->tet_field + field * (size_t)from, (const double(*)[4])place,
                                   mesh->tet_field + field * (size_t)t);
        }
    }
    return OST_SUCCESS;
}

/* Keeps the children of items that touch an owned node: this rank has the tets behind them. */
static OstStatus fill_boundary(const Making *making, const OstBoundary *from, OstBoundary *to)
{
    const Pattern *pattern = &making->division->item[from->dimension];
    const OstGlobal most = (OstGlobal)from->count * pattern->children;
    OstLocal nodes[6];
    if (most > INT32_MAX)
        return OST_RAISE(making->mesh->ctx, OST_LIMIT_EXCEEDED,
                         "boundary '%s' would have %lld items on a rank, more than the %d it can number; use more "
                         "ranks",
                         from->name, (long long)most, INT32_MAX);
    OST_TRY(OST_NEW(making->mesh->ctx, &to->nodes, (size_t)most * (size_t)pattern->nodes));
    OstGlobal *next = to->nodes;
    for (OstLocal i = 0; i < from->count; i++) {
        OST_TRY(gather_item(making, from, i, nodes));
        for (int k = 0; k < pattern->children; k++) {
            if (place_of(making->mid, pattern, k, nodes) == ELSEWHERE)
                continue;
            for (int j = 0; j < pattern->nodes; j++)
                *next++ = making->local[nodes[pattern->node[k * pattern->nodes + j]]] - 1;
            to->count++;
        }
    }
    return OST_SUCCESS;
}

static OstStatus make_piece(Making *making)
{
    const OstMesh *parent = making->mid->mesh;
    OST_TRY(ost_mesh_inherit(parent, making->division->tet.nodes, &making->mesh));
    OST_TRY(choose_tets(making));
    OST_TRY(number_nodes(making));
    OST_TRY(fill_nodes(making));
    OST_TRY(fill_tets(making));
    for (int b = 0; b < parent->boundary_count; b++)
        OST_TRY(fill_boundary(making, &parent->boundaries[b], &making->mesh->boundaries[b]));
    making->mesh->global_nodes = making->mid->global_nodes;
    making->mesh->global_tets = parent->global_tets * making->division->tet.children;
    return OST_SUCCESS;
}

OstStatus ost_mesh_divide(const MidNodes *mid, const Division *division, const unsigned char *turn, OstMesh **mesh,
                          OstLocal **origin)
{
    Making making = {mid, division, turn, NULL, NULL, NULL};
    OstStatus status = ost_agree(mid->mesh->ctx, make_piece(&making));
    OST_FREE(making.local);
    OST_THEN(ost_mesh_connect(making.mesh));
    if (status != OST_SUCCESS)
        ost_mesh_destroy(&making.mesh);
    if (status != OST_SUCCESS || !origin)
        OST_FREE(making.origin);
    if (origin)
        *origin = making.origin;
    *mesh = making.mesh;
    return status;
}
