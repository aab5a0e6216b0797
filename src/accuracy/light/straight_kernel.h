/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_LIGHT_STRAIGHT_KERNEL_H
#define ORTHOSTAT_ACCURACY_LIGHT_STRAIGHT_KERNEL_H

#include "element/quadrature.h"
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
#pragma GCC unroll 6
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
#pragma GCC unroll 6
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
#pragma GCC unroll 6
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

/* The points of ost_tet_degree5 have two different coordinates: one at a vertex, or at the ends of an edge, and one
 * elsewhere. So a value there is made of three sums of coefficients: of all, and two of a square, of the products with
 * a vertex, and of all that an edge's ends have between them. */
enum { ALL, SQUARE, WITH = SQUARE + VERTICES, WITHIN = WITH + VERTICES, SUMS = WITHIN + EDGES };

typedef struct Mix {
    int sum[2]; /* beside that of all, which is first in what follows */
    Scalar factor[3];
} Mix;

static inline Mix find_mix(int q)
{
    static const int edge[EDGES] = {0, 2, 3, 1, 4, 5}, opposite[EDGES] = {5, 3, 4, 1, 2, 0};
    const double *at = ost_tet_degree5.point[q].at;
    if (q < 2 * VERTICES) {
        const int v = q % VERTICES;
        const double b = at[v], a = at[(v + 1) % VERTICES];
        return (Mix){{SQUARE + v, WITH + v}, {(Scalar)(a * a), (Scalar)(b * b - a * a), (Scalar)(a * b - a * a)}};
    }
    const int e = edge[q - 2 * VERTICES], other = opposite[e];
    const double b = at[ost_tet_edge[e][0]], a = at[ost_tet_edge[other][0]];
    return (Mix){{WITHIN + e, WITHIN + other}, {(Scalar)(a * b), (Scalar)(b * b - a * b), (Scalar)(a * a - a * b)}};
}

static inline void add_up(Number coefficient[PRODUCTS][6], Number sum[SUMS][6])
{
    for (int p = 0; p < 6; p++) {
        Number with[VERTICES] = {{0}}, edges = {0};
        for (int v = 0; v < VERTICES; v++)
            sum[SQUARE + v][p] = coefficient[v][p];
#pragma GCC unroll 6
        for (int e = 0; e < EDGES; e++) {
            const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
            const Number here = coefficient[VERTICES + e][p];
            with[a] += here;
            with[b] += here;
            edges += here;
            sum[WITHIN + e][p] = coefficient[a][p] + coefficient[b][p] + here;
        }
        for (int v = 0; v < VERTICES; v++)
            sum[WITH + v][p] = with[v];
        sum[ALL][p] = coefficient[0][p] + coefficient[1][p] + coefficient[2][p] + coefficient[3][p] + edges;
    }
}

/* The transposed, of `width` moments of each: every product has its part in the sums. */
static inline void hand_out_sums(int width, const Number *sum, Number *moment)
{
    for (int p = 0; p < width; p++) {
        Number of_vertex[VERTICES];
        for (int v = 0; v < VERTICES; v++)
            of_vertex[v] = sum[width * ALL + p] + sum[width * (SQUARE + v) + p];
#pragma GCC unroll 6
        for (int e = 0; e < EDGES; e++) {
            const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
            const Number within = sum[width * (WITHIN + e) + p];
            of_vertex[a] += within;
            of_vertex[b] += within;
            moment[width * (VERTICES + e) + p] =
                sum[width * ALL + p] + within + sum[width * (WITH + a) + p] + sum[width * (WITH + b) + p];
        }
        for (int v = 0; v < VERTICES; v++)
            moment[width * v + p] = of_vertex[v];
    }
}

static inline void find_strain_at(const Mix *mix, Number sum[SUMS][6], Number here[6])
{
    const Number *one = sum[mix->sum[0]], *other = sum[mix->sum[1]];
    for (int p = 0; p < 6; p++)
        here[p] = mix->factor[0] * sum[ALL][p] + mix->factor[1] * one[p] + mix->factor[2] * other[p];
}

/* sum += what a point adds to moments; `weight` is its part of the volume. */
static inline void add_moments(const Mix *mix, const Number *weight, const Number stress[6], Number sum[SUMS][6])
{
    Number *one = sum[mix->sum[0]], *other = sum[mix->sum[1]];
    for (int p = 0; p < 6; p++) {
        const Number weighted = *weight * stress[p];
        sum[ALL][p] += mix->factor[0] * weighted;
        one[p] += mix->factor[1] * weighted;
        other[p] += mix->factor[2] * weighted;
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
#pragma GCC unroll 6
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
#pragma GCC unroll 6
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
#pragma GCC unroll 6
    for (int f = 0; f < 4; f++)
        for (int i = 0; i < 3; i++)
            add_force(27, tet->gradient[ost_tet_face[f][i]], moment[4 + face_edge[f][i]],
                      at_functions + 3 * (EDGES + f));
}

#endif
