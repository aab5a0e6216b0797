/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/coarse_space.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "mesh/mesh_data.h"
#include "orthostat/refine.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { VERTICES = 4, NODES = 10 };

/* An edge is straight if its middle node is this near to the mean of its ends, relative to its length. */
static const double straight = 1e-10;

static void difference(const double *a, const double *b, double d[3])
{
    for (int i = 0; i < 3; i++)
        d[i] = a[i] - b[i];
}

/* Barycentric coordinates of a point in a linear tet with its vertices at x[0], x[1], ... */
static void barycentric_coordinates(const double *const x[VERTICES], const double *point, double barycentric[VERTICES])
{
    double side[3][3], to_point[3], normal[3];
    for (int v = 1; v < VERTICES; v++)
        difference(x[v], x[0], side[v - 1]);
    difference(point, x[0], to_point);
    barycentric[0] = 1.0;
    for (int v = 0; v < 3; v++) {
        ost_cross3(side[(v + 1) % 3], side[(v + 2) % 3], normal);
        barycentric[v + 1] = ost_dot3(normal, to_point) / ost_dot3(normal, side[v]);
        barycentric[0] -= barycentric[v + 1];
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

/* Interpolates a curved edge's row from this tet's vertices, unless another tet at the edge did so with a smaller sum
 * of weights, that is, with the node less far outside of it. */
static void interpolate_in_tet(const double *const x[VERTICES], const double *point, const OstLocal columns[VERTICES],
                               OstLocal *parents, double *weights, double *weight_sum)
{
    double barycentric[VERTICES], size = 0.0;
    barycentric_coordinates(x, point, barycentric);
    for (int v = 0; v < VERTICES; v++)
        size += fabs(barycentric[v]);
    if (!(size < *weight_sum * (1.0 - 1e-9)))
        return;
    *weight_sum = size;
    memcpy(parents, columns, VERTICES * sizeof *parents);
    memcpy(weights, barycentric, sizeof barycentric);
}

static void interpolate_curved_edges(const OstSystem *quadratic, const OstSystem *linear, const OstLocal *ends,
                                     OstLocal *parents, double *weights, double *weight_sum)
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
                interpolate_in_tet(x, x[VERTICES + e], columns, parents + VERTICES * (size_t)row,
                                   weights + VERTICES * (size_t)row, weight_sum + row);
        }
    }
}

/* Mid-edge nodes take both ends at half weight; a vertex has itself twice. */
static void interpolate_from_ends(const OstSystem *quadratic, const OstSystem *linear, const OstLocal *ends,
                                  OstLocal *parents, double *weights, double *weight_sum)
{
    for (size_t row = 0; row < (size_t)quadratic->matrix->rows; row++) {
        weight_sum[row] = DBL_MAX;
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
    double *weight_sum = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(ctx, &ends, 2 * (size_t)quadratic->mesh->node_count));
    OST_TRY_DONE(OST_NEW(ctx, &weight_sum, rows));
    OST_TRY_DONE(OST_NEW(ctx, parents, VERTICES * rows));
    OST_TRY_DONE(OST_NEW(ctx, weights, VERTICES * rows));
    OST_TRY_DONE(ost_mesh_parents(quadratic->mesh, linear->mesh, ends));
    interpolate_from_ends(quadratic, linear, ends, *parents, *weights, weight_sum);
    interpolate_curved_edges(quadratic, linear, ends, *parents, *weights, weight_sum);
done:
    OST_FREE(ends, weight_sum);
    return status;
}
