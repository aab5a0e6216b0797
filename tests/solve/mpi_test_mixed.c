/* SPDX-License-Identifier: BSD-3-Clause */
#include "iterations.h"
#include "run.h"
#include "two_layers.h"

#include "core/parallel/reduce.h"
#include "recovery/derived.h"

/* The mixed form: quadratic tets whose pressure is an unknown of its own, for nu up to 1/2. */

static OstStatus try_to_solve(const char *text, Run *run)
{
    *run = (Run){.c = NULL};
    assert_success(read_text(text, &run->c));
    OstStatus status = ost_scene_create(run->c, &run->scene);
    return status == OST_SUCCESS ? ost_scene_solve(run->scene, &run->result) : status;
}

#define TUBE                                                                                                     \
    "mesh: {tube: {axis: y, length: 2, radii: [0.9, 1.5], divisions: {around: 8, radial: 2, axial: 4}}}\n"       \
    "element: {order: 2}\nlarge_rotation: off\nconstraints: [{on: {boundary: ends}, displacement: [0, 0, 0]}]\n" \
    "loads: [{on: {nearest: [1.5, 1, 0]}, total_force: [1, 0, 0]}]\naccuracy: {relative_residual: 1e-10}\n"

/* The answer is the same on any number of ranks and by either preconditioner, and goes to that of nu = 1/2. */
static void any_compressibility_and_stiffness_is_solved(void **state)
{
    static const char *const moduli[] = {"1e3", "[1e6, 1e3, 1e3]", "[1e3, 1e6, 1e3]", "[1e3, 1e3, 1e6]"};
    static const char *const ratios[] = {"0.499999999", "0.5"};
    static const double expected[] = {1.91971353358e-3, 2.54215713954e-4, 2.64100565107e-4, 1.43398259212e-4};
    for (int m = 0; m < 4; m++)
        for (int direct = 0; direct < 2; direct++) {
            double energy[2];
            for (int n = 0; n < 2; n++) {
                char text[1024];
                Run run;
                snprintf(text, sizeof text,
                         TUBE "materials: [{region: all, youngs_modulus: %s, poissons_ratio: %s, axes: {cylindrical: "
                              "{origin: [0, 0, 0], axis: [0, 1, 0], order: [axial, radial, tangential]}}}]\n"
                              "solver: {method: %s}\n",
                         moduli[m], ratios[n], direct ? "direct" : "metric");
                assert_success(try_to_solve(text, &run));
                assert_true(ost_effect_on(&run.scene->plan.effects, OST_EFFECT_MIXED));
                assert_true(run.result->solve.relative_residual <= 1e-10);
                energy[n] = run.result->checks.strain_energy;
                clear(&run);
            }
            assert_close(energy[0] / energy[1], 1.0, 1e-7);
            assert_close(energy[1] / expected[m], 1.0, 1e-8);
        }
}

/* A block that is constrained all around but at its top, and pressed there, cannot give way: the pressure is the
 * load's, and nothing moves. Stress at nodes and in tets is that. */
static void an_incompressible_block_in_a_box_bears_the_load(void **state)
{
    Run run;
    double *pressure = NULL;
    assert_success(try_to_solve("mesh: {block: {size: [1, 1, 1], divisions: [3, 2, 2]}}\nelement: {order: 2}\n"
                                "materials: [{region: all, youngs_modulus: 3, poissons_ratio: 0.5}]\n"
                                "constraints: [{on: {boundary: [xmin, xmax]}, slide: [1, 0, 0]},\n"
                                "  {on: {boundary: [ymin, ymax]}, slide: [0, 1, 0]}, {on: {boundary: zmin}, slide: "
                                "[0, 0, 1]}]\nloads: [{on: {boundary: zmax}, pressure: 7}]\n"
                                "accuracy: {relative_residual: 1e-11}\n",
                                &run));
    for (OstLocal t = 0; t < run.scene->mesh->owned_tets; t++)
        for (int p = 0; p < 6; p++)
            assert_close(ost_result_stress(run.result)[6 * t + p], p < 3 ? -7.0 : 0.0, 1e-8);
    for (OstLocal node = 0; node < run.scene->mesh->owned_nodes; node++) {
        for (int p = 0; p < 6; p++)
            assert_close(ost_result_node_stress(run.result)[6 * node + p], p < 3 ? -7.0 : 0.0, 1e-8);
        for (int i = 0; i < 3; i++)
            assert_close(ost_result_displacement(run.result)[3 * node + i], 0.0, 1e-9);
    }
    assert_true(ost_result_can_derive(run.result, OST_FIELD_MIXED_PRESSURE));
    assert_success(OST_NEW(ctx, &pressure, run.scene->mesh->owned_tets));
    assert_success(ost_result_derive(run.result, OST_FIELD_MIXED_PRESSURE, pressure));
    for (OstLocal t = 0; t < run.scene->mesh->owned_tets; t++)
        assert_close(pressure[t], 7.0, 1e-8);
    OST_FREE(pressure);
    clear(&run);
}

#define BOX                                                                                                         \
    "mesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}\nelement: {order: 2}\nlarge_rotation: off\n"            \
    "materials: [{region: all, youngs_modulus: 3, poissons_ratio: 0.5%s}]\n"                                        \
    "constraints: [{on: {boundary: [xmin, xmax]}, slide: [1, 0, 0]}, {on: {boundary: [ymin, ymax]}, slide: [0, 1, " \
    "0]},\n  {on: {boundary: zmin}, slide: [0, 0, 1]}, {on: {boundary: zmax}, displacement: [free, free, %s]}]\n"   \
    "loads: [{body_force: [0, 0, -2]}]\n"                                                                           \
    "accuracy: {relative_residual: 1e-10}\n"

/* Held all around, only the shape of the pressure is known: that of the weight; its mean is taken to be 0. A change of
 * volume has no solution. */
static void a_body_held_all_around_may_not_change_its_volume(void **state)
{
    char text[1024];
    Run run;
    snprintf(text, sizeof text, BOX, "", "0");
    assert_success(try_to_solve(text, &run));
    for (OstLocal node = 0; node < run.scene->mesh->owned_nodes; node++)
        assert_close(ost_result_node_stress(run.result)[6 * node + 2],
                     2.0 * (run.scene->mesh->coordinates[3 * node + 2] - 0.5), 1e-7);
    clear(&run);
    snprintf(text, sizeof text, BOX, "", "0.01");
    assert_failure(try_to_solve(text, &run), OST_INVALID_INPUT, "constrained all around");
    clear(&run);
    snprintf(text, sizeof text, BOX, ", eigenstrain: 0.01", "0");
    assert_failure(try_to_solve(text, &run), OST_INVALID_INPUT, "changes its volume");
    clear(&run);
}

/* Two layers in a box, an incompressible one on a compressible one, pressed from above: the upper has the stress of the
 * load in every direction, the lower nu / (1 - nu) of it across, and only the lower gives way. */
static void a_pressure_jumps_where_the_material_does(void **state)
{
    static const double ratios[2] = {0.3, 0.499};
    for (int k = 0; k < 2; k++) {
        const double nu = ratios[k], across = nu / (1.0 - nu);
        char text[1024];
        Run run = {.c = NULL};
        snprintf(text, sizeof text,
                 "mesh: {block: {size: [2, 2, 2], divisions: [2, 2, 2]}}\nelement: {order: 2}\nlarge_rotation: off\n"
                 "materials:\n  - {region: block, youngs_modulus: 50, poissons_ratio: %g}\n"
                 "  - {region: upper, youngs_modulus: 10, poissons_ratio: 0.5}\n"
                 "constraints: [{on: {boundary: [xmin, xmax]}, slide: [1, 0, 0]},\n"
                 "  {on: {boundary: [ymin, ymax]}, slide: [0, 1, 0]}, {on: {boundary: zmin}, slide: [0, 0, 1]}]\n"
                 "loads: [{on: {boundary: zmax}, pressure: 3}]\naccuracy: {relative_residual: 1e-12}\n",
                 nu);
        run.result = solve_layers(text, &run.c, &run.scene);
        for (OstLocal t = 0; t < run.scene->mesh->owned_tets; t++)
            for (int p = 0; p < 6; p++)
                assert_close(ost_result_stress(run.result)[6 * t + p],
                             p > 2                                          ? 0.0
                             : p < 2 && run.scene->mesh->tet_region[t] == 0 ? -3.0 * across
                                                                            : -3.0,
                             1e-7);
        assert_close(displacement_at(run.result, 1.0, 2), -3.0 * (1.0 + nu) * (1.0 - 2.0 * nu) / (50.0 * (1.0 - nu)),
                     1e-8);
        clear(&run);
    }
}

/* The classical formulation has no mixed form: Newton's method goes on with the mean dilatation. nu = 1/2 is refused
 * then, as it is for linear tets. */
static void what_has_no_mixed_form_says_so(void **state)
{
    static const struct {
        const char *order, *nu, *rest, *message;
    } refused[] = {{"1", "0.5", "large_rotation: off\n", "element: {order: 2}"},
                   {"2", "0.5", "large_rotation: on\nformulation: classical\n", "Set formulation: consistent"}};
    for (int i = 0; i < 3; i++) {
        char text[1024];
        Run run;
        snprintf(text, sizeof text,
                 "mesh: {block: {size: [8, 1, 1], divisions: [8, 1, 1]}}\nelement: {order: %s}\n%s"
                 "materials: [{region: all, youngs_modulus: 1200, poissons_ratio: %s}]\n"
                 "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
                 "loads: [{on: {boundary: zmax}, pressure: %g, follows: true}]\n",
                 i < 2 ? refused[i].order : "2", refused[i < 2 ? i : 1].rest, i < 2 ? refused[i].nu : "0.499",
                 i < 2 ? 0.5 : 0.01);
        const OstStatus status = try_to_solve(text, &run);
        if (i < 2) {
            assert_failure(status, OST_INVALID_INPUT, refused[i].message);
        } else {
            assert_success(status);
            assert_true(run.result->newton.used);
            assert_null(run.result->pressure);
            assert_true(ost_result_stress(run.result) != NULL);
        }
        clear(&run);
    }
}

static void solve_to(const char *given, double residual, Run *run)
{
    char text[1200];
    snprintf(text, sizeof text, "%saccuracy: {relative_residual: %g, out_of_reach: accept}\n", given, residual);
    assert_success(try_to_solve(text, run));
}

/* The stated error of the equations is that of the displacement, held against an answer to rounding: of a tenth to a
 * thousand times, and no less, where the material is uneven. Factors solve to rounding whatever is asked for; their
 * answer is held against that of iterations, as far as both state. */
static void the_stated_error_is_no_less_than_the_true_one(void **state)
{
    static const char *const moduli[] = {"1", "[1000, 1, 1]", "[1, 1, 1000]", "[1e-3, 1, 1]"};
    for (int m = 0; m < 4; m++)
        for (int direct = 0; direct < 2; direct++) {
            double sums[2] = {0.0};
            char text[1024], by_metric[1024];
            Run run, reference;
            snprintf(
                text, sizeof text,
                "mesh: {block: {size: [4, 1, 1], divisions: [6, 3, 3]}}\nelement: {order: 2}\nlarge_rotation: off\n"
                "materials: [{region: all, youngs_modulus: %s, poissons_ratio: 0.4999, axes: {euler: {degrees: [30, "
                "40, 50]}}}]\nconstraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
                "loads: [{on: {boundary: xmax}, total_force: [0, 0, 1]}]\nsolver: {method: %s}\n",
                moduli[m], direct ? "direct" : "metric");
            snprintf(by_metric, sizeof by_metric, "%.*smetric}\n", (int)(strstr(text, "method: ") + 8 - text), text);
            solve_to(text, 1e-6, &run);
            solve_to(by_metric, 1e-13, &reference);
            for (size_t i = 0; i < 3 * (size_t)run.scene->mesh->owned_nodes; i++) {
                const double u = reference.result->displacement[i], d = run.result->displacement[i] - u;
                sums[0] += d * d;
                sums[1] += u * u;
            }
            assert_success(ost_sum(ctx, 2, sums));
            const double error = sqrt(sums[0] / sums[1]), stated = run.result->checks.displacement_error;
            const double allowed = direct ? stated + reference.result->checks.displacement_error : 2.0 * stated;
            if (!(error <= allowed && stated <= (direct ? 1e-9 : 1e4 * error)))
                fail_msg("E %s, %s: error %g, stated %g", moduli[m], direct ? "direct" : "metric", error, stated);
            clear(&run);
            clear(&reference);
        }
}

/* Of half the block all nodes are fixed, and pressures next to it are held by few that are free. */
static void a_body_whose_inside_is_fixed_takes_few_iterations(void **state)
{
    static const char text[] =
        "mesh: {block: {size: [1, 1, 1], divisions: [7, 7, 7]}}\n"
        "materials: [{region: all, youngs_modulus: 1, poissons_ratio: 0.499, density: 1}]\n"
        "constraints: [{on: {sphere: {center: [0, 0, 0], radius: 0.9}}, displacement: [0, 0, 0]}]\n"
        "loads: [{gravity: [0, 0, 1e-3]}]\nlarge_rotation: off\naccuracy: {algebraic_fraction: 0}\n"
        "solver: {factor_memory: 1e-6}\noutput: {fields: [displacement]}\n";
    check_iterations("half of a block is fixed", text, 2, 36, NULL, NULL);
}

/* Tets of a lower half that is fixed throughout change no volume: the upper half alone takes as many iterations. */
static void a_fixed_half_takes_no_iterations(void **state)
{
    static const struct {
        const char *size, *held;
    } bodies[] = {{"[1, 1, 1], divisions: [6, 6, 6]}}", "{box: {min: [-1, -1, -1], max: [2, 2, 0.5]}}"},
                  {"[1, 1, 0.5], divisions: [6, 6, 3]}}", "{boundary: zmin}"}};
    for (int k = 0; k < 2; k++) {
        int iterations[2];
        for (int alone = 0; alone < 2; alone++) {
            char text[1024];
            snprintf(text, sizeof text,
                     "mesh: {block: {size: %s\nmaterials: [{region: all, youngs_modulus: 1e6, poissons_ratio: %s}]\n"
                     "constraints: [{on: %s, displacement: [0, 0, 0]}]\n"
                     "loads: [{on: {boundary: zmax}, traction: [1, 0, -1]}]\nlarge_rotation: off\n"
                     "accuracy: {relative_residual: 1e-8}\nsolver: {method: metric}\n",
                     bodies[alone].size, k ? "0.499" : "0.5", bodies[alone].held);
            iterations[alone] = count_iterations(text, 2, NULL, NULL);
        }
        if (iterations[0] > iterations[1] + 3)
            fail_msg("half fixed: %d iterations, the other half alone: %d", iterations[0], iterations[1]);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_fixed_half_takes_no_iterations),
    cmocka_unit_test(a_body_whose_inside_is_fixed_takes_few_iterations),
    cmocka_unit_test(any_compressibility_and_stiffness_is_solved),
    cmocka_unit_test(an_incompressible_block_in_a_box_bears_the_load),
    cmocka_unit_test(a_body_held_all_around_may_not_change_its_volume),
    cmocka_unit_test(a_pressure_jumps_where_the_material_does),
    cmocka_unit_test(the_stated_error_is_no_less_than_the_true_one),
    cmocka_unit_test(what_has_no_mixed_form_says_so),
};

OST_TEST_MAIN(tests)
