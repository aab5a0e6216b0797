/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/straight.h"

#include "core/kernel.h"
#include "element/shape_functions.h"
#include "element/strain_batch.h"
typedef OstSimd Number;
typedef double Scalar;
#include "accuracy/light/straight_kernel.h"

int ost_straight_all(const OstSimd *x)
{
    static const OstElasticity uniform;
    return ost_element_of(10)->uniform(x, &uniform) == (1U << OST_SIMD_WIDTH) - 1U;
}

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

OST_KERNEL void ost_straight_stretches(int nodes, const OstSimd *x, const OstElasticity *elasticity,
                                       const OstQuadrature *rule, OstSimd tensor[OST_MAX_POINTS][6])
{
    for (int q = 0; q < rule->count; q++)
        find_stretch(nodes, x, elasticity, rule->point[q].at, tensor[q]);
}

/* Of C at point q. */
static inline void find_stress(const OstSimd *x, const OstElasticity *elasticity, const OstQuadrature *rule, int q,
                               const OstSimd strain[6], OstSimd stress[6])
{
    OstSimd tensor[6];
    if (!elasticity->about_line) {
        ost_simd_stress(elasticity->c[ost_elasticity_at(elasticity, q)], strain, stress);
        return;
    }
    if (!elasticity->stretch_at)
        find_stretch(VERTICES + EDGES, x, elasticity, rule->point[q].at, tensor);
    ost_stretch_stress(elasticity->stretch_at ? elasticity->stretch_at[q] : tensor, elasticity->shear, strain, stress);
}

/* moment = integrals of the stress times each product by quadrature, which is ost_tet_degree5, of a C that varies. */
static inline void integrate_points(const OstSimd *x, const Straight *tet, const OstElasticity *elasticity,
                                    const OstQuadrature *rule, OstSimd strain[PRODUCTS][6], OstSimd moment[PRODUCTS][6])
{
    OstSimd sum[SUMS][6], of_stress[SUMS][6];
    add_up(strain, sum);
    memset(of_stress, 0, sizeof of_stress);
    for (int q = 0; q < rule->count; q++) {
        const OstSimd weight = rule->point[q].weight * tet->volume;
        const Mix mix = find_mix(q);
        OstSimd here[6], stress[6];
        find_strain_at(&mix, sum, here);
        find_stress(x, elasticity, rule, q, here, stress);
        add_moments(&mix, &weight, stress, of_stress);
    }
    hand_out_sums(6, of_stress[0], moment[0]);
}

/* Of a uniform C. */
static inline void integrate_uniform(const Straight *tet, const OstSimd *c, OstSimd strain[PRODUCTS][6],
                                     OstSimd moment[PRODUCTS][6])
{
    OstSimd stress[PRODUCTS][6];
    for (int k = 0; k < PRODUCTS; k++)
        ost_simd_stress(c, strain[k], stress[k]);
    integrate_stress(tet, stress, moment);
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
        integrate_uniform(&tet, elasticity->c[0], strain, moment);
    else
        integrate_points(x, &tet, elasticity, rule, strain, moment);
    find_own_forces(&tet, moment, at_nodes);
    find_surplus_forces(&tet, moment, at_functions);
}

/* --- curved tets --- */

/* How a quadratic function of the nodes (3 numbers each) grows with L_1 to L_3, L_0 taking what they leave: at the
 * vertices, between which it is linear. */
static inline void find_growth(const OstSimd *of_nodes, OstSimd growth[VERTICES][9])
{
    OstSimd along[VERTICES][VERTICES][3]; /* at a vertex, with a coordinate */
    for (int i = 0; i < 3; i++) {
        for (int v = 0; v < VERTICES; v++)
            along[v][v][i] = 3.0 * of_nodes[3 * v + i];
        for (int e = 0; e < EDGES; e++) {
            const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
            along[a][b][i] = 4.0 * of_nodes[3 * (4 + e) + i] - of_nodes[3 * b + i];
            along[b][a][i] = 4.0 * of_nodes[3 * (4 + e) + i] - of_nodes[3 * a + i];
        }
    }
    for (int v = 0; v < VERTICES; v++)
        for (int i = 0; i < 3; i++)
            for (int m = 1; m < VERTICES; m++)
                growth[v][3 * i + m - 1] = along[v][m][i] - along[v][0][i];
}

static inline void find_growth_at(OstSimd growth[VERTICES][9], const double at[VERTICES], OstSimd here[9])
{
    for (int n = 0; n < 9; n++)
        here[n] = at[0] * growth[0][n] + at[1] * growth[1][n] + at[2] * growth[2][n] + at[3] * growth[3][n];
}

/* The inverse of J, and its determinant's absolute value. */
static inline void invert(const OstSimd j[9], OstSimd inverse[9], OstSimd *size)
{
    OstSimd columns[9];
    for (int m = 0; m < 3; m++) {
        const int b = (m + 1) % 3, c = (m + 2) % 3;
        for (int i = 0; i < 3; i++) {
            const int k = (i + 1) % 3, l = (i + 2) % 3;
            columns[3 * m + i] = j[3 * k + b] * j[3 * l + c] - j[3 * l + b] * j[3 * k + c];
        }
    }
    const OstSimd determinant = j[0] * columns[0] + j[3] * columns[1] + j[6] * columns[2], factor = 1.0 / determinant;
    for (int n = 0; n < 9; n++)
        inverse[n] = factor * columns[n];
    *size = determinant;
    ost_simd_absolute(size);
}

/* Of the slope G J^-1, with G how u grows. */
static inline void find_point_strain(const OstSimd inverse[9], const OstSimd growth[9], OstSimd strain[6])
{
    OstSimd slope[3][3];
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            slope[i][k] =
                growth[3 * i] * inverse[k] + growth[3 * i + 1] * inverse[3 + k] + growth[3 * i + 2] * inverse[6 + k];
    ost_strain_of_slope(slope, strain);
}

/* How functions grow with coordinates are products of two of these: of the stress, times J^-1, their moments are all
 * that forces need. Adds what a point has of them. */
static inline void add_stress_moments(const Mix *mix, const OstSimd inverse[9], const OstSimd stress[6],
                                      OstSimd sum[SUMS][9])
{
    OstSimd *one = sum[mix->sum[0]], *other = sum[mix->sum[1]];
    for (int m = 0; m < 3; m++) {
        OstSimd along[3];
        ost_force_of_stress(inverse + 3 * m, stress, along);
        for (int i = 0; i < 3; i++) {
            sum[ALL][3 * m + i] += mix->factor[0] * along[i];
            one[3 * m + i] += mix->factor[1] * along[i];
            other[3 * m + i] += mix->factor[2] * along[i];
        }
    }
}

/* force += factor × a product's moment along coordinate v */
static inline void add_moment(double factor, const OstSimd moment[9], int v, OstSimd force[3])
{
    for (int i = 0; i < 3; i++)
        force[i] += v > 0 ? factor * moment[3 * (v - 1) + i] : -factor * (moment[i] + moment[3 + i] + moment[6 + i]);
}

/* The functions are 8 L_a L_b (L_b - L_a), and 27 L_a L_b L_c. */
static inline void find_functions_forces(OstSimd moment[PRODUCTS][9], OstSimd *at_functions)
{
    memset(at_functions, 0, 3 * (EDGES + 4) * sizeof *at_functions);
    for (int e = 0; e < EDGES; e++) {
        const int a = ost_tet_edge[e][0], b = ost_tet_edge[e][1];
        add_moment(8.0, moment[b], a, at_functions + 3 * e);
        add_moment(-16.0, moment[4 + e], a, at_functions + 3 * e);
        add_moment(16.0, moment[4 + e], b, at_functions + 3 * e);
        add_moment(-8.0, moment[a], b, at_functions + 3 * e);
    }
    for (int f = 0; f < 4; f++)
        for (int i = 0; i < 3; i++)
            add_moment(27.0, moment[4 + face_edge[f][i]], ost_tet_face[f][i], at_functions + 3 * (EDGES + f));
}

OST_KERNEL void ost_curved_points(const OstSimd *x, OstCurvedPoint at[OST_MAX_POINTS])
{
    OstSimd of_x[VERTICES][9];
    find_growth(x, of_x);
    for (int q = 0; q < ost_tet_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_tet_degree5.point[q];
        OstSimd j[9];
        find_growth_at(of_x, point->at, j);
        invert(j, at[q].inverse, &at[q].volume);
        at[q].volume *= point->weight / 6.0;
    }
}

OST_KERNEL void ost_curved_forces(const OstSimd *x, const OstCurvedPoint *at, const OstElasticity *elasticity,
                                  const OstSimd *u, OstSimd *at_functions, OstSimd *work)
{
    OstSimd of_u[VERTICES][9], sum[SUMS][9], moment[PRODUCTS][9];
    find_growth(u, of_u);
    memset(sum, 0, sizeof sum);
    *work = (OstSimd){0};
    for (int q = 0; q < ost_tet_degree5.count; q++) {
        const Mix mix = find_mix(q);
        OstSimd growth[9], strain[6], stress[6];
        find_growth_at(of_u, ost_tet_degree5.point[q].at, growth);
        find_point_strain(at[q].inverse, growth, strain);
        find_stress(x, elasticity, &ost_tet_degree5, q, strain, stress);
        for (int p = 0; p < 6; p++) {
            stress[p] *= at[q].volume;
            *work += stress[p] * strain[p];
        }
        add_stress_moments(&mix, at[q].inverse, stress, sum);
    }
    hand_out_sums(9, sum[0], moment[0]);
    find_functions_forces(moment, at_functions);
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
