/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "elastic_block.h"

/* More than the 3000 unknowns below which AUTO is direct, and nothing easy. */
static const ElasticBlock hard = {
    .bricks = {7, 7, 16}, .size = {1.0, 1.0, 1.0}, .modulus = 1e3, .poisson = 0.3, .contrast = 100.0, .held = 1};

static OstSolverOptions options_of(OstMethod method)
{
    OstSolverOptions options = ost_solver_default_options();
    options.method = method;
    options.coarsest_unknowns = 100;
    return options;
}

/* Flat bricks, and a metric that takes the far neighbours for the near ones: METRIC at its worst. */
static const ElasticBlock flat = {
    .bricks = {7, 7, 16}, .size = {1.0, 1.0, 0.05}, .modulus = 1e3, .poisson = 0.3, .contrast = 100.0, .held = 1};

static void create_misled(ElasticProblem *problem, double **metric)
{
    assert_success(elastic_create(ctx, &flat, problem));
    assert_success(OST_NEW(ctx, metric, 6 * (size_t)problem->matrix->rows));
    for (OstLocal i = 0; i < problem->matrix->rows; i++)
        for (int c = 0; c < 3; c++)
            (*metric)[6 * i + c] = c == 2 ? 1e8 : 1.0;
    problem->geometry.metric = *metric;
}

/* Of many stiffnesses: factors of one, which are cheap here, do not come before the other strategies. */
static const OstSolverFacts one_of_many = {.repeated = 1};

static void destroy_misled(ElasticProblem *problem, double **metric)
{
    OST_FREE(*metric);
    elastic_destroy(problem);
}

static OstSolverOptions slow_options(void)
{
    OstSolverOptions options = options_of(OST_METHOD_AUTO);
    options.aggregate_nodes = 100.0;
    options.smoother_degree = 1;
    options.smoother_block_nodes = 1.0;
    options.patience = 10;
    options.relative_residual = 1e-10;
    return options;
}

static OstStatus create_and_solve(const ElasticProblem *problem, const OstSolverOptions *options, double *u,
                                  OstSolveReport *report)
{
    OstSolver *solver = NULL;
    memset(report, 0, sizeof *report);
    OstStatus status = ost_solver_create(ctx, problem->matrix, &problem->geometry, options, &solver);
    if (status == OST_SUCCESS)
        status = ost_solver_solve(solver, problem->force, u, report);
    ost_solver_destroy(&solver);
    return status;
}

static double *new_vector(const ElasticProblem *problem)
{
    double *u = NULL;
    assert_success(OST_NEW(ctx, &u, 3 * (size_t)problem->matrix->rows));
    return u;
}

/* Largest difference over the largest number, over all ranks. */
static double difference(const ElasticProblem *problem, const double *a, const double *b)
{
    double largest[2] = {0.0, 0.0};
    for (OstLocal i = 0; i < 3 * problem->matrix->rows; i++) {
        largest[0] = fmax(largest[0], fabs(a[i] - b[i]));
        largest[1] = fmax(largest[1], fabs(b[i]));
    }
    MPI_Allreduce(MPI_IN_PLACE, largest, 2, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return largest[0] / largest[1];
}

/* The direct method's answer. */
static double *reference(const ElasticProblem *problem)
{
    OstSolverOptions options = options_of(OST_METHOD_DIRECT);
    OstSolveReport report;
    double *u = new_vector(problem);
    options.relative_residual = 1e-12;
    assert_success(create_and_solve(problem, &options, u, &report));
    return u;
}

static void a_slow_strategy_is_left_for_a_stronger_one(void **state)
{
    ElasticProblem problem;
    double *metric = NULL;
    OstSolveReport report;
    create_misled(&problem, &metric);
    problem.geometry.facts = &one_of_many;
    double *u = new_vector(&problem), *expected = reference(&problem);
    const OstSolverOptions options = slow_options();
    assert_success(create_and_solve(&problem, &options, u, &report));
    assert_in_range(report.steps, 2, 4);
    assert_int_equal(report.step[0].method, OST_METHOD_METRIC);
    assert_non_null(strstr(report.step[0].outcome, "too slow"));
    int iterations = 0;
    for (int s = 0; s < report.steps; s++) {
        assert_int_equal(report.step[s].method, OST_METHOD_METRIC + s);
        assert_true(s == 0 || report.step[s].relative_residual < 10.0 * report.step[s - 1].relative_residual);
        iterations += report.step[s].iterations;
    }
    assert_int_equal(report.iterations, iterations);
    assert_int_equal(report.method, report.step[report.steps - 1].method);
    assert_true(report.relative_residual <= 1e-10);
    assert_true(difference(&problem, u, expected) < 1e-6);
    OST_FREE(u, expected);
    destroy_misled(&problem, &metric);
}

/* Few unknowns are factored in less time than a stronger smoother takes to fail. */
static void cheap_factors_come_before_a_stronger_smoother(void **state)
{
    ElasticProblem problem;
    double *metric = NULL;
    OstSolveReport report;
    create_misled(&problem, &metric);
    double *u = new_vector(&problem), *expected = reference(&problem);
    const OstSolverOptions options = slow_options();
    assert_success(create_and_solve(&problem, &options, u, &report));
    assert_int_equal(report.steps, 2);
    assert_int_equal(report.step[0].method, OST_METHOD_METRIC);
    assert_int_equal(report.step[1].method, OST_METHOD_DIRECT);
    assert_true(report.relative_residual <= 1e-10);
    assert_true(difference(&problem, u, expected) < 1e-6);
    OST_FREE(u, expected);
    destroy_misled(&problem, &metric);
}

/* With the smoother given, only a factorisation helps; the solver gets there. */
static void given_parameters_are_left_alone_up_to_the_top(void **state)
{
    ElasticProblem problem;
    double *metric = NULL;
    OstSolveReport report;
    create_misled(&problem, &metric);
    problem.geometry.facts = &one_of_many;
    double *u = new_vector(&problem), *expected = reference(&problem);
    OstSolverOptions options = slow_options();
    options.given = OST_GIVEN_AGGREGATE | OST_GIVEN_DEGREE | OST_GIVEN_RATIO | OST_GIVEN_BLOCK;
    options.smoother_ratio = 1.5;
    options.patience = 1;
    assert_success(create_and_solve(&problem, &options, u, &report));
    assert_int_equal(report.steps, 4);
    assert_int_equal(report.method, OST_METHOD_DIRECT);
    assert_int_equal(report.step[3].method, OST_METHOD_DIRECT);
    assert_in_range(report.step[3].iterations, 1, 3);
    assert_true(difference(&problem, u, expected) < 1e-6);
    OST_FREE(u, expected);
    destroy_misled(&problem, &metric);
}

static void a_chosen_method_is_never_changed(void **state)
{
    ElasticProblem problem;
    OstSolveReport report;
    assert_success(elastic_create(ctx, &hard, &problem));
    double *u = new_vector(&problem);
    for (OstMethod method = OST_METHOD_PLAIN; method <= OST_METHOD_TWO_LEVEL; method++) {
        OstSolverOptions options = options_of(method);
        options.max_iterations = 3;
        options.patience = 1;
        assert_failure(create_and_solve(&problem, &options, u, &report), OST_NOT_CONVERGED,
                       "after 3 iterations, the most allowed");
        assert_int_equal(report.steps, 1);
        assert_int_equal(report.method, method);
    }
    OST_FREE(u);
    elastic_destroy(&problem);
}

static void the_next_strategy_starts_from_what_was_reached(void **state)
{
    ElasticProblem problem;
    double *metric = NULL;
    OstSolveReport report;
    OstSolver *solver = NULL;
    create_misled(&problem, &metric);
    double *u = new_vector(&problem);
    const OstSolverOptions options = slow_options();
    assert_success(ost_solver_create(ctx, problem.matrix, &problem.geometry, &options, &solver));
    assert_success(ost_solver_solve(solver, problem.force, u, &report));
    const OstMethod reached = report.method;
    assert_true(reached > OST_METHOD_METRIC);
    /* the next right-hand side starts with the strategy reached */
    for (OstLocal i = 0; i < 3 * problem.matrix->rows; i++)
        problem.force[i] = 1.0 + i % 5;
    assert_success(ost_solver_solve(solver, problem.force, u, &report));
    assert_int_equal(report.step[0].method, reached);
    assert_true(report.relative_residual <= 1e-10);
    ost_solver_destroy(&solver);
    OST_FREE(u);
    destroy_misled(&problem, &metric);
}

static void a_factorisation_that_does_not_fit_is_refused_before_it_begins(void **state)
{
    ElasticProblem problem;
    OstSolveReport report;
    assert_success(elastic_create(ctx, &hard, &problem));
    double *u = new_vector(&problem);
    OstSolverOptions options = options_of(OST_METHOD_DIRECT);
    options.factor_memory = 1e6;
    assert_failure(create_and_solve(&problem, &options, u, &report), OST_OUT_OF_MEMORY,
                   "factor_memory allows 0.954 MiB; raise it or leave it out");
    OST_FREE(u);
    elastic_destroy(&problem);
}

/* If memory does not allow factors, small aggregates on all levels go on, without patience. */
static void without_memory_for_factors_small_aggregates_go_on(void **state)
{
    ElasticProblem problem;
    double *metric = NULL;
    OstSolveReport report;
    create_misled(&problem, &metric);
    double *u = new_vector(&problem), *expected = reference(&problem);
    OstSolverOptions options = slow_options();
    options.given = OST_GIVEN_AGGREGATE | OST_GIVEN_DEGREE | OST_GIVEN_RATIO | OST_GIVEN_BLOCK;
    options.smoother_ratio = 1.5;
    options.patience = 1;
    options.factor_memory = 1e6;
    assert_success(create_and_solve(&problem, &options, u, &report));
    assert_int_equal(report.steps, 5);
    assert_int_equal(report.step[3].method, OST_METHOD_DIRECT);
    assert_int_equal(report.step[3].iterations, 0);
    assert_non_null(strstr(report.step[3].outcome, "MiB"));
    assert_int_equal(report.method, OST_METHOD_STRONG);
    assert_true(difference(&problem, u, expected) < 1e-6);
    options.max_iterations = 130; /* and if that is not enough, all that was tried is told */
    assert_failure(create_and_solve(&problem, &options, u, &report), OST_NOT_CONVERGED, "Tried: metric (4");
    assert_non_null(strstr(ost_error_text(ctx), "direct (0 iterations): factoring"));
    OST_FREE(u, expected);
    destroy_misled(&problem, &metric);
}

static void no_other_strategy_is_tried_against_rounding(void **state)
{
    ElasticProblem problem;
    OstSolveReport report;
    assert_success(elastic_create(ctx, &hard, &problem));
    double *u = new_vector(&problem);
    OstSolverOptions options = options_of(OST_METHOD_AUTO);
    options.relative_residual = 1e-17;
    assert_failure(create_and_solve(&problem, &options, u, &report), OST_NOT_CONVERGED, "double precision allows");
    assert_int_equal(report.steps, 1);
    assert_true(report.attainable_residual > 1e-17 && report.attainable_residual < 1e-12);
    assert_true(report.relative_residual < 3.0 * report.attainable_residual);
    options.accept_attainable = 1;
    assert_success(create_and_solve(&problem, &options, u, &report));
    assert_true(report.rounding_limited);
    assert_true(report.relative_residual < 3.0 * report.attainable_residual);
    options.relative_residual = 1e-8;
    assert_success(create_and_solve(&problem, &options, u, &report));
    assert_false(report.rounding_limited);
    OST_FREE(u);
    elastic_destroy(&problem);
}

static void an_indefinite_matrix_never_passes(void **state)
{
    ElasticProblem problem;
    OstSolveReport report;
    assert_success(elastic_create(ctx, &hard, &problem));
    OstBlockMatrix *matrix = problem.matrix;
    double *u = new_vector(&problem);
    for (OstLocal i = 0; i < matrix->rows; i++)
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++)
            for (size_t c = 0; c < 9 && k != matrix->diagonal[i]; c++)
                matrix->value[9 * (size_t)k + c] *= 1.3;
    for (OstMethod method = OST_METHOD_AUTO; method <= OST_METHOD_DIRECT; method++) {
        const OstSolverOptions options = options_of(method);
        assert_failure(create_and_solve(&problem, &options, u, &report), OST_NOT_CONVERGED, "definite");
    }
    OST_FREE(u);
    elastic_destroy(&problem);
}

/* Powers of two, so that nothing is rounded otherwise: all the same but for the exponent. */
static void units_make_no_difference(void **state)
{
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &hard, &problem));
    const OstBlockMatrix *matrix = problem.matrix;
    const size_t values = 9 * (size_t)matrix->row_start[matrix->rows], n = 3 * (size_t)matrix->rows;
    double *u[2] = {new_vector(&problem), new_vector(&problem)};
    for (OstMethod method = OST_METHOD_METRIC; method <= OST_METHOD_DIRECT; method += 3) {
        const OstSolverOptions options = options_of(method);
        OstSolveReport report[2];
        assert_success(create_and_solve(&problem, &options, u[0], &report[0]));
        for (int sign = -1; sign <= 1; sign += 2) {
            const int stiffness = sign * 660, force = sign * 150; /* 1e±200, 1e±45; even, for Cholesky's root */
            for (size_t k = 0; k < values; k++)
                matrix->value[k] = ldexp(matrix->value[k], stiffness);
            for (size_t i = 0; i < n; i++)
                problem.force[i] = ldexp(problem.force[i], force);
            assert_success(create_and_solve(&problem, &options, u[1], &report[1]));
            for (size_t k = 0; k < values; k++)
                matrix->value[k] = ldexp(matrix->value[k], -stiffness);
            for (size_t i = 0; i < n; i++) {
                problem.force[i] = ldexp(problem.force[i], -force);
                u[1][i] = ldexp(u[1][i], stiffness - force);
            }
            assert_int_equal(report[1].iterations, report[0].iterations);
            assert_true(difference(&problem, u[1], u[0]) < 1e-9);
        }
    }
    OST_FREE(u[0], u[1]);
    elastic_destroy(&problem);
}

/* A coarse matrix beyond what every rank would factor for itself is MUMPS's. */
static void a_large_coarse_level_is_factored(void **state)
{
    ElasticBlock large = hard;
    ElasticProblem problem;
    OstSolveReport report;
    large.bricks[0] = large.bricks[1] = 9;
    large.bricks[2] = 32;
    assert_success(elastic_create(ctx, &large, &problem));
    double *u = new_vector(&problem), *expected = reference(&problem);
    OstSolverOptions options = options_of(OST_METHOD_TWO_LEVEL);
    options.aggregate_nodes = 3.0;
    options.given = OST_GIVEN_AGGREGATE;
    options.relative_residual = 1e-10;
    assert_success(create_and_solve(&problem, &options, u, &report));
    assert_int_equal(report.levels, 2);
    assert_true(report.level_unknowns[1] > 4096);
    assert_true(difference(&problem, u, expected) < 1e-6);
    OST_FREE(u, expected);
    elastic_destroy(&problem);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_slow_strategy_is_left_for_a_stronger_one),
    cmocka_unit_test(cheap_factors_come_before_a_stronger_smoother),
    cmocka_unit_test(given_parameters_are_left_alone_up_to_the_top),
    cmocka_unit_test(a_chosen_method_is_never_changed),
    cmocka_unit_test(the_next_strategy_starts_from_what_was_reached),
    cmocka_unit_test(a_factorisation_that_does_not_fit_is_refused_before_it_begins),
    cmocka_unit_test(without_memory_for_factors_small_aggregates_go_on),
    cmocka_unit_test(no_other_strategy_is_tried_against_rounding),
    cmocka_unit_test(an_indefinite_matrix_never_passes),
    cmocka_unit_test(units_make_no_difference),
    cmocka_unit_test(a_large_coarse_level_is_factored),
};

OST_TEST_MAIN(tests)
