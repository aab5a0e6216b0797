/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "core/parallel/reduce.h"
#include "mesh/bisection/forest.h"

#include <math.h>
#include <stdlib.h>

/* A coarse tet may be curved so far that the straight tets of its pieces turn over: an edge's middle is then put
 * halfway between its ends. */

/* Of its share of the root's volume, a leaf has this much at least. */
static const double least_share = 0.1;

enum { MOST_ROUNDS = 20 };

static double volume_of(const Forest *forest, const Leaf *leaf)
{
    static const OstLocal corner[4] = {0, 1, 2, 3};
    double x[12];
    for (int v = 0; v < 4; v++)
        for (int d = 0; d < 3; d++)
            x[3 * v + d] = forest->vertex[leaf->vertex[v]].x[d];
    return ost_tet_volume(x, corner);
}

static double halfway(const Forest *forest, const ForestVertex *vertex, int d)
{
    return 0.5 * forest->vertex[vertex->ends[0]].x[d] + 0.5 * forest->vertex[vertex->ends[1]].x[d];
}

static int is_curved(const Forest *forest, const ForestVertex *vertex)
{
    int curved = 0;
    for (int d = 0; d < 3 && vertex->ends[0] >= 0 && !vertex->flat; d++)
        curved |= vertex->x[d] != halfway(forest, vertex, d);
    return curved;
}

/* The labels of curved cuts at leaves that turn over. */
static OstStatus list(const Forest *forest, OstLocal *count, OstGlobal **label)
{
    const OstMesh *mesh = forest->mesh;
    for (OstLocal i = 0; i < forest->leaf_count; i++) {
        const Leaf *leaf = &forest->leaf[i];
        const double root = ost_tet_volume(mesh->coordinates, ost_mesh_nodes_of(mesh, leaf->root));
        if (leaf->depth == 0 || volume_of(forest, leaf) > least_share * ldexp(root, -leaf->depth))
            continue;
        for (int v = 0; v < 4; v++) {
            if (!is_curved(forest, &forest->vertex[leaf->vertex[v]]))
                continue;
            OST_TRY(FOREST_ROOM(forest, *count, label));
            const ForestVertex *vertex = &forest->vertex[leaf->vertex[v]];
            (*label)[(*count)++] = vertex->leader > 0 ? vertex->leader : vertex->label;
        }
    }
    return OST_SUCCESS;
}

static int compare(const void *a, const void *b)
{
    const OstGlobal x = *(const OstGlobal *)a, y = *(const OstGlobal *)b;
    return (x > y) - (x < y);
}

/* Ends come before what cuts their edge. Where an end has moved, so does a middle between straight ones. */
static void move(Forest *forest, OstLocal count, const OstGlobal *label)
{
    for (OstLocal n = forest->mesh->node_count; n < forest->vertex_count; n++) {
        ForestVertex *vertex = &forest->vertex[n];
        if (count > 0 && bsearch(&vertex->label, label, (size_t)count, sizeof *label, compare))
            vertex->flat = 1;
        for (int d = 0; d < 3 && vertex->flat; d++)
            vertex->x[d] = halfway(forest, vertex, d);
    }
}

/* One round; *found: how many are told of. */
static OstStatus flatten(Forest *forest, OstLocal *found)
{
    OstGlobal *mine = NULL, *all = NULL;
    OstLocal count = 0;
    OstStatus status = ost_agree(forest->ctx, list(forest, &count, &mine));
    OST_THEN(ost_gather_items(forest->ctx, sizeof *mine, mine, count, "too many curved edges are to be straight",
                              (void **)&all, found));
    if (status == OST_SUCCESS && *found > 0) {
        qsort(all, (size_t)*found, sizeof *all, compare);
        move(forest, *found, all);
        status = ost_forest_follow(forest);
    }
    OST_FREE(mine, all);
    return status;
}

OstStatus ost_forest_flatten(Forest *forest)
{
    OstGlobal flat = 0;
    OstLocal found = 1;
    if (!forest->shape && forest->mesh->nodes_per_tet == 4)
        return OST_SUCCESS;
    OST_TRY(ost_forest_follow(forest));
    for (int round = 0; round < MOST_ROUNDS && found > 0; round++)
        OST_TRY(flatten(forest, &found));
    for (OstLocal n = forest->mesh->node_count; n < forest->vertex_count; n++)
        flat += forest->vertex[n].flat && forest->vertex[n].holder == ost_rank(forest->ctx);
    OST_TRY(ost_sum_numbers(forest->ctx, 1, &flat));
    if (flat > 0)
        ost_warn(
            forest->ctx,
            "curved tets would turn over when they are cut: %lld new vertices are halfway between the ends of their "
            "edges, and the body is that much less round; begin with a finer mesh where it is curved",
            (long long)flat);
    return OST_SUCCESS;
}
