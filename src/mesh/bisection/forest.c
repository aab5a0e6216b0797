/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/bisection/forest.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "mesh/periods.h"

#include <string.h>

OstStatus ost_forest_room(OstContext *ctx, OstLocal count, size_t size, void **array)
{
    if (count == INT32_MAX)
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED, "a rank would hold more than %d tets or edges; use more ranks",
                         INT32_MAX);
    return ost_grow(ctx, (size_t)count + 1, size, array);
}

void ost_forest_destroy(Forest **forest)
{
    Forest *old = *forest;
    if (!old)
        return;
    OST_FREE(old->vertex);
    ost_index_destroy(&old->edges);
    OST_FREE(old->edge, old->leaf, old->barycentric, old->item, old->notice);
    ost_cuts_destroy(&old->cuts);
    OST_FREE(*forest);
}

/* The notice of an edge in this round, made if there is none. */
static OstStatus notice_of(Forest *forest, OstLocal number, Notice **notice)
{
    ForestEdge *edge = &forest->edge[number];
    if (edge->notice < 0) {
        OstLocal ends[2];
        ost_forest_ends(forest, number, ends);
        const OstKey key = ost_key(forest->vertex[ends[0]].label, forest->vertex[ends[1]].label);
        OST_TRY(FOREST_ROOM(forest, forest->notice_count, &forest->notice));
        edge->notice = forest->notice_count++;
        forest->notice[edge->notice] = (Notice){.key = key, .tet = INT64_MAX, .edge = number, .first = !edge->told};
        edge->told = 1;
    }
    *notice = &forest->notice[edge->notice];
    return OST_SUCCESS;
}

OstStatus ost_forest_edge(Forest *forest, OstLocal a, OstLocal b, OstLocal *edge)
{
    const OstGlobal key[2] = {a < b ? a : b, a < b ? b : a};
    const OstLocal known = forest->edges->count;
    OST_TRY(ost_index_place(forest->edges, key, edge));
    if (*edge < known)
        return OST_SUCCESS;
    OST_TRY(FOREST_ROOM(forest, known, &forest->edge));
    forest->edge[*edge] =
        (ForestEdge){.cut = -1, .notice = -1, .shared = forest->vertex[a].shared && forest->vertex[b].shared};
    Notice *notice;
    return forest->edge[*edge].shared ? notice_of(forest, *edge, &notice) : OST_SUCCESS;
}

/* A vertex may be shared where a tet that another rank owns touches it. This rank knows all tets around its own nodes
 * alone. */
static OstStatus file_vertices(Forest *forest)
{
    const OstMesh *mesh = forest->mesh;
    OST_TRY(OST_NEW(forest->ctx, &forest->vertex, mesh->node_count));
    forest->vertex_count = mesh->node_count;
    for (OstLocal n = 0; n < mesh->node_count; n++) {
        ForestVertex *vertex = &forest->vertex[n];
        *vertex = (ForestVertex){
            .label = mesh->node_label[n], .ends = {-1, -1}, .holder = -1, .shared = n >= mesh->owned_nodes};
        memcpy(vertex->x, mesh->coordinates + 3 * (size_t)n, sizeof vertex->x);
        vertex->leads = forest->periods ? forest->periods->leads[n] : 0;
        vertex->follows = forest->periods ? forest->periods->follows[n] : 0;
    }
    for (OstLocal t = mesh->owned_tets; t < mesh->tet_count; t++)
        for (int v = 0; v < 4; v++)
            forest->vertex[ost_mesh_nodes_of(mesh, t)[v]].shared = 1;
    return OST_SUCCESS;
}

static OstStatus file_edges_of(Forest *forest, Leaf *leaf)
{
    for (int e = 0; e < 6; e++)
        OST_TRY(ost_forest_edge(forest, leaf->vertex[ost_tet_edge[e][0]], leaf->vertex[ost_tet_edge[e][1]],
                                &leaf->edge[e]));
    return OST_SUCCESS;
}

static OstStatus file_tets(Forest *forest, const OstTag *tag)
{
    const OstMesh *mesh = forest->mesh;
    OST_TRY(OST_NEW(forest->ctx, &forest->leaf, mesh->owned_tets));
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        Leaf *leaf = &forest->leaf[forest->leaf_count++];
        *leaf = (Leaf){.root = t, .place = -1, .tag = tag[t]};
        memcpy(leaf->vertex, ost_mesh_nodes_of(mesh, t), sizeof leaf->vertex);
        OST_TRY(file_edges_of(forest, leaf));
    }
    return OST_SUCCESS;
}

static OstStatus file_all(Forest *forest, const OstTag *tag)
{
    OST_TRY(ost_index_create(forest->ctx, 2, &forest->edges));
    OST_TRY(file_vertices(forest));
    OST_TRY(file_tets(forest, tag));
    return ost_forest_file_items(forest, tag);
}

OstStatus ost_forest_create(const OstMesh *mesh, const OstTag *tag, const OstShapeSurface *shape,
                            const OstPeriods *periods, Forest **forest)
{
    OstContext *ctx = mesh->ctx;
    OstStatus status = OST_NEW(ctx, forest, 1);
    if (status == OST_SUCCESS) {
        (*forest)->ctx = ctx;
        (*forest)->mesh = mesh;
        (*forest)->periods = periods;
        (*forest)->shape = shape && shape->kind != OST_SURFACE_NONE ? shape : NULL;
        for (OstLocal n = 0; n < mesh->owned_nodes; n++)
            if (mesh->node_label[n] > (*forest)->highest_label)
                (*forest)->highest_label = mesh->node_label[n];
        status = file_all(*forest, tag);
    }
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(ost_max_numbers(ctx, 1, &(*forest)->highest_label));
    (*forest)->label_limit = (*forest)->highest_label;
    return OST_SUCCESS;
}

void ost_forest_barycentric(const Forest *forest, const Leaf *leaf, int vertex, double b[4])
{
    for (int v = 0; v < 4; v++)
        b[v] = leaf->place < 0 ? (v == vertex ? 1.0 : 0.0)
                               : forest->barycentric[16 * (size_t)leaf->place + 4 * (size_t)vertex + (size_t)v];
}

void ost_forest_value(const OstMesh *mesh, OstLocal tet, const double b[4], int width, const double *field,
                      double *value)
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    const int quadratic = mesh->nodes_per_tet == 10;
    memset(value, 0, (size_t)width * sizeof *value);
    for (int n = 0; n < mesh->nodes_per_tet; n++) {
        const double weight = n >= 4      ? 4.0 * b[ost_tet_edge[n - 4][0]] * b[ost_tet_edge[n - 4][1]]
                              : quadratic ? b[n] * (2.0 * b[n] - 1.0)
                                          : b[n];
        for (int d = 0; d < width; d++)
            value[d] += weight * field[(size_t)nodes[n] * (size_t)width + (size_t)d];
    }
}

/* --- bisecting --- */

/* Where the middle of a leaf's edge belongs: on the shape's surface; or where the root, which may be curved, has it. */
static void place_middle(const Forest *forest, const Leaf *leaf, int edge, double x[3])
{
    const int p = ost_tet_edge[edge][0], q = ost_tet_edge[edge][1];
    double b[2][4];
    if (forest->shape || forest->mesh->nodes_per_tet == 4) {
        ost_shape_surface_middle(forest->shape, forest->vertex[leaf->vertex[p]].x, forest->vertex[leaf->vertex[q]].x,
                                 x);
        return;
    }
    ost_forest_barycentric(forest, leaf, p, b[0]);
    ost_forest_barycentric(forest, leaf, q, b[1]);
    for (int v = 0; v < 4; v++)
        b[0][v] = 0.5 * (b[0][v] + b[1][v]);
    ost_forest_value(forest->mesh, leaf->root, b[0], 3, forest->mesh->coordinates, x);
}

/* Of the roots that cut an edge, the one with the lowest label says where its middle is. */
static OstStatus ask_cut(Forest *forest, const Leaf *leaf)
{
    const OstLocal edge = leaf->edge[leaf->tag.edge];
    const OstGlobal root = forest->mesh->tet_label[leaf->root];
    Notice *notice = NULL;
    if (forest->edge[edge].cut >= 0)
        return OST_SUCCESS;
    OST_TRY(notice_of(forest, edge, &notice));
    if (root < notice->tet) {
        notice->tet = root;
        place_middle(forest, leaf, leaf->tag.edge, notice->x);
    }
    return OST_SUCCESS;
}

/* The rows of the children's vertices in the root. */
static OstStatus place_children(Forest *forest, const Leaf *parent, OstLocal place[2])
{
    const int *ends = ost_tet_edge[parent->tag.edge];
    double b[4][4];
    for (int v = 0; v < 4; v++)
        ost_forest_barycentric(forest, parent, v, b[v]);
    for (int c = 0; c < 2; c++) {
        place[c] = c == 0 ? parent->place : -1;
        if (place[c] < 0) {
            OST_TRY(
                ost_forest_room(forest->ctx, forest->place_count, 16 * sizeof(double), (void **)&forest->barycentric));
            place[c] = forest->place_count++;
        }
        double *row = forest->barycentric + 16 * (size_t)place[c];
        memcpy(row, b, sizeof b);
        for (int v = 0; v < 4; v++)
            row[4 * ends[1 - c] + v] = 0.5 * (b[ends[0]][v] + b[ends[1]][v]);
    }
    return OST_SUCCESS;
}

enum { DEEPEST = 63 };

static OstStatus bisect(Forest *forest, OstLocal number)
{
    const Leaf parent = forest->leaf[number];
    const int *ends = ost_tet_edge[parent.tag.edge];
    const OstLocal middle = forest->edge[parent.edge[parent.tag.edge]].cut;
    OstTag tag[2];
    OstLocal place[2];
    if (parent.depth > DEEPEST)
        return OST_RAISE(forest->ctx, OST_LIMIT_EXCEEDED, "tet %lld would be cut more than %d times at once",
                         (long long)forest->mesh->tet_label[parent.root], DEEPEST + 1);
    ost_tag_children(&parent.tag, tag);
    OST_TRY(place_children(forest, &parent, place));
    OST_TRY(FOREST_ROOM(forest, forest->leaf_count, &forest->leaf));
    for (int c = 0; c < 2; c++) {
        Leaf child = parent;
        child.vertex[ends[1 - c]] = middle;
        child.tag = tag[c];
        child.place = place[c];
        child.path |= (uint64_t)c << (DEEPEST - parent.depth);
        child.depth++;
        OST_TRY(file_edges_of(forest, &child));
        forest->leaf[c == 0 ? number : forest->leaf_count++] = child;
    }
    return OST_SUCCESS;
}

/* --- rounds --- */

/* The leaves to be cut in this round. */
typedef struct Round {
    OstLocal count;
    OstLocal *leaf;
} Round;

static OstStatus choose(Forest *forest, const unsigned char *times, Round *round)
{
    round->count = 0;
    for (OstLocal i = 0; i < forest->leaf_count; i++) {
        const Leaf *leaf = &forest->leaf[i];
        int cut = leaf->depth < times[leaf->root];
        for (int e = 0; e < 6; e++)
            cut |= forest->edge[leaf->edge[e]].cut >= 0 || forest->edge[leaf->edge[e]].wanted;
        if (!cut)
            continue;
        OST_TRY(FOREST_ROOM(forest, round->count, &round->leaf));
        round->leaf[round->count++] = i;
        OST_TRY(ask_cut(forest, leaf));
    }
    return OST_SUCCESS;
}

static OstStatus cut_leaves(Forest *forest, const Round *round)
{
    for (OstLocal i = 0; i < round->count; i++)
        OST_TRY(bisect(forest, round->leaf[i]));
    return OST_SUCCESS;
}

/* Cuts are told before leaves are bisected, and edges that this brings after it: in each round all ranks cut what one
 * rank alone would. */
static OstStatus cut_round(Forest *forest, const unsigned char *times, Round *round, OstGlobal *cut)
{
    OstLocal items = 0;
    OST_TRY(ost_agree(forest->ctx, choose(forest, times, round)));
    OST_TRY(ost_forest_exchange(forest));
    OstStatus status = cut_leaves(forest, round);
    OST_THEN(ost_forest_split_items(forest, &items));
    OST_TRY(ost_agree(forest->ctx, status));
    if (ost_size(forest->ctx) > 1)
        OST_TRY(ost_forest_exchange(forest));
    *cut = round->count + items;
    return ost_sum_numbers(forest->ctx, 1, cut);
}

/* Cuts tets until they meet in whole faces. */
static OstStatus close(Forest *forest, const unsigned char *times, Round *round)
{
    OstGlobal cut = 1;
    while (cut > 0)
        OST_TRY(cut_round(forest, times, round, &cut));
    return OST_SUCCESS;
}

/* Ends with periodic pairs, too: faces and their images have the same marked edges, as if they were one. */
OstStatus ost_forest_grow(Forest *forest, const unsigned char *times)
{
    Round round = {0};
    OstGlobal wanted = 1;
    OstStatus status = ost_forest_exchange(forest);
    while (status == OST_SUCCESS && wanted > 0) {
        status = close(forest, times, &round);
        OST_THEN(ost_forest_want_images(forest, &wanted));
    }
    OST_FREE(round.leaf);
    ost_cuts_destroy(&forest->cuts);
    OST_THEN(ost_forest_flatten(forest));
    return status;
}
