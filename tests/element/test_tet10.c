/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/quadrature.h"
#include "element/shape_functions.h"
#include "element/tets.h"
#include "element_support.h"

enum { NODES = 10, WIDTH = 30, PAIRS = 55, GAUSS = 8 };

static const int ends[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}; /* orthostat/mesh.h */

/* A tet whose middles are moved from the edges by up to `bend` in each direction. */
static void random_tet10(unsigned seed, double bend, double x[WIDTH])
{
    unsigned s = seed + 100u;
    random_tet(seed, x);
    for (int e = 0; e < 6; e++)
        for (int i = 0; i < 3; i++)
            x[12 + 3 * e + i] = 0.5 * (x[3 * ends[e][0] + i] + x[3 * ends[e][1] + i]) + bend * random_number(&s);
}

/* A batch of tets of four shapes, with one C. */
typedef struct Case {
    double x[OST_SIMD_WIDTH][WIDTH];
    double c[36];
    OstSimd batch_x[WIDTH];
    OstSimd batch_u[WIDTH];
    OstElasticity elasticity;
} Case;

static void make_case(double bend, Case *test)
{
    unsigned seed = 5u;
    turned_ply(test->c);
    uniform_elasticity(test->c, &test->elasticity);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        random_tet10((unsigned)slot % 4u + 1u, bend, test->x[slot]);
        for (int n = 0; n < WIDTH; n++) {
            test->batch_x[n][slot] = test->x[slot][n];
            test->batch_u[n][slot] = random_number(&seed);
        }
    }
}

/* Gauss' points of 8 in each direction of a cube blown onto the tet: exact to degree 13. */
static void gauss_point(int n, double at[4], double *weight)
{
    static const double root[4] = {0.183434642495649805, 0.525532409916328986, 0.796666477413626740,
                                   0.960289856497536232};
    static const double of_root[4] = {0.362683783378361983, 0.313706645877887287, 0.222381034453374471,
                                      0.101228536290376259};
    double t[3];
    *weight = 6.0;
    for (int d = 0; d < 3; d++, n /= GAUSS) {
        const int k = n % GAUSS;
        t[d] = 0.5 + 0.5 * (k < 4 ? root[k] : -root[k - 4]);
        *weight *= 0.5 * of_root[k % 4];
    }
    *weight *= (1.0 - t[0]) * (1.0 - t[0]) * (1.0 - t[1]);
    at[1] = t[0];
    at[2] = t[1] * (1.0 - t[0]);
    at[3] = t[2] * (1.0 - t[0]) * (1.0 - t[1]);
    at[0] = 1.0 - at[1] - at[2] - at[3];
}

/* Factor on C at a point, of degree 1: with the gradients' products the degree is 3. */
static double factor_at(const double at[4])
{
    return 1.0 + at[0] - 0.7 * at[2] + 0.3 * at[1];
}

/* 30 × 30, by the plain product in many points; C is the same everywhere, or varies by the factor. */
static void plain_stiffness(const double x[WIDTH], const double c[36], int varies, double *k)
{
    memset(k, 0, WIDTH * WIDTH * sizeof *k);
    for (int n = 0; n < GAUSS * GAUSS * GAUSS; n++) {
        double at[4], weight, g[WIDTH];
        gauss_point(n, at, &weight);
        const double volume = fabs(ost_shape_gradients(NODES, at, x, g)) / 6.0;
        add_plain_product(NODES, g, c, weight * volume * (varies ? factor_at(at) : 1.0), k);
    }
}

static void make_varying(Case *test)
{
    test->elasticity.points = ost_tet10.points;
    assert_int_equal(ost_tet10.points, ost_tet_degree3.count);
    for (int q = ost_tet_degree3.count - 1; q >= 0; q--)
        for (int n = 0; n < OST_ELASTICITY_COUNT; n++)
            test->elasticity.c[q][n] = factor_at(ost_tet_degree3.point[q].at) * test->elasticity.c[0][n];
}

/* Expects the kernels' K and K u of every tet to be the plain ones'. */
static void assert_stiffness(const Case *test, int varies, double tolerance)
{
    OstSimd blocks[9 * PAIRS];
    OstSimd force[WIDTH];
    ost_tet10.stiffness(test->batch_x, &test->elasticity, blocks);
    ost_tet10.force(test->batch_x, &test->elasticity, test->batch_u, force);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double k[WIDTH * WIDTH];
        double expected[WIDTH * WIDTH];
        full_matrix(NODES, blocks, slot, k);
        plain_stiffness(test->x[slot], test->c, varies, expected);
        const double size = largest_of(WIDTH * WIDTH, expected);
        for (int i = 0; i < WIDTH; i++) {
            double sum = 0.0;
            for (int j = 0; j < WIDTH; j++) {
                assert_close(k[WIDTH * i + j] / size, expected[WIDTH * i + j] / size, tolerance);
                sum += expected[WIDTH * i + j] * test->batch_u[j][slot];
            }
            assert_close(force[i][slot] / size, sum / size, 10.0 * tolerance);
        }
    }
}

static void rules_are_exact_to_their_degrees(void **state)
{
    static const int degrees[3] = {2, 3, 5};
    const OstQuadrature *rules[3] = {&ost_tet_degree2, &ost_tet_degree3, &ost_tet_degree5};
    for (int r = 0; r < 3; r++)
        for (int n = 0; n < 216; n++) {
            const int power[3] = {n % 6, n / 6 % 6, n / 36};
            const int degree = power[0] + power[1] + power[2];
            double sum = 0.0;
            for (int q = 0; q < rules[r]->count; q++) {
                const double *at = rules[r]->point[q].at;
                assert_close(at[0] + at[1] + at[2] + at[3], 1.0, 1e-15);
                assert_true(at[0] > 0.0 && at[1] > 0.0 && at[2] > 0.0 && rules[r]->point[q].weight > 0.0);
                sum += rules[r]->point[q].weight * pow(at[1], power[0]) * pow(at[2], power[1]) * pow(at[3], power[2]);
            }
            /* mean of x^a y^b z^c over the tet: 3! a! b! c! / (a + b + c + 3)! */
            const double mean =
                6.0 * tgamma(power[0] + 1) * tgamma(power[1] + 1) * tgamma(power[2] + 1) / tgamma(degree + 4);
            if (degree <= degrees[r])
                assert_close(sum, mean, 1e-16);
        }
    for (int n = 0; n < 36; n++) {
        double sum = 0.0;
        for (int q = 0; q < ost_triangle_degree5.count; q++) {
            const OstQuadraturePoint *point = &ost_triangle_degree5.point[q];
            sum += point->weight * pow(point->at[1], n % 6) * pow(point->at[2], n / 6);
        }
        if (n % 6 + n / 6 <= 5)
            assert_close(sum, 2.0 * tgamma(n % 6 + 1) * tgamma(n / 6 + 1) / tgamma(n % 6 + n / 6 + 3), 1e-16);
    }
}

static void stiffness_of_a_straight_tet_is_the_plain_product(void **state)
{
    Case test;
    make_case(0.0, &test);
    assert_stiffness(&test, 0, 1e-12);
}

static void stiffness_follows_c_from_point_to_point(void **state)
{
    Case test;
    make_case(0.0, &test);
    make_varying(&test);
    assert_stiffness(&test, 1, 1e-12);
}

/* On curved tets the integrand is no polynomial; the rule is good where edges bend by a few hundredths. */
static void stiffness_of_a_curved_tet_is_the_plain_product_to_the_rules_error(void **state)
{
    Case test;
    make_case(0.03, &test);
    assert_stiffness(&test, 0, 2e-3);
    make_varying(&test);
    assert_stiffness(&test, 1, 2e-3);
    make_case(0.003, &test);
    assert_stiffness(&test, 0, 1e-5);
}

/* The paths of stiffness and force are not the same; straight tets beside a curved one take the longer. */
static void a_straight_tet_does_not_feel_a_curved_one_beside_it(void **state)
{
    Case test;
    OstSimd alone[9 * PAIRS];
    OstSimd beside[9 * PAIRS];
    make_case(0.0, &test);
    ost_tet10.stiffness(test.batch_x, &test.elasticity, alone);
    test.batch_x[20][3] += 0.05;
    ost_tet10.stiffness(test.batch_x, &test.elasticity, beside);
    double size = 0.0;
    for (int n = 0; n < 9 * PAIRS; n++)
        size = fmax(size, fabs(alone[n][0]));
    for (int n = 0; n < 9 * PAIRS; n++)
        for (int slot = 0; slot < 3; slot++)
            assert_close(beside[n][slot] / size, alone[n][slot] / size, 1e-13);
}

static void rigid_motions_meet_no_stiffness(void **state)
{
    for (int curved = 0; curved < 2; curved++) {
        Case test;
        OstSimd force[WIDTH];
        make_case(0.05 * curved, &test);
        for (int mode = 0; mode < 6; mode++) {
            const int first = mode % 3, next = (mode + 1) % 3;
            for (int n = 0; n < WIDTH; n++)
                test.batch_u[n] = (OstSimd){0} + (mode < 3 && n % 3 == mode);
            for (int a = 0; a < NODES && mode >= 3; a++) {
                test.batch_u[3 * a + next] = test.batch_x[3 * a + first] - 5.0;
                test.batch_u[3 * a + first] = 5.0 - test.batch_x[3 * a + next];
            }
            ost_tet10.force(test.batch_x, &test.elasticity, test.batch_u, force);
            for (int n = 0; n < WIDTH; n++)
                for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
                    assert_close(force[n][slot] / test.c[0], 0.0, 1e-12);
        }
    }
}

/* u_i = quadratic in x; the nodal forces are the integrals of B' C strain with the strain written out. */
static double quadratic(int i, const double x[3])
{
    const double y[3] = {x[0] - 5.0, x[1] - 5.0, x[2] - 5.0};
    return (0.3 - 0.1 * i) * y[0] * y[0] + 0.2 * y[0] * y[(i + 1) % 3] - 0.4 * y[1] * y[2] + 0.15 * i * y[2] * y[2] +
           0.05 * y[i];
}

static void strain_of_quadratic(const double x[3], double strain[6])
{
    const double y[3] = {x[0] - 5.0, x[1] - 5.0, x[2] - 5.0};
    double slope[3][3] = {{0}};
    for (int i = 0; i < 3; i++) {
        slope[i][0] += 2.0 * (0.3 - 0.1 * i) * y[0] + 0.2 * y[(i + 1) % 3];
        slope[i][(i + 1) % 3] += 0.2 * y[0];
        slope[i][1] -= 0.4 * y[2];
        slope[i][2] -= 0.4 * y[1];
        slope[i][2] += 0.3 * i * y[2];
        slope[i][i] += 0.05;
    }
    for (int i = 0; i < 3; i++) {
        strain[i] = slope[i][i];
        strain[3 + i] = slope[i][(i + 1) % 3] + slope[(i + 1) % 3][i];
    }
}

/* Of a tet under the quadratic displacement: force by the plain product, and means of strain, stress and energy. */
static void plain_answer(const double x[WIDTH], const double c[36], double force[WIDTH], double means[13])
{
    double whole = 0.0;
    memset(force, 0, WIDTH * sizeof *force);
    memset(means, 0, 13 * sizeof *means);
    for (int n = 0; n < GAUSS * GAUSS * GAUSS; n++) {
        double at[4], weight, g[WIDTH], values[NODES], place[3], strain[6], stress[6] = {0};
        gauss_point(n, at, &weight);
        const double volume = weight * fabs(ost_shape_gradients(NODES, at, x, g)) / 6.0;
        ost_shape_values(NODES, at, values);
        ost_shape_place(NODES, values, x, place);
        strain_of_quadratic(place, strain);
        for (int pq = 0; pq < 36; pq++)
            stress[pq / 6] += c[pq] * strain[pq % 6];
        whole += volume;
        for (int p = 0; p < 6; p++) {
            means[p] += volume * strain[p];
            means[6 + p] += volume * stress[p];
            means[12] += 0.5 * volume * strain[p] * stress[p];
        }
        for (int a = 0; a < NODES; a++)
            for (int i = 0; i < 3; i++) {
                const int next = (i + 1) % 3, before = (i + 2) % 3;
                force[3 * a + i] += volume * (g[3 * a + i] * stress[i] + g[3 * a + next] * stress[3 + i] +
                                              g[3 * a + before] * stress[3 + before]);
            }
    }
    for (int p = 0; p < 13; p++)
        means[p] /= whole;
}

static void a_quadratic_field_has_its_strain_stress_and_forces(void **state)
{
    Case test;
    OstSimd force[WIDTH];
    OstSimd nodal[60];
    OstKeptPoints at_nodes;
    OstMeans means;
    make_case(0.0, &test);
    for (int n = 0; n < WIDTH; n++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            test.batch_u[n][slot] = quadratic(n % 3, test.x[slot] + n / 3 * 3);
    ost_tet10.force(test.batch_x, &test.elasticity, test.batch_u, force);
    ost_tet10.means(test.batch_x, &test.elasticity, test.batch_u, &means);
    ost_tet10.keep_nodes(test.batch_x, &at_nodes);
    ost_tet10.nodal_strain(test.batch_x, &at_nodes, test.batch_u, nodal);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double expected[WIDTH], mean[13], strain[6];
        plain_answer(test.x[slot], test.c, expected, mean);
        for (int n = 0; n < WIDTH; n++)
            assert_close(force[n][slot] / test.c[0], expected[n] / test.c[0], 1e-13);
        for (int p = 0; p < 6; p++) {
            assert_close(means.strain[p][slot], mean[p], 1e-13);
            assert_close(means.stress[p][slot] / test.c[0], mean[6 + p] / test.c[0], 1e-13);
        }
        assert_close(means.energy[slot] / mean[12], 1.0, 1e-12);
        for (int a = 0; a < NODES; a++) {
            strain_of_quadratic(test.x[slot] + 3 * a, strain);
            for (int p = 0; p < 6; p++)
                assert_close(nodal[6 * a + p][slot], strain[p], 1e-13);
        }
    }
}

/* What a batch's displacements give. */
typedef struct Found {
    OstSimd force[WIDTH], beside[WIDTH], magnitude[WIDTH], stress[6];
    OstMeans means;
} Found;

static void find(const Case *test, Found *found)
{
    ost_tet10.force(test->batch_x, &test->elasticity, test->batch_u, found->force);
    ost_tet10.force_and_stress(test->batch_x, &test->elasticity, test->batch_u, found->beside, found->stress);
    ost_tet10.magnitude(test->batch_x, &test->elasticity, test->batch_u, found->magnitude);
    ost_tet10.means(test->batch_x, &test->elasticity, test->batch_u, &found->means);
}

static void assert_same(int count, const OstSimd *a, const OstSimd *b)
{
    double size = 0.0;
    for (int n = 0; n < count; n++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            size = fmax(size, fabs(b[n][slot]));
    for (int n = 0; n < count; n++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            assert_close(a[n][slot] / size, b[n][slot] / size, 1e-14);
}

static void points_that_are_kept_change_nothing(void **state)
{
    (void)state;
    for (int kind = 0; kind < 3; kind++) { /* straight, curved, of a C that varies */
        Case test;
        OstKeptPoints kept;
        Found alone, shared;
        make_case(kind > 0 ? 0.1 : 0.0, &test);
        if (kind == 2)
            make_varying(&test);
        find(&test, &alone);
        ost_tet10.keep(test.batch_x, &test.elasticity, &kept);
        assert_ptr_equal(kept.rule, kind == 0 ? &ost_tet_degree2 : &ost_tet_degree3);
        test.elasticity.kept = &kept;
        find(&test, &shared);
        assert_same(WIDTH, shared.force, alone.force);
        assert_same(WIDTH, shared.magnitude, alone.magnitude);
        assert_same(6, shared.means.stress, alone.means.stress);
        assert_same(WIDTH, alone.beside, alone.force);
        assert_same(6, alone.stress, alone.means.stress);
    }
}

/* |B'| |C| |B| |u| in the rule's points, by plain loops. */
static void magnitude_sums_absolute_values(void **state)
{
    Case test;
    OstSimd magnitude[WIDTH];
    OstSimd force[WIDTH];
    make_case(0.0, &test);
    ost_tet10.magnitude(test.batch_x, &test.elasticity, test.batch_u, magnitude);
    ost_tet10.force(test.batch_x, &test.elasticity, test.batch_u, force);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double k[WIDTH * WIDTH] = {0};
        double c[36];
        for (int p = 0; p < 36; p++)
            c[p] = fabs(test.c[p]);
        for (int q = 0; q < ost_tet_degree2.count; q++) {
            double g[WIDTH];
            const double volume = fabs(ost_shape_gradients(NODES, ost_tet_degree2.point[q].at, test.x[slot], g)) / 6.0;
            for (int n = 0; n < WIDTH; n++)
                g[n] = fabs(g[n]);
            add_plain_product(NODES, g, c, 0.25 * volume, k);
        }
        for (int i = 0; i < WIDTH; i++) {
            double expected = 0.0;
            for (int j = 0; j < WIDTH; j++)
                expected += k[WIDTH * i + j] * fabs(test.batch_u[j][slot]);
            assert_close(magnitude[i][slot] / expected, 1.0, 1e-12);
            assert_true(fabs(force[i][slot]) <= magnitude[i][slot]);
        }
    }
}

static void scalar_measures_follow_the_shape_functions(void **state)
{
    for (unsigned seed = 1u; seed <= 2u; seed++) { /* one of each orientation */
        double x[WIDTH], u[WIDTH], volumes[NODES], gradient[9], pairs[PAIRS];
        double volume = 0.0, node_volumes[NODES] = {0}, mean[9] = {0}, products[PAIRS] = {0};
        unsigned s = 9u;
        random_tet10(seed, seed == 1u ? 0.0 : 0.05, x);
        for (int n = 0; n < WIDTH; n++)
            u[n] = random_number(&s);
        for (int n = 0; n < GAUSS * GAUSS * GAUSS; n++) {
            double at[4], weight, g[WIDTH], values[NODES];
            gauss_point(n, at, &weight);
            const double signed_volume = weight * ost_shape_gradients(NODES, at, x, g) / 6.0;
            ost_shape_values(NODES, at, values);
            volume += signed_volume;
            for (int a = 0, p = 0; a < NODES; a++) {
                node_volumes[a] += fabs(signed_volume) * values[a];
                for (int m = 0; m < 9; m++)
                    mean[m] += fabs(signed_volume) * u[3 * a + m / 3] * g[3 * a + m % 3];
                for (int b = a; b < NODES; b++, p++)
                    for (int i = 0; i < 3; i++)
                        products[p] += fabs(signed_volume) * g[3 * a + i] * g[3 * b + i];
            }
        }
        assert_close(ost_tet10.volume(x) / volume, 1.0, 1e-13);
        assert_true(seed == 1u ? volume < 0.0 : volume > 0.0);
        ost_tet10.node_volumes(x, volumes);
        for (int a = 0; a < NODES; a++)
            assert_close(volumes[a] / volume, node_volumes[a] / volume, 1e-13); /* degree 5 */
        ost_tet10.gradient(x, u, gradient);
        for (int m = 0; m < 9; m++)
            assert_close(gradient[m], mean[m] / fabs(volume), 1e-12); /* degree 3 */
        ost_tet10.laplacian(x, pairs);
        const double tolerance = seed == 1u ? 1e-12 : 1e-3;
        for (int p = 0; p < PAIRS; p++)
            assert_close(pairs[p], products[p], tolerance);
    }
}

/* A sphere's octant of one face, its middles on the sphere, and refined by cutting angles: area pi/2 in the limit. */
static double area_of_octant(int cuts)
{
    double area = 0.0;
    for (int i = 0; i < cuts; i++)
        for (int j = 0; j < cuts; j++)
            for (int half = 0; half < 2 && i + j + half < cuts; half++) {
                static const int corner[2][3][2] = {{{0, 0}, {1, 0}, {0, 1}}, {{1, 0}, {1, 1}, {0, 1}}};
                double x[18], areas[6], vectors[18];
                for (int a = 0; a < 6; a++) {
                    double p[3] = {0};
                    for (int end = 0; end < 2; end++) {
                        const int *c = corner[half][a < 3 ? a : (a + end) % 3];
                        p[0] += i + c[0];
                        p[1] += j + c[1];
                    }
                    p[2] = 2.0 * cuts - p[0] - p[1];
                    const double length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
                    for (int d = 0; d < 3; d++)
                        x[3 * a + d] = p[d] / length;
                }
                ost_tet10.node_areas(x, areas, vectors);
                for (int a = 0; a < 6; a++)
                    area += areas[a];
            }
    return area;
}

static void areas_of_curved_faces_converge_with_order_four(void **state)
{
    const double exact = 1.57079632679489662;
    const double error[3] = {fabs(area_of_octant(4) - exact), fabs(area_of_octant(8) - exact),
                             fabs(area_of_octant(16) - exact)};
    assert_true(error[1] < error[0] / 14.0);
    assert_true(error[2] < error[1] / 15.0);
}

/* 0, 0, 0 at the vertices and a third at each middle. */
static void straight_faces_share_area_between_their_middles(void **state)
{
    const double x[18] = {1, 1, 1, 1, 3, 1, 1, 1, 4, 1, 2, 1, 1, 2, 2.5, 1, 1, 2.5}; /* area 3, normal +x */
    double areas[6], vectors[18];
    ost_tet10.node_areas(x, areas, vectors);
    for (int a = 0; a < 6; a++) {
        assert_close(areas[a], a < 3 ? 0.0 : 1.0, 1e-15);
        assert_close(vectors[3 * a], a < 3 ? 0.0 : 1.0, 1e-15);
        assert_close(vectors[3 * a + 1], 0.0, 1e-16);
        assert_close(vectors[3 * a + 2], 0.0, 1e-16);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(rules_are_exact_to_their_degrees),
    cmocka_unit_test(stiffness_of_a_straight_tet_is_the_plain_product),
    cmocka_unit_test(stiffness_follows_c_from_point_to_point),
    cmocka_unit_test(stiffness_of_a_curved_tet_is_the_plain_product_to_the_rules_error),
    cmocka_unit_test(a_straight_tet_does_not_feel_a_curved_one_beside_it),
    cmocka_unit_test(rigid_motions_meet_no_stiffness),
    cmocka_unit_test(a_quadratic_field_has_its_strain_stress_and_forces),
    cmocka_unit_test(points_that_are_kept_change_nothing),
    cmocka_unit_test(magnitude_sums_absolute_values),
    cmocka_unit_test(scalar_measures_follow_the_shape_functions),
    cmocka_unit_test(areas_of_curved_faces_converge_with_order_four),
    cmocka_unit_test(straight_faces_share_area_between_their_middles),
};

OST_TEST_MAIN(tests)
