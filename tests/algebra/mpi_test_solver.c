/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "elastic_block.h"

#include "core/small.h"

static const ElasticBlock column = {
    .bricks = {3, 4, 12}, .size = {1.0, 0.7, 1.2}, .modulus = 5.0, .poisson = 0.3, .held = 1};
static const ElasticBlock slab = {
    .bricks = {4, 3, 2}, .size = {1.0, 1.0, 1.0}, .modulus = 1.0, .poisson = 0.3, .held = 1};
static const ElasticBlock afloat = {.bricks = {3, 3, 4}, .size = {1.0, 1.0, 1.0}, .modulus = 1.0, .poisson = 0.3};

static const OstMethod methods[] = {OST_METHOD_PLAIN,     OST_METHOD_METRIC, OST_METHOD_STRONG,
                                    OST_METHOD_TWO_LEVEL, OST_METHOD_DIRECT, OST_METHOD_AUTO};
enum { METHODS = 6 };

static OstSolverOptions options_for(OstMethod method, double relative_residual)
{
    OstSolverOptions options = ost_solver_default_options();
    options.method = method;
    options.relative_residual = relative_residual;
    options.coarsest_unknowns = 150; /* several levels, small as the problems are */
    return options;
}

/* The problem's solution on this rank's rows, the caller's to free. */
static double *solve(OstContext *context, const ElasticProblem *problem, const OstSolverOptions *options,
                     OstSolveReport *report)
{
    OstSolver *solver = NULL;
    double *u = NULL;
    assert_int_equal(OST_NEW(context, &u, 3 * (size_t)problem->matrix->rows), OST_SUCCESS);
    OstStatus status = ost_solver_create(context, problem->matrix, &problem->geometry, options, &solver);
    if (status == OST_SUCCESS)
        status = ost_solver_solve(solver, problem->force, u, report);
    if (status != OST_SUCCESS)
        fail_msg("%s: %s", ost_method_name(options->method), ost_error_text(context));
    ost_solver_destroy(&solver);
    assert_null(solver);
    return u;
}

static double norm_over_ranks(size_t n, const double *x)
{
    double square = 0.0;
    for (size_t i = 0; i < n; i++)
        square += x[i] * x[i];
    MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return sqrt(square);
}

static double true_residual(const ElasticProblem *problem, const double *u)
{
    const OstBlockMatrix *matrix = problem->matrix;
    const size_t n = 3 * (size_t)matrix->rows;
    double *x = NULL;
    double *r = NULL;
    assert_success(OST_NEW(ctx, &x, 3 * (size_t)matrix->columns));
    assert_success(OST_NEW(ctx, &r, n));
    memcpy(x, u, n * sizeof *u);
    assert_success(ost_block_matrix_apply(matrix, x, r));
    for (size_t i = 0; i < n; i++)
        r[i] -= problem->force[i];
    const double residual = norm_over_ranks(n, r) / norm_over_ranks(n, problem->force);
    OST_FREE(x, r);
    return residual;
}

static void every_method_reaches_the_requested_true_residual(void **state)
{
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &column, &problem));
    for (int k = 0; k < METHODS; k++) {
        const OstSolverOptions options = options_for(methods[k], 1e-10);
        OstSolveReport report;
        double *u = solve(ctx, &problem, &options, &report);
        const double residual = true_residual(&problem, u);
        assert_true(residual <= 1e-10);
        assert_close(report.relative_residual, residual, 1e-3 * residual + 1e-15);
        OST_FREE(u);
    }
    elastic_destroy(&problem);
}

/* Cholesky of the whole matrix, which one rank holds. */
static void solve_dense(OstContext *alone, const ElasticProblem *problem, double *u)
{
    const OstBlockMatrix *matrix = problem->matrix;
    const size_t n = 3 * (size_t)matrix->rows;
    double *a = NULL;
    assert_int_equal(OST_NEW(alone, &a, n * n), OST_SUCCESS);
    for (OstLocal i = 0; i < matrix->rows; i++)
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++)
            for (size_t c = 0; c < 9; c++)
                a[(3 * (size_t)i + c / 3) * n + 3 * (size_t)matrix->column[k] + c % 3] =
                    matrix->value[9 * (size_t)k + c];
    for (size_t j = 0; j < n; j++)
        for (size_t i = j; i < n; i++) {
            for (size_t k = 0; k < j; k++)
                a[i * n + j] -= a[i * n + k] * a[j * n + k];
            a[i * n + j] = i == j ? sqrt(a[j * n + j]) : a[i * n + j] / a[j * n + j];
        }
    for (size_t i = 0; i < n; i++) {
        u[i] = problem->force[i];
        for (size_t k = 0; k < i; k++)
            u[i] -= a[i * n + k] * u[k];
        u[i] /= a[i * n + i];
    }
    for (size_t i = n; i-- > 0;) {
        for (size_t k = i + 1; k < n; k++)
            u[i] -= a[k * n + i] * u[k];
        u[i] /= a[i * n + i];
    }
    OST_FREE(a);
}

/* Also with more ranks than layers of nodes, so that a rank has no rows. */
static void every_method_agrees_with_dense_cholesky_on_any_number_of_ranks(void **state)
{
    OstContext *alone = NULL;
    ElasticProblem shared;
    ElasticProblem whole;
    assert_int_equal(ost_context_create(MPI_COMM_SELF, &alone), OST_SUCCESS);
    assert_success(elastic_create(ctx, &slab, &shared));
    assert_int_equal(elastic_create(alone, &slab, &whole), OST_SUCCESS);
    double *expected = NULL;
    assert_int_equal(OST_NEW(alone, &expected, 3 * (size_t)whole.matrix->rows), OST_SUCCESS);
    solve_dense(alone, &whole, expected);
    double largest = 0.0;
    for (OstLocal i = 0; i < 3 * whole.matrix->rows; i++)
        largest = fmax(largest, fabs(expected[i]));
    for (int k = 0; k < METHODS; k++) {
        OstSolverOptions options = options_for(methods[k], 1e-12);
        options.coarsest_unknowns = 30;
        OstSolveReport report;
        double *u = solve(ctx, &shared, &options, &report);
        for (OstLocal i = 0; i < 3 * shared.matrix->rows; i++)
            assert_close(u[i], expected[3 * shared.matrix->first_row + i], 1e-9 * largest);
        OST_FREE(u);
        /* a communicator that is not everybody's */
        u = solve(alone, &whole, &options, &report);
        for (OstLocal i = 0; i < 3 * whole.matrix->rows; i++)
            assert_close(u[i], expected[i], 1e-9 * largest);
        OST_FREE(u);
    }
    OST_FREE(expected);
    elastic_destroy(&shared);
    elastic_destroy(&whole);
    ost_context_destroy(&alone);
}

static void six_modes_take_fewer_iterations_than_three_translations(void **state)
{
    ElasticProblem problem;
    OstSolveReport report[2];
    const OstSolverOptions options = options_for(OST_METHOD_PLAIN, 1e-10);
    assert_success(elastic_create(ctx, &column, &problem));
    for (int k = 0; k < 2; k++) {
        double *u = solve(ctx, &problem, &options, &report[k]);
        problem.geometry.modes = NULL;
        OST_FREE(u);
    }
    assert_true(report[0].iterations < report[1].iterations);
    assert_true(report[0].level_unknowns[1] > report[1].level_unknowns[1]);
    elastic_destroy(&problem);
}

static void the_report_tells_what_was_done(void **state)
{
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &column, &problem));
    const OstGlobal unknowns = 3 * problem.matrix->global_rows;
    const double hierarchy = ost_ledger_entry(ctx, OST_LEDGER_HIERARCHY).seconds;
    for (int k = 0; k < METHODS; k++) {
        const OstSolverOptions options = options_for(methods[k], 1e-8);
        OstSolveReport report;
        double *u = solve(ctx, &problem, &options, &report);
        const OstMethod used = methods[k] == OST_METHOD_AUTO ? OST_METHOD_DIRECT : methods[k];
        assert_int_equal(report.method, used);
        assert_int_equal(report.steps, 1);
        assert_int_equal(report.step[0].method, used);
        assert_int_equal(report.step[0].iterations, report.iterations);
        assert_true(report.step[0].factor > 0.0 && report.step[0].factor < 0.9);
        assert_string_equal(report.step[0].outcome, "reached the requested residual");
        assert_true(used != OST_METHOD_TWO_LEVEL || report.levels == 2);
        assert_true(report.iterations >= 1 && report.iterations <= (used == OST_METHOD_DIRECT ? 2 : 60));
        assert_int_equal(report.level_unknowns[0], unknowns);
        assert_true(used == OST_METHOD_DIRECT ? report.levels == 1 : report.levels >= 2);
        for (int level = 1; level < report.levels; level++)
            assert_true(report.level_unknowns[level] > 0 &&
                        report.level_unknowns[level] < report.level_unknowns[level - 1]);
        assert_true(report.operator_complexity >= 1.0 && report.operator_complexity < 3.0);
        assert_true(report.condition_estimate >= 1.0);
        assert_true(report.setup_seconds > 0.0 && report.solve_seconds > 0.0);
        OST_FREE(u);
    }
    assert_true(ost_ledger_entry(ctx, OST_LEDGER_HIERARCHY).seconds > hierarchy);
    assert_true(ost_ledger_entry(ctx, OST_LEDGER_SOLVE).seconds > 0.0);
    elastic_destroy(&problem);
}

static void a_coarsest_level_of_thousands_is_solved_directly(void **state)
{
    ElasticBlock large = column;
    ElasticProblem problem;
    large.bricks[2] = 40;
    assert_success(elastic_create(ctx, &large, &problem));
    OstSolverOptions options = options_for(OST_METHOD_PLAIN, 1e-8);
    options.coarsest_unknowns = 100000; /* one level, beyond what KLU is used for */
    OstSolveReport report;
    double *u = solve(ctx, &problem, &options, &report);
    assert_int_equal(report.levels, 1);
    assert_int_equal(report.iterations, 1);
    OST_FREE(u);
    elastic_destroy(&problem);
}

/* One row of three unknowns, on the last rank. */
static ElasticProblem single_row(void)
{
    ElasticBlock point = slab;
    ElasticProblem problem;
    const double block[9] = {4.0, 1.0, 0.0, 1.0, 3.0, -1.0, 0.0, -1.0, 2.0};
    point.bricks[0] = point.bricks[1] = 0;
    point.bricks[2] = 1;
    assert_success(elastic_create(ctx, &point, &problem));
    assert_int_equal(problem.matrix->global_rows, 1);
    for (OstLocal i = 0; i < problem.matrix->rows; i++)
        memcpy(problem.matrix->value, block, sizeof block);
    return problem;
}

static void one_row_is_enough(void **state)
{
    ElasticProblem problem = single_row();
    for (int k = 0; k < METHODS; k++) {
        const OstSolverOptions options = options_for(methods[k], 1e-12);
        OstSolveReport report;
        double *u = solve(ctx, &problem, &options, &report);
        for (OstLocal i = 0; i < problem.matrix->rows; i++) {
            double inverse[9] = {0.0};
            double expected[3];
            assert_true(ost_invert3(problem.matrix->value, inverse) != 0.0);
            ost_apply3(inverse, problem.force, expected);
            for (int c = 0; c < 3; c++)
                assert_close(u[c], expected[c], 1e-11);
        }
        OST_FREE(u);
    }
    elastic_destroy(&problem);
}

static void nothing_to_solve_is_solved(void **state)
{
    ElasticBlock nothing = slab;
    ElasticProblem problem;
    nothing.bricks[2] = 0;
    assert_success(elastic_create(ctx, &nothing, &problem));
    assert_int_equal(problem.matrix->global_rows, 0);
    for (int k = 0; k < METHODS; k++) {
        const OstSolverOptions options = options_for(methods[k], 1e-8);
        OstSolveReport report;
        double *u = solve(ctx, &problem, &options, &report);
        assert_int_equal(report.iterations, 0);
        assert_close(report.relative_residual, 0.0, 0.0);
        OST_FREE(u);
    }
    elastic_destroy(&problem);
}

static void no_force_gives_no_displacement(void **state)
{
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &column, &problem));
    memset(problem.force, 0, 3 * (size_t)problem.matrix->rows * sizeof *problem.force);
    for (int k = 0; k < METHODS; k++) {
        const OstSolverOptions options = options_for(methods[k], 1e-8);
        OstSolveReport report;
        double *u = solve(ctx, &problem, &options, &report);
        assert_int_equal(report.iterations, 0);
        for (OstLocal i = 0; i < 3 * problem.matrix->rows; i++)
            assert_close(u[i], 0.0, 0.0);
        OST_FREE(u);
    }
    elastic_destroy(&problem);
}

static void one_solver_solves_for_many_forces(void **state)
{
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &column, &problem));
    const size_t n = 3 * (size_t)problem.matrix->rows;
    double *u = NULL;
    assert_success(OST_NEW(ctx, &u, n));
    for (int k = 0; k < METHODS; k++) {
        const OstSolverOptions options = options_for(methods[k], 1e-9);
        OstSolver *solver = NULL;
        OstSolveReport report;
        assert_success(ost_solver_create(ctx, problem.matrix, &problem.geometry, &options, &solver));
        for (int load = 0; load < 3; load++) {
            for (size_t i = 0; i < n; i++)
                problem.force[i] = cos((double)(load + 1) * (double)i);
            assert_success(ost_solver_solve(solver, problem.force, u, &report));
            assert_true(true_residual(&problem, u) <= 1e-9);
        }
        ost_solver_destroy(&solver);
    }
    OST_FREE(u);
    elastic_destroy(&problem);
}

/* Raises status OST_NOT_CONVERGED, be it in create or in solve, with one reason or the other, or as singular. */
static void assert_not_converged(const ElasticProblem *problem, OstMethod method, const char *words, const char *others)
{
    const OstSolverOptions options = options_for(method, 1e-8);
    OstSolver *solver = NULL;
    OstSolveReport report;
    double *u = NULL;
    assert_success(OST_NEW(ctx, &u, 3 * (size_t)problem->matrix->rows));
    OstStatus status = ost_solver_create(ctx, problem->matrix, &problem->geometry, &options, &solver);
    if (status == OST_SUCCESS) {
        status = ost_solver_solve(solver, problem->force, u, &report);
        assert_int_equal(report.steps, 1);
        assert_true(strstr(report.step[0].outcome, words) || strstr(report.step[0].outcome, others));
    }
    const char *text = ost_error_text(ctx);
    assert_failure(status, OST_NOT_CONVERGED,
                   strstr(text, words)    ? words
                   : strstr(text, others) ? others
                                          : "the stiffness is singular to rounding");
    ost_solver_destroy(&solver);
    OST_FREE(u);
}

static void a_body_afloat_is_refused(void **state)
{
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &afloat, &problem));
    /* Rounding decides which sign its softest modes have. */
    assert_not_converged(&problem, OST_METHOD_DIRECT, "leaves the displacement less than one digit",
                         "rounding in double precision allows");
    assert_not_converged(&problem, OST_METHOD_PLAIN, "not positive definite", "rounding in double precision allows");
    elastic_destroy(&problem);
}

static void an_indefinite_matrix_is_refused(void **state)
{
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &column, &problem));
    OstBlockMatrix *matrix = problem.matrix;
    for (OstLocal i = 0; i < matrix->rows; i++) /* positive definite diagonal blocks, but far too much beside them */
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++)
            for (size_t c = 0; c < 9 && k != matrix->diagonal[i]; c++)
                matrix->value[9 * (size_t)k + c] *= 3.0;
    assert_not_converged(&problem, OST_METHOD_PLAIN, "not positive definite", "not positive definite");
    assert_not_converged(&problem, OST_METHOD_DIRECT, "not positive definite", "not positive definite");
    elastic_destroy(&problem);
}

static void a_row_without_stiffness_is_refused_by_its_number(void **state)
{
    ElasticProblem problem = single_row();
    for (OstLocal i = 0; i < problem.matrix->rows; i++)
        problem.matrix->value[8] = 0.0;
    for (int k = 0; k < METHODS; k++) {
        const OstSolverOptions options = options_for(methods[k], 1e-8);
        OstSolver *solver = NULL;
        assert_failure(ost_solver_create(ctx, problem.matrix, &problem.geometry, &options, &solver), OST_INVALID_INPUT,
                       "row 0 ");
        assert_null(solver);
    }
    elastic_destroy(&problem);
}

static void options_out_of_range_are_refused_by_name(void **state)
{
    ElasticProblem problem;
    OstSolver *solver = NULL;
    assert_success(elastic_create(ctx, &slab, &problem));
    OstSolverOptions options = ost_solver_default_options();
    options.relative_residual = NAN;
    assert_failure(ost_solver_create(ctx, problem.matrix, &problem.geometry, &options, &solver), OST_INVALID_INPUT,
                   "relative_residual");
    options = ost_solver_default_options();
    options.max_iterations = 0;
    assert_failure(ost_solver_create(ctx, problem.matrix, &problem.geometry, &options, &solver), OST_INVALID_INPUT,
                   "max_iterations");
    options = ost_solver_default_options();
    options.smoother_ratio = 1.0;
    assert_failure(ost_solver_create(ctx, problem.matrix, &problem.geometry, &options, &solver), OST_INVALID_INPUT,
                   "smoother_ratio");
    assert_null(solver);
    elastic_destroy(&problem);
}

/* New values on the same pattern: with the hierarchy kept as with a new one, the solution is that of the new matrix. */
static void new_values_are_solved_with(void **state)
{
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++)
        for (OstSolverUpdate how = OST_UPDATE_REBUILD; how <= OST_UPDATE_KEEP; how++) {
            ElasticProblem problem;
            assert_success(elastic_create(ctx, &column, &problem));
            const OstSolverOptions options = options_for(methods[k], 1e-9);
            const size_t n = 3 * (size_t)problem.matrix->rows;
            OstSolver *solver = NULL;
            OstSolveReport report;
            double *u = NULL, *first = NULL;
            assert_success(OST_NEW(ctx, &u, n));
            assert_success(OST_NEW(ctx, &first, n));
            assert_success(ost_solver_create(ctx, problem.matrix, &problem.geometry, &options, &solver));
            assert_success(ost_solver_solve(solver, problem.force, first, &report));
            for (OstLocal i = 0; i < 9 * problem.matrix->row_start[problem.matrix->rows]; i++)
                problem.matrix->value[i] *= 3.0;
            assert_success(ost_solver_update(solver, how));
            assert_success(ost_solver_solve(solver, problem.force, u, &report));
            assert_true(true_residual(&problem, u) <= 1e-9);
            for (size_t i = 0; i < n; i++)
                assert_close(3.0 * u[i], first[i], 1e-6 * (1.0 + fabs(first[i])));
            ost_solver_destroy(&solver);
            OST_FREE(u, first);
            elastic_destroy(&problem);
        }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_method_reaches_the_requested_true_residual),
    cmocka_unit_test(every_method_agrees_with_dense_cholesky_on_any_number_of_ranks),
    cmocka_unit_test(six_modes_take_fewer_iterations_than_three_translations),
    cmocka_unit_test(the_report_tells_what_was_done),
    cmocka_unit_test(a_coarsest_level_of_thousands_is_solved_directly),
    cmocka_unit_test(one_row_is_enough),
    cmocka_unit_test(nothing_to_solve_is_solved),
    cmocka_unit_test(no_force_gives_no_displacement),
    cmocka_unit_test(one_solver_solves_for_many_forces),
    cmocka_unit_test(new_values_are_solved_with),
    cmocka_unit_test(a_body_afloat_is_refused),
    cmocka_unit_test(an_indefinite_matrix_is_refused),
    cmocka_unit_test(a_row_without_stiffness_is_refused_by_its_number),
    cmocka_unit_test(options_out_of_range_are_refused_by_name),
};

OST_TEST_MAIN(tests)
