/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "mesh/bisection/forest.h"
#include "mesh/check/check.h"
#include "mesh/periods.h"

#include <string.h>

struct OstBisection {
    OstContext *ctx;
    const OstMesh *mesh;   /* to be bisected next */
    OstTag *tag;           /* of each of its local tets */
    int pairs;             /* periodic ones */
    OstPeriodicPair *pair; /* their names are the caller's */
    Forest *forest;        /* of the last split: from the mesh before */
    OstGlobal *leaf_label; /* of the forest's leaves: labels of the new mesh's tets */
    int settled;           /* is there a mesh made of them? */
    int curved;            /* has that mesh curved edges, which no shape says better? */
};

void ost_bisection_destroy(OstBisection **bisection)
{
    if (!*bisection)
        return;
    OST_FREE((*bisection)->tag, (*bisection)->pair, (*bisection)->leaf_label);
    ost_forest_destroy(&(*bisection)->forest);
    OST_FREE(*bisection);
}

/* --- the first tags --- */

/* A tet's edge, to be compared with its others. Lengths that differ by rounding count as equal, and labels decide: so
 * equal cells are cut alike. */
typedef struct EdgeRank {
    float square;
    OstKey key;
} EdgeRank;

static int is_longer(const EdgeRank *a, const EdgeRank *b)
{
    if (a->square != b->square)
        return a->square > b->square;
    return a->key.low != b->key.low ? a->key.low < b->key.low : a->key.high < b->key.high;
}

/* The node that counts for this one, as an end of an edge on the following boundaries of these pairs. */
static OstPeriodicNode node_for(const OstMesh *mesh, const OstPeriods *periods, uint32_t pairs, OstLocal node)
{
    const double *x = mesh->coordinates + 3 * (size_t)node;
    OstPeriodicNode itself = {.label = mesh->node_label[node]};
    double back[3];
    memcpy(itself.x, x, sizeof itself.x);
    if (pairs == 0)
        return itself;
    ost_periods_back(periods, pairs, x, back);
    const OstPeriodicNode *image = ost_periods_find(periods, back);
    return image ? *image : itself;
}

/* Of edges on a boundary that follows, their images decide: so both are marked alike. */
static EdgeRank rank_of(const OstMesh *mesh, const OstPeriods *periods, OstLocal a, OstLocal b)
{
    const uint32_t pairs = periods ? periods->follows[a] & periods->follows[b] : 0;
    const OstPeriodicNode from = node_for(mesh, periods, pairs, a), to = node_for(mesh, periods, pairs, b);
    double square = 0.0;
    for (int d = 0; d < 3; d++) {
        const double step = to.x[d] - from.x[d];
        square += step * step;
    }
    return (EdgeRank){(float)square, ost_key(from.label, to.label)};
}

static OstTag first_tag(const OstMesh *mesh, const OstPeriods *periods, OstLocal tet)
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    EdgeRank edge[6];
    int rank[6] = {0};
    for (int e = 0; e < 6; e++)
        edge[e] = rank_of(mesh, periods, nodes[ost_tet_edge[e][0]], nodes[ost_tet_edge[e][1]]);
    for (int e = 0; e < 6; e++)
        for (int f = 0; f < 6; f++)
            rank[e] += f != e && is_longer(&edge[f], &edge[e]);
    return ost_tag_first(rank);
}

OstStatus ost_bisection_create(const OstMesh *mesh, OstBisection **bisection)
{
    OstContext *ctx = mesh->ctx;
    ost_ledger_enter(ctx, OST_LEDGER_MESH);
    OstStatus status = OST_NEW(ctx, bisection, 1);
    if (status == OST_SUCCESS) {
        (*bisection)->ctx = ctx;
        (*bisection)->mesh = mesh;
        status = OST_NEW(ctx, &(*bisection)->tag, mesh->tet_count);
    }
    for (OstLocal t = 0; status == OST_SUCCESS && t < mesh->tet_count; t++)
        (*bisection)->tag[t] = first_tag(mesh, NULL, t);
    status = ost_agree(ctx, status);
    if (status != OST_SUCCESS)
        ost_bisection_destroy(bisection);
    ost_ledger_leave(ctx);
    return status;
}

/* --- periodic pairs --- */

static OstStatus check_pairs(const OstMesh *mesh, int count, const OstPeriodicPair *pair)
{
    for (int p = 0; p < 2 * count; p++) {
        const char *name = p % 2 ? pair[p / 2].follows : pair[p / 2].leads;
        const int b = ost_mesh_find_boundary(mesh, name);
        if (b >= 0 && mesh->boundaries[b].dimension != 2)
            return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                             "boundary '%.80s' is of %s, and a periodic pair that is refined is one of faces; name "
                             "boundaries of faces",
                             name, mesh->boundaries[b].dimension == 1 ? "curves" : "points");
    }
    return OST_SUCCESS;
}

OstStatus ost_bisection_pair(OstBisection *bisection, int count, const OstPeriodicPair *pair)
{
    const OstMesh *mesh = bisection->mesh;
    OstPeriods *periods = NULL;
    if (bisection->forest || bisection->pairs > 0)
        return OST_RAISE(bisection->ctx, OST_INVALID_INPUT, "periodic pairs are stated once, before tets are cut");
    if (count == 0)
        return OST_SUCCESS;
    OST_TRY(check_pairs(mesh, count, pair));
    ost_ledger_enter(bisection->ctx, OST_LEDGER_MESH);
    OstStatus status = ost_agree(bisection->ctx, OST_NEW(bisection->ctx, &bisection->pair, count));
    OST_THEN(ost_periods_create(mesh, count, pair, &periods));
    if (status == OST_SUCCESS) {
        bisection->pairs = count;
        memcpy(bisection->pair, pair, (size_t)count * sizeof *pair);
        for (OstLocal t = 0; t < mesh->tet_count; t++)
            bisection->tag[t] = first_tag(mesh, periods, t);
    } else
        OST_FREE(bisection->pair);
    ost_periods_destroy(&periods);
    ost_ledger_leave(bisection->ctx);
    return status;
}

/* --- carrying --- */

/* What this rank's leaves know of the new mesh's nodes: of each, what the root with the lowest label says, so that it
 * does not depend on the ranks. Vertices come first, then edges. */
typedef struct Load {
    const Forest *forest;
    int width;
    const double *old; /* NULL: where the nodes are */
    OstLocal count;
    OstLocal *place; /* of vertices and edges: 1 + item, or 0 */
    OstKey *key;
    OstGlobal *order;
    double *value;
} Load;

static void load_point(Load *load, const Leaf *leaf, OstLocal point, OstKey key, const double b[4])
{
    const OstMesh *mesh = load->forest->mesh;
    const OstGlobal root = mesh->tet_label[leaf->root];
    if (load->place[point] == 0) {
        load->place[point] = ++load->count;
        load->order[load->count - 1] = INT64_MAX;
    }
    const OstLocal item = load->place[point] - 1;
    if (root >= load->order[item])
        return;
    load->key[item] = key;
    load->order[item] = root;
    ost_forest_value(mesh, leaf->root, b, load->width, load->old ? load->old : mesh->coordinates,
                     load->value + (size_t)item * (size_t)load->width);
}

/* Where a vertex is, on the old curve or not; edges at one that is put halfway are straight. */
static void straighten(Load *load, OstLocal point, OstLocal p, OstLocal q)
{
    const ForestVertex *from = &load->forest->vertex[p], *to = &load->forest->vertex[q];
    double *x = load->value + 3 * (size_t)(load->place[point] - 1);
    for (int d = 0; d < 3 && !load->old && (p == q || from->flat || to->flat); d++)
        x[d] = 0.5 * from->x[d] + 0.5 * to->x[d];
}

static void load_leaf(Load *load, const Leaf *leaf, int with_edges)
{
    const Forest *forest = load->forest;
    OstGlobal label[4];
    double b[4][4];
    for (int v = 0; v < 4; v++) {
        label[v] = forest->vertex[leaf->vertex[v]].label;
        ost_forest_barycentric(forest, leaf, v, b[v]);
        load_point(load, leaf, leaf->vertex[v], ost_key(label[v], label[v]), b[v]);
        straighten(load, leaf->vertex[v], leaf->vertex[v], leaf->vertex[v]);
    }
    for (int e = 0; with_edges && e < 6; e++) {
        const int p = ost_tet_edge[e][0], q = ost_tet_edge[e][1];
        double middle[4];
        for (int v = 0; v < 4; v++)
            middle[v] = 0.5 * (b[p][v] + b[q][v]);
        load_point(load, leaf, forest->vertex_count + leaf->edge[e], ost_key(label[p], label[q]), middle);
        straighten(load, forest->vertex_count + leaf->edge[e], leaf->vertex[p], leaf->vertex[q]);
    }
}

static OstStatus load_all(Load *load, int with_edges)
{
    const Forest *forest = load->forest;
    OstContext *ctx = forest->ctx;
    const size_t points = (size_t)forest->vertex_count + (size_t)forest->edges->count;
    OST_TRY(OST_NEW(ctx, &load->place, points));
    OST_TRY(OST_NEW(ctx, &load->key, points));
    OST_TRY(OST_NEW(ctx, &load->order, points));
    OST_TRY(OST_NEW(ctx, &load->value, points * (size_t)load->width));
    for (OstLocal i = 0; i < forest->leaf_count; i++)
        load_leaf(load, &forest->leaf[i], with_edges);
    return OST_SUCCESS;
}

/* The keys of a mesh's own nodes. */
static void node_keys(const OstMesh *mesh, OstKey *key)
{
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, t);
        for (int n = 0; n < mesh->nodes_per_tet; n++) {
            const int a = n < 4 ? n : ost_tet_edge[n - 4][0], b = n < 4 ? n : ost_tet_edge[n - 4][1];
            if (nodes[n] < mesh->owned_nodes)
                key[nodes[n]] = ost_key(mesh->node_label[nodes[a]], mesh->node_label[nodes[b]]);
        }
    }
}

static OstStatus carry(const Forest *forest, int width, const double *old, const OstMesh *mesh, double *carried)
{
    OstContext *ctx = forest->ctx;
    const size_t size = (size_t)width * sizeof *carried;
    Load load = {.forest = forest, .width = width, .old = old};
    OstKey *key = NULL;
    OstStatus status = load_all(&load, mesh->nodes_per_tet == 10);
    OST_THEN(OST_NEW(ctx, &key, mesh->owned_nodes));
    OST_TRY_DONE(ost_agree(ctx, status));
    node_keys(mesh, key);
    const OstKeyed known = {load.count, load.key, load.order, load.value};
    OST_TRY_DONE(ost_rendezvous(ctx, "node between vertices", size, &known, mesh->owned_nodes, key, carried));
    OST_TRY_DONE(ost_agree(ctx, ost_halo_import(mesh->halo, size, carried)));
done:
    OST_FREE(key, load.place, load.key, load.order, load.value);
    return status;
}

OstStatus ost_bisection_carry(const OstBisection *bisection, int width, const double *old, double *carried)
{
    OstContext *ctx = bisection->ctx;
    if (!bisection->settled || width < 1 || (size_t)width * sizeof *carried > OST_LARGEST_ENTRY)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "there is no bisected mesh to carry %d numbers a node to; call ost_bisection_settle first, "
                         "and carry 1 to %d numbers",
                         width, (int)(OST_LARGEST_ENTRY / sizeof *carried));
    ost_ledger_enter(ctx, OST_LEDGER_MESH);
    const OstStatus status = carry(bisection->forest, width, old, bisection->mesh, carried);
    ost_ledger_leave(ctx);
    return status;
}

/* --- one generation --- */

static OstStatus grow(OstBisection *bisection, const unsigned char *times, const OstShapeSurface *shape)
{
    const OstMesh *mesh = bisection->mesh;
    OstPeriods *periods = NULL;
    if (bisection->pairs > 0)
        OST_TRY(ost_periods_create(mesh, bisection->pairs, bisection->pair, &periods));
    OstStatus status = ost_forest_create(mesh, bisection->tag, shape, periods, &bisection->forest);
    OST_THEN(ost_forest_grow(bisection->forest, times));
    if (bisection->forest)
        bisection->forest->periods = NULL;
    ost_periods_destroy(&periods);
    return status;
}

static OstStatus split(OstBisection *bisection, const unsigned char *times, const OstShapeSurface *shape,
                       OstMeshChunk **chunk)
{
    ost_forest_destroy(&bisection->forest);
    OST_FREE(bisection->leaf_label);
    bisection->settled = 0;
    OST_TRY(grow(bisection, times, shape));
    if (!bisection->forest->shape) /* the finer mesh no longer shows it */
        OST_TRY(ost_mesh_cut_off(bisection->mesh, &(OstCutOff){0}));
    OST_TRY(ost_forest_chunk(bisection->forest, chunk, &bisection->leaf_label));
    bisection->curved = bisection->mesh->nodes_per_tet == 10 && !bisection->forest->shape;
    return OST_SUCCESS;
}

OstStatus ost_bisection_split(OstBisection *bisection, const unsigned char *times, const OstShapeSurface *shape,
                              OstMeshChunk **chunk)
{
    *chunk = NULL;
    ost_ledger_enter(bisection->ctx, OST_LEDGER_MESH);
    const OstStatus status = split(bisection, times, shape, chunk);
    if (status != OST_SUCCESS) {
        ost_forest_destroy(&bisection->forest);
        OST_FREE(bisection->leaf_label);
    }
    ost_ledger_leave(bisection->ctx);
    return status;
}

/* Values of the new mesh's first `count` tets, from the ranks that cut them: `value` has `size` bytes for each leaf. */
static OstStatus fetch(const OstBisection *bisection, const OstMesh *mesh, size_t size, const void *value,
                       OstLocal count, void *fetched)
{
    OstContext *ctx = bisection->ctx;
    const OstLocal leaves = bisection->forest->leaf_count;
    OstKey *known = NULL, *key = NULL;
    OstStatus status = OST_NEW(ctx, &known, leaves);
    OST_THEN(OST_NEW(ctx, &key, count));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (OstLocal i = 0; i < leaves; i++)
        known[i] = ost_key(bisection->leaf_label[i], bisection->leaf_label[i]);
    for (OstLocal t = 0; t < count; t++)
        key[t] = ost_key(mesh->tet_label[t], mesh->tet_label[t]);
    OST_TRY_DONE(ost_rendezvous(ctx, "tet", size, &(OstKeyed){leaves, known, NULL, value}, count, key, fetched));
done:
    OST_FREE(known, key);
    return status;
}

static OstStatus fetch_tags(const OstBisection *bisection, const OstMesh *mesh, OstTag *tag)
{
    const Forest *forest = bisection->forest;
    OstTag *told = NULL;
    OST_TRY(ost_agree(bisection->ctx, OST_NEW(bisection->ctx, &told, forest->leaf_count)));
    for (OstLocal i = 0; i < forest->leaf_count; i++)
        told[i] = forest->leaf[i].tag;
    const OstStatus status = fetch(bisection, mesh, sizeof *tag, told, mesh->tet_count, tag);
    OST_FREE(told);
    return status;
}

/* The roots' numbers, then the number of cuts. */
static void list_roots(const Forest *forest, size_t width, const double *old, double *row)
{
    for (OstLocal i = 0; i < forest->leaf_count; i++, row += width + 1) {
        const Leaf *leaf = &forest->leaf[i];
        memcpy(row, old + (size_t)leaf->root * width, width * sizeof *row);
        row[width] = leaf->depth;
    }
}

OstStatus ost_bisection_carry_tets(const OstBisection *bisection, int width, const double *old, double *carried,
                                   int *cuts)
{
    OstContext *ctx = bisection->ctx;
    const OstMesh *mesh = bisection->mesh;
    const size_t all = (size_t)width + 1;
    double *told = NULL, *heard = NULL;
    if (!bisection->settled)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "there is no bisected mesh to carry to; call ost_bisection_settle first");
    ost_ledger_enter(ctx, OST_LEDGER_MESH);
    OstStatus status = OST_NEW(ctx, &told, all * (size_t)bisection->forest->leaf_count);
    OST_THEN(OST_NEW(ctx, &heard, all * (size_t)mesh->owned_tets));
    OST_TRY_DONE(ost_agree(ctx, status));
    list_roots(bisection->forest, (size_t)width, old, told);
    OST_TRY_DONE(fetch(bisection, mesh, all * sizeof *told, told, mesh->owned_tets, heard));
    for (size_t t = 0; t < (size_t)mesh->owned_tets; t++) {
        memcpy(carried + t * (size_t)width, heard + t * all, (size_t)width * sizeof *carried);
        cuts[t] = (int)heard[t * all + (size_t)width];
    }
done:
    OST_FREE(told, heard);
    ost_ledger_leave(ctx);
    return status;
}

/* Mid-edge nodes of the new mesh go where the old tets, which may be curved, have them. A piece that folds over, as the
 * old tet did between its nodes, becomes straight. */
static OstStatus bend(const OstBisection *bisection, OstMesh *mesh)
{
    OST_TRY(carry(bisection->forest, 3, NULL, mesh, mesh->coordinates));
    mesh->straighten = 1;
    return ost_check_folds(mesh);
}

static OstStatus settle(OstBisection *bisection, OstMesh *mesh)
{
    OstContext *ctx = bisection->ctx;
    OstTag *tag = NULL;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &tag, mesh->tet_count)));
    OstStatus status = fetch_tags(bisection, mesh, tag);
    if (status == OST_SUCCESS && bisection->curved && mesh->nodes_per_tet == 10)
        status = bend(bisection, mesh);
    if (status != OST_SUCCESS) {
        OST_FREE(tag);
        return status;
    }
    OST_FREE(bisection->tag);
    bisection->settled = 1;
    bisection->tag = tag;
    bisection->mesh = mesh;
    return OST_SUCCESS;
}

OstStatus ost_bisection_settle(OstBisection *bisection, OstMesh *mesh)
{
    if (!bisection->leaf_label || bisection->settled)
        return OST_RAISE(bisection->ctx, OST_INVALID_INPUT,
                         "there is no chunk that a new mesh could be made of; call ost_bisection_split first");
    ost_ledger_enter(bisection->ctx, OST_LEDGER_MESH);
    const OstStatus status = settle(bisection, mesh);
    ost_ledger_leave(bisection->ctx);
    return status;
}

OstStatus ost_bisection_refine(OstBisection *bisection, const unsigned char *times, const OstShapeSurface *shape,
                               OstMesh **fine)
{
    OstContext *ctx = bisection->ctx;
    const int quadratic = bisection->mesh->nodes_per_tet == 10;
    OstMeshChunk *chunk = NULL;
    OstMesh *linear = NULL;
    *fine = NULL;
    OstStatus status = ost_bisection_split(bisection, times, shape, &chunk);
    OST_THEN(ost_mesh_distribute(ctx, &chunk, &linear));
    if (status == OST_SUCCESS && quadratic) {
        status = ost_mesh_raise(linear, shape, fine);
        ost_mesh_destroy(&linear);
    } else
        *fine = linear;
    OST_THEN(ost_bisection_settle(bisection, *fine));
    ost_chunk_destroy(&chunk);
    if (status != OST_SUCCESS)
        ost_mesh_destroy(fine);
    return status;
}
