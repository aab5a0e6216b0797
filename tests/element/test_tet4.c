/* SPDX-License-Identifier: BSD-3-Clause */
#include "element/tets.h"
#include "element_support.h"

enum { PAIRS = 10 };

/* B, 6 × 12, written out from the definition of strain. */
static void strain_matrix(const double g[12], double b[6][12])
{
    memset(b, 0, 72 * sizeof(double));
    for (int a = 0; a < 4; a++) {
        const double dx = g[3 * a], dy = g[3 * a + 1], dz = g[3 * a + 2];
        b[0][3 * a] = dx;
        b[1][3 * a + 1] = dy;
        b[2][3 * a + 2] = dz;
        b[3][3 * a] = dy;
        b[3][3 * a + 1] = dx;
        b[4][3 * a + 1] = dz;
        b[4][3 * a + 2] = dy;
        b[5][3 * a] = dz;
        b[5][3 * a + 2] = dx;
    }
}

/* Gradients by solving for the planes N_a = 1 at a and 0 at the others (Cramer's rule on [1 x y z]). */
static double plain_determinant(const double x[12], int row, int column)
{
    double m[9];
    int n = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            if (i != row && j != column)
                m[n++] = j == 0 ? 1.0 : x[3 * i + j - 1];
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) + m[2] * (m[3] * m[7] - m[4] * m[6]);
}

static double plain_gradients(const double x[12], double g[12])
{
    double determinant = 0.0;
    for (int a = 0; a < 4; a++)
        determinant += (a % 2 == 0 ? 1.0 : -1.0) * plain_determinant(x, a, 0);
    for (int a = 0; a < 4; a++)
        for (int j = 1; j < 4; j++)
            g[3 * a + j - 1] = ((a + j) % 2 == 0 ? 1.0 : -1.0) * plain_determinant(x, a, j) / determinant;
    return determinant / 6.0;
}

static void plain_stiffness(const double x[12], const double c[36], double k[12][12])
{
    double g[12];
    double b[6][12];
    const double volume = fabs(plain_gradients(x, g));
    strain_matrix(g, b);
    for (int i = 0; i < 12; i++)
        for (int j = 0; j < 12; j++) {
            k[i][j] = 0.0;
            for (int p = 0; p < 6; p++)
                for (int q = 0; q < 6; q++)
                    k[i][j] += volume * b[p][i] * c[6 * p + q] * b[q][j];
        }
}

/* Four tets at once, each of its own shape; K as 12 × 12 of one of them. */
typedef struct Case {
    double x[OST_SIMD_WIDTH][12];
    double c[36];
    OstSimd batch_x[12];
    OstElasticity elasticity;
} Case;

static void make_case(Case *test)
{
    turned_ply(test->c);
    uniform_elasticity(test->c, &test->elasticity);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        random_tet((unsigned)slot + 1u, test->x[slot]);
        for (int i = 0; i < 12; i++)
            test->batch_x[i][slot] = test->x[slot][i];
    }
}

static double largest(double k[12][12])
{
    double size = 0.0;
    for (int i = 0; i < 12; i++)
        for (int j = 0; j < 12; j++)
            size = fmax(size, fabs(k[i][j]));
    return size;
}

static void pairs_are_numbered_row_by_row(void **state)
{
    int n = 0;
    for (int a = 0; a < 10; a++)
        for (int b = a; b < 10; b++)
            assert_int_equal(ost_pair_index(10, a, b), n++);
    assert_int_equal(ost_pair_count(10), n);
    assert_int_equal(ost_pair_count(4), PAIRS);
}

static void stiffness_is_the_full_product_b_c_b(void **state)
{
    Case test;
    OstSimd blocks[9 * PAIRS];
    make_case(&test);
    ost_tet4.stiffness(test.batch_x, &test.elasticity, blocks);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double expected[12][12];
        double k[12][12];
        plain_stiffness(test.x[slot], test.c, expected);
        full_matrix(4, blocks, slot, *k);
        const double size = largest(expected);
        for (int i = 0; i < 12; i++)
            for (int j = 0; j < 12; j++)
                assert_close(k[i][j] / size, expected[i][j] / size, 1e-12);
    }
}

static void force_is_stiffness_times_displacement(void **state)
{
    Case test;
    OstSimd u[12];
    OstSimd force[12];
    unsigned seed = 5u;
    make_case(&test);
    for (int i = 0; i < 12; i++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            u[i][slot] = random_number(&seed);
    ost_tet4.force(test.batch_x, &test.elasticity, u, force);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double k[12][12];
        plain_stiffness(test.x[slot], test.c, k);
        for (int i = 0; i < 12; i++) {
            double expected = 0.0;
            for (int j = 0; j < 12; j++)
                expected += k[i][j] * u[j][slot];
            assert_close(force[i][slot] / largest(k), expected / largest(k), 1e-12);
        }
    }
}

/* |B'| |C| |B| |u|, by the plain matrices. */
static void magnitude_sums_absolute_values(void **state)
{
    Case test;
    OstSimd u[12];
    OstSimd magnitude[12];
    unsigned seed = 5u;
    make_case(&test);
    for (int i = 0; i < 12; i++)
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
            u[i][slot] = random_number(&seed);
    ost_tet4.magnitude(test.batch_x, &test.elasticity, u, magnitude);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double g[12];
        double b[6][12];
        const double volume = fabs(plain_gradients(test.x[slot], g));
        strain_matrix(g, b);
        for (int i = 0; i < 12; i++) {
            double expected = 0.0;
            for (int pq = 0; pq < 36; pq++)
                for (int j = 0; j < 12; j++)
                    expected += volume * fabs(b[pq / 6][i] * test.c[pq] * b[pq % 6][j] * u[j][slot]);
            assert_close(magnitude[i][slot] / expected, 1.0, 1e-11);
        }
    }
}

static void rigid_motions_meet_no_stiffness(void **state)
{
    Case test;
    OstSimd blocks[9 * PAIRS];
    make_case(&test);
    ost_tet4.stiffness(test.batch_x, &test.elasticity, blocks);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double k[12][12];
        full_matrix(4, blocks, slot, *k);
        for (int mode = 0; mode < 6; mode++)
            for (int i = 0; i < 12; i++) {
                double force = 0.0;
                for (int a = 0; a < 4; a++) {
                    const double *x = &test.x[slot][3 * a];
                    const int first = mode % 3, next = (mode + 1) % 3;
                    if (mode < 3) {
                        force += k[i][3 * a + mode];
                    } else {
                        force += k[i][3 * a + next] * (x[first] - 5.0) - k[i][3 * a + first] * (x[next] - 5.0);
                    }
                }
                assert_close(force / largest(k), 0.0, 1e-14);
            }
    }
}

/* u = A x gives the strains of A exactly, and stress C strain with energy ½ strain·C·strain. */
static void a_linear_field_has_its_strain_and_energy(void **state)
{
    static const double a[9] = {0.1, 0.02, -0.03, 0.05, -0.2, 0.04, 0.07, 0.01, 0.3};
    const double expected[6] = {a[0], a[4], a[8], a[1] + a[3], a[5] + a[7], a[6] + a[2]};
    Case test;
    OstSimd u[12];
    OstSimd nodal[24];
    OstMeans means;
    double density = 0.0;
    make_case(&test);
    for (int n = 0; n < 12; n++)
        u[n] = a[3 * (n % 3)] * test.batch_x[n / 3 * 3] + a[3 * (n % 3) + 1] * test.batch_x[n / 3 * 3 + 1] +
               a[3 * (n % 3) + 2] * test.batch_x[n / 3 * 3 + 2];
    for (int pq = 0; pq < 36; pq++)
        density += 0.5 * expected[pq / 6] * test.c[pq] * expected[pq % 6];
    ost_tet4.means(test.batch_x, &test.elasticity, u, &means);
    ost_tet4.nodal_strain(test.batch_x, NULL, u, nodal);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        for (int p = 0; p < 6; p++) {
            double stress = 0.0;
            for (int q = 0; q < 6; q++)
                stress += test.c[6 * p + q] * expected[q];
            assert_close(means.strain[p][slot], expected[p], 1e-14);
            assert_close(means.stress[p][slot] / test.c[0], stress / test.c[0], 1e-13);
            for (int node = 0; node < 4; node++)
                assert_close(nodal[6 * node + p][slot], expected[p], 1e-14);
        }
        assert_close(means.energy[slot] / density, 1.0, 1e-12);
        assert_close(means.stiff[slot], 0.0, 0.0);
    }
}

static void gradients_and_laplacian_follow_the_shape_functions(void **state)
{
    double x[12];
    double u[12];
    double g[12];
    double gradient[9];
    double pairs[PAIRS];
    unsigned seed = 3u;
    random_tet(1u, x); /* turned inside out: the laplacian is positive all the same */
    for (int i = 0; i < 12; i++)
        u[i] = random_number(&seed);
    const double volume = fabs(plain_gradients(x, g));
    ost_tet4.gradient(x, u, gradient);
    ost_tet4.laplacian(x, pairs);
    for (int i = 0; i < 9; i++) {
        double expected = 0.0;
        for (int a = 0; a < 4; a++)
            expected += u[3 * a + i / 3] * g[3 * a + i % 3];
        assert_close(gradient[i], expected, 1e-12);
    }
    for (int a = 0; a < 4; a++)
        for (int b = a; b < 4; b++)
            assert_close(pairs[ost_pair_index(4, a, b)],
                         volume * (g[3 * a] * g[3 * b] + g[3 * a + 1] * g[3 * b + 1] + g[3 * a + 2] * g[3 * b + 2]),
                         1e-12);
}

static void volumes_carry_the_orientation(void **state)
{
    const double x[12] = {1, 2, 3, 3, 2, 3, 1, 5, 3, 1, 2, 7}; /* legs 2, 3, 4 from a corner: 4 */
    double mirrored[12];
    double gradients[12];
    double volumes[4];
    memcpy(mirrored, x, sizeof x);
    memcpy(mirrored + 3, x + 6, 3 * sizeof *x);
    memcpy(mirrored + 6, x + 3, 3 * sizeof *x);
    assert_close(ost_tet4.volume(x), 4.0, 1e-14);
    assert_close(ost_tet4.volume(mirrored), -4.0, 1e-14);
    assert_close(ost_tet4_gradients(x, gradients), 4.0, 1e-14);
    assert_close(gradients[3], 1.0 / 2.0, 1e-15);
    assert_close(gradients[7], 1.0 / 3.0, 1e-15);
    assert_close(gradients[11], 1.0 / 4.0, 1e-15);
    ost_tet4.node_volumes(mirrored, volumes);
    for (int a = 0; a < 4; a++)
        assert_close(volumes[a], 1.0, 1e-14);
}

static void faces_share_area_and_direction(void **state)
{
    const double x[9] = {1, 1, 1, 1, 3, 1, 1, 1, 4}; /* legs 2 and 3: area 3, normal +x */
    double areas[3];
    double vectors[9];
    ost_tet4.node_areas(x, areas, vectors);
    for (int a = 0; a < 3; a++) {
        assert_close(areas[a], 1.0, 1e-15);
        assert_close(vectors[3 * a], 1.0, 1e-15);
        assert_close(vectors[3 * a + 1], 0.0, 0.0);
        assert_close(vectors[3 * a + 2], 0.0, 0.0);
    }
}

static void tets_are_told_apart_by_their_nodes(void **state)
{
    assert_ptr_equal(ost_element_of(4), &ost_tet4);
    assert_ptr_equal(ost_element_of(10), &ost_tet10);
    assert_null(ost_element_of(8));
}

static void lanes_turn_into_tets(void **state)
{
    OstSimdFour in[OST_SIMD_FOUR];
    OstSimdFour out[OST_SIMD_FOUR];
    for (int i = 0; i < OST_SIMD_FOUR; i++)
        for (int slot = 0; slot < OST_SIMD_FOUR; slot++)
            in[i][slot] = 10 * i + slot;
    ost_simd_transpose(in, out);
    for (int i = 0; i < OST_SIMD_FOUR; i++)
        for (int slot = 0; slot < OST_SIMD_FOUR; slot++)
            assert_close(out[slot][i], 10 * i + slot, 0.0);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(pairs_are_numbered_row_by_row),
    cmocka_unit_test(lanes_turn_into_tets),
    cmocka_unit_test(stiffness_is_the_full_product_b_c_b),
    cmocka_unit_test(force_is_stiffness_times_displacement),
    cmocka_unit_test(magnitude_sums_absolute_values),
    cmocka_unit_test(rigid_motions_meet_no_stiffness),
    cmocka_unit_test(a_linear_field_has_its_strain_and_energy),
    cmocka_unit_test(gradients_and_laplacian_follow_the_shape_functions),
    cmocka_unit_test(volumes_carry_the_orientation),
    cmocka_unit_test(faces_share_area_and_direction),
    cmocka_unit_test(tets_are_told_apart_by_their_nodes),
};

OST_TEST_MAIN(tests)
