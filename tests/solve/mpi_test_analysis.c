/* SPDX-License-Identifier: BSD-3-Clause */
#include "../assembly/body.h"
#include "problem/result_data.h"

#include "orthostat/analysis.h"

/* Several loads on one hierarchy, and what speaks against solving, in one verdict. */

typedef struct Made {
    OstMesh *mesh;
    OstMaterialField *field;
} Made;

static Made make_body_of_wood(void)
{
    const OstMaterial material = make_material(ctx, 1);
    Made made = {.mesh = make_body(ctx)};
    made.field = make_field(made.mesh, &material, AXES_FIXED);
    return made;
}

static void destroy(Made *made)
{
    ost_field_destroy(&made->field);
    ost_mesh_destroy(&made->mesh);
}

/* Held at x = 0, along all axes or along the first alone. */
static OstProblem *make_problem(const Made *made, int axes, const double *force)
{
    const OstMesh *mesh = made->mesh;
    OstNodeConstraint *constraints = calloc(3 * (size_t)mesh->owned_nodes + 1, sizeof *constraints);
    OstProblemParts parts = {.mesh = mesh, .field = made->field, .constraints = constraints, .force = force};
    OstProblem *problem = NULL;
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        for (int i = 0; i < axes && mesh->coordinates[3 * node] < 1e-12; i++) {
            OstNodeConstraint *constraint = &constraints[parts.constraint_count++];
            constraint->node = node;
            constraint->direction[i] = 1.0;
        }
    assert_success(ost_problem_create(&parts, &problem));
    free(constraints);
    return problem;
}

static double *make_force(const OstMesh *mesh, int salt, double size)
{
    double *force = numbers(3 * (size_t)mesh->owned_nodes);
    for (OstLocal node = 0; node < mesh->owned_nodes; node++)
        for (int i = 0; i < 3; i++)
            force[3 * node + i] = size * random_of(mesh->node_label[node], salt + i);
    return force;
}

static OstSolverOptions options_of(OstMethod method)
{
    OstSolverOptions options = ost_solver_default_options();
    options.method = method;
    options.relative_residual = 1e-10;
    options.coarsest_unknowns = 30;
    return options;
}

static void two_loads_on_one_solver_are_two_solves(void **state)
{
    const OstMethod methods[] = {OST_METHOD_METRIC, OST_METHOD_DIRECT};
    Made made = make_body_of_wood();
    const size_t size = 3 * (size_t)made.mesh->owned_nodes;
    for (int r = 0; r < 2; r++) {
        const OstSolverOptions options = options_of(methods[r]);
        double *force[2] = {make_force(made.mesh, 50, 1.0), make_force(made.mesh, 60, 3.0)};
        OstProblem *shared = make_problem(&made, 3, NULL);
        OstAnalysis *analysis = NULL;
        assert_success(ost_analysis_create(shared, &options, &analysis));
        for (int load = 0; load < 2; load++) {
            OstProblem *alone = make_problem(&made, 3, force[load]);
            OstResult *of_shared = NULL, *of_alone = NULL;
            ost_problem_set_load(shared, force[load]);
            assert_success(ost_analysis_solve(analysis, 1U << OST_FIELD_STRESS, &of_shared));
            assert_success(ost_problem_solve(alone, &options, 1U << OST_FIELD_STRESS, &of_alone));
            assert_memory_equal(of_shared->force, force[load], size * sizeof(double));
            assert_int_equal(of_shared->verdict.count, 0);
            assert_non_null(of_shared->stress);
            const double u = largest(ctx, (OstLocal)size, of_alone->displacement);
            const double reaction = largest(ctx, (OstLocal)size, of_alone->reaction);
            assert_true(u > 0.0 && reaction > 0.0);
            for (size_t i = 0; i < size; i++) {
                assert_close(of_shared->displacement[i], of_alone->displacement[i], 1e-8 * u);
                assert_close(of_shared->reaction[i], of_alone->reaction[i], 1e-8 * reaction);
            }
            ost_result_destroy(&of_shared);
            ost_result_destroy(&of_alone);
            ost_problem_destroy(&alone);
        }
        assert_int_equal(ost_ledger_entry(ctx, OST_LEDGER_PATTERN).bytes > 0, 1); /* the shared one's */
        ost_analysis_destroy(&analysis);
        ost_problem_destroy(&shared);
        free(force[0]);
        free(force[1]);
    }
    destroy(&made);
}

/* A load that is refused leaves stiffness and solver to the next. */
static void a_refused_load_is_followed_by_another(void **state)
{
    Made made = make_body_of_wood();
    const OstSolverOptions options = options_of(OST_METHOD_METRIC);
    double *force = make_force(made.mesh, 50, 1.0), *beyond = make_force(made.mesh, 50, 1e80);
    OstProblem *problem = make_problem(&made, 3, force);
    OstAnalysis *analysis = NULL;
    OstResult *result = NULL;
    assert_success(ost_analysis_create(problem, &options, &analysis));
    for (int k = 0; k < 3; k++) {
        ost_problem_set_load(problem, k == 1 ? beyond : force);
        if (k == 1)
            assert_failure(ost_analysis_solve(analysis, 0, &result), OST_INVALID_INPUT, "are of size 1e+80");
        else
            assert_success(ost_analysis_solve(analysis, 0, &result));
        assert_int_equal(result->reached, k != 1);
        ost_result_destroy(&result);
    }
    ost_analysis_destroy(&analysis);
    ost_problem_destroy(&problem);
    free(force);
    free(beyond);
    destroy(&made);
}

static void a_dry_run_refuses_what_a_solve_refuses(void **state)
{
    Made made = make_body_of_wood();
    const OstSolverOptions options = options_of(OST_METHOD_METRIC);
    double *force = make_force(made.mesh, 50, 1.0);
    OstProblem *sliding = make_problem(&made, 1, force), *held = make_problem(&made, 3, force);
    OstResult *result = NULL;
    assert_failure(ost_problem_dry_run(sliding, &options), OST_INVALID_INPUT, "the problem: nothing constrains these");
    assert_failure(ost_problem_solve(sliding, &options, 0, &result), OST_INVALID_INPUT,
                   "the problem: nothing constrains these motions");
    assert_false(result->reached);
    ost_result_destroy(&result);
    assert_success(ost_problem_dry_run(held, &options));
    assert_success(ost_problem_solve(held, &options, 0, &result));
    ost_result_destroy(&result);
    ost_problem_destroy(&sliding);
    ost_problem_destroy(&held);
    free(force);
    destroy(&made);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(two_loads_on_one_solver_are_two_solves),
    cmocka_unit_test(a_refused_load_is_followed_by_another),
    cmocka_unit_test(a_dry_run_refuses_what_a_solve_refuses),
};

OST_TEST_MAIN(tests)
