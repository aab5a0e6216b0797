/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/shape_functions.h"

#include "core/small.h"
#include "element/element.h"

#include <string.h>

/* The two vertices of each mid-edge node. */
static const int tet_edges[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}};
static const int face_edges[3][2] = {{0, 1}, {1, 2}, {2, 0}};

static int is_linear(int nodes)
{
    return nodes == 3 || nodes == 4;
}

static int vertex_count(int nodes)
{
    return nodes == 3 || nodes == 6 ? 3 : 4;
}

static const int (*edges_of(int nodes))[2]
{
    return nodes == 6 ? face_edges : tet_edges;
}

void ost_shape_values(int nodes, const double at[4], double *values)
{
    const int vertices = vertex_count(nodes);
    if (is_linear(nodes)) {
        memcpy(values, at, (size_t)vertices * sizeof *values);
        return;
    }
    const int(*edges)[2] = edges_of(nodes);
    for (int a = 0; a < vertices; a++)
        values[a] = at[a] * (2.0 * at[a] - 1.0);
    for (int e = 0; e < nodes - vertices; e++)
        values[vertices + e] = 4.0 * at[edges[e][0]] * at[edges[e][1]];
}

/* Derivatives of the shape functions with respect to the barycentric coordinates, as if these were independent: 4
 * numbers a node. */
static void derive(int nodes, const double at[4], double (*derivatives)[4])
{
    const int vertices = vertex_count(nodes);
    const int(*edges)[2] = edges_of(nodes);
    memset(derivatives, 0, (size_t)nodes * sizeof *derivatives);
    for (int a = 0; a < vertices; a++)
        derivatives[a][a] = is_linear(nodes) ? 1.0 : 4.0 * at[a] - 1.0;
    for (int e = 0; e < nodes - vertices; e++) {
        derivatives[vertices + e][edges[e][0]] = 4.0 * at[edges[e][1]];
        derivatives[vertices + e][edges[e][1]] = 4.0 * at[edges[e][0]];
    }
}

void ost_shape_place(int nodes, const double *values, const double *x, double place[3])
{
    for (int i = 0; i < 3; i++) {
        place[i] = 0.0;
        for (int a = 0; a < nodes; a++)
            place[i] += values[a] * x[3 * a + i];
    }
}

/* dx_i / dxi_j, with xi_j the coordinate of vertex j + 1 */
static void find_map(int nodes, double derivatives[OST_MAX_TET_NODES][4], const double *x, double map[9])
{
    memset(map, 0, 9 * sizeof *map);
    for (int a = 0; a < nodes; a++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                map[3 * i + j] += x[3 * a + i] * (derivatives[a][j + 1] - derivatives[a][0]);
}

double ost_shape_determinant(int nodes, const double at[4], const double *x)
{
    double derivatives[OST_MAX_TET_NODES][4], map[9];
    derive(nodes, at, derivatives);
    find_map(nodes, derivatives, x, map);
    return ost_determinant3(map);
}

double ost_shape_gradients(int nodes, const double at[4], const double *x, double *gradients)
{
    double derivatives[OST_MAX_TET_NODES][4], map[9];
    double inverse[9] = {0.0};
    derive(nodes, at, derivatives);
    find_map(nodes, derivatives, x, map);
    const double determinant = ost_invert3(map, inverse);
    for (int a = 0; a < nodes; a++) {
        const double by_xi[3] = {derivatives[a][1] - derivatives[a][0], derivatives[a][2] - derivatives[a][0],
                                 derivatives[a][3] - derivatives[a][0]};
        ost_apply3_transposed(inverse, by_xi, gradients + 3 * a);
    }
    return determinant;
}

void ost_shape_face_slopes(int nodes, const double at[3], double (*slopes)[2])
{
    double derivatives[OST_MAX_FACE_NODES][4];
    derive(nodes, (const double[4]){at[0], at[1], at[2], 0.0}, derivatives);
    for (int a = 0; a < nodes; a++)
        for (int j = 0; j < 2; j++)
            slopes[a][j] = derivatives[a][j + 1] - derivatives[a][0];
}

void ost_shape_area_vector(int nodes, const double at[3], const double *x, double area_vector[3])
{
    double slopes[OST_MAX_FACE_NODES][2];
    double along[2][3] = {{0.0}};
    ost_shape_face_slopes(nodes, at, slopes);
    for (int a = 0; a < nodes; a++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 2; j++)
                along[j][i] += x[3 * a + i] * slopes[a][j];
    ost_cross3(along[0], along[1], area_vector);
}
