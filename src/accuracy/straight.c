/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/straight.h"

#include "core/kernel.h"
#include "element/shape_functions.h"
#include "element/strain_batch.h"
#include "element/tets.h"

#include <string.h>

/* Polynomials of degree 2 have a coefficient for each product of two barycentric coordinates: L_a L_a, then L_a L_b of
 * each edge as ost_tet_edge. */
enum { VERTICES = 4, EDGES = 6, PRODUCTS = VERTICES + EDGES };

static const int face_edge[4][3] = {{5, 4, 1}, {5, 2, 3}, {4, 3, 0}, {1, 0, 2}}; /* opposite to the face's vertices */

int ost_straight_all(const OstSimd *x)
{
    static const OstElasticity uniform;
    return ost_element_of(10)->uniform(x, &uniform) == (1U << OST_SIMD_WIDTH) - 1U;
}

typedef struct Straight {
    OstSimd gradient[VERTICES][3], volume;
    OstSimd bend[EDGES][3]; /* of mid-edge nodes, from the middle of the edge's ends */
} Straight;

static inline void open(const OstSimd *x, Straight *tet)
{
    OstPoint point;
    ost_element_of(4)->evaluate(x, &ost_tet_degree1.point[0], &point);
    memcpy(tet->gradient, point.gradient, sizeof tet->gradient);
    tet->volume = point.volume;
    for (int e = 0; e < EDGES; e++)
        for (int i = 0; i < 3; i++)
            tet->bend[e][i] =
                x[3 * (4 + e) + i] - 0.5 * (x[3 * ost_tet_edge[e][0] + i] + x[3 * ost_tet_edge[e][1] + i]);
}

/* strain += factor × that of a displacement v f, g the gradient of f */
static inline void add_strain(double factor, const OstSimd v[3], const OstSimd g[3], OstSimd strain[6])
{
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        strain[i] += factor * v[i] * g[i];
        strain[3 + i] += factor * (v[i] * g[next] + v[next] * g[i]);
    }
}

static inline void add_force(double factor, const OstSimd g[3], const OstSimd stress[6], OstSimd force[3])
{
    OstSimd part[3];
    ost_force_of_stress(g, stress, part);
    for (int i = 0; i < 3; i++)
        force[i] += factor * part[i];
}

/* The strain of the elements' own displacement: u = sum of u_a L_a + h_ab 4 L_a L_b, linear in L. What the slope
 * between the vertices explains of a mid-edge node that lies off its edge does not count: so a linear u has a uniform
 * strain. */
static inline void add_own_strain(const Straight *tet, const OstSimd *u, OstSimd strain[PRODUCTS][6])
{
    OstSimd at_vertex[VERTICES][6], mean[6] = {{0}};
    OstSimd slope[3][3] = {{{0}}};
    for (int a = 0; a < VERTICES; a++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                slope[i][j] += u[3 * a + i] * tet->gradient[a][j];
    ost_strain_of_slope(slope, mean);
    for (int a = 0; a < VERTICES; a++)
        memcpy(at_vertex[a], mean, sizeof mean);
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        OstSimd h[3];
        for (int i = 0; i < 3; i++)
            h[i] = u[3 * (4 + e) + i] - 0.5 * (u[3 * a + i] + u[3 * b + i]) - slope[i][0] * tet->bend[e][0] -
                   slope[i][1] * tet->bend[e][1] - slope[i][2] * tet->bend[e][2];
        add_strain(4.0, h, tet->gradient[b], at_vertex[a]);
        add_strain(4.0, h, tet->gradient[a], at_vertex[b]);
    }
    for (int p = 0; p < 6; p++) { /* times the sum of all L, which is 1 */
        for (int a = 0; a < VERTICES; a++)
            strain[a][p] += at_vertex[a][p];
        for (int e = 0; e < EDGES; e++)
            strain[4 + e][p] += at_vertex[ost_tet_edge[e][0]][p] + at_vertex[ost_tet_edge[e][1]][p];
    }
}

/* That of the functions: 8 L_a L_b (L_b - L_a), and 27 L_a L_b L_c. */
static inline void add_surplus_strain(const Straight *tet, const OstSimd *w, OstSimd strain[PRODUCTS][6])
{
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        OstSimd by_a[6] = {{0}}, by_b[6] = {{0}};
        add_strain(8.0, w + 3 * e, tet->gradient[a], by_a);
        add_strain(8.0, w + 3 * e, tet->gradient[b], by_b);
        for (int p = 0; p < 6; p++) {
            strain[a][p] -= by_b[p];
            strain[b][p] += by_a[p];
            strain[4 + e][p] += 2.0 * (by_b[p] - by_a[p]);
        }
    }
    for (int f = 0; f < 4; f++)
        for (int i = 0; i < 3; i++)
            add_strain(27.0, w + 3 * (EDGES + f), tet->gradient[ost_tet_face[f][i]], strain[4 + face_edge[f][i]]);
}

/* moment = integrals of the stress times each product, of a uniform C. Integrals of four coordinates are those of
 * L_a^i L_b^j .. = i! j! .. volume / 840. */
static inline void integrate(const Straight *tet, const OstSimd *c, OstSimd strain[PRODUCTS][6],
                             OstSimd moment[PRODUCTS][6])
{
    OstSimd stress[PRODUCTS][6];
    const OstSimd unit = tet->volume / 840.0;
    for (int k = 0; k < PRODUCTS; k++)
        ost_simd_stress(c, strain[k], stress[k]);
    for (int p = 0; p < 6; p++) {
        const OstSimd squares = stress[0][p] + stress[1][p] + stress[2][p] + stress[3][p];
        OstSimd at[VERTICES] = {{0}}, edges = {0};
        for (int e = 0; e < EDGES; e++) {
            at[ost_tet_edge[e][0]] += stress[4 + e][p];
            at[ost_tet_edge[e][1]] += stress[4 + e][p];
            edges += stress[4 + e][p];
        }
        for (int a = 0; a < VERTICES; a++)
            moment[a][p] = unit * (20.0 * stress[a][p] + 4.0 * (squares + at[a]) + 2.0 * edges);
        for (int e = 0; e < EDGES; e++) {
            const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
            moment[4 + e][p] =
                unit * (4.0 * (stress[a][p] + stress[b][p]) + 2.0 * squares + stress[4 + e][p] + at[a] + at[b] + edges);
        }
    }
}

static inline void find_stretch(int nodes, const OstSimd *x, const OstElasticity *elasticity, const double at[4],
                                OstSimd tensor[6])
{
    double shape[OST_MAX_TET_NODES];
    OstSimd fourfold[3] = {{0}};
    ost_shape_values(nodes, at, shape);
    for (int a = 0; a < nodes; a++)
        for (int i = 0; i < 3; i++)
            fourfold[i] += 4.0 * shape[a] * x[3 * a + i];
    ost_stretch_at(elasticity, fourfold, tensor);
}

void ost_straight_stretch(const OstSimd *x, const OstElasticity *elasticity, const double at[4], OstSimd tensor[6])
{
    find_stretch(VERTICES + EDGES, x, elasticity, at, tensor);
}

OST_KERNEL void ost_straight_stretches(int nodes, const OstSimd *x, const OstElasticity *elasticity,
                                       const OstQuadrature *rule, OstSimd tensor[OST_MAX_POINTS + 1][6])
{
    for (int q = 0; q < rule->count; q++)
        find_stretch(nodes, x, elasticity, rule->point[q].at, tensor[q]);
    find_stretch(nodes, x, elasticity, ost_tet_degree1.point[0].at, tensor[rule->count]);
}

/* Of C at point q. */
static inline void find_stress(const OstSimd *x, const OstElasticity *elasticity, const OstQuadrature *rule, int q,
                               const OstSimd strain[6], OstSimd stress[6])
{
    OstSimd tensor[6];
    if (!elasticity->about_line) {
        ost_simd_stress(elasticity->c[q], strain, stress);
        return;
    }
    if (!elasticity->stretch_at)
        ost_straight_stretch(x, elasticity, rule->point[q].at, tensor);
    ost_stretch_stress(elasticity->stretch_at ? elasticity->stretch_at[q] : tensor, elasticity->shear, strain, stress);
}

/* The same by quadrature, of a C that varies. */
static inline void integrate_points(const OstSimd *x, const Straight *tet, const OstElasticity *elasticity,
                                    const OstQuadrature *rule, OstSimd strain[PRODUCTS][6], OstSimd moment[PRODUCTS][6])
{
    memset(moment, 0, PRODUCTS * sizeof *moment);
    for (int q = 0; q < rule->count; q++) {
        const double *at = rule->point[q].at;
        OstSimd here[6] = {{0}}, stress[6];
        double product[PRODUCTS];
        for (int a = 0; a < VERTICES; a++)
            product[a] = at[a] * at[a];
        for (int e = 0; e < EDGES; e++)
            product[4 + e] = at[ost_tet_edge[e][0]] * at[ost_tet_edge[e][1]];
        for (int k = 0; k < PRODUCTS; k++)
            for (int p = 0; p < 6; p++)
                here[p] += product[k] * strain[k][p];
        find_stress(x, elasticity, rule, q, here, stress);
        for (int p = 0; p < 6; p++) {
            const OstSimd weighted = rule->point[q].weight * tet->volume * stress[p];
            for (int k = 0; k < PRODUCTS; k++)
                moment[k][p] += product[k] * weighted;
        }
    }
}

static inline void find_own_forces(const Straight *tet, OstSimd moment[PRODUCTS][6], OstSimd *at_nodes)
{
    OstSimd of_vertex[VERTICES][6], sum[6], of_slope[3][3] = {{{0}}};
    memcpy(of_vertex, moment, sizeof of_vertex);
    for (int p = 0; p < 6; p++) {
        for (int e = 0; e < EDGES; e++) {
            of_vertex[ost_tet_edge[e][0]][p] += moment[4 + e][p];
            of_vertex[ost_tet_edge[e][1]][p] += moment[4 + e][p];
        }
        sum[p] = of_vertex[0][p] + of_vertex[1][p] + of_vertex[2][p] + of_vertex[3][p];
    }
    for (int a = 0; a < VERTICES; a++)
        ost_force_of_stress(tet->gradient[a], sum, at_nodes + 3 * a);
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        OstSimd *force = at_nodes + 3 * (4 + e);
        force[0] = force[1] = force[2] = (OstSimd){0};
        add_force(4.0, tet->gradient[b], of_vertex[a], force);
        add_force(4.0, tet->gradient[a], of_vertex[b], force);
        for (int i = 0; i < 3; i++) {
            at_nodes[3 * a + i] -= 0.5 * force[i];
            at_nodes[3 * b + i] -= 0.5 * force[i];
            for (int j = 0; j < 3; j++)
                of_slope[i][j] -= force[i] * tet->bend[e][j];
        }
    }
    for (int a = 0; a < VERTICES; a++)
        for (int i = 0; i < 3; i++)
            at_nodes[3 * a + i] += of_slope[i][0] * tet->gradient[a][0] + of_slope[i][1] * tet->gradient[a][1] +
                                   of_slope[i][2] * tet->gradient[a][2];
}

static inline void find_surplus_forces(const Straight *tet, OstSimd moment[PRODUCTS][6], OstSimd *at_functions)
{
    memset(at_functions, 0, 3 * (EDGES + 4) * sizeof *at_functions);
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        OstSimd by_a[6], by_b[6];
        for (int p = 0; p < 6; p++) {
            by_a[p] = moment[b][p] - 2.0 * moment[4 + e][p];
            by_b[p] = 2.0 * moment[4 + e][p] - moment[a][p];
        }
        add_force(8.0, tet->gradient[a], by_a, at_functions + 3 * e);
        add_force(8.0, tet->gradient[b], by_b, at_functions + 3 * e);
    }
    for (int f = 0; f < 4; f++)
        for (int i = 0; i < 3; i++)
            add_force(27.0, tet->gradient[ost_tet_face[f][i]], moment[4 + face_edge[f][i]],
                      at_functions + 3 * (EDGES + f));
}

OST_KERNEL void ost_straight_forces(const OstSimd *x, const OstElasticity *elasticity, const OstQuadrature *rule,
                                    const OstSimd *u, const OstSimd *w, OstSimd *at_nodes, OstSimd *at_functions)
{
    OstSimd strain[PRODUCTS][6], moment[PRODUCTS][6];
    Straight tet;
    open(x, &tet);
    memset(strain, 0, sizeof strain);
    add_own_strain(&tet, u, strain);
    if (w)
        add_surplus_strain(&tet, w, strain);
    if (elasticity->points == 1)
        integrate(&tet, elasticity->c[0], strain, moment);
    else
        integrate_points(x, &tet, elasticity, rule, strain, moment);
    find_own_forces(&tet, moment, at_nodes);
    find_surplus_forces(&tet, moment, at_functions);
}

/* --- the functions' own blocks --- */

/* block += factor (B_a' C B_b + its transposed) */
static inline void add_cross(double factor, const OstSimd a[3], OstSimd stress_b[6][3], OstSimd block[9])
{
    OstSimd part[9];
    ost_block_of_stress(a, stress_b, part);
    for (int n = 0; n < 9; n++)
        block[n] += factor * (part[n] + part[3 * (n % 3) + n / 3]);
}

OST_KERNEL void ost_straight_blocks(const OstSimd *x, const OstElasticity *elasticity,
                                    OstSimd block[OST_MAX_FUNCTIONS][9])
{
    OstSimd stress[VERTICES][6][3];
    Straight tet;
    open(x, &tet);
    memset(block, 0, OST_MAX_FUNCTIONS * sizeof *block);
    for (int a = 0; a < VERTICES; a++)
        ost_stress_columns(elasticity->c[0], tet.gradient[a], stress[a]);
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        add_cross(512.0, tet.gradient[a], stress[a], block[e]);
        add_cross(512.0, tet.gradient[b], stress[b], block[e]);
        add_cross(256.0, tet.gradient[a], stress[b], block[e]);
    }
    for (int f = 0; f < 4; f++)
        for (int i = 0; i < 3; i++) {
            const int a = ost_tet_face[f][i], b = ost_tet_face[f][(i + 1) % 3];
            add_cross(1458.0, tet.gradient[a], stress[a], block[EDGES + f]);
            add_cross(1458.0, tet.gradient[a], stress[b], block[EDGES + f]);
        }
    for (int k = 0; k < OST_MAX_FUNCTIONS; k++)
        for (int n = 0; n < 9; n++)
            block[k][n] *= tet.volume / 840.0;
}
