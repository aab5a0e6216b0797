/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/periods.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/gather.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Of the body's diagonal. */
static const double relative_within = 1e-6;

void ost_periods_destroy(OstPeriods **periods)
{
    if (!*periods)
        return;
    OST_FREE((*periods)->leads, (*periods)->follows, (*periods)->place, (*periods)->node);
    OST_FREE(*periods);
}

static void place_nodes(const OstMesh *mesh, double *place)
{
    memcpy(place, mesh->coordinates, 3 * (size_t)mesh->node_count * sizeof *place);
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, t);
        for (int e = 0; e < mesh->nodes_per_tet - 4; e++) {
            const double *a = mesh->coordinates + 3 * (size_t)nodes[ost_tet_edge[e][0]];
            const double *b = mesh->coordinates + 3 * (size_t)nodes[ost_tet_edge[e][1]];
            for (size_t d = 0; d < 3; d++)
                place[3 * (size_t)nodes[4 + e] + d] = 0.5 * a[d] + 0.5 * b[d];
        }
    }
}

/* Marks the owned nodes of a boundary, and finds their mean. */
static OstStatus mark_side(const OstPeriods *periods, const char *name, uint32_t bit, uint32_t *marks, double mean[3])
{
    const OstMesh *mesh = periods->mesh;
    const int b = ost_mesh_find_boundary(mesh, name);
    double sums[4] = {0.0};
    if (b < 0)
        return OST_RAISE(mesh->ctx, OST_INVALID_INPUT, "there is no boundary '%.80s'", name);
    const OstBoundary *boundary = &mesh->boundaries[b];
    for (size_t i = 0; i < (size_t)boundary->count * (size_t)boundary->nodes_per_item; i++)
        marks[boundary->nodes[i]] |= bit;
    for (OstLocal n = 0; n < mesh->owned_nodes; n++)
        if (marks[n] & bit) {
            sums[3] += 1.0;
            for (size_t k = 0; k < 3; k++)
                sums[k] += periods->place[3 * (size_t)n + k];
        }
    OST_TRY(ost_sum(mesh->ctx, 4, sums));
    if (!(sums[3] > 0.0))
        return OST_RAISE(mesh->ctx, OST_INVALID_INPUT, "boundary '%.80s' has no nodes", name);
    for (int k = 0; k < 3; k++)
        mean[k] = sums[k] / sums[3];
    return OST_SUCCESS;
}

static OstStatus mark_sides(OstPeriods *periods, const OstPeriodicPair *pair)
{
    const OstMesh *mesh = periods->mesh;
    for (int p = 0; p < periods->count; p++) {
        double from[3], to[3];
        OST_TRY(mark_side(periods, pair[p].leads, 1U << p, periods->leads, from));
        OST_TRY(mark_side(periods, pair[p].follows, 1U << p, periods->follows, to));
        for (int i = 0; i < 3; i++)
            periods->period[p][i] = to[i] - from[i];
        if (!(ost_norm3(periods->period[p]) > periods->within))
            return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                             "boundaries '%.60s' and '%.60s' lie in the same place; name opposite ones", pair[p].leads,
                             pair[p].follows);
    }
    /* owners know all items at their nodes */
    OST_TRY(ost_halo_import(mesh->halo, sizeof *periods->leads, periods->leads));
    return ost_halo_import(mesh->halo, sizeof *periods->follows, periods->follows);
}

static int compare_nodes(const void *a, const void *b)
{
    const OstPeriodicNode *p = a, *q = b;
    return (p->x[0] > q->x[0]) - (p->x[0] < q->x[0]);
}

static OstStatus gather_nodes(OstPeriods *periods)
{
    const OstMesh *mesh = periods->mesh;
    OstPeriodicNode *mine = NULL;
    OstLocal count = 0;
    OST_TRY(ost_agree(mesh->ctx, OST_NEW(mesh->ctx, &mine, mesh->owned_nodes)));
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        if (!periods->leads[n])
            continue;
        OstPeriodicNode *node = &mine[count++];
        node->number = mesh->node_number[n];
        node->label = mesh->node_label[n];
        node->follows = periods->follows[n] != 0;
        memcpy(node->x, periods->place + 3 * (size_t)n, sizeof node->x);
        memcpy(node->at, mesh->coordinates + 3 * (size_t)n, sizeof node->at);
    }
    const OstStatus status =
        ost_gather_items(mesh->ctx, sizeof *mine, mine, count, "a periodic pair has too many vertices",
                         (void **)&periods->node, &periods->nodes);
    OST_FREE(mine);
    if (status == OST_SUCCESS && periods->nodes > 0)
        qsort(periods->node, (size_t)periods->nodes, sizeof *periods->node, compare_nodes);
    return status;
}

static OstStatus fill(OstPeriods *periods, const OstPeriodicPair *pair)
{
    const OstMesh *mesh = periods->mesh;
    double low[3], high[3];
    OstStatus status = OST_NEW(mesh->ctx, &periods->leads, mesh->node_count);
    OST_THEN(OST_NEW(mesh->ctx, &periods->follows, mesh->node_count));
    OST_THEN(OST_NEW(mesh->ctx, &periods->place, 3 * (size_t)mesh->node_count));
    OST_TRY(ost_agree(mesh->ctx, status));
    OST_TRY(ost_mesh_bounds(mesh, low, high));
    place_nodes(mesh, periods->place);
    periods->within = relative_within * ost_norm3((double[3]){high[0] - low[0], high[1] - low[1], high[2] - low[2]});
    OST_TRY(mark_sides(periods, pair));
    return gather_nodes(periods);
}

OstStatus ost_periods_create(const OstMesh *mesh, int count, const OstPeriodicPair *pair, OstPeriods **periods)
{
    if (count > OST_MOST_PERIODS)
        return OST_RAISE(mesh->ctx, OST_LIMIT_EXCEEDED,
                         "there are %d periodic pairs, at most %d can be; leave some out", count, OST_MOST_PERIODS);
    OST_TRY(ost_agree(mesh->ctx, OST_NEW(mesh->ctx, periods, 1)));
    (*periods)->mesh = mesh;
    (*periods)->count = count;
    const OstStatus status = fill(*periods, pair);
    if (status != OST_SUCCESS)
        ost_periods_destroy(periods);
    return status;
}

void ost_periods_back(const OstPeriods *periods, uint32_t pairs, const double x[3], double back[3])
{
    memcpy(back, x, 3 * sizeof *back);
    for (int p = 0; p < periods->count; p++)
        for (int i = 0; i < 3 && (pairs >> p & 1U); i++)
            back[i] -= periods->period[p][i];
}

int ost_is_same_place(const double a[3], const double b[3], double within)
{
    return fabs(a[0] - b[0]) <= within && fabs(a[1] - b[1]) <= within && fabs(a[2] - b[2]) <= within;
}

OstLocal ost_first_by_x(OstLocal count, size_t size, const void *items, double x)
{
    OstLocal low = 0, high = count;
    while (low < high) {
        const OstLocal middle = low + (high - low) / 2;
        const double *at = (const double *)(const void *)((const char *)items + (size_t)middle * size);
        if (*at < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

const OstPeriodicNode *ost_periods_find(const OstPeriods *periods, const double x[3])
{
    const OstPeriodicNode *found = NULL;
    const double within = periods->within;
    OstLocal n = ost_first_by_x(periods->nodes, sizeof *periods->node, periods->node, x[0] - within);
    for (; n < periods->nodes && periods->node[n].x[0] <= x[0] + within; n++)
        if (ost_is_same_place(periods->node[n].x, x, within) && (!found || found->follows))
            found = &periods->node[n];
    return found;
}
