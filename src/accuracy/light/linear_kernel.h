/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_LIGHT_LINEAR_KERNEL_H
#define ORTHOSTAT_ACCURACY_LIGHT_LINEAR_KERNEL_H

#include "accuracy/light/light_data.h"
#include "element/tets.h"

/* The arithmetic of linear tets, for the file that includes this: it defines Number, a vector of one number of each
 * tet, and FROM(kept), the Number of what is kept of eight tets. */

enum { VERTICES = 4, EDGES = 6 };

/* With the stretch tensor A, C : D = (1 - 2 shear) (A : D) A + shear (A D A + A D'A). Slopes are kept as D A then, that
 * is with `along` = A g in place of the gradient g. */
typedef struct Linear {
    Number gradient[4][3], along[4][3], volume;
    const Kept *elastic;
    int by_stretch;
} Linear;

static inline void open_linear(const Eights *eights, const Kept *elastic, int by_stretch, Linear *tet)
{
    tet->elastic = elastic;
    tet->by_stretch = by_stretch;
    tet->volume = FROM(eights->volume);
    for (int i = 0; i < 3; i++) {
        for (int v = 1; v < 4; v++)
            tet->gradient[v][i] = FROM(eights->gradient[v - 1][i]);
        tet->gradient[0][i] = -(tet->gradient[1][i] + tet->gradient[2][i] + tet->gradient[3][i]);
    }
    for (int v = 0; v < 4; v++) {
        const Kept *a = elastic;
        const Number *g = tet->gradient[v];
        if (!by_stretch) {
            for (int i = 0; i < 3; i++)
                tet->along[v][i] = g[i];
            continue;
        }
        tet->along[v][0] = FROM(a[0]) * g[0] + FROM(a[3]) * g[1] + FROM(a[5]) * g[2];
        tet->along[v][1] = FROM(a[3]) * g[0] + FROM(a[1]) * g[1] + FROM(a[4]) * g[2];
        tet->along[v][2] = FROM(a[5]) * g[0] + FROM(a[4]) * g[1] + FROM(a[2]) * g[2];
    }
}

/* slope += v g' */
static inline void add_slope(const Number v[3], const Number g[3], Number slope[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            slope[3 * i + j] += v[i] * g[j];
}

static inline void find_stress(const Linear *tet, const Number slope[9], Number stress[6])
{
    static const int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    const Kept *a = tet->elastic;
    if (!tet->by_stretch) {
        Number strain[6];
        for (int i = 0; i < 3; i++) {
            const int next = (i + 1) % 3;
            strain[i] = slope[4 * i];
            strain[3 + i] = slope[3 * i + next] + slope[3 * next + i];
        }
        for (int p = 0; p < 6; p++) {
            stress[p] = FROM(a[ost_upper[p][0]]) * strain[0];
            for (int q = 1; q < 6; q++)
                stress[p] += FROM(a[ost_upper[p][q]]) * strain[q];
        }
        return;
    }
    Number half[9];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            half[3 * i + j] = FROM(a[place[i][0]]) * slope[j] + FROM(a[place[i][1]]) * slope[3 + j] +
                              FROM(a[place[i][2]]) * slope[6 + j];
    const Number shear = FROM(a[6]), bulk = (1.0F - 2.0F * shear) * (slope[0] + slope[4] + slope[8]);
    for (int p = 0; p < 6; p++) {
        const int i = p % 3, j = p < 3 ? i : (i + 1) % 3;
        stress[p] = bulk * FROM(a[p]) + shear * (half[3 * i + j] + half[3 * j + i]);
    }
}

/* force += stress g */
static inline void add_force(const Number g[3], const Number stress[6], Number force[3])
{
    force[0] += g[0] * stress[0] + g[1] * stress[3] + g[2] * stress[5];
    force[1] += g[0] * stress[3] + g[1] * stress[1] + g[2] * stress[4];
    force[2] += g[0] * stress[5] + g[1] * stress[4] + g[2] * stress[2];
}

/* The stress is linear. With a quarter of the slopes, as a function is 4 L_a L_b; products of two coordinates have the
 * mean 1/10 or 1/20. */
static inline void find_forces(const Linear *tet, Number moved[VERTICES - 1][3], Number w[EDGES][3],
                               Number at_nodes[VERTICES - 1][3], Number at_functions[EDGES][3])
{
    Number at_vertex[VERTICES][9], stress[VERTICES][6], sum[6], slope[9] = {{0.0F}};
    for (int v = 1; v < VERTICES; v++)
        add_slope(moved[v - 1], tet->along[v], slope);
    for (int v = 0; v < VERTICES; v++)
        for (int n = 0; n < 9; n++)
            at_vertex[v][n] = 0.25F * slope[n];
#pragma GCC unroll 6
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        add_slope(w[e], tet->along[b], at_vertex[a]);
        add_slope(w[e], tet->along[a], at_vertex[b]);
    }
    const Number weight = 0.8F * tet->volume; /* 4 × 4 / 20 */
#pragma GCC unroll 4
    for (int v = 0; v < VERTICES; v++)
        find_stress(tet, at_vertex[v], stress[v]);
    for (int p = 0; p < 6; p++) {
        for (int v = 0; v < VERTICES; v++)
            stress[v][p] *= weight;
        sum[p] = stress[0][p] + stress[1][p] + stress[2][p] + stress[3][p];
        for (int v = 0; v < VERTICES; v++)
            stress[v][p] += sum[p];
        sum[p] *= 1.25F;
    }
    memset(at_nodes, 0, (VERTICES - 1) * sizeof *at_nodes);
    memset(at_functions, 0, EDGES * sizeof *at_functions);
    for (int v = 1; v < VERTICES; v++)
        add_force(tet->gradient[v], sum, at_nodes[v - 1]);
#pragma GCC unroll 6
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        add_force(tet->gradient[b], stress[a], at_functions[e]);
        add_force(tet->gradient[a], stress[b], at_functions[e]);
    }
}

#endif
