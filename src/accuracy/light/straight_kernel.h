/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_LIGHT_STRAIGHT_KERNEL_H
#define ORTHOSTAT_ACCURACY_LIGHT_STRAIGHT_KERNEL_H

#include "element/tets.h"

#include <string.h>

/* The arithmetic of straight quadratic tets (accuracy/straight.h) for several side by side, in the precision of the
 * file that includes this: it defines Number, a vector of one number of each tet, and Scalar, the type of these. */

/* Polynomials of degree 2 have a coefficient for each product of two barycentric coordinates: L_a L_a, then L_a L_b of
 * each edge as ost_tet_edge. */
enum { VERTICES = 4, EDGES = 6, PRODUCTS = VERTICES + EDGES };

static const int face_edge[4][3] = {{5, 4, 1}, {5, 2, 3}, {4, 3, 0}, {1, 0, 2}}; /* opposite to the face's vertices */

typedef struct Straight {
    Number gradient[VERTICES][3], volume;
    Number bend[EDGES][3]; /* of mid-edge nodes, from the middle of the edge's ends */
} Straight;

/* strain += factor × that of a displacement v f, g the gradient of f */
static inline void add_strain(Scalar factor, const Number v[3], const Number g[3], Number strain[6])
{
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        strain[i] += factor * v[i] * g[i];
        strain[3 + i] += factor * (v[i] * g[next] + v[next] * g[i]);
    }
}

static inline void add_force(Scalar factor, const Number g[3], const Number stress[6], Number force[3])
{
    force[0] += factor * (g[0] * stress[0] + g[1] * stress[3] + g[2] * stress[5]);
    force[1] += factor * (g[0] * stress[3] + g[1] * stress[1] + g[2] * stress[4]);
    force[2] += factor * (g[0] * stress[5] + g[1] * stress[4] + g[2] * stress[2]);
}

/* The strain of the elements' own displacement: u = sum of u_a L_a + h_ab 4 L_a L_b, linear in L. What the slope
 * between the vertices explains of a mid-edge node that lies off its edge does not count: so a linear u has a uniform
 * strain. */
static inline void add_own_strain(const Straight *tet, const Number *u, Number strain[PRODUCTS][6])
{
    Number at_vertex[VERTICES][6], mean[6] = {{0}};
    Number slope[3][3] = {{{0}}};
    for (int a = 0; a < VERTICES; a++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                slope[i][j] += u[3 * a + i] * tet->gradient[a][j];
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        mean[i] = slope[i][i];
        mean[3 + i] = slope[i][next] + slope[next][i];
    }
    for (int a = 0; a < VERTICES; a++)
        memcpy(at_vertex[a], mean, sizeof mean);
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        Number h[3];
        for (int i = 0; i < 3; i++)
            h[i] = u[3 * (4 + e) + i] - (Scalar)0.5 * (u[3 * a + i] + u[3 * b + i]) - slope[i][0] * tet->bend[e][0] -
                   slope[i][1] * tet->bend[e][1] - slope[i][2] * tet->bend[e][2];
        add_strain(4, h, tet->gradient[b], at_vertex[a]);
        add_strain(4, h, tet->gradient[a], at_vertex[b]);
    }
    for (int p = 0; p < 6; p++) { /* times the sum of all L, which is 1 */
        for (int a = 0; a < VERTICES; a++)
            strain[a][p] += at_vertex[a][p];
        for (int e = 0; e < EDGES; e++)
            strain[4 + e][p] += at_vertex[ost_tet_edge[e][0]][p] + at_vertex[ost_tet_edge[e][1]][p];
    }
}

/* That of the functions: 8 L_a L_b (L_b - L_a), and 27 L_a L_b L_c. */
static inline void add_surplus_strain(const Straight *tet, const Number *w, Number strain[PRODUCTS][6])
{
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        Number by_a[6] = {{0}}, by_b[6] = {{0}};
        add_strain(8, w + 3 * e, tet->gradient[a], by_a);
        add_strain(8, w + 3 * e, tet->gradient[b], by_b);
        for (int p = 0; p < 6; p++) {
            strain[a][p] -= by_b[p];
            strain[b][p] += by_a[p];
            strain[4 + e][p] += 2 * (by_b[p] - by_a[p]);
        }
    }
    for (int f = 0; f < 4; f++)
        for (int i = 0; i < 3; i++)
            add_strain(27, w + 3 * (EDGES + f), tet->gradient[ost_tet_face[f][i]], strain[4 + face_edge[f][i]]);
}

/* moment = integrals of the stress, a polynomial of degree 2, times each product. Integrals of four coordinates are
 * those of L_a^i L_b^j .. = i! j! .. volume / 840. */
static inline void integrate_stress(const Straight *tet, Number stress[PRODUCTS][6], Number moment[PRODUCTS][6])
{
    const Number unit = tet->volume * (Scalar)(1.0 / 840.0);
    for (int p = 0; p < 6; p++) {
        const Number squares = stress[0][p] + stress[1][p] + stress[2][p] + stress[3][p];
        Number at[VERTICES] = {{0}}, edges = {0};
        for (int e = 0; e < EDGES; e++) {
            at[ost_tet_edge[e][0]] += stress[4 + e][p];
            at[ost_tet_edge[e][1]] += stress[4 + e][p];
            edges += stress[4 + e][p];
        }
        for (int a = 0; a < VERTICES; a++)
            moment[a][p] = unit * (20 * stress[a][p] + 4 * (squares + at[a]) + 2 * edges);
        for (int e = 0; e < EDGES; e++) {
            const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
            moment[4 + e][p] =
                unit * (4 * (stress[a][p] + stress[b][p]) + 2 * squares + stress[4 + e][p] + at[a] + at[b] + edges);
        }
    }
}

/* The products at a point of a rule. */
static inline void find_products(const double at[VERTICES], Scalar product[PRODUCTS])
{
    for (int a = 0; a < VERTICES; a++)
        product[a] = (Scalar)(at[a] * at[a]);
    for (int e = 0; e < EDGES; e++)
        product[VERTICES + e] = (Scalar)(at[ost_tet_edge[e][0]] * at[ost_tet_edge[e][1]]);
}

static inline void find_strain_at(const Scalar product[PRODUCTS], Number strain[PRODUCTS][6], Number here[6])
{
    memset(here, 0, 6 * sizeof *here);
    for (int k = 0; k < PRODUCTS; k++)
        for (int p = 0; p < 6; p++)
            here[p] += product[k] * strain[k][p];
}

/* moment += what a point adds; `weight` is its part of the volume. */
static inline void add_moments(const Scalar product[PRODUCTS], const Number *weight, const Number stress[6],
                               Number moment[PRODUCTS][6])
{
    for (int p = 0; p < 6; p++) {
        const Number weighted = *weight * stress[p];
        for (int k = 0; k < PRODUCTS; k++)
            moment[k][p] += product[k] * weighted;
    }
}

static inline void find_own_forces(const Straight *tet, Number moment[PRODUCTS][6], Number *at_nodes)
{
    Number of_vertex[VERTICES][6], sum[6], of_slope[3][3] = {{{0}}};
    memcpy(of_vertex, moment, sizeof of_vertex);
    for (int p = 0; p < 6; p++) {
        for (int e = 0; e < EDGES; e++) {
            of_vertex[ost_tet_edge[e][0]][p] += moment[4 + e][p];
            of_vertex[ost_tet_edge[e][1]][p] += moment[4 + e][p];
        }
        sum[p] = of_vertex[0][p] + of_vertex[1][p] + of_vertex[2][p] + of_vertex[3][p];
    }
    for (int a = 0; a < VERTICES; a++) {
        at_nodes[3 * a] = at_nodes[3 * a + 1] = at_nodes[3 * a + 2] = (Number){0};
        add_force(1, tet->gradient[a], sum, at_nodes + 3 * a);
    }
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        Number *force = at_nodes + 3 * (4 + e);
        force[0] = force[1] = force[2] = (Number){0};
        add_force(4, tet->gradient[b], of_vertex[a], force);
        add_force(4, tet->gradient[a], of_vertex[b], force);
        for (int i = 0; i < 3; i++) {
            at_nodes[3 * a + i] -= (Scalar)0.5 * force[i];
            at_nodes[3 * b + i] -= (Scalar)0.5 * force[i];
            for (int j = 0; j < 3; j++)
                of_slope[i][j] -= force[i] * tet->bend[e][j];
        }
    }
    for (int a = 0; a < VERTICES; a++)
        for (int i = 0; i < 3; i++)
            at_nodes[3 * a + i] += of_slope[i][0] * tet->gradient[a][0] + of_slope[i][1] * tet->gradient[a][1] +
                                   of_slope[i][2] * tet->gradient[a][2];
}

static inline void find_surplus_forces(const Straight *tet, Number moment[PRODUCTS][6], Number *at_functions)
{
    memset(at_functions, 0, 3 * (EDGES + 4) * sizeof *at_functions);
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        Number by_a[6], by_b[6];
        for (int p = 0; p < 6; p++) {
            by_a[p] = moment[b][p] - 2 * moment[4 + e][p];
            by_b[p] = 2 * moment[4 + e][p] - moment[a][p];
        }
        add_force(8, tet->gradient[a], by_a, at_functions + 3 * e);
        add_force(8, tet->gradient[b], by_b, at_functions + 3 * e);
    }
    for (int f = 0; f < 4; f++)
        for (int i = 0; i < 3; i++)
            add_force(27, tet->gradient[ost_tet_face[f][i]], moment[4 + face_edge[f][i]],
                      at_functions + 3 * (EDGES + f));
}

#endif
