/* SPDX-License-Identifier: BSD-3-Clause */
#include "orthostat/load_cases.h"
#include "problem/result_data.h"
#include "problem/scene_data.h"
#include "support.h"

/* Load cases are what each would be alone, on one stiffness for all that share supports. */

static const char beam[] =
    "mesh: {block: {size: [6, 1, 1], divisions: [8, 2, 2]}}\n"
    "materials:\n"
    "  - {region: all, youngs_modulus: [100, 8, 5], poissons_ratio: 0.3, density: 1, axes: {euler: {degrees: [20, 30, "
    "0]}}}\n"
    "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
    "loads: [{gravity: [0, 0, -1e-4]}]\n"
    "cases:\n"
    "  - {name: own-weight}\n"
    "  - {name: end, loads: [{on: {boundary: xmax}, total_force: [0, 0.002, -0.001]}]}\n"
    "  - {name: propped, constraints: [{on: {boundary: xmax}, displacement: [free, free, 0]}]}\n"
    "  - {name: far, loads: [{on: {boundary: xmax}, total_force: [0, 0, 0.2]}]}\n"
    "  - {name: blown, loads: [{on: {boundary: ymax}, pressure: 1e-3, follows: true}]}\n"
    "  - {name: moved, constraints: [{on: {boundary: xmax}, displacement: [free, free, 0.05]}]}\n"
    "  - {name: sunk, constraints: [{on: {boundary: xmin}, displacement: [0, 0, -0.1]}]}\n";

static OstCase *read_case(const char *body, const char *settings)
{
    char text[4096];
    OstCase *c = NULL;
    snprintf(text, sizeof text, "%s%s", body, settings);
    assert_success(ost_case_parse(ctx, "beam", text, &c));
    return c;
}

static double distance(const OstMesh *mesh, const double *u, const double *v)
{
    double sums[2] = {0.0};
    for (OstLocal i = 0; i < 3 * mesh->owned_nodes; i++) {
        sums[0] += (u[i] - v[i]) * (u[i] - v[i]);
        sums[1] += v[i] * v[i];
    }
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
    return sqrt(sums[0] / sums[1]);
}

/* What is to be added to each watched reaction by its adjoint problem, and its error. */
static void compare_reactions(const OstCase *c, const OstResult *together, const OstResult *single, double tolerance)
{
    for (int w = 0; w < c->watch_count; w++) {
        const OstWatchedReaction *found = &together->reactions[w], *expected = &single->reactions[w];
        assert_true(found->known && expected->known);
        assert_close(found->error, expected->error, 0.05 * fabs(expected->error));
        assert_close(found->missing, expected->missing, tolerance);
    }
}

static void compare_with_single_runs(const char *body, const char *settings, unsigned fields, double tolerance,
                                     int newtons)
{
    OstCase *c = read_case(body, settings);
    OstScene *scene = NULL;
    OstLoadCases *cases = NULL;
    int solved_by_newton = 0;
    assert_success(ost_scene_create(c, &scene));
    assert_success(ost_load_cases_create(scene, &cases));
    assert_int_equal(ost_load_cases_stiffnesses(cases), body == beam ? 2 : 1);
    while (ost_load_cases_left(cases) > 0) {
        const int number = ost_load_cases_next(cases);
        OstScene *alone = NULL;
        OstResult *together = NULL, *single = NULL;
        assert_success(ost_load_cases_solve(cases, fields, &together));
        assert_success(ost_scene_create(ost_case_load_case(c, number), &alone));
        assert_success(ost_scene_solve(alone, &single));
        assert_true(distance(scene->mesh, together->displacement, single->displacement) <= tolerance);
        assert_true(distance(scene->mesh, together->reaction, single->reaction) <= 10.0 * tolerance);
        assert_close(together->checks.strain_energy, single->checks.strain_energy,
                     10.0 * tolerance * single->checks.strain_energy);
        assert_int_equal(together->newton.used, single->newton.used);
        assert_int_equal(together->answer.known, single->answer.known);
        assert_close(together->answer.relative, single->answer.relative, 0.05 * single->answer.relative);
        assert_true(together->checks.force_imbalance <= fmax(10.0 * tolerance, 2.0 * single->checks.force_imbalance));
        compare_reactions(c, together, single, tolerance);
        solved_by_newton += together->newton.used;
        ost_result_destroy(&together);
        ost_result_destroy(&single);
        ost_scene_destroy(&alone);
    }
    assert_int_equal(solved_by_newton, newtons);
    ost_load_cases_destroy(&cases);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

static void linear_cases_are_their_single_runs(void **state)
{
    compare_with_single_runs(beam,
                             "large_rotation: off\naccuracy: {relative_residual: 1e-11}\nsolver: {method: metric}\n",
                             1U << OST_FIELD_ERROR, 1e-7, 0);
    compare_with_single_runs(beam,
                             "large_rotation: off\naccuracy: {relative_residual: 1e-11}\nsolver: {method: direct}\n",
                             1U << OST_FIELD_ERROR, 1e-7, 0);
}

static void cases_stop_where_the_mesh_is_worse(void **state)
{
    compare_with_single_runs(beam, "large_rotation: off\nelement: {order: 2}\n", 1U << OST_FIELD_ERROR, 1e-2, 0);
}

static void large_rotations_are_solved_for_where_they_are(void **state)
{
    compare_with_single_runs(beam, "accuracy: {relative_residual: 1e-11}\n", 1U << OST_FIELD_ERROR, 1e-6, 1);
}

static const char handle[] =
    "mesh: {block: {size: [6, 1, 1], divisions: [6, 2, 2]}}\n"
    "materials: [{region: all, youngs_modulus: [100, 8, 5], poissons_ratio: 0.3}]\n"
    "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
    "cases:\n"
    "  - {name: pulled, constraints: [{on: {boundary: xmax}, rigid: {at: [6, 0.5, 0.5], displacement: [0.01, 0, "
    "0]}}]}\n"
    "  - {name: held, loads: [{on: {boundary: ymax}, pressure: 1e-3}],\n"
    "     constraints: [{on: {boundary: xmax}, rigid: {at: [6, 0.5, 0.5], displacement: [0, 0, 0]}}]}\n"
    "  - {name: aside, constraints: [{on: {boundary: xmax}, rigid: {at: [6, 0.5, 0.5], displacement: [0, 0.02, "
    "0.01]}}]}\n";

static void a_rigid_face_is_moved_in_each_case_on_one_stiffness(void **state)
{
    compare_with_single_runs(handle, "large_rotation: off\naccuracy: {relative_residual: 1e-11}\n",
                             1U << OST_FIELD_ERROR, 1e-7, 0);
}

/* One pattern and one hierarchy for each way the body is held. */
static void stiffness_is_made_once_for_all_that_share_supports(void **state)
{
    OstCase *c = read_case(beam, "large_rotation: off\n");
    OstScene *scene = NULL;
    OstLoadCases *cases = NULL;
    const int order[] = {0, 1, 3, 4, 6, 2, 5};
    assert_success(ost_scene_create(c, &scene));
    assert_success(ost_load_cases_create(scene, &cases));
    const long before = ost_ledger_entry(ctx, OST_LEDGER_PATTERN).entries;
    for (int k = 0; k < 7; k++) {
        OstResult *result = NULL;
        assert_int_equal(ost_load_cases_next(cases), order[k]);
        assert_success(ost_load_cases_solve(cases, 0, &result));
        ost_result_destroy(&result);
        if (k == 0 || k == 4 || k == 5 || k == 6)
            assert_int_equal(ost_ledger_entry(ctx, OST_LEDGER_PATTERN).entries - before, k < 5 ? 1 : 2);
    }
    ost_load_cases_destroy(&cases);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

static const char several[] =
    "mesh: {block: {size: [3, 1, 1], divisions: [12, 4, 4]}}\n"
    "materials:\n"
    "  - {region: all, youngs_modulus: [100, 8, 5], poissons_ratio: 0.3, density: 1, axes: {euler: {degrees: [20, 30, "
    "0]}}}\n"
    "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
    "large_rotation: off\n"
    "solver: {method: metric, coarsest_unknowns: 200}\n"
    "cases:\n"
    "  - {name: own-weight, loads: [{gravity: [0, 0, -1e-4]}]}\n"
    "  - {name: aside, loads: [{gravity: [0, 1e-4, 0]}]}\n"
    "  - {name: pressed, loads: [{on: {boundary: zmax}, pressure: 1e-3}]}\n"
    "  - {name: sheared, loads: [{on: {boundary: ymax}, traction: [1e-3, 2e-3, 0]}]}\n"
    "  - {name: pulled, loads: [{on: {boundary: xmax}, total_force: [1e-3, 0, 0]}]}\n"
    "  - {name: bent, loads: [{on: {boundary: xmax}, total_force: [0, 1e-3, 0]}]}\n"
    "  - {name: lifted, loads: [{on: {boundary: xmax}, total_force: [0, 0, 1e-3]}]}\n"
    "  - {name: twisted, loads: [{on: {boundary: xmax}, moment: [1e-3, 0, 0]}]}\n"
    "  - {name: turned, loads: [{on: {boundary: xmax}, moment: [0, 1e-3, 0]}]}\n"
    "  - {name: stretched, constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}], loads: [{gravity: [1e-4, "
    "0, 0]}]}\n";

static void ten_cases_are_ten_runs(void **state)
{
    compare_with_single_runs(several, "accuracy: {relative_residual: 1e-10, algebraic_fraction: 0}\n",
                             1U << OST_FIELD_ERROR, 1e-7, 0);
    compare_with_single_runs(several, "element: {order: 2}\n", 1U << OST_FIELD_ERROR, 1e-5, 0);
}

static const char reactions[] = "springs: [{on: {boundary: xmax}, foundation: 0.1}]\n"
                                "watch:\n"
                                "  up: {reaction: {boundary: xmin}, component: z}\n"
                                "  along: {reaction: {boundary: xmin}, component: x}\n";

/* Entries of matrices that are read for products in solves, and iterations, of all ten. */
static void count_work(int alone, const char *settings, OstAccount account, double *entries, int *iterations)
{
    OstCase *c = read_case(several, settings);
    OstScene *scene = NULL;
    OstLoadCases *cases = NULL;
    const double before = ost_ledger_entry(ctx, account).work.multiplied;
    assert_success(ost_scene_create(c, &scene));
    assert_success(ost_load_cases_create(scene, &cases));
    *iterations = 0;
    for (int k = 0; k < 10; k++) {
        OstScene *one = NULL;
        OstResult *result = NULL;
        if (alone) {
            assert_success(ost_scene_create(ost_case_load_case(c, k), &one));
            assert_success(ost_scene_solve(one, &result));
        } else {
            assert_success(ost_load_cases_solve(cases, ost_scene_result_fields(scene), &result));
        }
        *iterations += result->solve.iterations;
        ost_result_destroy(&result);
        ost_scene_destroy(&one);
    }
    *entries = ost_ledger_entry(ctx, account).work.multiplied - before;
    ost_load_cases_destroy(&cases);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

static void cases_of_a_company_read_matrices_once_for_all(void **state)
{
    double together, alone;
    int iterations[2];
    count_work(0, "", OST_LEDGER_SOLVE, &together, &iterations[0]);
    count_work(1, "", OST_LEDGER_SOLVE, &alone, &iterations[1]);
    assert_in_range(iterations[0], iterations[1] - 3, iterations[1] + 3);
    assert_true(together < 0.25 * alone); /* eight at once */
}

/* The adjoint problem of a reaction depends on the supports alone. */
static void cases_of_a_company_share_what_reactions_take(void **state)
{
    double together, alone;
    int iterations[2];
    compare_with_single_runs(several, reactions, 1U << OST_FIELD_ERROR, 1e-5, 0);
    count_work(0, reactions, OST_EFFECT_ERROR_ESTIMATE, &together, &iterations[0]);
    count_work(1, reactions, OST_EFFECT_ERROR_ESTIMATE, &alone, &iterations[1]);
    assert_true(together < 0.25 * alone);
}

static const char sums[] =
    "mesh: {block: {size: [3, 1, 1], divisions: [12, 4, 4]}}\n"
    "materials: [{region: all, youngs_modulus: [100, 8, 5], poissons_ratio: 0.3, axes: {euler: {degrees: [20, 30, "
    "0]}}}]\n"
    "constraints: [{on: {boundary: xmin}, displacement: [0, 0, 0]}]\n"
    "large_rotation: off\n"
    "solver: {method: metric, coarsest_unknowns: 200}\n"
    "cases:\n"
    "  - {name: one, loads: [{on: {boundary: xmax}, total_force: [0, 2e-3, -1e-3]}]}\n"
    "  - {name: pressed, loads: [{on: {boundary: zmax}, pressure: 1e-3}]}\n"
    "  - {name: other, loads: [{on: {boundary: xmax}, total_force: [1e-3, 0, 2e-3]}]}\n"
    "  - {name: both, loads: [{on: {boundary: xmax}, total_force: [1e-3, 2e-3, 1e-3]}]}\n"
    "  - {name: mixed, loads: [{on: {boundary: xmax}, total_force: [3e-3, -2e-3, 7e-3]}, {on: {boundary: zmax}, "
    "pressure: 2e-3}]}\n";

/* Loads that are sums of others are not solved for again, and their errors add up. */
static void loads_that_are_sums_take_no_iterations(void **state)
{
    compare_with_single_runs(sums, "", 1U << OST_FIELD_ERROR, 1e-2, 0);
    OstCase *c = read_case(sums, "watch: {tip: {displacement: {nearest: [3, 1, 1]}, component: z}}\nelement: {order: 2}\n");
    OstScene *scene = NULL;
    OstLoadCases *cases = NULL;
    OstResult *result[5];
    assert_success(ost_scene_create(c, &scene));
    assert_success(ost_load_cases_create(scene, &cases));
    for (int k = 0; k < 5; k++) {
        assert_success(ost_load_cases_solve(cases, 1U << OST_FIELD_ERROR, &result[k]));
        assert_true((result[k]->solve.iterations == 0) == (k > 2));
    }
    for (OstLocal i = 0; i < 3 * scene->mesh->owned_nodes; i++) {
        assert_close(result[3]->displacement[i], result[0]->displacement[i] + result[2]->displacement[i], 1e-9);
        assert_close(result[3]->surplus[i], result[0]->surplus[i] + result[2]->surplus[i],
                     0.1 * result[3]->answer.displacement * result[3]->largest_displacement);
    }
    for (int k = 0; k < 5; k++)
        ost_result_destroy(&result[k]);
    ost_load_cases_destroy(&cases);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

static void a_case_that_fails_keeps_no_other_from_being_solved(void **state)
{
    static const char text[] = "mesh: {block: {size: [2, 1, 1], divisions: [4, 2, 2]}}\n"
                               "materials: [{region: all, youngs_modulus: 10, poissons_ratio: 0.3}]\n"
                               "constraints: free_body\n"
                               "cases:\n"
                               "  - {name: pulled, loads: [{on: {boundary: xmax}, total_force: [1e-3, 0, 0]}, "
                               "{on: {boundary: xmin}, total_force: [-1e-3, 0, 0]}]}\n"
                               "  - {name: pushed-away, loads: [{on: {boundary: xmax}, total_force: [1e-3, 0, 0]}]}\n"
                               "  - {name: pressed, loads: [{on: {boundary: [ymin, ymax]}, pressure: 1e-3}]}\n";
    const OstStatus expected[] = {OST_SUCCESS, OST_INVALID_INPUT, OST_SUCCESS};
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstLoadCases *cases = NULL;
    assert_success(ost_case_parse(ctx, "bar", text, &c));
    assert_success(ost_scene_create(c, &scene));
    assert_success(ost_load_cases_create(scene, &cases));
    for (int k = 0; k < 3; k++) {
        OstResult *result = NULL;
        assert_int_equal(ost_load_cases_solve(cases, 0, &result), expected[k]);
        if (expected[k] == OST_SUCCESS)
            assert_true(result->checks.relative_residual < 0.1 && result->largest_displacement > 0.0);
        ost_result_destroy(&result);
    }
    ost_load_cases_destroy(&cases);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(linear_cases_are_their_single_runs),
    cmocka_unit_test(cases_stop_where_the_mesh_is_worse),
    cmocka_unit_test(large_rotations_are_solved_for_where_they_are),
    cmocka_unit_test(a_rigid_face_is_moved_in_each_case_on_one_stiffness),
    cmocka_unit_test(stiffness_is_made_once_for_all_that_share_supports),
    cmocka_unit_test(ten_cases_are_ten_runs),
    cmocka_unit_test(cases_of_a_company_read_matrices_once_for_all),
    cmocka_unit_test(cases_of_a_company_share_what_reactions_take),
    cmocka_unit_test(loads_that_are_sums_take_no_iterations),
    cmocka_unit_test(a_case_that_fails_keeps_no_other_from_being_solved),
};

OST_TEST_MAIN(tests)
