/* SPDX-License-Identifier: BSD-3-Clause */
#include "probe/locate.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "element/element.h"
#include "element/shape_functions.h"
#include "element/tets.h"

#include <stdlib.h>

/* A point this much outside, of a tet's height, is on its surface but for rounding; one that is less than `near`
 * outside belongs to the tet if no other holds it. */
static const double rounding = 1e-9, near = 0.05;

/* Points in ascending order of x. */
typedef struct Sorted {
    double x;
    OstLocal point;
} Sorted;

static int by_x(const void *a, const void *b)
{
    const Sorted *one = a, *two = b;
    return one->x != two->x ? (one->x > two->x) - (one->x < two->x)
                            : (one->point > two->point) - (one->point < two->point);
}

/* The first that is not left of x. */
static OstLocal first_from(OstLocal count, const Sorted *sorted, double x)
{
    OstLocal low = 0, high = count;
    while (low < high) {
        const OstLocal middle = low + (high - low) / 2;
        if (sorted[middle].x < x)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* One tet, and a box around its nodes that is larger than it by `near`. */
typedef struct Tet {
    int nodes;
    double x[3 * OST_MAX_TET_NODES];
    double low[3], high[3];
} Tet;

static void gather(const OstMesh *mesh, OstLocal number, Tet *tet)
{
    tet->nodes = mesh->nodes_per_tet;
    ost_gather3(tet->nodes, ost_mesh_nodes_of(mesh, number), mesh->coordinates, tet->x);
    for (int i = 0; i < 3; i++) {
        tet->low[i] = tet->high[i] = tet->x[i];
        for (int a = 1; a < tet->nodes; a++) {
            tet->low[i] = fmin(tet->low[i], tet->x[3 * a + i]);
            tet->high[i] = fmax(tet->high[i], tet->x[3 * a + i]);
        }
    }
    double size = 0.0;
    for (int i = 0; i < 3; i++)
        size = fmax(size, tet->high[i] - tet->low[i]);
    for (int i = 0; i < 3; i++) {
        tet->low[i] -= 2.0 * near * size;
        tet->high[i] += 2.0 * near * size;
    }
}

/* The derivative of coordinate k along a direction: it is k's share of each node's shape function. */
static double slope_along(int nodes, const double *gradients, int k, const double direction[3])
{
    double slope = 0.0;
    for (int a = 0; a < nodes; a++)
        for (int end = 0; end < 2; end++)
            if (ost_tet10_ends[a][end] == k)
                slope += 0.5 * ost_dot3(gradients + 3 * a, direction);
    return slope;
}

/* Barycentric coordinates of a point, by Newton's method (one step of a straight tet); returns by how much it is
 * outside, as a share of the height: not above 0 inside. */
static double invert(const Tet *tet, const double point[3], double at[4])
{
    enum { MOST_STEPS = 12 };
    for (int k = 0; k < 4; k++)
        at[k] = 0.25;
    for (int step = 0; step < MOST_STEPS; step++) {
        double values[OST_MAX_TET_NODES], gradients[3 * OST_MAX_TET_NODES], place[3], rest[3], change = 0.0;
        ost_shape_values(tet->nodes, at, values);
        ost_shape_place(tet->nodes, values, tet->x, place);
        if (ost_shape_gradients(tet->nodes, at, tet->x, gradients) == 0.0)
            return 1.0;
        for (int i = 0; i < 3; i++)
            rest[i] = point[i] - place[i];
        for (int k = 1; k < 4; k++) {
            const double correction = slope_along(tet->nodes, gradients, k, rest);
            at[k] += correction;
            change = fmax(change, fabs(correction));
        }
        at[0] = 1.0 - at[1] - at[2] - at[3];
        if (change < 1e-13 || tet->nodes == 4)
            break;
    }
    return -fmin(fmin(at[0], at[1]), fmin(at[2], at[3]));
}

/* --- the best tet of each point --- */

/* How well a rank's best tet holds a point: 0 if it does, else by how much it misses it. */
typedef struct Found {
    double *outside;
    OstLocated *located;
} Found;

static void try_tet(const OstMesh *mesh, OstLocal number, const Tet *tet, OstLocal point, const double *place,
                    Found *found)
{
    OstLocated here = {.label = mesh->tet_label[number], .tet = number};
    OstLocated *best = &found->located[point];
    const double missed = invert(tet, place, here.at);
    const double outside = missed <= rounding ? 0.0 : missed;
    if (!(outside < near) || outside > found->outside[point] ||
        (outside == found->outside[point] && best->label != 0 && best->label < here.label))
        return;
    found->outside[point] = outside;
    *best = here;
}

static void search(const OstMesh *mesh, OstLocal count, const double *points, const Sorted *sorted, Found *found)
{
    for (OstLocal number = 0; number < mesh->owned_tets; number++) {
        Tet tet;
        gather(mesh, number, &tet);
        for (OstLocal s = first_from(count, sorted, tet.low[0]); s < count && sorted[s].x <= tet.high[0]; s++) {
            const double *place = points + 3 * (size_t)sorted[s].point;
            if (place[1] >= tet.low[1] && place[1] <= tet.high[1] && place[2] >= tet.low[2] && place[2] <= tet.high[2])
                try_tet(mesh, number, &tet, sorted[s].point, place, found);
        }
    }
}

/* The least outside of all ranks, of these the lowest label; its coordinates go to all. */
static OstStatus agree(OstContext *ctx, OstLocal count, double *outside, double *least, OstGlobal *label,
                       OstLocated *located)
{
    for (OstLocal p = 0; p < count; p++)
        least[p] = outside[p];
    OST_TRY(ost_min(ctx, count, least));
    for (OstLocal p = 0; p < count; p++)
        label[p] = located[p].label > 0 && outside[p] == least[p] ? located[p].label : INT64_MAX;
    OST_TRY(ost_min_numbers(ctx, count, label));
    for (OstLocal p = 0; p < count; p++) {
        if (located[p].label != label[p])
            located[p] = (OstLocated){.tet = -1};
        if (label[p] != INT64_MAX)
            located[p].label = label[p];
    }
    return OST_SUCCESS;
}

OstStatus ost_locate(const OstMesh *mesh, OstLocal count, const double *points, OstLocated *located)
{
    OstContext *ctx = mesh->ctx;
    Sorted *sorted = NULL;
    Found found = {.located = located};
    double *least = NULL;
    OstGlobal *label = NULL;
    OstStatus status = OST_NEW(ctx, &sorted, count);
    OST_THEN(OST_NEW(ctx, &found.outside, count));
    OST_THEN(OST_NEW(ctx, &least, count));
    OST_THEN(OST_NEW(ctx, &label, count));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (OstLocal p = 0; p < count; p++) {
        sorted[p] = (Sorted){points[3 * (size_t)p], p};
        found.outside[p] = near;
        located[p] = (OstLocated){.tet = -1};
    }
    qsort(sorted, (size_t)count, sizeof *sorted, by_x);
    search(mesh, count, points, sorted, &found);
    status = agree(ctx, count, found.outside, least, label, located);
done:
    OST_FREE(sorted, found.outside, least, label);
    return status;
}
