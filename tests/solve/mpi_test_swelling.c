/* SPDX-License-Identifier: BSD-3-Clause */
#include "two_layers.h"

/* Eigenstrains of a case, against formulas; cases/verify/swelling and heated-bar are two more. */

/* S. Timoshenko, Analysis of Bi-metal Thermostats, 1925, eq. 4: the curvature of a strip of two layers, here of equal
 * thickness, moduli E1 and E2, that lengthen by different strains. They swell along the strip alone, which isotropic
 * materials do too if their eigenstrain says so. */
static void a_strip_of_two_layers_bends_as_timoshenko_says(void **state)
{
    const double difference = 0.01, height = 2.0;
    for (int contrast = 1; contrast <= 4; contrast *= 4) {
        const double n = 1.0 / contrast,
                     curvature = 24.0 * difference / (height * (12.0 + (1.0 + n) * (1.0 + 1.0 / n)));
        char text[1024];
        OstCase *c = NULL;
        OstScene *scene = NULL;
        OstResult *result = NULL;
        snprintf(text, sizeof text,
                 "mesh: {block: {size: [24, 1, 2], divisions: [24, 1, 2]}}\nelement: {order: 2}\nmaterials:\n"
                 "  - {region: block, youngs_modulus: 100, poissons_ratio: 0, eigenstrain: [0.002, 0, 0]}\n"
                 "  - {region: upper, youngs_modulus: %d, poissons_ratio: 0, eigenstrain: {per_unit: [6, 0, 0], "
                 "change: 2e-3}}\n"
                 "constraints: free_body\naccuracy: {relative_residual: 1e-11}\n",
                 100 * contrast);
        result = solve_layers(text, &c, &scene);
        const double bend =
            (2.0 * displacement_at(result, 12, 2) - displacement_at(result, 7, 2) - displacement_at(result, 17, 2)) /
            25.0;
        assert_close(bend / curvature, 1.0, 1e-3);
        assert_true(ost_result_checks(result)->strain_energy > 0.0);
        ost_result_destroy(&result);
        ost_scene_destroy(&scene);
        ost_case_destroy(&c);
    }
}

/* Incompressible rubber that is kept from growing: the pressure is that of its bulk modulus, E / (3 (1 - 2 nu)), times
 * three strains; and stress at the nodes is that of the tets. */
static void nearly_incompressible_rubber_presses(void **state)
{
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    assert_success(
        read_text("mesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}\nelement: {order: 2}\n"
                  "materials: [{region: all, youngs_modulus: 3, poissons_ratio: 0.499, eigenstrain: 0.01}]\n"
                  "constraints: [{on: {boundary: [xmin, xmax]}, slide: [1, 0, 0]},\n"
                  "  {on: {boundary: [ymin, ymax]}, slide: [0, 1, 0]}, {on: {boundary: [zmin, zmax]}, slide: "
                  "[0, 0, 1]}]\n",
                  &c));
    assert_success(ost_scene_create(c, &scene));
    assert_success(ost_scene_solve(scene, &result));
    const double pressure = 3.0 / (3.0 * (1.0 - 2.0 * 0.499)) * 0.03;
    for (OstLocal t = 0; t < scene->mesh->owned_tets; t++)
        for (int p = 0; p < 6; p++)
            assert_close(ost_result_stress(result)[6 * t + p] / pressure, p < 3 ? -1.0 : 0.0, 1e-8);
    for (OstLocal node = 0; node < scene->mesh->owned_nodes; node++)
        for (int p = 0; p < 6; p++)
            assert_close(ost_result_node_stress(result)[6 * node + p] / pressure, p < 3 ? -1.0 : 0.0, 1e-8);
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

/* Far beyond small strains: what may grow has no stress, what may not has C e0, which is Cauchy's where nothing moves.
 */
static void stresses_of_large_swelling_leave_out_what_is_free(void **state)
{
    static const double swelling[3] = {0.3, 0.1, -0.05};
    for (int order = 1; order <= 2; order++)
        for (int held = 0; held <= 1; held++) {
            char text[1024];
            OstCase *c = NULL;
            OstScene *scene = NULL;
            OstResult *result = NULL;
            snprintf(text, sizeof text,
                     "mesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}\nelement: {order: %d}\n"
                     "materials: [{region: all, youngs_modulus: [1, 2, 3], poissons_ratio: 0, eigenstrain: [%g, %g, "
                     "%g]}]\nlarge_rotation: on\nconstraints: [{on: {boundary: [xmin%s]}, slide: [1, 0, 0]},\n"
                     "  {on: {boundary: [ymin%s]}, slide: [0, 1, 0]}, {on: {boundary: [zmin%s]}, slide: [0, 0, 1]}]\n",
                     order, swelling[0], swelling[1], swelling[2], held ? ", xmax" : "", held ? ", ymax" : "",
                     held ? ", zmax" : "");
            assert_success(read_text(text, &c));
            assert_success(ost_scene_create(c, &scene));
            assert_success(ost_scene_solve(scene, &result));
            for (OstLocal t = 0; t < scene->mesh->owned_tets; t++)
                for (int p = 0; p < 6; p++)
                    assert_close(ost_result_stress(result)[6 * t + p], held && p < 3 ? -(1.0 + p) * swelling[p] : 0.0,
                                 1e-7);
            for (OstLocal node = 0; node < scene->mesh->owned_nodes; node++)
                for (int p = 0; p < 6; p++)
                    assert_close(ost_result_node_stress(result)[6 * node + p],
                                 held && p < 3 ? -(1.0 + p) * swelling[p] : 0.0, 1e-7);
            ost_result_destroy(&result);
            ost_scene_destroy(&scene);
            ost_case_destroy(&c);
        }
}

/* A block that swells and shrinks freely along a path is at each time as large as its table says, without stress;
 * beside a load of its own table, which pulls it by F / (E A). */
static void swelling_follows_its_own_table(void **state)
{
    static const double factors[3] = {0.5, 1.0, 0.25}, pulled[3] = {0.01, 0.02, 0.04};
    for (int large = 0; large <= 1; large++) {
        char text[1024];
        OstCase *c = NULL;
        OstScene *scene = NULL;
        OstPath *path = NULL;
        snprintf(text, sizeof text,
                 "mesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}\nmaterials:\n"
                 "  - {region: all, youngs_modulus: 100, poissons_ratio: 0,\n"
                 "     eigenstrain: {value: [0.1, 0.2, -0.05], time: [[0, 0], [0.5, 1], [1, 0.25]]}}\n"
                 "constraints: [{on: {boundary: xmin}, slide: [1, 0, 0]}, {on: {boundary: ymin}, slide: [0, 1, 0]},\n"
                 "  {on: {boundary: zmin}, slide: [0, 0, 1]}]\n"
                 "loads: [{on: {boundary: zmax}, total_force: [0, 0, 4]}]\n"
                 "large_rotation: %s\npath: {times: [0.25, 0.5, 1]}\naccuracy: {relative_residual: 1e-11}\n",
                 large ? "on" : "off");
        assert_success(read_text(text, &c));
        assert_success(ost_scene_create(c, &scene));
        assert_success(ost_scene_path(scene, &path));
        for (int i = 0; i < 3; i++) {
            const double grown[3] = {0.1 * factors[i], 0.2 * factors[i], -0.05 * factors[i] + pulled[i]};
            OstResult *result = NULL;
            assert_success(ost_path_advance(path, 1U << OST_FIELD_STRESS | 1U << OST_FIELD_ERROR, &result));
            for (OstLocal n = 0; n < scene->mesh->owned_nodes; n++)
                for (int k = 0; k < 3; k++)
                    assert_close(result->displacement[3 * n + k], grown[k] * scene->mesh->coordinates[3 * n + k], 1e-8);
            assert_true(result->answer.known && result->answer.relative < 1e-5); /* tets have such a displacement */
            for (OstLocal t = 0; t < scene->mesh->owned_tets && !large; t++)
                for (int p = 0; p < 6; p++)
                    assert_close(result->stress[6 * t + p], p == 2 ? 100.0 * pulled[i] : 0.0, 1e-6);
            ost_result_destroy(&result);
        }
        ost_path_destroy(&path);
        ost_scene_destroy(&scene);
        ost_case_destroy(&c);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(stresses_of_large_swelling_leave_out_what_is_free),
    cmocka_unit_test(a_strip_of_two_layers_bends_as_timoshenko_says),
    cmocka_unit_test(nearly_incompressible_rubber_presses),
    cmocka_unit_test(swelling_follows_its_own_table),
};

OST_TEST_MAIN(tests)
