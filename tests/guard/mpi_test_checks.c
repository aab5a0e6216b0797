/* SPDX-License-Identifier: BSD-3-Clause */
#include "../assembly/body.h"

#include "guard/guard.h"
#include "orthostat/refine.h"

/* A right answer has nothing held against it; each wrong one has, in words. */

typedef struct Solved {
    OstMesh *mesh;
    OstMaterialField *field;
    OstProblem *problem;
    OstResult result;
    OstSolvedFor rhs;
} Solved;

static const double requested = 1e-12;

static OstMesh *make_mesh(int order)
{
    OstMesh *linear = make_body(ctx);
    OstMesh *mesh = NULL;
    if (order == 1)
        return linear;
    assert_success(ost_mesh_raise(linear, NULL, &mesh));
    ost_mesh_destroy(&linear);
    return mesh;
}

/* Held at one end, moved there as given, and loaded at every other node. */
static Solved make_held(int order, const double given[3], double load)
{
    const OstMaterial material = make_material(ctx, 1);
    Solved solved = {.mesh = make_mesh(order)};
    OstMesh *mesh = solved.mesh;
    OstResult *result = &solved.result;
    const size_t size = 3 * (size_t)mesh->node_count;
    solved.field = make_field(mesh, &material, AXES_RANDOM_BY_TET);
    *result = (OstResult){.ctx = ctx, .mesh = mesh, .field = solved.field};
    result->displacement = numbers(size);
    result->force = numbers(size);
    result->reaction = numbers(size);
    result->solve.error_estimate = result->solve.energy_error = 3e-5;
    result->solve.rounding_error = 1e-5;
    OstNodeConstraint *constraints = calloc(size + 1, sizeof *constraints);
    OstProblemParts parts = {.mesh = mesh, .field = solved.field, .constraints = constraints, .force = result->force};
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        for (int i = 0; i < 3; i++) {
            OstNodeConstraint constraint = {.node = node, .displacement = given[i]};
            constraint.direction[i] = 1.0;
            if (mesh->coordinates[3 * node] < 1e-12)
                constraints[parts.constraint_count++] = constraint;
            else
                result->force[3 * node + i] = load * random_of(mesh->node_label[node], 40 + i);
        }
    assert_success(ost_problem_create(&parts, &solved.problem));
    free(constraints);
    assert_success(ost_problem_stiffness(solved.problem, 1.0, NULL, NULL));
    const OstSystem *system = solved.problem->system;
    const OstLocal length = 3 * system->matrix->rows;
    double *rhs = numbers((size_t)length), *v = numbers((size_t)length);
    assert_success(ost_problem_right_hand_side(solved.problem, 1.0, rhs));
    solve(ctx, system->matrix, rhs, v);
    assert_success(ost_problem_displacement(solved.problem, 1.0, v, result->displacement));
    result->unknowns = 3 * system->matrix->global_rows;
    solved.rhs = (OstSolvedFor){.norm = sqrt(dot(ctx, length, rhs, rhs)), .work = dot(ctx, length, rhs, v)};
    free(rhs);
    free(v);
    ost_problem_release_stiffness(solved.problem);
    return solved;
}

/* Moved by `common` all along, and a little beside. */
static Solved make_along(int order, double common, double load)
{
    return make_held(order, (const double[3]){common, common + 0.01, common + 0.02}, load);
}

static Solved make(int order)
{
    return make_along(order, 0.0, 1.0);
}

static void destroy(Solved *solved)
{
    free(solved->result.displacement);
    free(solved->result.force);
    free(solved->result.reaction);
    ost_problem_destroy(&solved->problem);
    ost_field_destroy(&solved->field);
    ost_mesh_destroy(&solved->mesh);
}

static void check(Solved *solved)
{
    solved->result.verdict.count = 0;
    assert_success(ost_guard_after(solved->problem, requested, &solved->rhs, NULL, &solved->result));
}

static int objects_to(const Solved *solved, const char *words)
{
    for (int i = 0; i < solved->result.verdict.count; i++)
        if (strstr(solved->result.verdict.text[i], words))
            return 1;
    return 0;
}

static void an_answer_passes(void **state)
{
    for (int order = 1; order <= 2; order++) {
        Solved solved = make(order);
        const OstChecks *checks = &solved.result.checks;
        check(&solved);
        assert_int_equal(solved.result.verdict.count, 0);
        assert_true(checks->finite);
        assert_true(checks->strain_energy > 0.0);
        assert_close(checks->work / checks->strain_energy, 1.0, 1e-10);
        assert_close(checks->displacement_error, 3e-5, 0.0);
        destroy(&solved);
    }
}

static void a_slip_in_the_displacement_is_seen(void **state)
{
    for (int order = 1; order <= 2; order++) {
        Solved solved = make(order);
        for (OstLocal i = 0; i < 3 * solved.mesh->node_count; i++)
            solved.result.displacement[i] *= 1.0 + 1e-6;
        check(&solved);
        assert_true(objects_to(&solved, "true residual"));
        destroy(&solved);
    }
}

/* u + 1e-6 u has 2e-6 more energy, and does 1e-6 more work. */
static void a_difference_of_work_and_energy_is_an_error(void **state)
{
    for (int moved = 0; moved < 2; moved++) {
        Solved solved = moved ? make(1) : make_held(1, (const double[3]){0.0, 0.0, 0.0}, 1.0);
        const OstChecks *checks = &solved.result.checks;
        solved.result.solve.error_estimate = 1e-9;
        check(&solved);
        assert_close(checks->displacement_error, 1e-9, 0.0);
        for (OstLocal i = 0; i < 3 * solved.mesh->node_count; i++)
            solved.result.displacement[i] *= 1.0 + 1e-6;
        check(&solved);
        assert_close(checks->displacement_error, moved ? 1e-9 : checks->energy_imbalance, 0.0);
        assert_true(moved || (checks->energy_imbalance > 1e-7 && checks->energy_imbalance < 2e-6));
        destroy(&solved);
    }
}

/* Loads that the answer does not belong to: what the right-hand side is said to be does not count. */
static void a_load_that_nothing_carries_is_seen(void **state)
{
    Solved solved = make(1);
    for (OstLocal node = 0; node < solved.mesh->owned_nodes; node++)
        solved.result.force[3 * node] += 0.5;
    check(&solved);
    assert_true(objects_to(&solved, "true residual"));
    destroy(&solved);
}

static void what_is_no_number_is_seen(void **state)
{
    Solved solved = make(1);
    if (ost_rank(ctx) == ost_size(ctx) - 1)
        solved.result.displacement[4] = NAN;
    check(&solved);
    assert_false(solved.result.checks.finite);
    assert_int_equal(solved.result.verdict.count, 1);
    assert_true(objects_to(&solved, "not finite"));
    destroy(&solved);
}

/* Of a nonlinear problem the energy is not half the work: nothing is concluded from their difference. */
static void energy_and_work_are_compared_in_linear_problems_alone(void **state)
{
    for (int linear = 0; linear < 2; linear++) {
        Solved solved = make_held(1, (const double[3]){0.0, 0.0, 0.0}, 1.0);
        const OstChecks *checks = &solved.result.checks;
        solved.problem->linear = linear;
        solved.result.solve.error_estimate = 1e-9;
        for (OstLocal i = 0; i < 3 * solved.mesh->node_count; i++)
            solved.result.displacement[i] *= 1.0 + 1e-6;
        check(&solved);
        assert_int_equal(checks->linear, linear);
        assert_true(linear ? checks->energy_imbalance > 1e-7 : checks->energy_imbalance == 0.0);
        assert_int_equal(objects_to(&solved, "strain energy"), 0); /* the residual explains it */
        assert_close(checks->displacement_error, linear ? checks->energy_imbalance : 1e-9, 0.0);
        memset(solved.result.force, 0, 3 * (size_t)solved.mesh->owned_nodes * sizeof(double));
        check(&solved);
        assert_true(objects_to(&solved, "true residual"));
        destroy(&solved);
    }
}

static int is_held(const Solved *solved, OstLocal node)
{
    return solved->mesh->coordinates[3 * node] < 1e-12;
}

/* It strains nothing, but where the support moves its work and that of the reaction all but cancel. */
static void load_the_support(Solved *solved, double force)
{
    for (OstLocal node = 0; node < solved->mesh->owned_nodes; node++)
        for (int i = 0; is_held(solved, node) && i < 3; i++)
            solved->result.force[3 * node + i] = force / (1.0 + i);
}

static void a_force_straight_into_a_support_is_no_miss(void **state)
{
    for (int order = 1; order <= 2; order++) {
        Solved solved = make(order);
        load_the_support(&solved, 1e10);
        check(&solved);
        assert_int_equal(solved.result.verdict.count, 0);
        destroy(&solved);
    }
}

static void a_force_straight_into_a_support_hides_no_miss(void **state)
{
    Solved solved = make(1);
    const OstChecks *checks = &solved.result.checks;
    load_the_support(&solved, 1e8);
    for (OstLocal i = 0; i < 3 * solved.mesh->node_count; i++)
        solved.result.displacement[i] *= 1.001;
    check(&solved);
    assert_true(objects_to(&solved, "true residual"));
    assert_true(checks->energy_imbalance > 1e-5);
    assert_true(fmax(checks->force_imbalance, checks->moment_imbalance) > 1e-5);
    destroy(&solved);
}

static void rounding_that_leaves_no_correct_digit_is_refused(void **state)
{
    Solved solved = make(1);
    OstSolveReport *report = &solved.result.solve;
    report->rounding_error = 0.09;
    report->error_estimate = 0.5; /* the residual's part is the user's choice */
    check(&solved);
    assert_int_equal(solved.result.verdict.count, 0);
    assert_true(solved.result.checks.displacement_error > 0.1);
    report->rounding_error = 0.129; /* random samples leave open on which side of a tenth it is */
    report->rounding_spread = 0.1;
    check(&solved);
    assert_int_equal(solved.result.verdict.count, 0);
    report->rounding_spread = 0.02;
    report->rounding_limited = 1; /* the residual's part has no such excuse */
    report->rounding_error = 0.02;
    report->rounding_spread = 0.25;
    report->error_estimate = 0.17;
    check(&solved);
    assert_int_equal(solved.result.verdict.count, 1);
    assert_true(objects_to(&solved, "an error of about 0.2"));
    report->rounding_error = 0.168; /* nearly all of it is from random samples: their border is 0.175 */
    check(&solved);
    assert_int_equal(solved.result.verdict.count, 0);
    report->rounding_limited = 0;
    report->rounding_spread = 0.02;
    const double wrong[] = {0.11, (double)INFINITY, (double)NAN};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        report->rounding_error = report->error_estimate = wrong[i];
        check(&solved);
        assert_int_equal(solved.result.verdict.count, 1);
        assert_true(objects_to(&solved, "less than one digit"));
        assert_true(objects_to(&solved, i == 0 ? "an error of about 0.1" : "none at all"));
        assert_true(!(solved.result.checks.displacement_error <= 0.1));
    }
    report->rounding_error = report->error_estimate = 0.0; /* not known */
    check(&solved);
    assert_int_equal(solved.result.verdict.count, 0);
    assert_true(isnan(solved.result.checks.displacement_error));
    destroy(&solved);
}

/* How right the strains are beside a displacement that all share; by the two norms that an estimate may be in. */
static void forces_lost_beside_a_common_displacement_are_seen(void **state)
{
    const OstMethod norms[] = {OST_METHOD_METRIC, OST_METHOD_DIRECT};
    for (int n = 0; n < 2; n++) {
        Solved solved = make_along(1, 1e4, 1.0);
        OstSolveReport *report = &solved.result.solve;
        const OstChecks *checks = &solved.result.checks;
        report->method = norms[n];
        report->rounding_error = 0.0;
        report->energy_error = report->error_estimate = 1e-11;
        check(&solved);
        assert_int_equal(solved.result.verdict.count, 0);
        assert_true(checks->force_error > 1e3 * checks->displacement_error && checks->force_error > 1e-8);
        const double amplified = checks->force_error / 1e-11;
        report->energy_error = report->error_estimate = 0.09 / amplified;
        check(&solved);
        assert_int_equal(solved.result.verdict.count, 0);
        report->energy_error = report->error_estimate = 0.11 / amplified;
        check(&solved);
        assert_close(checks->force_error, 0.11, 1e-3);
        assert_true(checks->displacement_error < 1e-3);
        assert_int_equal(solved.result.verdict.count, 1);
        assert_true(objects_to(&solved, "by about (1e+04, 1e+04, 1e+04)"));
        assert_true(objects_to(&solved, "(an error of about 0.1)"));
        assert_true(objects_to(&solved, "subtract the common part from the prescribed displacements"));
        solved.result.unfinished = 1; /* which says more */
        check(&solved);
        assert_int_equal(solved.result.verdict.count, 0);
        destroy(&solved);
    }
}

/* Its forces are rounding errors alone, and so out of balance by their own size. */
static void a_rigid_motion_has_no_forces_to_lose(void **state)
{
    Solved solved = make_along(1, 1e4, 0.0);
    solved.result.solve.energy_error = solved.result.solve.error_estimate = 1e-3; /* 1e4 times what deforms it */
    check(&solved);
    assert_true(solved.result.checks.force_error >= 1.0);
    assert_int_equal(solved.result.verdict.count, 0);
    load_the_support(&solved, 1e3); /* nor does this strain anything */
    check(&solved);
    assert_int_equal(solved.result.verdict.count, 0);
    destroy(&solved);
}

static void forces_are_as_right_as_the_displacement_where_nothing_is_moved(void **state)
{
    Solved solved = make_along(1, 0.0, 1.0);
    const OstChecks *checks = &solved.result.checks;
    check(&solved);
    assert_true(checks->force_error >= checks->displacement_error);
    assert_true(checks->force_error < 100.0 * checks->displacement_error);
    solved.result.solve.error_estimate = 0.0; /* not known */
    check(&solved);
    assert_true(isnan(checks->force_error));
    destroy(&solved);
}

/* What a linear map does to a tet does not depend on its edges' being straight. */
static void bend_edges(OstMesh *mesh)
{
    for (OstLocal node = 0; node < mesh->node_count; node++) {
        double *x = mesh->coordinates + 3 * node;
        x[2] += 0.05 * x[0] * x[0];
    }
}

/* u = g x: the largest strain of a tet is the norm of g's symmetric part, the largest turn that of half its curl. */
static void assert_linearity(const double g[9], double strain, double rotation)
{
    for (int order = 1; order <= 2; order++) {
        Solved solved = make(order);
        bend_edges(solved.mesh);
        for (OstLocal node = 0; node < solved.mesh->node_count; node++)
            ost_apply3(g, solved.mesh->coordinates + 3 * node, solved.result.displacement + 3 * node);
        check(&solved);
        assert_close(solved.result.checks.largest_strain, strain, 1e-12);
        assert_close(solved.result.checks.largest_rotation, rotation, 1e-12);
        assert_close(ost_linear_error(&solved.result.checks), fmax(0.5 * strain, 0.5 * rotation * rotation), 1e-12);
        destroy(&solved);
    }
}

static void large_strains_and_rotations_are_measured(void **state)
{
    assert_linearity((const double[9]){0.0, -0.3, 0.2, 0.3, 0.0, -0.6, -0.2, 0.6, 0.0}, 0.0, 0.7);
    assert_linearity((const double[9]){0.1, 0.0, 0.0, 0.0, -0.25, 0.0, 0.0, 0.0, 0.2}, 0.25, 0.0);
    assert_linearity((const double[9]){0.04, 0.0, 0.0, 0.0, 0.04, 0.0, 0.0, 0.0, 0.04}, 0.04, 0.0);
    /* simple shear by 0.08: principal strains of 0.04 and a turn of 0.04, about x, y and z */
    assert_linearity((const double[9]){0.0, 0.0, 0.0, 0.0, 0.0, 0.08, 0.0, 0.0, 0.0}, 0.04, 0.04);
    assert_linearity((const double[9]){0.0, 0.0, 0.08, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0}, 0.04, 0.04);
    assert_linearity((const double[9]){0.0, 0.0, 0.0, 0.08, 0.0, 0.0, 0.0, 0.0, 0.0}, 0.04, 0.04);
    /* all six strains: -0.2 v v' with |v| = 1, (2, -1, 2) / 3, and a pull of 0.1 across it, (1, 2, 0) / sqrt(5) */
    const double v[3] = {2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0}, w[3] = {1.0 / sqrt(5.0), 2.0 / sqrt(5.0), 0.0};
    double g[9];
    for (int i = 0; i < 9; i++)
        g[i] = 0.1 * w[i / 3] * w[i % 3] - 0.2 * v[i / 3] * v[i % 3];
    assert_linearity(g, 0.2, 0.0);
}

/* One tet is enough, on whichever rank it is. */
static void the_largest_of_all_ranks_counts(void **state)
{
    Solved solved = make(1);
    const OstMesh *mesh = solved.mesh;
    memset(solved.result.displacement, 0, 3 * (size_t)mesh->node_count * sizeof(double));
    for (OstLocal node = 0; node < mesh->node_count; node++)
        if (mesh->node_label[node] == 1)
            solved.result.displacement[3 * node] = 1.0;
    check(&solved);
    double all[2] = {solved.result.checks.largest_strain, solved.result.checks.largest_rotation}, least[2];
    assert_true(all[0] > 0.1 && all[1] > 0.1);
    MPI_Allreduce(all, least, 2, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
    assert_close(all[0], least[0], 0.0);
    assert_close(all[1], least[1], 0.0);
    destroy(&solved);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(large_strains_and_rotations_are_measured),
    cmocka_unit_test(the_largest_of_all_ranks_counts),
    cmocka_unit_test(an_answer_passes),
    cmocka_unit_test(a_slip_in_the_displacement_is_seen),
    cmocka_unit_test(a_difference_of_work_and_energy_is_an_error),
    cmocka_unit_test(a_load_that_nothing_carries_is_seen),
    cmocka_unit_test(what_is_no_number_is_seen),
    cmocka_unit_test(energy_and_work_are_compared_in_linear_problems_alone),
    cmocka_unit_test(a_force_straight_into_a_support_is_no_miss),
    cmocka_unit_test(a_force_straight_into_a_support_hides_no_miss),
    cmocka_unit_test(rounding_that_leaves_no_correct_digit_is_refused),
    cmocka_unit_test(forces_lost_beside_a_common_displacement_are_seen),
    cmocka_unit_test(a_rigid_motion_has_no_forces_to_lose),
    cmocka_unit_test(forces_are_as_right_as_the_displacement_where_nothing_is_moved),
};

OST_TEST_MAIN(tests)
