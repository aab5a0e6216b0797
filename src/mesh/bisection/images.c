/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "core/parallel/reduce.h"
#include "mesh/bisection/forest.h"
#include "mesh/periods.h"

#include <stdlib.h>
#include <string.h>

/* Periodic pairs: an edge is cut where its image on the opposite boundary is. An edge is known by the place halfway
 * between its ends. */

/* Where an edge is to be cut: on a boundary of a pair. */
typedef struct Image {
    double x[3];
    int pair, follows; /* on the side that follows? */
} Image;

/* Both begin with a place. */
static int compare(const void *a, const void *b)
{
    const double p = *(const double *)a, q = *(const double *)b;
    return (p > q) - (p < q);
}

static void halfway(const Forest *forest, const OstLocal ends[2], double x[3])
{
    for (int d = 0; d < 3; d++)
        x[d] = 0.5 * forest->vertex[ends[0]].x[d] + 0.5 * forest->vertex[ends[1]].x[d];
}

/* The images of an edge that is cut. */
static OstStatus add_images(const Forest *forest, const ForestVertex *cut, OstLocal *count, Image **image)
{
    const OstPeriods *periods = forest->periods;
    double x[3];
    halfway(forest, cut->ends, x);
    for (int p = 0; p < periods->count; p++)
        for (int follows = 0; follows < 2; follows++) {
            if (!((follows ? cut->leads : cut->follows) >> p & 1U))
                continue;
            OST_TRY(FOREST_ROOM(forest, *count, image));
            Image *one = &(*image)[(*count)++];
            *one = (Image){.pair = p, .follows = follows};
            for (int d = 0; d < 3; d++)
                one->x[d] = follows ? x[d] + periods->period[p][d] : x[d] - periods->period[p][d];
        }
    return OST_SUCCESS;
}

/* Of the edges that this rank's vertices cut. */
static OstStatus list_images(const Forest *forest, OstLocal *count, Image **image)
{
    for (OstLocal n = forest->mesh->node_count; n < forest->vertex_count; n++) {
        const ForestVertex *vertex = &forest->vertex[n];
        if (vertex->holder == ost_rank(forest->ctx) && (vertex->leads | vertex->follows))
            OST_TRY(add_images(forest, vertex, count, image));
    }
    return OST_SUCCESS;
}

static int is_image(const Forest *forest, OstLocal edge, OstLocal count, const Image *image)
{
    const double within = forest->periods->within;
    OstLocal ends[2];
    double x[3];
    ost_forest_ends(forest, edge, ends);
    const ForestVertex *a = &forest->vertex[ends[0]], *b = &forest->vertex[ends[1]];
    const uint32_t side[2] = {a->leads & b->leads, a->follows & b->follows};
    if (!(side[0] | side[1]))
        return 0;
    halfway(forest, ends, x);
    for (OstLocal i = ost_first_by_x(count, sizeof *image, image, x[0] - within);
         i < count && image[i].x[0] <= x[0] + within; i++)
        if ((side[image[i].follows] >> image[i].pair & 1U) && ost_is_same_place(image[i].x, x, within))
            return 1;
    return 0;
}

OstStatus ost_forest_want_images(Forest *forest, OstGlobal *wanted)
{
    Image *mine = NULL, *all = NULL;
    OstLocal count = 0, total = 0;
    *wanted = 0;
    if (!forest->periods)
        return OST_SUCCESS;
    OstStatus status = ost_agree(forest->ctx, list_images(forest, &count, &mine));
    OST_THEN(ost_gather_items(forest->ctx, sizeof *mine, mine, count, "too many edges of periodic pairs are cut",
                              (void **)&all, &total));
    if (status == OST_SUCCESS && total > 0)
        qsort(all, (size_t)total, sizeof *all, compare);
    for (OstLocal e = 0; status == OST_SUCCESS && e < forest->edges->count; e++) {
        ForestEdge *edge = &forest->edge[e];
        if (edge->cut >= 0 || edge->wanted || !is_image(forest, e, total, all))
            continue;
        edge->wanted = 1;
        (*wanted)++;
    }
    OST_FREE(mine, all);
    OST_THEN(ost_sum_numbers(forest->ctx, 1, wanted));
    return status;
}

/* --- where the new vertices are --- */

/* A new vertex that leads and follows none. */
typedef struct Leader {
    double x[3];  /* halfway between its edge's ends */
    double at[3]; /* where it is */
    OstGlobal label, flat;
} Leader;

static OstStatus list_leaders(const Forest *forest, OstLocal *count, Leader **leader)
{
    for (OstLocal n = forest->mesh->node_count; n < forest->vertex_count; n++) {
        const ForestVertex *vertex = &forest->vertex[n];
        if (vertex->holder != ost_rank(forest->ctx) || !vertex->leads || vertex->follows)
            continue;
        OST_TRY(FOREST_ROOM(forest, *count, leader));
        Leader *one = &(*leader)[(*count)++];
        *one = (Leader){.label = vertex->label, .flat = vertex->flat};
        halfway(forest, vertex->ends, one->x);
        memcpy(one->at, vertex->x, sizeof one->at);
    }
    return OST_SUCCESS;
}

static void follow(Forest *forest, ForestVertex *vertex, OstLocal count, const Leader *leader)
{
    static const double nowhere[3] = {0.0};
    const double within = forest->periods->within;
    double middle[3], back[3], shift[3];
    halfway(forest, vertex->ends, middle);
    ost_periods_back(forest->periods, vertex->follows, middle, back);
    ost_periods_back(forest->periods, vertex->follows, nowhere, shift);
    for (OstLocal i = ost_first_by_x(count, sizeof *leader, leader, back[0] - within);
         i < count && leader[i].x[0] <= back[0] + within; i++) {
        if (!ost_is_same_place(leader[i].x, back, within))
            continue;
        vertex->leader = leader[i].label;
        vertex->flat = (char)leader[i].flat;
        const double x[3] = {leader[i].at[0] - shift[0], leader[i].at[1] - shift[1], leader[i].at[2] - shift[2]};
        if (!ost_is_same_place(vertex->x, x, within))
            memcpy(vertex->x, x, sizeof x);
    }
}

/* Ends come before what cuts their edge. */
OstStatus ost_forest_follow(Forest *forest)
{
    Leader *mine = NULL, *all = NULL;
    OstLocal count = 0, total = 0;
    if (!forest->periods)
        return OST_SUCCESS;
    OstStatus status = ost_agree(forest->ctx, list_leaders(forest, &count, &mine));
    OST_THEN(ost_gather_items(forest->ctx, sizeof *mine, mine, count, "too many edges of periodic pairs are cut",
                              (void **)&all, &total));
    if (status == OST_SUCCESS && total > 0)
        qsort(all, (size_t)total, sizeof *all, compare);
    for (OstLocal n = forest->mesh->node_count; status == OST_SUCCESS && n < forest->vertex_count; n++)
        if (forest->vertex[n].follows)
            follow(forest, &forest->vertex[n], total, all);
    OST_FREE(mine, all);
    return status;
}
