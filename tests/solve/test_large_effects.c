/* SPDX-License-Identifier: BSD-3-Clause */
#include "two_layers.h"

/* Pressure that follows the surface, and eigenstrains, with large displacements, against formulas. */

static OstResult *solve(const char *text, OstCase **c, OstScene **scene)
{
    OstResult *result = NULL;
    assert_success(read_text(text, c));
    assert_success(ost_scene_create(*c, scene));
    assert_success(ost_scene_solve(*scene, &result));
    return result;
}

static void destroy(OstCase *c, OstScene *scene, OstResult *result)
{
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

/* The displacement of the vertex at a place, on every rank. */
static void displacement_of(const OstResult *result, double x, double y, double z, double u[3])
{
    const OstMesh *mesh = result->mesh;
    memset(u, 0, 3 * sizeof *u);
    for (OstLocal node = 0; node < mesh->owned_nodes; node++) {
        const double *at = mesh->coordinates + 3 * node;
        if (fabs(at[0] - x) + fabs(at[1] - y) + fabs(at[2] - z) < 1e-9)
            memcpy(u, result->displacement + 3 * node, 3 * sizeof *u);
    }
    MPI_Allreduce(MPI_IN_PLACE, u, 3, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
}

/* A thick ring, a <= R <= b, that is kept from getting longer. Its Biot strains are r' - 1 and r/R - 1, so that r = A R
 * + B/R as by linear theory (Lamé); with P = c11 (r' - 1) + c12 (r/R - 1) along the radius, P(b) = 0, and on the inner
 * face P(a) = -p r(a)/a, since the pressure acts on the circumference as it has become. */
static void a_ring_widens_under_its_growing_surface(void **state)
{
    const double a = 1.0, b = 2.0, e = 10.0, nu = 0.3, p = 1.0;
    const double c11 = e * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)), c12 = e * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));
    /* P = (c11 + c12) (A - 1) - (c11 - c12) B / R²; with P(b) = 0, A - 1 = k B / b². */
    const double k = (c11 - c12) / (c11 + c12);
    const double of_b = (c11 + c12) * k * (1.0 / (b * b) - 1.0 / (a * a)) + p * (k / (b * b) + 1.0 / (a * a));
    const double big_b = -p / of_b, inner = k * big_b / (b * b) * a + big_b / a;
    char text[1024];
    OstCase *c;
    OstScene *scene;
    double u[3];
    snprintf(text, sizeof text,
             "mesh: {sector: {axis: z, length: 0.2, radii: [1, 2], angle: 90, divisions: {around: 8, radial: 5, axial: "
             "1}}}\nelement: {order: 2}\nlarge_rotation: on\n"
             "materials: [{region: all, youngs_modulus: %g, poissons_ratio: %g}]\n"
             "constraints:\n  - {on: {boundary: [bottom, top]}, slide: [0, 0, 1]}\n"
             "  - {on: {boundary: start}, slide: [1, 0, 0]}\n  - {on: {boundary: finish}, slide: [0, 1, 0]}\n"
             "loads: [{on: {boundary: inner}, pressure: %g, follows: true}]\n",
             e, nu, p);
    OstResult *result = solve(text, &c, &scene);
    displacement_of(result, 1.0, 0.0, 0.0, u);
    assert_true(inner > 0.23); /* by linear theory 0.19 */
    assert_close(u[0] / inner, 1.0, 5e-4);
    destroy(c, scene, result);
}

/* A strip, clamped at one end, under a pressure normal to it in any shape. Euler's elastica, E I theta' = M, M' = -t ×
 * F, F' = -q n, begun at the free end: loads that follow turn with it, so that its direction may be chosen, and turned
 * back in the end. By Runge and Kutta's method of order 4; s runs from the free end. */
static void bend(double q, double stiffness, const double y[6], double slope[6])
{
    const double t[2] = {cos(y[2]), sin(y[2])}; /* y: place, angle, force, moment */
    slope[0] = -t[0];
    slope[1] = -t[1];
    slope[2] = -y[5] / stiffness;
    slope[3] = -q * t[1];
    slope[4] = q * t[0];
    slope[5] = t[0] * y[4] - t[1] * y[3];
}

static void elastica_tip(double q, double stiffness, double length, double tip[2])
{
    enum { STEPS = 400 };
    const double h = length / STEPS;
    double y[6] = {0.0}, slope[4][6], at[6];
    for (int n = 0; n < STEPS; n++) {
        for (int stage = 0; stage < 4; stage++) {
            const double ahead = stage == 0 ? 0.0 : stage == 3 ? h : 0.5 * h;
            for (int i = 0; i < 6; i++)
                at[i] = y[i] + (stage == 0 ? 0.0 : ahead * slope[stage - 1][i]);
            bend(q, stiffness, at, slope[stage]);
        }
        for (int i = 0; i < 6; i++)
            y[i] += h / 6.0 * (slope[0][i] + 2.0 * slope[1][i] + 2.0 * slope[2][i] + slope[3][i]);
    }
    tip[0] = -(cos(y[2]) * y[0] + sin(y[2]) * y[1]); /* of the free end from the clamped one, along it and across */
    tip[1] = -(cos(y[2]) * y[1] - sin(y[2]) * y[0]);
}

static void a_strip_under_pressure_is_an_elastica(void **state)
{
    double tip[2], u[3];
    OstCase *c;
    OstScene *scene;
    elastica_tip(6.0 * 0.5, 1e6 * 0.5 * pow(0.25, 3) / 12.0, 10.0, tip);
    OstResult *result = solve("mesh: {block: {size: [10, 0.5, 0.25], divisions: [20, 1, 1]}}\nelement: {order: 2}\n"
                              "large_rotation: on\nmaterials: [{region: all, youngs_modulus: 1e6, poissons_ratio: 0}]\n"
                              "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
                              "loads: [{on: {boundary: zmin}, pressure: 6, follows: true}]\n",
                              &c, &scene);
    displacement_of(result, 10.0, 0.0, 0.0, u);
    assert_true(tip[1] > 4.0);
    assert_close(u[2] / tip[1], 1.0, 0.01);
    assert_close((10.0 + u[0]) / tip[0], 1.0, 0.01);
    destroy(c, scene, result);
}

/* The same curvature, 3/2 of the difference over the height for equal moduli, bends a long strip into half a circle. */
static void a_long_strip_of_two_layers_closes_half_a_circle(void **state)
{
    const double length = 60.0, height = 2.0, half = M_PI * height / (3.0 * length), radius = length / M_PI;
    char text[1024];
    OstCase *c = NULL;
    OstScene *scene = NULL;
    snprintf(text, sizeof text,
             "mesh: {block: {size: [60, 1, 2], divisions: [30, 1, 2]}}\nelement: {order: 2}\nlarge_rotation: "
             "on\nmaterials:\n"
             "  - {region: block, youngs_modulus: 100, poissons_ratio: 0, eigenstrain: [%.17g, 0, 0]}\n"
             "  - {region: upper, youngs_modulus: 100, poissons_ratio: 0, eigenstrain: [%.17g, 0, 0]}\n"
             "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n",
             half, -half);
    OstResult *result = solve_layers(text, &c, &scene);
    assert_close((length + displacement_at(result, 60, 0)) / radius, 0.0, 0.01);
    assert_close(displacement_at(result, 60, 2) / (2.0 * radius), 1.0, 0.01);
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

/* A following couple at a beam's end, whose free rim leaves the load no potential: Newton's method may not get to it,
 * but where the forces do not balance nothing is accepted. */
static void what_is_not_at_rest_is_not_accepted(void **state)
{
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    assert_success(read_text("mesh: {block: {size: [20, 1, 1], divisions: [4, 1, 2]}}\nelement: {order: 2}\n"
                             "materials: [{region: all, youngs_modulus: 1, poissons_ratio: 0}]\n"
                             "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\nloads:\n"
                             "  - {on: {box: {min: [20, 0, 0.5], max: [20, 1, 1]}}, pressure: 0.1, follows: true}\n"
                             "  - {on: {box: {min: [20, 0, 0], max: [20, 1, 0.5]}}, pressure: -0.1, follows: true}\n"
                             "large_rotation: on\n",
                             &c));
    assert_success(ost_scene_create(c, &scene));
    const OstStatus status = ost_scene_solve(scene, &result);
    assert_true(status == OST_NOT_CONVERGED || ost_result_checks(result)->relative_residual < 1e-6);
    destroy(c, scene, result);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(what_is_not_at_rest_is_not_accepted),
    cmocka_unit_test(a_ring_widens_under_its_growing_surface),
    cmocka_unit_test(a_strip_under_pressure_is_an_elastica),
    cmocka_unit_test(a_long_strip_of_two_layers_closes_half_a_circle),
};

OST_TEST_MAIN(tests)
