/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/coarse_space.h"

#include "assembly/links/row_parts.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "core/parallel/halo.h"
#include "core/small.h"
#include "mesh/mesh_data.h"
#include "orthostat/refine.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { VERTICES = 4, NODES = 10, PARENTS = 4, MOST_PARTS = VERTICES * OST_MOST_CORNERS };

/* To find the columns of the linear matrix with which a vertex moves. */
typedef struct Vertices {
    const OstSystem *linear;
    OstRowNumbers rows;   /* where vertices follow others */
    OstGlobal *of_column; /* their numbers; those of ghosts ascend */
} Vertices;

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

/* --- a node's parents --- */

/* Collective. */
static OstStatus open_vertices(const OstSystem *linear, Vertices *vertices)
{
    const OstBlockMatrix *matrix = linear->matrix;
    *vertices = (Vertices){.linear = linear};
    if (!linear->supports->links)
        return OST_SUCCESS;
    OST_TRY(ost_row_numbers_create(linear->supports->links, linear->row_of_node, matrix->first_row, &vertices->rows));
    OST_TRY(ost_agree(linear->ctx, OST_NEW(linear->ctx, &vertices->of_column, matrix->columns)));
    for (OstLocal row = 0; row < matrix->rows; row++)
        vertices->of_column[row] = matrix->first_row + row;
    return ost_agree(linear->ctx, ost_halo_import(matrix->halo, sizeof(OstGlobal), vertices->of_column));
}

static OstLocal column_of(const Vertices *vertices, OstGlobal row)
{
    const OstBlockMatrix *matrix = vertices->linear->matrix;
    const OstGlobal own = row - matrix->first_row;
    if (row < 0 || (own >= 0 && own < matrix->rows))
        return row < 0 ? -1 : (OstLocal)own;
    return matrix->rows + ost_numbers_find(matrix->columns - matrix->rows, vertices->of_column + matrix->rows, row);
}

/* The number w of a weight w P, with P the projector on the directions in which a leader is free. */
static double scalar_of(const double weight[9])
{
    double square = 0.0;
    for (int i = 0; i < 9; i++)
        square += weight[i] * weight[i];
    const double trace = weight[0] + weight[4] + weight[8];
    return trace != 0.0 ? square / trace : 0.0;
}

typedef struct Parts {
    int count;
    OstLocal column[MOST_PARTS];
    double weight[MOST_PARTS];
} Parts;

static void add_part(Parts *parts, OstLocal column, double weight)
{
    int at = 0;
    while (at < parts->count && parts->column[at] != column)
        at++;
    if (at == parts->count) {
        parts->column[parts->count] = column;
        parts->weight[parts->count++] = 0.0;
    }
    parts->weight[at] += weight;
}

static void add_vertex(const Vertices *vertices, OstLocal vertex, double weight, Parts *parts)
{
    OstRowParts of;
    if (!vertices->of_column) {
        add_part(parts, vertices->linear->row_of_node[vertex], weight);
        return;
    }
    ost_row_parts(&vertices->rows, vertex, &of);
    for (int k = 0; k < of.count; k++)
        add_part(parts, column_of(vertices, of.row[k]), weight * scalar_of(of.weight[k]));
}

/* Keeps the four largest parts, scaled to the sum of all. There are more only at edges whose two ends follow faces. */
static void put_parents(Parts *parts, OstLocal *parent, double *weight)
{
    double all = 0.0, kept = 0.0;
    for (int k = 0; k < parts->count; k++)
        all += parts->weight[k];
    for (int n = 0; n < PARENTS; n++) {
        int most = n;
        for (int k = n; k < parts->count; k++)
            most = fabs(parts->weight[k]) > fabs(parts->weight[most]) ? k : most;
        parent[n] = n < parts->count ? parts->column[most] : -1;
        weight[n] = n < parts->count ? parts->weight[most] : 0.0;
        kept += weight[n];
        if (n < parts->count) {
            parts->column[most] = parts->column[n];
            parts->weight[most] = parts->weight[n];
        }
    }
    for (int n = 0; n < PARENTS && parts->count > PARENTS; n++)
        weight[n] *= all / kept;
}

/* Interpolates a curved edge's row from this tet's vertices, unless another tet at the edge did so with a smaller sum
 * of weights, that is, with the node less far outside of it. */
static void interpolate_in_tet(const Vertices *vertices, const double *const x[VERTICES], const double *point,
                               const OstLocal vertex[VERTICES], OstLocal *parents, double *weights, double *weight_sum)
{
    double barycentric[VERTICES], size = 0.0;
    Parts parts = {.count = 0};
    barycentric_coordinates(x, point, barycentric);
    for (int v = 0; v < VERTICES; v++)
        size += fabs(barycentric[v]);
    if (!(size < *weight_sum * (1.0 - 1e-9)))
        return;
    *weight_sum = size;
    for (int v = 0; v < VERTICES; v++)
        add_vertex(vertices, vertex[v], barycentric[v], &parts);
    put_parents(&parts, parents, weights);
}

static void interpolate_curved_edges(const OstSystem *quadratic, const Vertices *vertices, const OstLocal *ends,
                                     OstLocal *parents, double *weights, double *weight_sum)
{
    const OstMesh *mesh = quadratic->mesh;
    for (size_t tet = 0; tet < (size_t)mesh->tet_count; tet++) {
        const OstLocal *node = mesh->tet_nodes + NODES * tet;
        const double *x[NODES];
        OstLocal vertex[VERTICES];
        for (int a = 0; a < NODES; a++)
            x[a] = mesh->coordinates + 3 * (size_t)node[a];
        for (int v = 0; v < VERTICES; v++)
            vertex[v] = ends[2 * (size_t)node[v]];
        for (int e = 0; e < NODES - VERTICES; e++) {
            const OstLocal row = quadratic->row_of_node[node[VERTICES + e]];
            if (row < 0 || row >= quadratic->matrix->rows)
                continue;
            if (!is_straight(x[VERTICES + e], x[ost_tet_edge[e][0]], x[ost_tet_edge[e][1]]))
                interpolate_in_tet(vertices, x, x[VERTICES + e], vertex, parents + PARENTS * (size_t)row,
                                   weights + PARENTS * (size_t)row, weight_sum + row);
        }
    }
}

/* Mid-edge nodes take both ends at half weight; a vertex has itself. */
static void interpolate_from_ends(const OstSystem *quadratic, const Vertices *vertices, const OstLocal *ends,
                                  OstLocal *parents, double *weights, double *weight_sum)
{
    for (size_t row = 0; row < (size_t)quadratic->matrix->rows; row++) {
        Parts parts = {.count = 0};
        weight_sum[row] = DBL_MAX;
        for (size_t k = 0; k < 2; k++)
            add_vertex(vertices, ends[2 * (size_t)quadratic->node_of_row[row] + k], 0.5, &parts);
        put_parents(&parts, parents + PARENTS * row, weights + PARENTS * row);
    }
}

OstStatus ost_coarse_parents(const OstSystem *quadratic, const OstSystem *linear, OstLocal **parents, double **weights)
{
    OstContext *ctx = quadratic->ctx;
    const size_t rows = (size_t)quadratic->matrix->rows;
    OstLocal *ends = NULL;
    double *weight_sum = NULL;
    Vertices vertices = {0};
    OstStatus status = open_vertices(linear, &vertices);
    OST_THEN(OST_NEW(ctx, &ends, 2 * (size_t)quadratic->mesh->node_count));
    OST_THEN(OST_NEW(ctx, &weight_sum, rows));
    OST_THEN(OST_NEW(ctx, parents, PARENTS * rows));
    OST_THEN(OST_NEW(ctx, weights, PARENTS * rows));
    OST_THEN(ost_mesh_parents(quadratic->mesh, linear->mesh, ends));
    if (status == OST_SUCCESS) {
        interpolate_from_ends(quadratic, &vertices, ends, *parents, *weights, weight_sum);
        interpolate_curved_edges(quadratic, &vertices, ends, *parents, *weights, weight_sum);
    }
    ost_row_numbers_clear(&vertices.rows);
    OST_FREE(vertices.of_column, ends, weight_sum);
    return status;
}
