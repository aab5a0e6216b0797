/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/small.h"
#include "element/large_rotation.h"
#include "element_support.h"

/* Stresses with large rotations, by both formulations, against forces and energy. */

enum { WIDTH = 30 };

static const double moderate[4][3] = {{1.1, 0.95, 1.2}, {0.7, 1.0, 1.4}, {1.0, 1.02, 0.99}, {0.6, 0.7, 0.5}};

typedef struct Case {
    const OstElement *element;
    OstSimd x[WIDTH], u[WIDTH];
    OstElasticity elasticity;
} Case;

/* Nodes go to F x, and up to `scatter` off. */
static void make_case(int nodes, int by_mean, double scatter, Case *test)
{
    static const int ends[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}; /* orthostat/mesh.h */
    unsigned seed = 3u;
    double c[36];
    test->element = ost_element_of(nodes);
    turned_ply(c);
    uniform_elasticity(c, &test->elasticity);
    test->elasticity.by_mean = by_mean;
    for (int p = 0; p < 6; p++)
        test->elasticity.m[0][p] = 300.0 - 40.0 * p + (OstSimd){0};
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double x[WIDTH], f[9], to[3];
        random_tet((unsigned)slot + 1u, x);
        for (int n = 0; n < 18; n++)
            x[12 + n] =
                0.5 * (x[3 * ends[n / 3][0] + n % 3] + x[3 * ends[n / 3][1] + n % 3]) + scatter * random_number(&seed);
        deformation((unsigned)slot + 7u, moderate[slot % 4], f);
        for (int n = 0; n < 3 * nodes; n++) {
            ost_apply3(f, x + n - n % 3, to);
            test->x[n][slot] = x[n];
            test->u[n][slot] = to[n % 3] - x[n] + scatter * random_number(&seed);
        }
    }
}

/* The volume of the deformed tets. */
static void volume_now(const Case *test, OstSimd *volume)
{
    const OstQuadrature *rule = test->element->rule(test->x, &test->elasticity);
    *volume = (OstSimd){0};
    for (int q = 0; q < rule->count; q++) {
        OstPoint point;
        OstSimd slope[9];
        test->element->evaluate(test->x, &rule->point[q], &point);
        ost_displacement_gradient(test->element->nodes, &point, test->u, slope);
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            double f[9];
            for (int n = 0; n < 9; n++)
                f[n] = slope[n][slot] + (n % 4 == 0 ? 1.0 : 0.0);
            (*volume)[slot] += point.volume[slot] * ost_determinant3(f);
        }
    }
}

/* The virial theorem: the sum over the nodes of force times place is the integral of Cauchy's stress over the deformed
 * tet, but for the moment of the classical forces. */
static void mean_stress_is_that_of_the_forces(void **state)
{
    for (int kind = 0; kind < 3; kind++)
        for (int f = OST_FORMULATION_CONSISTENT; f <= OST_FORMULATION_CLASSICAL; f++) {
            Case test;
            OstSimd force[WIDTH], stress[6], volume;
            make_case(kind == 0 ? 4 : 10, kind == 2, 0.03, &test);
            volume_now(&test, &volume);
            ost_large_rotation_force(test.element, (OstFormulation)f, test.x, &test.elasticity, test.u, NULL, force);
            ost_large_rotation_mean_stress(test.element, (OstFormulation)f, test.x, &test.elasticity, test.u, stress);
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
                for (int p = 0; p < 6; p++) {
                    const int i = p % 3, j = p < 3 ? i : (i + 1) % 3;
                    double virial = 0.0, size = 0.0;
                    for (int a = 0; a < test.element->nodes; a++)
                        virial += 0.5 * (force[3 * a + i][slot] * (test.x[3 * a + j][slot] + test.u[3 * a + j][slot]) +
                                         force[3 * a + j][slot] * (test.x[3 * a + i][slot] + test.u[3 * a + i][slot]));
                    for (int q = 0; q < 6; q++)
                        size = fmax(size, fabs(stress[q][slot]));
                    assert_close(stress[p][slot] / size, virial / volume[slot] / size, 1e-11);
                }
        }
}

/* Where the deformation is uniform, so is the stress: its mean is that at the nodes. */
static void nodes_have_the_mean_of_a_uniform_stress(void **state)
{
    for (int nodes = 4; nodes <= 10; nodes += 6)
        for (int f = OST_FORMULATION_CONSISTENT; f <= OST_FORMULATION_CLASSICAL; f++) {
            Case test;
            OstSimd mean[6], at_nodes[6 * 10];
            make_case(nodes, nodes == 10, 0.0, &test);
            ost_large_rotation_mean_stress(test.element, (OstFormulation)f, test.x, &test.elasticity, test.u, mean);
            ost_large_rotation_nodal_stress(test.element, (OstFormulation)f, test.x, &test.elasticity, &test.elasticity,
                                            test.u, at_nodes);
            for (int n = 0; n < 6 * nodes; n++)
                for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
                    assert_close(at_nodes[n][slot] / mean[0][slot], mean[n % 6][slot] / mean[0][slot], 1e-11);
        }
}

/* The mean energy density is the energy, and half of stress times strain, of either form. */
static void means_belong_to_the_energy(void **state)
{
    for (int nodes = 4; nodes <= 10; nodes += 6)
        for (int f = OST_FORMULATION_CONSISTENT; f <= OST_FORMULATION_CLASSICAL; f++) {
            Case test;
            OstMeans means;
            OstSimd energy;
            make_case(nodes, 0, 0.03, &test);
            ost_large_rotation_means(test.element, (OstFormulation)f, test.x, &test.elasticity, test.u, &means);
            ost_large_rotation_energy(test.element, (OstFormulation)f, test.x, &test.elasticity, test.u, &energy);
            for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
                assert_close(means.energy[slot] * means.volume[slot] / energy[slot], 1.0, 1e-12);
        }
}

/* Classical forces of tiny displacements keep their digits: those of twice the displacement are twice as large. */
static void tiny_displacements_keep_their_digits(void **state)
{
    for (int nodes = 4; nodes <= 10; nodes += 6) {
        Case test;
        OstSimd force[2][WIDTH];
        make_case(nodes, 0, 0.03, &test);
        for (int twice = 0; twice < 2; twice++) {
            for (int n = 0; n < 3 * nodes; n++)
                test.u[n] *= twice ? 2.0 : 1e-14;
            ost_large_rotation_force(test.element, OST_FORMULATION_CLASSICAL, test.x, &test.elasticity, test.u, NULL,
                                     force[twice]);
        }
        for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
            double size = 0.0;
            for (int n = 0; n < 3 * nodes; n++)
                size = fmax(size, fabs(force[0][n][slot]));
            for (int n = 0; n < 3 * nodes; n++)
                assert_close(force[1][n][slot] / size, 2.0 * force[0][n][slot] / size, 1e-11);
        }
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(mean_stress_is_that_of_the_forces),
    cmocka_unit_test(nodes_have_the_mean_of_a_uniform_stress),
    cmocka_unit_test(means_belong_to_the_energy),
    cmocka_unit_test(tiny_displacements_keep_their_digits),
};

OST_TEST_MAIN(tests)
