/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/tets.h"

#include "core/kernel.h"
#include "element/strain_batch.h"

#include <string.h>

enum { VERTICES = 4, EDGES = 6, BLOCK = 9, LINEAR_BLOCKS = 10 * BLOCK };

/* sum += weight × block ij of the linear tet */
static inline void add(OstSimd *restrict sum, double weight, const OstSimd *restrict linear, int i, int j)
{
    if (i <= j) {
        const OstSimd *block = linear + BLOCK * ost_pair_index(4, i, j);
        for (int n = 0; n < BLOCK; n++)
            sum[n] += weight * block[n];
    } else {
        const OstSimd *block = linear + BLOCK * ost_pair_index(4, j, i);
        for (int n = 0; n < BLOCK; n++)
            sum[n] += weight * block[3 * (n % 3) + n / 3];
    }
}

/* Gradients are (4 L_a - 1) g_a at a vertex node and 4 (L_a g_b + L_b g_a) at a mid-edge node, with g the gradients of
 * the barycentric coordinates L. The mean of L_c L_d over the tet is 1/20, and 1/10 for c = d. */
static void add_pair(const OstSimd *linear, int a, int b, OstSimd *block)
{
    const int *end_a = ost_tet10_ends[a];
    const int *end_b = ost_tet10_ends[b];
    if (b < 4) {
        add(block, a == b ? 0.6 : -0.2, linear, a, b);
        return;
    }
    for (int d = 0; d < 2; d++) {
        if (a < 4) {
            add(block, a == end_b[d] ? 0.6 : -0.2, linear, a, end_b[1 - d]);
            continue;
        }
        for (int c = 0; c < 2; c++)
            add(block, end_a[c] == end_b[d] ? 1.6 : 0.8, linear, end_a[1 - c], end_b[1 - d]);
    }
}

OST_KERNEL void ost_tet10_straight_blocks(const OstSimd *x, const OstSimd *c, OstSimd *blocks)
{
    OstSimd linear[LINEAR_BLOCKS];
    ost_tet4_blocks(x, c, linear);
    for (int a = 0; a < 10; a++)
        for (int b = a; b < 10; b++, blocks += BLOCK) {
            OstSimd block[BLOCK] = {{0}};
            add_pair(linear, a, b, block);
            memcpy(blocks, block, sizeof block);
        }
}

/* --- forces and means --- */

/* Strain and stress are linear in the tet: they are known by those at its vertices. */
typedef struct Straight {
    OstSimd gradient[VERTICES][3], volume; /* of the barycentric coordinates L */
    OstSimd elastic[VERTICES][6];          /* strain less eigenstrain */
    OstSimd stress[VERTICES][6];
} Straight;

static inline void find_gradients(const OstSimd *x, Straight *tet)
{
    OstSimd edge[VERTICES][3];
    for (int a = 1; a < VERTICES; a++)
        for (int i = 0; i < 3; i++)
            edge[a][i] = x[3 * a + i] - x[i];
    ost_simd_cross(edge[2], edge[3], tet->gradient[1]);
    ost_simd_cross(edge[3], edge[1], tet->gradient[2]);
    ost_simd_cross(edge[1], edge[2], tet->gradient[3]);
    const OstSimd *g = tet->gradient[1];
    const OstSimd determinant = edge[1][0] * g[0] + edge[1][1] * g[1] + edge[1][2] * g[2];
    const OstSimd inverse = 1.0 / determinant;
    tet->volume = determinant / 6.0;
    ost_simd_absolute(&tet->volume);
    for (int i = 0; i < 3; i++) {
        for (int a = 1; a < VERTICES; a++)
            tet->gradient[a][i] *= inverse;
        tet->gradient[0][i] = -(tet->gradient[1][i] + tet->gradient[2][i] + tet->gradient[3][i]);
    }
}

/* How far a vector's number at the middle of edge e is from the mean of its ends'. */
static inline void from_mean(const OstSimd *vectors, int e, OstSimd off[3])
{
    const OstSimd *middle = vectors + 3 * (VERTICES + e);
    const OstSimd *from = vectors + 3 * ost_tet10_ends[VERTICES + e][0],
                  *to = vectors + 3 * ost_tet10_ends[VERTICES + e][1];
    for (int i = 0; i < 3; i++)
        off[i] = 0.5 * ((middle[i] - from[i]) + (middle[i] - to[i]));
}

/* slope += v g' */
static inline void add_slope(const OstSimd v[3], const OstSimd g[3], OstSimd slope[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            slope[i][j] += v[i] * g[j];
}

/* u = sum of u_a L_a + h_ab 4 L_a L_b. What the slope between the vertices explains of a middle that rounding has moved
 * off its edge does not count: so a rigid rotation has no strain. */
static inline void find_strains(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, Straight *tet)
{
    OstSimd mean[3][3] = {{{0}}}, slope[VERTICES][3][3];
    find_gradients(x, tet);
    for (int a = 1; a < VERTICES; a++) {
        const OstSimd moved[3] = {u[3 * a] - u[0], u[3 * a + 1] - u[1], u[3 * a + 2] - u[2]};
        add_slope(moved, tet->gradient[a], mean);
    }
    for (int a = 0; a < VERTICES; a++)
        memcpy(slope[a], mean, sizeof mean);
    for (int e = 0; e < EDGES; e++) {
        const int *end = ost_tet10_ends[VERTICES + e];
        OstSimd bend[3], h[3];
        from_mean(x, e, bend);
        from_mean(u, e, h);
        for (int i = 0; i < 3; i++)
            h[i] = 4.0 * (h[i] - mean[i][0] * bend[0] - mean[i][1] * bend[1] - mean[i][2] * bend[2]);
        add_slope(h, tet->gradient[end[1]], slope[end[0]]);
        add_slope(h, tet->gradient[end[0]], slope[end[1]]);
    }
    for (int a = 0; a < VERTICES; a++) {
        OstSimd strain[6];
        ost_strain_of_slope(slope[a], strain);
        ost_elastic_strain(elasticity, 0, strain, tet->elastic[a]);
        ost_simd_stress(elasticity->c[0], tet->elastic[a], tet->stress[a]);
    }
}

static inline void add_force(double factor, const OstSimd g[3], const OstSimd stress[6], OstSimd *force)
{
    OstSimd part[3];
    ost_force_of_stress(g, stress, part);
    for (int i = 0; i < 3; i++)
        force[i] += factor * part[i];
}

/* Integrals of the stress times each L: the mean of L_a L_b is 1/20, and 1/10 for a = b. */
OST_KERNEL void ost_tet10_straight_force(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u,
                                         OstSimd *force)
{
    OstSimd moment[VERTICES][6], sum[6];
    Straight tet;
    find_strains(x, elasticity, u, &tet);
    memset(force, 0, 30 * sizeof *force);
    for (int p = 0; p < 6; p++) {
        const OstSimd all = tet.stress[0][p] + tet.stress[1][p] + tet.stress[2][p] + tet.stress[3][p];
        sum[p] = 0.25 * tet.volume * all;
        for (int a = 0; a < VERTICES; a++)
            moment[a][p] = 0.05 * tet.volume * (tet.stress[a][p] + all);
    }
    for (int a = 0; a < VERTICES; a++) {
        add_force(4.0, tet.gradient[a], moment[a], force + 3 * a);
        add_force(-1.0, tet.gradient[a], sum, force + 3 * a);
    }
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet10_ends[VERTICES + e][0], b = ost_tet10_ends[VERTICES + e][1];
        add_force(4.0, tet.gradient[b], moment[a], force + 3 * (VERTICES + e));
        add_force(4.0, tet.gradient[a], moment[b], force + 3 * (VERTICES + e));
    }
}

OST_KERNEL void ost_tet10_straight_means(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u,
                                         OstMeans *means)
{
    OstSimd energy = {0};
    Straight tet;
    find_strains(x, elasticity, u, &tet);
    means->volume = tet.volume;
    means->eigen = (OstSimd){0};
    for (int p = 0; p < 6; p++) {
        OstSimd elastic = {0}, stress = {0};
        for (int a = 0; a < VERTICES; a++) {
            elastic += tet.elastic[a][p];
            stress += tet.stress[a][p];
            energy += tet.elastic[a][p] * tet.stress[a][p];
        }
        energy += elastic * stress;
        means->strain[p] = 0.25 * elastic;
        means->stress[p] = 0.25 * stress;
        if (elasticity->by_mean)
            means->stress[p] += means->stiff * elasticity->m[0][p];
        if (elasticity->eigenstrained) {
            means->strain[p] += elasticity->e0[0][p];
            means->eigen += elasticity->e0[0][p] * means->stress[p];
        }
    }
    means->energy = 0.025 * energy + 0.5 * means->stiff * means->stiff;
}
