/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/numbering.h"
#include "core/parallel/reduce.h"
#include "core/parallel/rendezvous.h"
#include "core/parallel/route.h"
#include "mesh/bisection/forest.h"
#include "mesh/refinement/divide.h"

#include <stdlib.h>
#include <string.h>

/* --- labels of the new tets: 1, 2, 3, ... in the order of their roots' labels, then of their paths --- */

static int compare_leaves(const void *a, const void *b)
{
    const Leaf *x = a, *y = b;
    return x->root != y->root ? (x->root > y->root) - (x->root < y->root) : (x->path > y->path) - (x->path < y->path);
}

/* A root, and how many leaves it has. */
typedef struct Family {
    OstGlobal label;
    OstLocal leaves, arrival;
} Family;

static int compare_families(const void *a, const void *b)
{
    const OstGlobal x = ((const Family *)a)->label, y = ((const Family *)b)->label;
    return (x > y) - (x < y);
}

/* The label of the first leaf of each family: ranks count those in their ranges of labels, which ascend. */
static OstStatus number_families(OstContext *ctx, const OstRoute *route, Family *family, OstGlobal *first)
{
    OstGlobal leaves = 0, before = 0, all = 0;
    for (OstLocal i = 0; i < route->receives; i++) {
        family[i].arrival = i;
        leaves += family[i].leaves;
    }
    qsort(family, (size_t)route->receives, sizeof *family, compare_families);
    OST_TRY(ost_number_from(ctx, leaves, &before, &all));
    for (OstLocal i = 0; i < route->receives; i++) {
        first[family[i].arrival] = before + 1;
        before += family[i].leaves;
    }
    return OST_SUCCESS;
}

static OstStatus route_families(const Forest *forest, const Family *family, int *to, OstRoute **route)
{
    const OstMesh *mesh = forest->mesh;
    OstGlobal highest = 0;
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        highest = family[t].label > highest ? family[t].label : highest;
    OST_TRY(ost_max_numbers(forest->ctx, 1, &highest));
    const OstGlobal range = highest / ost_size(forest->ctx) + 1;
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        to[t] = (int)((family[t].label < 0 ? 0 : family[t].label) / range);
    return ost_route_create(forest->ctx, mesh->owned_tets, 1, to, route);
}

/* The label of each own root's first leaf. */
static OstStatus first_labels(const Forest *forest, OstGlobal *first)
{
    OstContext *ctx = forest->ctx;
    const OstMesh *mesh = forest->mesh;
    OstRoute *route = NULL;
    Family *family = NULL, *arrived = NULL;
    OstGlobal *answer = NULL;
    int *to = NULL;
    OstStatus status = OST_NEW(ctx, &family, mesh->owned_tets);
    OST_THEN(OST_NEW(ctx, &to, mesh->owned_tets));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        family[t].label = mesh->tet_label[t];
    for (OstLocal i = 0; i < forest->leaf_count; i++)
        family[forest->leaf[i].root].leaves++;
    OST_TRY_DONE(route_families(forest, family, to, &route));
    OST_TRY_DONE(ost_route_carry(route, sizeof *arrived, family, (void **)&arrived));
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &answer, route->receives)));
    OST_TRY_DONE(number_families(ctx, route, arrived, answer));
    OST_TRY_DONE(ost_route_answer(route, sizeof *first, answer, first));
done:
    ost_route_destroy(&route);
    OST_FREE(family, arrived, answer, to);
    return status;
}

static OstStatus label_leaves(const Forest *forest, OstGlobal *label)
{
    OstGlobal *next = NULL;
    OstStatus status = ost_agree(forest->ctx, OST_NEW(forest->ctx, &next, forest->mesh->owned_tets));
    OST_THEN(first_labels(forest, next));
    for (OstLocal i = 0; status == OST_SUCCESS && i < forest->leaf_count; i++)
        label[i] = next[forest->leaf[i].root]++;
    OST_FREE(next);
    return status;
}

/* --- the chunk --- */

/* Which nodes go into the chunk, and their numbers there. */
typedef struct Making {
    const Forest *forest;
    OstMeshChunk *chunk;
    OstGlobal *number; /* of the forest's vertices; -1: mid-edge node of the old mesh */
} Making;

static int is_held(const Forest *forest, OstLocal vertex)
{
    return vertex < forest->mesh->node_count ? vertex < forest->mesh->owned_nodes
                                             : forest->vertex[vertex].holder == ost_rank(forest->ctx);
}

/* Marks the vertices among the old mesh's nodes by 0. */
static void find_vertices(const Forest *forest, OstGlobal *number)
{
    const OstMesh *mesh = forest->mesh;
    for (OstLocal n = 0; n < mesh->node_count; n++)
        number[n] = -1;
    for (OstLocal t = 0; t < mesh->tet_count; t++)
        for (int v = 0; v < 4; v++)
            number[ost_mesh_nodes_of(mesh, t)[v]] = 0;
}

/* Numbers of new vertices come from the ranks that hold them. */
static OstStatus fetch_numbers(const Forest *forest, OstGlobal *number)
{
    OstContext *ctx = forest->ctx;
    const OstLocal old = forest->mesh->node_count, count = forest->vertex_count - old;
    OstKey *key = NULL, *known = NULL;
    OstGlobal *value = NULL;
    OstLocal held = 0;
    OstStatus status = OST_NEW(ctx, &key, count);
    OST_THEN(OST_NEW(ctx, &known, count));
    OST_THEN(OST_NEW(ctx, &value, count));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (OstLocal i = 0; i < count; i++) {
        key[i] = ost_key(forest->vertex[old + i].label, forest->vertex[old + i].label);
        if (!is_held(forest, old + i))
            continue;
        known[held] = key[i];
        value[held++] = number[old + i];
    }
    OST_TRY_DONE(
        ost_rendezvous(ctx, "vertex", sizeof *value, &(OstKeyed){held, known, NULL, value}, count, key, number + old));
done:
    OST_FREE(key, known, value);
    return status;
}

static OstStatus number_nodes(Making *making)
{
    const Forest *forest = making->forest;
    OstMeshChunk *chunk = making->chunk;
    OstGlobal *number = making->number;
    find_vertices(forest, number);
    for (OstLocal n = 0; n < forest->vertex_count; n++)
        chunk->node_count += number[n] == 0 && is_held(forest, n);
    OST_TRY(ost_number_from(forest->ctx, chunk->node_count, &chunk->first_node, &chunk->global_nodes));
    OstGlobal next = chunk->first_node;
    for (OstLocal n = 0; n < forest->vertex_count; n++)
        if (number[n] == 0 && is_held(forest, n))
            number[n] = next++;
    OST_TRY(ost_agree(forest->ctx, ost_halo_import(forest->mesh->halo, sizeof *number, number)));
    return fetch_numbers(forest, number);
}

static OstStatus fill_nodes(const Making *making)
{
    const Forest *forest = making->forest;
    OstMeshChunk *chunk = making->chunk;
    OST_TRY(OST_NEW(chunk->ctx, &chunk->coordinates, 3 * (size_t)chunk->node_count));
    OST_TRY(OST_NEW(chunk->ctx, &chunk->node_label, chunk->node_count));
    chunk->node_shift = making->forest->mesh->node_shift;
    for (OstLocal n = 0; n < forest->vertex_count; n++) {
        if (making->number[n] < 0 || !is_held(forest, n))
            continue;
        const size_t i = (size_t)(making->number[n] - chunk->first_node);
        memcpy(chunk->coordinates + 3 * i, forest->vertex[n].x, 3 * sizeof(double));
        chunk->node_label[i] = forest->vertex[n].label;
    }
    return OST_SUCCESS;
}

static OstStatus fill_tets(const Making *making, const OstGlobal *label)
{
    const Forest *forest = making->forest;
    const OstMesh *mesh = forest->mesh;
    OstMeshChunk *chunk = making->chunk;
    const size_t count = (size_t)forest->leaf_count;
    chunk->tet_count = forest->leaf_count;
    OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_nodes, 4 * count));
    OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_label, count));
    OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_region, count));
    if (mesh->tet_axes)
        OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_axes, 9 * count));
    const size_t field = (size_t)ost_tet_fields_width(&mesh->fields);
    chunk->fields = mesh->fields;
    if (field > 0)
        OST_TRY(OST_NEW(chunk->ctx, &chunk->tet_field, field * count));
    for (size_t i = 0; i < count; i++) {
        const Leaf *leaf = &forest->leaf[i];
        for (int v = 0; v < 4; v++)
            chunk->tet_nodes[4 * i + (size_t)v] = making->number[leaf->vertex[v]];
        chunk->tet_label[i] = label[i];
        chunk->tet_region[i] = mesh->tet_region[leaf->root];
        if (mesh->tet_axes)
            memcpy(chunk->tet_axes + 9 * i, mesh->tet_axes + 9 * (size_t)leaf->root, 9 * sizeof(double));
        if (field > 0) {
            double place[4][4];
            for (int v = 0; v < 4; v++)
                ost_forest_barycentric(forest, leaf, v, place[v]);
            ost_tet_fields_inherit(&mesh->fields, mesh->tet_field + field * (size_t)leaf->root,
                                   (const double(*)[4])place, chunk->tet_field + field * i);
        }
    }
    return OST_SUCCESS;
}

/* Points on mid-edge nodes of the old mesh are left out. */
static OstStatus fill_points(const Making *making, const OstBoundary *from, OstBoundary *to)
{
    OST_TRY(OST_NEW(making->chunk->ctx, &to->nodes, from->count));
    for (OstLocal i = 0; i < from->count; i++)
        if (making->number[from->nodes[i]] >= 0)
            to->nodes[to->count++] = making->number[from->nodes[i]];
    return OST_SUCCESS;
}

static OstStatus fill_items(const Making *making)
{
    const Forest *forest = making->forest;
    OstMeshChunk *chunk = making->chunk;
    for (int b = 0; b < chunk->boundary_count; b++) {
        OstBoundary *to = &chunk->boundaries[b];
        to->nodes_per_item = to->dimension + 1;
        if (to->dimension == 0)
            OST_TRY(fill_points(making, &forest->mesh->boundaries[b], to));
        else {
            OstLocal count = 0;
            for (OstLocal i = 0; i < forest->item_count; i++)
                count += forest->item[i].boundary == b;
            OST_TRY(OST_NEW(chunk->ctx, &to->nodes, (size_t)count * (size_t)to->nodes_per_item));
        }
    }
    for (OstLocal i = 0; i < forest->item_count; i++) {
        const Item *item = &forest->item[i];
        OstBoundary *to = &chunk->boundaries[item->boundary];
        OstGlobal *nodes = to->nodes + (size_t)to->count++ * (size_t)to->nodes_per_item;
        for (int v = 0; v <= item->dimension; v++)
            nodes[v] = making->number[item->vertex[v]];
    }
    return OST_SUCCESS;
}

/* Regions and the names of boundaries, as a mesh inherits them. */
static OstStatus inherit(const OstMesh *mesh, OstMeshChunk *chunk)
{
    OstMesh *names = NULL;
    const OstStatus status = ost_mesh_inherit(mesh, 4, &names);
    if (status == OST_SUCCESS) {
        chunk->regions = names->regions;
        chunk->boundary_count = names->boundary_count;
        chunk->boundaries = names->boundaries;
        names->regions = (OstNames){0, NULL};
        names->boundary_count = 0;
        names->boundaries = NULL;
    }
    ost_mesh_destroy(&names);
    return status;
}

static OstStatus make(Making *making, OstGlobal **label)
{
    const Forest *forest = making->forest;
    OstContext *ctx = forest->ctx;
    OstMeshChunk *chunk = making->chunk;
    OstStatus status = OST_NEW(ctx, label, forest->leaf_count);
    OST_THEN(OST_NEW(ctx, &making->number, forest->vertex_count));
    OST_THEN(inherit(forest->mesh, chunk));
    OST_TRY(ost_agree(ctx, status));
    chunk->ctx = ctx;
    chunk->nodes_per_tet = 4;
    chunk->straighten = forest->mesh->straighten;
    if (!forest->shape)
        chunk->cut_off = forest->mesh->cut_off;
    OST_TRY(label_leaves(forest, *label));
    OST_TRY(number_nodes(making));
    OST_TRY(ost_number_from(ctx, forest->leaf_count, &chunk->first_tet, &chunk->global_tets));
    status = fill_nodes(making);
    OST_THEN(fill_tets(making, *label));
    OST_THEN(fill_items(making));
    return ost_agree(ctx, status);
}

OstStatus ost_forest_chunk(Forest *forest, OstMeshChunk **chunk, OstGlobal **leaf_label)
{
    Making making = {.forest = forest};
    *leaf_label = NULL;
    qsort(forest->leaf, (size_t)forest->leaf_count, sizeof *forest->leaf, compare_leaves);
    OstStatus status = ost_agree(forest->ctx, OST_NEW(forest->ctx, &making.chunk, 1));
    OST_THEN(make(&making, leaf_label));
    OST_FREE(making.number);
    if (status != OST_SUCCESS) {
        ost_chunk_destroy(&making.chunk);
        OST_FREE(*leaf_label);
    }
    *chunk = making.chunk;
    return status;
}
