/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/linear_tets.h"

#include "core/kernel.h"
#include "element/strain_batch.h"

#include <string.h>

enum { VERTICES = 4, EDGES = 6 };

/* With the stretch tensor A, C : D = (1 - 2 shear) (A : D) A + shear (A D A + A D'A). Slopes are kept as D A then, that
 * is with A g in place of the gradient g. */
typedef struct Linear {
    OstSimd gradient[VERTICES][3];
    OstSimd along[VERTICES][3]; /* A g; or g where C is given as it is, or A differs within the tet */
    OstSimd volume;
} Linear;

static inline void open(const OstSimd *x, const OstElasticity *elasticity, Linear *tet)
{
    const int by_one_stretch = elasticity->by_stretch && elasticity->points == 1;
    const OstSimd *a = elasticity->stretch_tensor;
    OstPoint point;
    ost_element_of(VERTICES)->evaluate(x, &ost_tet_degree1.point[0], &point);
    memcpy(tet->gradient, point.gradient, sizeof tet->gradient);
    memcpy(tet->along, point.gradient, sizeof tet->along);
    tet->volume = point.volume;
    for (int v = 0; v < VERTICES && by_one_stretch; v++) {
        const OstSimd *g = tet->gradient[v];
        tet->along[v][0] = a[0] * g[0] + a[3] * g[1] + a[5] * g[2];
        tet->along[v][1] = a[3] * g[0] + a[1] * g[1] + a[4] * g[2];
        tet->along[v][2] = a[5] * g[0] + a[4] * g[1] + a[2] * g[2];
    }
}

/* slope += v g' */
static inline void add_slope(const OstSimd v[3], const OstSimd g[3], OstSimd slope[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            slope[3 * i + j] += v[i] * g[j];
}

/* Of D A, with the stretch tensor. */
static inline void find_stretch_stress(const OstSimd *a, double shear, const OstSimd slope[9], OstSimd stress[6])
{
    static const int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    OstSimd half[9];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            half[3 * i + j] = a[place[i][0]] * slope[j] + a[place[i][1]] * slope[3 + j] + a[place[i][2]] * slope[6 + j];
    const OstSimd bulk = (1.0 - 2.0 * shear) * (slope[0] + slope[4] + slope[8]);
    for (int p = 0; p < 6; p++) {
        const int i = p % 3, j = p < 3 ? i : (i + 1) % 3;
        stress[p] = bulk * a[p] + shear * (half[3 * i + j] + half[3 * j + i]);
    }
}

/* Less that of the eigenstrain. */
static inline void find_stress(const OstElasticity *elasticity, int at, const OstSimd slope[9], OstSimd stress[6])
{
    OstSimd strain[6];
    if (elasticity->by_stretch) {
        find_stretch_stress(elasticity->stretch_tensor, elasticity->shear, slope, stress);
        return;
    }
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        strain[i] = slope[4 * i];
        strain[3 + i] = slope[3 * i + next] + slope[3 * next + i];
    }
    ost_elastic_strain(elasticity, at, strain, strain);
    ost_simd_stress(elasticity->c[at], strain, stress);
}

/* The slope of u, which is uniform. */
static inline void find_slope(const Linear *tet, const OstSimd *u, OstSimd slope[9])
{
    memset(slope, 0, 9 * sizeof *slope);
    for (int v = 1; v < VERTICES; v++) {
        const OstSimd moved[3] = {u[3 * v] - u[0], u[3 * v + 1] - u[1], u[3 * v + 2] - u[2]};
        add_slope(moved, tet->along[v], slope);
    }
}

/* Forces on the nodes of the stress's mean, times the volume. */
static inline void find_own_forces(const Linear *tet, const OstSimd stress[6], OstSimd *at_nodes)
{
    for (int v = 1; v < VERTICES; v++)
        ost_force_of_stress(tet->gradient[v], stress, at_nodes + 3 * v);
    for (int i = 0; i < 3; i++)
        at_nodes[i] = -(at_nodes[3 + i] + at_nodes[6 + i] + at_nodes[9 + i]);
}

/* The mean of 4 L_a L_b's gradient is that of L_a + L_b. */
static inline void forces_of_uniform(const Linear *tet, const OstElasticity *elasticity, const OstSimd slope[9],
                                     OstSimd *at_nodes, OstSimd *at_functions)
{
    OstSimd stress[6];
    find_stress(elasticity, 0, slope, stress);
    for (int p = 0; p < 6; p++)
        stress[p] *= tet->volume;
    find_own_forces(tet, stress, at_nodes);
    for (int e = 0; e < EDGES; e++)
        for (int i = 0; i < 3; i++)
            at_functions[3 * e + i] = at_nodes[3 * ost_tet_edge[e][0] + i] + at_nodes[3 * ost_tet_edge[e][1] + i];
}

/* The stress of A at a point, where it differs about a line; `slope` is D. */
static inline void find_stress_about_line(const OstElasticity *elasticity, int q, const OstSimd slope[9],
                                          OstSimd stress[6])
{
    const OstSimd *a = elasticity->stretch_at[q];
    OstSimd along[9];
    for (int i = 0; i < 3; i++) {
        const OstSimd *d = slope + 3 * i;
        along[3 * i] = d[0] * a[0] + d[1] * a[3] + d[2] * a[5];
        along[3 * i + 1] = d[0] * a[3] + d[1] * a[1] + d[2] * a[4];
        along[3 * i + 2] = d[0] * a[5] + d[1] * a[4] + d[2] * a[2];
    }
    find_stretch_stress(a, elasticity->shear, along, stress);
}

/* At a point of the rule. */
static inline void find_stress_at(const OstElasticity *elasticity, int q, const OstSimd slope[9], OstSimd stress[6])
{
    if (elasticity->about_line)
        find_stress_about_line(elasticity, q, slope, stress);
    else
        find_stress(elasticity, q, slope, stress);
}

/* The stress times each coordinate is all that the functions need of it. */
static inline void forces_of_varying(const Linear *tet, const OstElasticity *elasticity, const OstQuadrature *rule,
                                     const OstSimd slope[9], OstSimd *at_nodes, OstSimd *at_functions)
{
    OstSimd moment[VERTICES][6] = {{{0}}}, sum[6];
    for (int q = 0; q < rule->count; q++) {
        OstSimd stress[6];
        find_stress_at(elasticity, q, slope, stress);
        for (int v = 0; v < VERTICES; v++)
            for (int p = 0; p < 6; p++)
                moment[v][p] += rule->point[q].weight * rule->point[q].at[v] * tet->volume * stress[p];
    }
    for (int p = 0; p < 6; p++) {
        sum[p] = moment[0][p] + moment[1][p] + moment[2][p] + moment[3][p];
        for (int v = 0; v < VERTICES; v++)
            moment[v][p] *= 4.0;
    }
    find_own_forces(tet, sum, at_nodes);
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        OstSimd of_b[3];
        ost_force_of_stress(tet->gradient[b], moment[a], at_functions + 3 * e);
        ost_force_of_stress(tet->gradient[a], moment[b], of_b);
        for (int i = 0; i < 3; i++)
            at_functions[3 * e + i] += of_b[i];
    }
}

OST_KERNEL void ost_linear_tets_forces(const OstSimd *x, const OstElasticity *elasticity, const OstQuadrature *rule,
                                       const OstSimd *u, OstSimd *at_nodes, OstSimd *at_functions)
{
    OstSimd slope[9];
    Linear tet;
    open(x, elasticity, &tet);
    find_slope(&tet, u, slope);
    if (elasticity->points == 1)
        forces_of_uniform(&tet, elasticity, slope, at_nodes, at_functions);
    else
        forces_of_varying(&tet, elasticity, rule, slope, at_nodes, at_functions);
}

/* --- the functions' own blocks --- */

/* block = B_a' C B_b */
static inline void find_block(const Linear *tet, const OstElasticity *elasticity, int a, int b, OstSimd block[9])
{
    static const int place[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    const double shear = elasticity->shear;
    const OstSimd *ha = tet->along[a], *hb = tet->along[b], *ga = tet->gradient[a];
    const OstSimd product = ga[0] * hb[0] + ga[1] * hb[1] + ga[2] * hb[2];
    for (int n = 0; n < 9; n++)
        block[n] = (1.0 - 2.0 * shear) * ha[n / 3] * hb[n % 3] +
                   shear * (hb[n / 3] * ha[n % 3] + product * elasticity->stretch_tensor[place[n]]);
}

OST_KERNEL void ost_linear_tets_blocks(const OstSimd *x, const OstElasticity *elasticity,
                                       OstSimd block[OST_MAX_FUNCTIONS][9])
{
    OstSimd own[VERTICES][9], stress[VERTICES][6][3];
    Linear tet;
    open(x, elasticity, &tet);
    for (int v = 0; v < VERTICES; v++) {
        if (elasticity->by_stretch) {
            find_block(&tet, elasticity, v, v, own[v]);
        } else {
            ost_stress_columns(elasticity->c[0], tet.gradient[v], stress[v]);
            ost_block_of_stress(tet.gradient[v], stress[v], own[v]);
        }
    }
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        OstSimd cross[9];
        if (elasticity->by_stretch)
            find_block(&tet, elasticity, a, b, cross);
        else
            ost_block_of_stress(tet.gradient[a], stress[b], cross);
        for (int n = 0; n < 9; n++)
            block[e][n] = tet.volume * (1.6 * (own[a][n] + own[b][n]) + 0.8 * (cross[n] + cross[3 * (n % 3) + n / 3]));
    }
}
