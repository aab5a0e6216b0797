/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/small.h"
#include "element/large_rotation.h"
#include "element_support.h"

#include <float.h>

/* The rounding errors of forces with large rotations are told by the linear forces' magnitudes |B'| |C| |B| |u|, as the
 * checks of an answer take it: at most four times a rounding step of these, and not by orders of magnitude less. */
enum { STEPS = 4, WIDTH = 30 };

static const int ends[6][2] = {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}; /* orthostat/mesh.h */

/* A rotation by an angle about an oblique axis. */
static void rotation_by(double angle, double turn[9])
{
    const double q[9] = {cos(angle), -sin(angle), 0.0, sin(angle), cos(angle), 0.0, 0.0, 0.0, 1.0};
    double axes[9], about[9];
    random_axes(3u, axes);
    ost_multiply3(q, axes, about);
    ost_multiply3_transposed_left(axes, about, turn);
}

/* Tets of a uniform deformation, turned by an angle about the origin and moved. */
static void make_tets(int nodes, const double stretch[3], double angle, double distance, OstSimd *x, OstSimd *u)
{
    double turn[9];
    rotation_by(angle, turn);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        double place[WIDTH], f[9], turned[9];
        random_tet((unsigned)slot + 1u, place);
        for (int n = 0; n < 18; n++)
            place[12 + n] = 0.5 * (place[3 * ends[n / 3][0] + n % 3] + place[3 * ends[n / 3][1] + n % 3]);
        deformation(0u, stretch, f);
        ost_multiply3(turn, f, turned);
        for (int n = 0; n < 3 * nodes; n++) {
            const double *row = turned + 3 * (n % 3), *at = place + n - n % 3;
            x[n][slot] = place[n];
            u[n][slot] = row[0] * at[0] + row[1] * at[1] + row[2] * at[2] - place[n] + distance;
        }
    }
}

/* The error of a tet's force beside a rounding step of its magnitudes. */
static double error_in_steps(int nodes, const OstSimd *force, const OstSimd *right, const OstSimd *magnitude, int slot)
{
    double error = 0.0, size = 0.0;
    for (int n = 0; n < 3 * nodes; n++) {
        error += (force[n][slot] - right[n][slot]) * (force[n][slot] - right[n][slot]);
        size += magnitude[n][slot] * magnitude[n][slot];
    }
    return sqrt(error / size) / DBL_EPSILON;
}

/* A rigid motion has no force; that of a deformed tet turns with it. */
static void rounding_errors_are_told_by_the_linear_magnitude(void **state)
{
    static const double angles[] = {0.0, 1e-5, 0.02, 0.7, 1.6, 2.9}, distances[] = {0.0, 30.0, 1e4};
    static const double stretches[3][3] = {{1.0, 1.0, 1.0}, {1.01, 0.997, 0.995}, {1.5, 0.8, 0.7}};
    double c[36], worst = 0.0;
    OstElasticity elasticity;
    turned_ply(c);
    uniform_elasticity(c, &elasticity);
    for (int nodes = 4; nodes <= 10; nodes += 6)
        for (int s = 0; s < 3; s++)
            for (int n = 1; n < 18; n++) {
                const OstElement *element = ost_element_of(nodes);
                const double angle = angles[n % 6];
                OstSimd x[WIDTH], u[WIDTH], at_rest[WIDTH], right[WIDTH], force[WIDTH], magnitude[WIDTH];
                double turn[9];
                make_tets(nodes, stretches[s], 0.0, 0.0, x, u);
                ost_large_rotation_force(element, OST_FORMULATION_CONSISTENT, x, &elasticity, u, NULL, at_rest);
                rotation_by(angle, turn);
                for (int i = 0; i < 3 * nodes; i++) {
                    const double *row = turn + 3 * (i % 3);
                    const OstSimd *of_node = at_rest + i - i % 3;
                    right[i] = row[0] * of_node[0] + row[1] * of_node[1] + row[2] * of_node[2];
                }
                make_tets(nodes, stretches[s], angle, distances[n / 6], x, u);
                ost_large_rotation_force(element, OST_FORMULATION_CONSISTENT, x, &elasticity, u, NULL, force);
                element->magnitude(x, &elasticity, u, magnitude);
                for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
                    worst = fmax(worst, error_in_steps(nodes, force, right, magnitude, slot));
            }
    assert_true(worst < STEPS);
    assert_true(worst > 0.01 * STEPS);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(rounding_errors_are_told_by_the_linear_magnitude),
};

OST_TEST_MAIN(tests)
