/* SPDX-License-Identifier: BSD-3-Clause */
#include "../support.h"

#include "accuracy/straight.h"
#include "element/shape_functions.h"
#include "element/strain_batch.h"

#include <math.h>
#include <string.h>

/* The kernel of straight tets against quadrature, which integrates products of gradients in them without error. */

enum { NODES = 10, FUNCTIONS = 10 };

/* Numbers between -1 and 1, the same in every run. */
static double next(unsigned *seed)
{
    *seed = *seed * 1664525U + 1013904223U;
    return (double)(*seed >> 8) / (double)(1U << 23) - 1.0;
}

static void fill(unsigned *seed, int count, OstSimd *numbers)
{
    for (int n = 0; n < count; n++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            numbers[n][slot] = next(seed);
}

/* Tets near a regular one, and a C that is not isotropic. */
static void make(unsigned *seed, double bend, OstSimd *x, OstElasticity *elasticity)
{
    static const double corner[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    memset(elasticity, 0, sizeof *elasticity);
    elasticity->points = 1;
    fill(seed, OST_ELASTICITY_COUNT, elasticity->c[0]);
    for (int p = 0; p < 6; p++)
        elasticity->c[0][ost_upper[p][p]] += 8.0;
    fill(seed, 12, x);
    for (int n = 0; n < 12; n++)
        x[n] = corner[n / 3][n % 3] + 0.2 * x[n];
    for (int e = 0; e < 6; e++)
        for (int i = 0; i < 3; i++)
            x[3 * (4 + e) + i] =
                0.5 * (x[3 * ost_tet_edge[e][0] + i] + x[3 * ost_tet_edge[e][1] + i]) + bend * next(seed);
}

/* The displacement gradient at a point, its stress times the volume. */
static void stress_at(const OstElasticity *elasticity, const OstPoint *point, OstSimd of_function[FUNCTIONS][3],
                      const OstSimd *u, const OstSimd *w, OstSimd stress[6])
{
    OstSimd slope[3][3] = {{{0}}}, strain[6];
    for (int k = 0; k < NODES + FUNCTIONS; k++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                slope[i][j] += k < NODES ? u[3 * k + i] * point->gradient[k][j]
                                         : w[3 * (k - NODES) + i] * of_function[k - NODES][j];
    ost_strain_of_slope(slope, strain);
    ost_simd_stress(elasticity->c[0], strain, stress);
    for (int p = 0; p < 6; p++)
        stress[p] *= point->volume;
}

static void integrate(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, const OstSimd *w,
                      OstSimd *forces, OstSimd block[FUNCTIONS][9])
{
    memset(forces, 0, 3 * (NODES + FUNCTIONS) * sizeof *forces);
    memset(block, 0, FUNCTIONS * sizeof *block);
    for (int q = 0; q < ost_tet_degree5.count; q++) {
        OstPoint point;
        OstSimd of_function[OST_MAX_FUNCTIONS][3], stress[6];
        ost_element_of(NODES)->evaluate(x, &ost_tet_degree5.point[q], &point);
        ost_complement_gradients(NODES, ost_tet_degree5.point[q].at, &point, of_function);
        stress_at(elasticity, &point, of_function, u, w, stress);
        for (int k = 0; k < NODES + FUNCTIONS; k++) {
            OstSimd force[3];
            ost_force_of_stress(k < NODES ? point.gradient[k] : of_function[k - NODES], stress, force);
            for (int i = 0; i < 3; i++)
                forces[3 * k + i] += force[i];
        }
        for (int k = 0; k < FUNCTIONS; k++) {
            OstSimd columns[6][3], of_point[9];
            ost_stress_columns(elasticity->c[0], of_function[k], columns);
            ost_block_of_stress(of_function[k], columns, of_point);
            for (int n = 0; n < 9; n++)
                block[k][n] += point.volume * of_point[n];
        }
    }
}

static void assert_near(const OstSimd *found, const OstSimd *expected, int count)
{
    for (int n = 0; n < count; n++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            if (!(fabs(found[n][slot] - expected[n][slot]) <= 1e-11))
                fail_msg("number %d is %.15g, by quadrature %.15g", n, found[n][slot], expected[n][slot]);
}

static void straight_tets_are_integrated_without_error(void **state)
{
    unsigned seed = 7U;
    OstSimd x[3 * NODES], u[3 * NODES], w[3 * FUNCTIONS];
    OstSimd at_nodes[3 * NODES], at_functions[3 * FUNCTIONS], forces[3 * (NODES + FUNCTIONS)];
    OstSimd block[OST_MAX_FUNCTIONS][9], expected[FUNCTIONS][9];
    OstElasticity elasticity;
    make(&seed, 0.0, x, &elasticity);
    fill(&seed, 3 * NODES, u);
    fill(&seed, 3 * FUNCTIONS, w);
    assert_true(ost_straight_all(x));
    ost_straight_forces(x, &elasticity, &ost_tet_degree5, u, w, at_nodes, at_functions);
    ost_straight_blocks(x, &elasticity, block);
    integrate(x, &elasticity, u, w, forces, expected);
    assert_near(at_nodes, forces, 3 * NODES);
    assert_near(at_functions, forces + 3 * NODES, 3 * FUNCTIONS);
    for (int k = 0; k < FUNCTIONS; k++)
        assert_near(block[k], expected[k], 9);
    memset(w, 0, sizeof w); /* and without the functions */
    ost_straight_forces(x, &elasticity, &ost_tet_degree5, u, NULL, at_nodes, at_functions);
    integrate(x, &elasticity, u, w, forces, expected);
    assert_near(at_nodes, forces, 3 * NODES);
}

/* A C that is given at the points of the rule. */
static void a_varying_stiffness_is_taken_at_the_points(void **state)
{
    unsigned seed = 11U;
    OstSimd x[3 * NODES], u[3 * NODES], w[3 * FUNCTIONS], expected[2][3 * NODES];
    OstElasticity elasticity;
    make(&seed, 0.0, x, &elasticity);
    fill(&seed, 3 * NODES, u);
    fill(&seed, 3 * FUNCTIONS, w);
    ost_straight_forces(x, &elasticity, &ost_tet_degree5, u, w, expected[0], expected[1]);
    OstSimd at_nodes[3 * NODES], at_functions[3 * FUNCTIONS];
    elasticity.points = ost_tet_degree5.count;
    for (int q = 1; q < elasticity.points; q++)
        memcpy(elasticity.c[q], elasticity.c[0], sizeof elasticity.c[0]);
    ost_straight_forces(x, &elasticity, &ost_tet_degree5, u, w, at_nodes, at_functions);
    assert_near(at_nodes, expected[0], 3 * NODES);
    assert_near(at_functions, expected[1], 3 * FUNCTIONS);
}

/* C_ijkl = (1 - 2 shear) A_ij A_kl + shear (A_ik A_jl + A_il A_jk) */
static void spread_stretch(const OstSimd a[6], double shear, OstSimd *c)
{
    static const int place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
    for (int p = 0; p < 6; p++)
        for (int q = p; q < 6; q++) {
            const int i = p % 3, j = p < 3 ? i : (i + 1) % 3, k = q % 3, l = q < 3 ? k : (k + 1) % 3;
            c[ost_upper[p][q]] = (1.0 - 2.0 * shear) * a[place[i][j]] * a[place[k][l]] +
                                 shear * (a[place[i][k]] * a[place[j][l]] + a[place[i][l]] * a[place[j][k]]);
        }
}

/* Axes about the line x = -1, y = 0.5, along z: stretches 3, 2 and 1 along the radius, around, and along the line. */
static void axes_about_a_line_need_no_stiffness(void **state)
{
    unsigned seed = 17U;
    OstSimd x[3 * NODES], u[3 * NODES], w[3 * FUNCTIONS], expected[2][3 * NODES];
    OstSimd at_nodes[3 * NODES], at_functions[3 * FUNCTIONS];
    OstElasticity elasticity;
    make(&seed, 0.1, x, &elasticity);
    fill(&seed, 3 * NODES, u);
    fill(&seed, 3 * FUNCTIONS, w);
    elasticity.points = ost_tet_degree5.count;
    elasticity.shear = 0.3;
    for (int q = 0; q < elasticity.points; q++) {
        double shape[NODES];
        OstSimd d[2] = {(OstSimd){0} + 1.0, (OstSimd){0} - 0.5}, a[6] = {{0}};
        ost_shape_values(NODES, ost_tet_degree5.point[q].at, shape);
        for (int n = 0; n < 2 * NODES; n++)
            d[n % 2] += shape[n / 2] * x[3 * (n / 2) + n % 2];
        const OstSimd square = d[0] * d[0] + d[1] * d[1];
        a[0] = 2.0 + d[0] * d[0] / square;
        a[1] = 2.0 + d[1] * d[1] / square;
        a[2] += 1.0;
        a[3] = d[0] * d[1] / square;
        spread_stretch(a, elasticity.shear, elasticity.c[q]);
    }
    ost_straight_forces(x, &elasticity, &ost_tet_degree5, u, w, expected[0], expected[1]);
    memset(elasticity.c, 0, sizeof elasticity.c);
    elasticity.about_line = 1;
    elasticity.origin[0] -= 4.0; /* fourfold */
    elasticity.origin[1] += 2.0;
    elasticity.axis[2] += 1.0;
    elasticity.radial += 1.0;
    for (int i = 0; i < 3; i++)
        elasticity.about_axis[i] += i < 2 ? 2.0 : 1.0;
    ost_straight_forces(x, &elasticity, &ost_tet_degree5, u, w, at_nodes, at_functions);
    assert_near(at_nodes, expected[0], 3 * NODES);
    assert_near(at_functions, expected[1], 3 * FUNCTIONS);
}

/* A turn of a curved tet as a whole makes no force, and all forces together make none and no moment. */
static void curved_tets_know_rotations(void **state)
{
    unsigned seed = 13U;
    OstSimd x[3 * NODES], u[3 * NODES], w[3 * FUNCTIONS], at_nodes[3 * NODES], at_functions[3 * FUNCTIONS];
    const OstSimd zero[3 * NODES] = {{0}};
    OstElasticity elasticity;
    make(&seed, 0.1, x, &elasticity);
    assert_false(ost_straight_all(x));
    for (int a = 0; a < NODES; a++) {
        u[3 * a] = 2.0 * x[3 * a + 1] - x[3 * a + 2];
        u[3 * a + 1] = 0.5 * x[3 * a + 2] - 2.0 * x[3 * a];
        u[3 * a + 2] = x[3 * a] - 0.5 * x[3 * a + 1];
    }
    memset(w, 0, sizeof w);
    ost_straight_forces(x, &elasticity, &ost_tet_degree5, u, w, at_nodes, at_functions);
    assert_near(at_nodes, zero, 3 * NODES);
    assert_near(at_functions, zero, 3 * FUNCTIONS);
    fill(&seed, 3 * NODES, u);
    fill(&seed, 3 * FUNCTIONS, w);
    ost_straight_forces(x, &elasticity, &ost_tet_degree5, u, w, at_nodes, at_functions);
    OstSimd sum[6] = {{0}};
    for (int a = 0; a < NODES; a++)
        for (int i = 0; i < 3; i++) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            sum[i] += at_nodes[3 * a + i];
            sum[3 + i] += x[3 * a + j] * at_nodes[3 * a + k] - x[3 * a + k] * at_nodes[3 * a + j];
        }
    assert_near(sum, zero, 6);
}

/* Forces on the functions, and their work, are those of the true shape. */
static void curved_tets_are_integrated_by_the_same_rule(void **state)
{
    unsigned seed = 23U;
    OstSimd x[3 * NODES], u[3 * NODES], w[3 * FUNCTIONS], forces[3 * (NODES + FUNCTIONS)];
    OstSimd at_functions[3 * FUNCTIONS], work, expected = {0}, block[FUNCTIONS][9];
    OstCurvedPoint at[OST_MAX_POINTS];
    OstElasticity elasticity;
    make(&seed, 0.05, x, &elasticity);
    fill(&seed, 3 * NODES, u);
    memset(w, 0, sizeof w);
    assert_false(ost_straight_all(x));
    ost_curved_points(x, at);
    ost_curved_forces(x, at, &elasticity, u, at_functions, &work);
    integrate(x, &elasticity, u, w, forces, block);
    for (int n = 0; n < 3 * NODES; n++)
        expected += u[n] * forces[n];
    assert_near(at_functions, forces + 3 * NODES, 3 * FUNCTIONS);
    assert_near(&work, &expected, 1);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(straight_tets_are_integrated_without_error),
    cmocka_unit_test(a_varying_stiffness_is_taken_at_the_points),
    cmocka_unit_test(axes_about_a_line_need_no_stiffness),
    cmocka_unit_test(curved_tets_know_rotations),
    cmocka_unit_test(curved_tets_are_integrated_by_the_same_rule),
};

OST_TEST_MAIN(tests)
