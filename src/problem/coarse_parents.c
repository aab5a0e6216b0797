/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/coarse_parents.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "mesh/tet.h"
#include "orthostat/refine.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { VERTICES = 4, NODES = 10 };

/* An edge node this near to the middle, relative to the edge, lies on a straight edge. */
static const double straight = 1e-10;

static void difference(const double *a, const double *b, double d[3])
{
    for (int i = 0; i < 3; i++)
        d[i] = a[i] - b[i];
}

/* The point's barycentric coordinates in a linear tet; vertices at x[0], x[1], ... */
static void place_in_tet(const double *const x[VERTICES], const double *point, double place[VERTICES])
{
    double side[3][3], to_point[3], normal[3];
    for (int v = 1; v < VERTICES; v++)
        difference(x[v], x[0], side[v - 1]);
    difference(point, x[0], to_point);
    place[0] = 1.0;
    for (int v = 0; v < 3; v++) {
        ost_cross3(side[(v + 1) % 3], side[(v + 2) % 3], normal);
        place[v + 1] = ost_dot3(normal, to_point) / ost_dot3(normal, side[v]);
        place[0] -= place[v + 1];
    }
}

static int is_straight(const double *middle, const double *from, const double *to)
{
    double edge[3], bend[3];
    difference(to, from, edge);
    for (int i = 0; i < 3; i++)
        bend[i] = middle[i] - 0.5 * (from[i] + to[i]);
    return ost_norm3(bend) <= straight * ost_norm3(edge);
}

static double sum_of_sizes(const double weights[VERTICES])
{
    double sum = 0.0;
    for (int v = 0; v < VERTICES; v++)
        sum += fabs(weights[v]);
    return sum;
}

/* Takes a tet's vertices for the row of one of its curved edges, if that reaches less far out of the tet than what the
 * row has: flat tets give way to better ones at the same edge. */
static void offer_tet(const double *const x[VERTICES], const double *point, const OstLocal columns[VERTICES],
                      OstLocal *parents, double *weights, double *reach)
{
    double place[VERTICES];
    place_in_tet(x, point, place);
    const double size = sum_of_sizes(place);
    if (!(size < *reach * (1.0 - 1e-9)))
        return;
    *reach = size;
    memcpy(parents, columns, VERTICES * sizeof *parents);
    memcpy(weights, place, sizeof place);
}

static void bend_edges(const OstSystem *quadratic, const OstSystem *linear, const OstLocal *ends, OstLocal *parents,
                       double *weights, double *reach)
{
    const OstMesh *mesh = quadratic->mesh;
    for (size_t tet = 0; tet < (size_t)mesh->tet_count; tet++) {
        const OstLocal *node = mesh->tet_nodes + NODES * tet;
        const double *x[NODES];
        OstLocal columns[VERTICES];
        for (int a = 0; a < NODES; a++)
            x[a] = mesh->coordinates + 3 * (size_t)node[a];
        for (int v = 0; v < VERTICES; v++)
            columns[v] = linear->row_of_node[ends[2 * (size_t)node[v]]];
        for (int e = 0; e < NODES - VERTICES; e++) {
            const OstLocal row = quadratic->row_of_node[node[VERTICES + e]];
            if (row < 0 || row >= quadratic->matrix->rows)
                continue;
            if (!is_straight(x[VERTICES + e], x[ost_tet_edge[e][0]], x[ost_tet_edge[e][1]]))
                offer_tet(x, x[VERTICES + e], columns, parents + VERTICES * (size_t)row,
                          weights + VERTICES * (size_t)row, reach + row);
        }
    }
}

/* Ends of edges at half weight each, vertices at their own. */
static void take_ends(const OstSystem *quadratic, const OstSystem *linear, const OstLocal *ends, OstLocal *parents,
                      double *weights, double *reach)
{
    for (size_t row = 0; row < (size_t)quadratic->matrix->rows; row++) {
        reach[row] = DBL_MAX;
        for (size_t k = 0; k < VERTICES; k++) {
            const OstLocal vertex = k < 2 ? ends[2 * (size_t)quadratic->node_of_row[row] + k] : -1;
            parents[VERTICES * row + k] = vertex < 0 ? -1 : linear->row_of_node[vertex];
            weights[VERTICES * row + k] = k < 2 ? 0.5 : 0.0;
        }
    }
}

OstStatus ost_coarse_parents(const OstSystem *quadratic, const OstSystem *linear, OstLocal **parents, double **weights)
{
    OstContext *ctx = quadratic->ctx;
    const size_t rows = (size_t)quadratic->matrix->rows;
    OstLocal *ends = NULL;
    double *reach = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(ctx, &ends, 2 * (size_t)quadratic->mesh->node_count));
    OST_TRY_DONE(OST_NEW(ctx, &reach, rows));
    OST_TRY_DONE(OST_NEW(ctx, parents, VERTICES * rows));
    OST_TRY_DONE(OST_NEW(ctx, weights, VERTICES * rows));
    OST_TRY_DONE(ost_mesh_parents(quadratic->mesh, linear->mesh, ends));
    take_ends(quadratic, linear, ends, *parents, *weights, reach);
    bend_edges(quadratic, linear, ends, *parents, *weights, reach);
done:
    OST_FREE(ends);
    OST_FREE(reach);
    return status;
}
