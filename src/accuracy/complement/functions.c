/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/complement/complement.h"
#include "core/kernel.h"
#include "element/tets.h"

static const int face_edge[3][2] = {{0, 1}, {1, 2}, {2, 0}};

static double on_edge(int quadratic, double a, double b)
{
    return quadratic ? 8.0 * a * b * (b - a) : 4.0 * a * b;
}

void ost_complement_values(int quadratic, const double at[4], double *values)
{
    for (int e = 0; e < 6; e++)
        values[e] = on_edge(quadratic, at[ost_tet_edge[e][0]], at[ost_tet_edge[e][1]]);
    for (int f = 0; f < 4 && quadratic; f++)
        values[6 + f] = 27.0 * at[ost_tet_face[f][0]] * at[ost_tet_face[f][1]] * at[ost_tet_face[f][2]];
}

void ost_complement_face_values(int quadratic, const double at[3], double *values)
{
    for (int e = 0; e < 3; e++)
        values[e] = on_edge(quadratic, at[face_edge[e][0]], at[face_edge[e][1]]);
    if (quadratic)
        values[3] = 27.0 * at[0] * at[1] * at[2];
}

/* Gradients of the barycentric coordinates. They are linear functions, so quadratic shape functions hold them, with
 * value 1/2 at the mid-edge nodes of a vertex. */
static inline void find_coordinates(int nodes, const OstPoint *point, OstSimd gradient[4][3])
{
    for (int a = 0; a < 4; a++)
        for (int i = 0; i < 3; i++)
            gradient[a][i] = point->gradient[a][i];
    for (int m = 4; m < nodes; m++)
        for (int end = 0; end < 2; end++)
            for (int i = 0; i < 3; i++)
                gradient[ost_tet10_ends[m][end]][i] += 0.5 * point->gradient[m][i];
}

OST_KERNEL void ost_complement_gradients(int nodes, const double at[4], const OstPoint *point,
                                         OstSimd gradient[OST_MAX_FUNCTIONS][3])
{
    OstSimd of[4][3];
    find_coordinates(nodes, point, of);
    for (int e = 0; e < 6; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        const double by_a = nodes == 4 ? 4.0 * at[b] : 8.0 * at[b] * (at[b] - 2.0 * at[a]);
        const double by_b = nodes == 4 ? 4.0 * at[a] : 8.0 * at[a] * (2.0 * at[b] - at[a]);
        for (int i = 0; i < 3; i++)
            gradient[e][i] = by_a * of[a][i] + by_b * of[b][i];
    }
    for (int f = 0; f < 4 && nodes == 10; f++) {
        const int *v = ost_tet_face[f];
        for (int i = 0; i < 3; i++)
            gradient[6 + f][i] = 27.0 * (at[v[1]] * at[v[2]] * of[v[0]][i] + at[v[2]] * at[v[0]] * of[v[1]][i] +
                                         at[v[0]] * at[v[1]] * of[v[2]][i]);
    }
}
