/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_STRAIN_BATCH_H
#define ORTHOSTAT_ELEMENT_STRAIN_BATCH_H

#include "element/simd.h"

#include <math.h>

/* Strain and stress at one point of each tet of a batch, from the gradients of the shape functions there: the same for
 * every kind of tet. C is an upper triangle. (Vectors are passed by pointer: by value, the calling convention would
 * depend on the processor's flags.) */

/* Index of C_pq in the upper triangle. */
static const int ost_upper[6][6] = {{0, 1, 2, 3, 4, 5},     {1, 6, 7, 8, 9, 10},    {2, 7, 11, 12, 13, 14},
                                    {3, 8, 12, 15, 16, 17}, {4, 9, 13, 16, 18, 19}, {5, 10, 14, 17, 19, 20}};

static inline void ost_simd_cross(const OstSimd a[3], const OstSimd b[3], OstSimd c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline void ost_simd_absolute(OstSimd *a)
{
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        (*a)[slot] = fabs((*a)[slot]);
}

/* stress = C B_a: the six stresses of a unit displacement of the node in each direction. g is its gradient. */
static inline void ost_stress_columns(const OstSimd *c, const OstSimd g[3], OstSimd stress[6][3])
{
    for (int p = 0; p < 6; p++) {
        const int *row = ost_upper[p];
        stress[p][0] = c[row[0]] * g[0] + c[row[3]] * g[1] + c[row[5]] * g[2];
        stress[p][1] = c[row[3]] * g[0] + c[row[1]] * g[1] + c[row[4]] * g[2];
        stress[p][2] = c[row[5]] * g[0] + c[row[4]] * g[1] + c[row[2]] * g[2];
    }
}

/* stress = C strain */
static inline void ost_simd_stress(const OstSimd *c, const OstSimd strain[6], OstSimd stress[6])
{
    for (int p = 0; p < 6; p++) {
        stress[p] = c[ost_upper[p][0]] * strain[0];
        for (int q = 1; q < 6; q++)
            stress[p] += c[ost_upper[p][q]] * strain[q];
    }
}

/* The same of the stable family, from its stretch tensor A (elasticity.h): C strain = (1 - 2 shear) A (A : strain) + 2
 * shear A strain A. */
static inline void ost_stretch_stress(const OstSimd a[6], double shear, const OstSimd strain[6], OstSimd stress[6])
{
    static const int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    OstSimd half[9], bulk = {0};
    for (int p = 0; p < 6; p++)
        bulk += (1.0 - 2.0 * shear) * a[p] * strain[p];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            half[3 * i + j] = (OstSimd){0};
            for (int k = 0; k < 3; k++) /* engineering shear */
                half[3 * i + j] += (k == j ? 2.0 : 1.0) * shear * a[place[i][k]] * strain[place[k][j]];
        }
    for (int p = 0; p < 6; p++) {
        const int i = p % 3, j = p < 3 ? i : (i + 1) % 3;
        stress[p] = bulk * a[p] + half[3 * i] * a[place[0][j]] + half[3 * i + 1] * a[place[1][j]] +
                    half[3 * i + 2] * a[place[2][j]];
    }
}

/* force = B_a' stress, with B_a the node's three columns of B. */
static inline void ost_force_of_stress(const OstSimd g[3], const OstSimd stress[6], OstSimd force[3])
{
    force[0] = g[0] * stress[0] + g[1] * stress[3] + g[2] * stress[5];
    force[1] = g[0] * stress[3] + g[1] * stress[1] + g[2] * stress[4];
    force[2] = g[0] * stress[5] + g[1] * stress[4] + g[2] * stress[2];
}

/* block = B_a' stress for three stresses: 3×3, row-major. */
static inline void ost_block_of_stress(const OstSimd g[3], OstSimd stress[6][3], OstSimd *block)
{
    for (int j = 0; j < 3; j++) {
        block[j] = g[0] * stress[0][j] + g[1] * stress[3][j] + g[2] * stress[5][j];
        block[3 + j] = g[0] * stress[3][j] + g[1] * stress[1][j] + g[2] * stress[4][j];
        block[6 + j] = g[0] * stress[5][j] + g[1] * stress[4][j] + g[2] * stress[2][j];
    }
}

/* Strain from the displacement gradient du_i / dx_j. */
static inline void ost_strain_of_slope(OstSimd slope[3][3], OstSimd strain[6])
{
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        strain[i] = slope[i][i];
        strain[3 + i] = slope[i][next] + slope[next][i];
    }
}

/* strain += |B_a| |u_a| of one node; g is its gradient's absolute value. */
static inline void ost_add_strain_size(const OstSimd g[3], const OstSimd *u, OstSimd strain[6])
{
    OstSimd size[3] = {u[0], u[1], u[2]};
    for (int i = 0; i < 3; i++)
        ost_simd_absolute(&size[i]);
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        strain[i] += g[i] * size[i];
        strain[3 + i] += g[next] * size[i] + g[i] * size[next];
    }
}

/* stress = |C| strain */
static inline void ost_simd_stress_size(const OstSimd *c, const OstSimd strain[6], OstSimd stress[6])
{
    for (int p = 0; p < 6; p++) {
        stress[p] = (OstSimd){0};
        for (int q = 0; q < 6; q++) {
            OstSimd size = c[ost_upper[p][q]];
            ost_simd_absolute(&size);
            stress[p] += size * strain[q];
        }
    }
}

#endif
