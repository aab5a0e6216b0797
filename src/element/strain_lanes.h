/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_STRAIN_LANES_H
#define ORTHOSTAT_ELEMENT_STRAIN_LANES_H

#include "element/lanes.h"

#include <math.h>

/* Strain and stress at a point of the tets in the lanes: what every kind of tet does with the gradients of its shape
 * functions there. C is an upper triangle. (Lanes go by pointer: by value, their passing would depend on the
 * processor.) */

/* Where C_pq is in the upper triangle. */
static const int ost_upper[6][6] = {{0, 1, 2, 3, 4, 5},     {1, 6, 7, 8, 9, 10},    {2, 7, 11, 12, 13, 14},
                                    {3, 8, 12, 15, 16, 17}, {4, 9, 13, 16, 18, 19}, {5, 10, 14, 17, 19, 20}};

static inline void ost_lanes_cross(const OstLanes a[3], const OstLanes b[3], OstLanes c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

/* a = |a| */
static inline void ost_lanes_absolute(OstLanes *a)
{
    for (int lane = 0; lane < OST_LANES; lane++)
        (*a)[lane] = fabs((*a)[lane]);
}

/* Stress (6) for each displacement component (3) of a node with gradient g: C times the node's columns of B. */
static inline void ost_stress_columns(const OstLanes *c, const OstLanes g[3], OstLanes stress[6][3])
{
    for (int p = 0; p < 6; p++) {
        const int *row = ost_upper[p];
        stress[p][0] = c[row[0]] * g[0] + c[row[3]] * g[1] + c[row[5]] * g[2];
        stress[p][1] = c[row[3]] * g[0] + c[row[1]] * g[1] + c[row[4]] * g[2];
        stress[p][2] = c[row[5]] * g[0] + c[row[4]] * g[1] + c[row[2]] * g[2];
    }
}

/* Stress of a strain. */
static inline void ost_lanes_stress(const OstLanes *c, const OstLanes strain[6], OstLanes stress[6])
{
    for (int p = 0; p < 6; p++) {
        stress[p] = c[ost_upper[p][0]] * strain[0];
        for (int q = 1; q < 6; q++)
            stress[p] += c[ost_upper[p][q]] * strain[q];
    }
}

/* A node's columns of B, transposed, times a stress. */
static inline void ost_force_of_stress(const OstLanes g[3], const OstLanes stress[6], OstLanes force[3])
{
    force[0] = g[0] * stress[0] + g[1] * stress[3] + g[2] * stress[5];
    force[1] = g[0] * stress[3] + g[1] * stress[1] + g[2] * stress[4];
    force[2] = g[0] * stress[5] + g[1] * stress[4] + g[2] * stress[2];
}

/* A node's columns of B, transposed, times three stresses: a 3×3 block. */
static inline void ost_block_of_stress(const OstLanes g[3], OstLanes stress[6][3], OstLanes *block)
{
    for (int j = 0; j < 3; j++) {
        block[j] = g[0] * stress[0][j] + g[1] * stress[3][j] + g[2] * stress[5][j];
        block[3 + j] = g[0] * stress[3][j] + g[1] * stress[1][j] + g[2] * stress[4][j];
        block[6 + j] = g[0] * stress[5][j] + g[1] * stress[4][j] + g[2] * stress[2][j];
    }
}

/* Strain of a displacement gradient, du_i / dx_j. */
static inline void ost_strain_of_slope(OstLanes slope[3][3], OstLanes strain[6])
{
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        strain[i] = slope[i][i];
        strain[3 + i] = slope[i][next] + slope[next][i];
    }
}

/* strain += |B| |u| of one node; the gradient has been made absolute. */
static inline void ost_add_strain_size(const OstLanes g[3], const OstLanes *u, OstLanes strain[6])
{
    OstLanes size[3] = {u[0], u[1], u[2]};
    for (int i = 0; i < 3; i++)
        ost_lanes_absolute(&size[i]);
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        strain[i] += g[i] * size[i];
        strain[3 + i] += g[next] * size[i] + g[i] * size[next];
    }
}

/* stress = |C| strain */
static inline void ost_lanes_stress_size(const OstLanes *c, const OstLanes strain[6], OstLanes stress[6])
{
    for (int p = 0; p < 6; p++) {
        stress[p] = (OstLanes){0};
        for (int q = 0; q < 6; q++) {
            OstLanes size = c[ost_upper[p][q]];
            ost_lanes_absolute(&size);
            stress[p] += size * strain[q];
        }
    }
}

#endif
