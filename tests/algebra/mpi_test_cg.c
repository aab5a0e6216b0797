/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "elastic_block.h"

#include "algebra/direct/mumps.h"
#include "algebra/krylov/cg.h"

static const ElasticBlock cube = {
    .bricks = {3, 3, 6}, .size = {1.0, 1.0, 1.0}, .modulus = 1e3, .poisson = 0.3, .held = 1};

/* Both implementations of conjugate gradients, AztecOO's and ours for factors, are held to the same promises. */
typedef enum { AZTEC, OWN, IMPLEMENTATIONS } Implementation;

typedef struct Weighted {
    size_t n;
    double weight[2]; /* of even and odd unknowns */
    int calls;
    int turn; /* change sign at this call */
} Weighted;

static OstStatus apply_weights(void *data, const double *r, double *z)
{
    Weighted *weighted = data;
    const double sign = ++weighted->calls == weighted->turn ? -1.0 : 1.0;
    for (size_t i = 0; i < weighted->n; i++)
        z[i] = sign * weighted->weight[i % 2] * r[i];
    return OST_SUCCESS;
}

static OstStatus solve_with(Implementation implementation, const OstCgSystem *system,
                            const OstPreconditioner *preconditioner, const double *f, double *u,
                            const OstSolverOptions *options, OstSolveReport *report)
{
    OstGoal goal;
    memset(report, 0, sizeof *report);
    OST_TRY(ost_goal_set(system->matrix, f, options, &goal));
    memset(u, 0, 3 * (size_t)system->matrix->rows * sizeof *u);
    const OstPreconditioner marked = {
        .data = preconditioner->data, .apply = preconditioner->apply, .factors = implementation == OWN};
    OstStatus status = ost_cg_solve(system, &marked, f, u, &goal, report);
    if (status == OST_SUCCESS)
        status = ost_goal_verdict(&goal);
    report->iterations = goal.iterations;
    report->relative_residual = goal.start > 0.0 ? goal.norm / goal.start : 0.0;
    return status;
}

static OstStatus solve(Implementation implementation, const OstBlockMatrix *matrix, Weighted *weighted, const double *f,
                       double *u, const OstSolverOptions *options, OstSolveReport *report)
{
    const OstPreconditioner preconditioner = {.data = weighted, .apply = apply_weights};
    const OstCgSystem system = {.matrix = matrix};
    return solve_with(implementation, &system, &preconditioner, f, u, options, report);
}

static Weighted identity(const OstBlockMatrix *matrix)
{
    return (Weighted){.n = 3 * (size_t)matrix->rows, .weight = {1.0, 1.0}};
}

/* A diagonal matrix with value(g) at the unknown of global number g, 4 block rows a rank. */
static ElasticProblem diagonal_problem(double (*value)(OstGlobal))
{
    const ElasticBlock bar = {.bricks = {1, 1, 1}, .size = {1.0, 1.0, 1.0}, .modulus = 1.0, .poisson = 0.0};
    ElasticBlock block = bar;
    block.bricks[2] = ost_size(ctx) - 1;
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &block, &problem));
    OstBlockMatrix *matrix = problem.matrix;
    memset(matrix->value, 0, 9 * (size_t)matrix->row_start[matrix->rows] * sizeof *matrix->value);
    for (OstLocal i = 0; i < matrix->rows; i++)
        for (int c = 0; c < 3; c++) {
            matrix->value[9 * (size_t)matrix->diagonal[i] + (size_t)(4 * c)] = value(3 * (matrix->first_row + i) + c);
            problem.force[3 * i + c] = 1.0;
        }
    return problem;
}

static double rising(OstGlobal g)
{
    return 1.0 + 0.5 * (double)g;
}

static double one_negative(OstGlobal g)
{
    return g == 7 ? -3.0 : 1.0 + 0.5 * (double)g;
}

static void a_known_spectrum_is_solved_and_measured(void **state)
{
    ElasticProblem problem = diagonal_problem(rising);
    OstSolverOptions options = ost_solver_default_options();
    options.relative_residual = 1e-12;
    for (Implementation i = AZTEC; i < IMPLEMENTATIONS; i++) {
        double u[12];
        OstSolveReport report;
        Weighted weighted = identity(problem.matrix);
        assert_success(solve(i, problem.matrix, &weighted, problem.force, u, &options, &report));
        for (int k = 0; k < 12; k++)
            assert_close(u[k], 1.0 / rising(3 * problem.matrix->first_row + k), 1e-11);
        assert_true(report.relative_residual <= 1e-12);
        assert_true(report.iterations > 1 && report.iterations <= 12 * ost_size(ctx));
        const double condition = rising(12 * ost_size(ctx) - 1) / rising(0);
        assert_close(report.condition_estimate, condition, 1e-4 * condition);
    }
    elastic_destroy(&problem);
}

static void scaling_gives_the_solution_of_the_unscaled_system(void **state)
{
    ElasticProblem problem;
    OstScaling *scaling = NULL;
    assert_success(elastic_create(ctx, &cube, &problem));
    assert_success(ost_scaling_create(problem.matrix, &scaling));
    const size_t n = 3 * (size_t)problem.matrix->rows;
    double *u[2] = {NULL, NULL};
    assert_success(OST_NEW(ctx, &u[0], n));
    assert_success(OST_NEW(ctx, &u[1], n));
    OstSolverOptions options = ost_solver_default_options();
    options.relative_residual = 1e-12;
    OstSolveReport report[2] = {{0}};
    Weighted weighted = identity(problem.matrix);
    const OstPreconditioner preconditioner = {.data = &weighted, .apply = apply_weights};
    const OstCgSystem system = {.matrix = problem.matrix, .scaling = scaling};
    assert_success(solve_with(AZTEC, &system, &preconditioner, problem.force, u[0], &options, &report[0]));
    assert_success(solve(AZTEC, problem.matrix, &weighted, problem.force, u[1], &options, &report[1]));
    for (size_t i = 0; i < n; i++)
        assert_close(u[0][i], u[1][i], 1e-9);
    assert_true(report[0].iterations < report[1].iterations);
    OST_FREE(u[0], u[1]);
    ost_scaling_destroy(&scaling);
    elastic_destroy(&problem);
}

static OstStatus apply_factors(void *data, const double *r, double *z)
{
    return ost_mumps_solve(data, r, z);
}

/* A stiff brick on a soft one, held below: rounding hides the energy of the stiff one's rigid motion. With a drift that
 * refinement is said to have left. */
static OstSolveReport solve_pile(double drift)
{
    const ElasticBlock pile = {
        .bricks = {1, 1, 2}, .size = {1.0, 1.0, 1.0}, .modulus = 1.0, .poisson = 0.3, .contrast = 1e14, .held = 1};
    ElasticProblem problem;
    OstScaling *scaling = NULL;
    OstMumps *factors = NULL;
    assert_success(elastic_create(ctx, &pile, &problem));
    assert_success(ost_scaling_create(problem.matrix, &scaling));
    assert_success(ost_mumps_create_of_rows(problem.matrix, scaling, 0.0, NULL, &factors));
    double u[24] = {0.0};
    OstSolverOptions options = ost_solver_default_options();
    options.accept_attainable = 1;
    const OstCgSystem system = {.matrix = problem.matrix, .scaling = scaling};
    const OstPreconditioner preconditioner = {.data = factors, .apply = apply_factors, .factors = 1};
    OstGoal goal;
    OstSolveReport report = {0};
    assert_success(ost_goal_set(problem.matrix, problem.force, &options, &goal));
    goal.drift = drift;
    assert_success(ost_cg_solve(&system, &preconditioner, problem.force, u, &goal, &report));
    assert_success(ost_goal_verdict(&goal));
    report.iterations = goal.iterations;
    ost_mumps_destroy(&factors);
    ost_scaling_destroy(&scaling);
    elastic_destroy(&problem);
    return report;
}

static void factors_go_on_where_rounding_hides_the_energy(void **state)
{
    const OstSolveReport report = solve_pile(0.0);
    assert_true(report.iterations >= 1 && report.iterations < 20);
    assert_close(report.condition_estimate, 1.0, 1e-12);
    assert_true(report.error_estimate > 1e-6); /* some 1e14 times 1e-16 */
    assert_true(report.rounding_error > 0.05 && report.rounding_error < 0.5);
    assert_true(report.rounding_spread >= 1.0 / sqrt(2.0 * 64.0) && report.rounding_spread <= 0.25);
}

/* A drift is measured, not sampled: where it is the larger error, the spread is 0. */
static void a_drift_beyond_rounding_is_the_error_and_has_no_spread(void **state)
{
    const OstSolveReport large = solve_pile(0.75), small = solve_pile(0.01);
    assert_close(large.error_estimate, 0.75, 1e-15);
    assert_close(large.rounding_error, 0.75, 1e-15);
    assert_true(large.rounding_spread == 0.0);
    assert_true(small.rounding_error > 0.05 && small.rounding_error < 0.5);
    assert_true(small.error_estimate >= small.rounding_error);
    assert_true(small.rounding_spread >= 1.0 / sqrt(2.0 * 64.0));
}

/* Stiff and soft unknowns in turn, the soft ones loaded so little that the residual does not see them. */
static double stiff_and_soft(OstGlobal g)
{
    return g % 2 == 0 ? 1e10 : 1.0 + 0.5 * (double)g;
}

/* Two iterations reach the residual; the displacement, all of it soft, is solved for beyond that. */
static void a_displacement_that_the_residual_does_not_see_is_solved_for(void **state)
{
    ElasticProblem problem = diagonal_problem(stiff_and_soft);
    const OstBlockMatrix *matrix = problem.matrix;
    const OstLocal n = 3 * matrix->rows;
    const OstGlobal first = 3 * matrix->first_row;
    Weighted weighted = {.n = (size_t)n, .weight = {first % 2 ? 1.0 : 1e-10, first % 2 ? 1e-10 : 1.0}};
    const OstSolverOptions options = ost_solver_default_options();
    OstSolveReport report;
    double u[12], sums[2] = {0.0};
    for (OstLocal i = 0; i < n; i++)
        problem.force[i] = (first + i) % 2 ? 1e-10 : 1.0;
    assert_success(solve(AZTEC, matrix, &weighted, problem.force, u, &options, &report));
    for (OstLocal i = 0; i < n; i++) {
        const double right = problem.force[i] / stiff_and_soft(first + i);
        sums[0] += (u[i] - right) * (u[i] - right);
        sums[1] += right * right;
    }
    assert_int_equal(MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, ost_comm(ctx)), MPI_SUCCESS);
    const double error = sqrt(sums[0] / sums[1]);
    assert_true(report.relative_residual <= options.relative_residual);
    assert_true(error <= 1e-6 && error <= 3.0 * report.error_estimate);
    assert_true(report.condition_estimate > 4.0); /* 1.5 to 6.5 and more: that of the soft ones too */
    elastic_destroy(&problem);
}

static void an_indefinite_matrix_is_refused_by_its_sign(void **state)
{
    ElasticProblem problem = diagonal_problem(one_negative);
    const OstSolverOptions options = ost_solver_default_options();
    for (Implementation i = AZTEC; i < IMPLEMENTATIONS; i++) {
        double u[12];
        OstSolveReport report;
        Weighted weighted = identity(problem.matrix);
        assert_failure(solve(i, problem.matrix, &weighted, problem.force, u, &options, &report), OST_NOT_CONVERGED,
                       "p·Ap");
        assert_non_null(strstr(ost_error_text(ctx), "stiffness is not positive definite"));
        assert_true(report.relative_residual > options.relative_residual);
    }
    elastic_destroy(&problem);
}

static void an_indefinite_preconditioner_is_refused_in_any_iteration(void **state)
{
    ElasticProblem problem = diagonal_problem(rising);
    const OstSolverOptions options = ost_solver_default_options();
    for (Implementation i = AZTEC; i < IMPLEMENTATIONS; i++)
        for (int turn = 1; turn <= 3; turn++) {
            double u[12];
            OstSolveReport report;
            Weighted weighted = identity(problem.matrix);
            weighted.turn = turn;
            assert_failure(solve(i, problem.matrix, &weighted, problem.force, u, &options, &report), OST_NOT_CONVERGED,
                           "is negative: the preconditioner is not positive definite");
        }
    elastic_destroy(&problem);
}

static void numbers_that_are_not_finite_are_refused(void **state)
{
    ElasticProblem problem = diagonal_problem(rising);
    const OstSolverOptions options = ost_solver_default_options();
    for (Implementation i = AZTEC; i < IMPLEMENTATIONS; i++) {
        double u[12];
        OstSolveReport report;
        Weighted weighted = identity(problem.matrix);
        weighted.weight[1] = NAN;
        assert_failure(solve(i, problem.matrix, &weighted, problem.force, u, &options, &report), OST_NOT_CONVERGED,
                       "is not finite");
        weighted = identity(problem.matrix);
        double f[12];
        memcpy(f, problem.force, sizeof f);
        if (ost_rank(ctx) == ost_size(ctx) - 1)
            f[5] = INFINITY;
        assert_failure(solve(i, problem.matrix, &weighted, f, u, &options, &report), OST_INVALID_INPUT, "not finite");
    }
    elastic_destroy(&problem);
}

static void no_force_gives_no_displacement_in_no_iterations(void **state)
{
    ElasticProblem problem = diagonal_problem(rising);
    const OstSolverOptions options = ost_solver_default_options();
    for (Implementation i = AZTEC; i < IMPLEMENTATIONS; i++) {
        double u[12];
        const double f[12] = {0.0};
        OstSolveReport report;
        Weighted weighted = identity(problem.matrix);
        for (int k = 0; k < 12; k++)
            u[k] = 7.0;
        assert_success(solve(i, problem.matrix, &weighted, f, u, &options, &report));
        assert_int_equal(report.iterations, 0);
        assert_int_equal(weighted.calls, 0);
        for (int k = 0; k < 12; k++)
            assert_close(u[k], 0.0, 0.0);
    }
    elastic_destroy(&problem);
}

static void too_few_iterations_are_reported_with_the_residual(void **state)
{
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &cube, &problem));
    double *u = NULL;
    assert_success(OST_NEW(ctx, &u, 3 * (size_t)problem.matrix->rows));
    OstSolverOptions options = ost_solver_default_options();
    options.max_iterations = 4;
    for (Implementation i = AZTEC; i < IMPLEMENTATIONS; i++) {
        OstSolveReport report;
        Weighted weighted = identity(problem.matrix);
        assert_failure(solve(i, problem.matrix, &weighted, problem.force, u, &options, &report), OST_NOT_CONVERGED,
                       "after 4 iterations, the most allowed");
        char number[32];
        snprintf(number, sizeof number, "is %.3g,", report.relative_residual);
        assert_non_null(strstr(ost_error_text(ctx), number));
        assert_int_equal(report.iterations, 4);
        assert_true(report.relative_residual > 1e-8);
    }
    OST_FREE(u);
    elastic_destroy(&problem);
}

static void more_than_double_precision_holds_is_refused_with_what_it_holds(void **state)
{
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &cube, &problem));
    double *u = NULL;
    assert_success(OST_NEW(ctx, &u, 3 * (size_t)problem.matrix->rows));
    OstSolverOptions options = ost_solver_default_options();
    options.relative_residual = 1e-18;
    for (Implementation i = AZTEC; i < IMPLEMENTATIONS; i++) {
        OstSolveReport report;
        Weighted weighted = identity(problem.matrix);
        assert_failure(solve(i, problem.matrix, &weighted, problem.force, u, &options, &report), OST_NOT_CONVERGED,
                       "double precision allows about");
        assert_true(report.relative_residual > 1e-18 && report.relative_residual < 1e-12);
    }
    OST_FREE(u);
    elastic_destroy(&problem);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_known_spectrum_is_solved_and_measured),
    cmocka_unit_test(scaling_gives_the_solution_of_the_unscaled_system),
    cmocka_unit_test(factors_go_on_where_rounding_hides_the_energy),
    cmocka_unit_test(a_drift_beyond_rounding_is_the_error_and_has_no_spread),
    cmocka_unit_test(a_displacement_that_the_residual_does_not_see_is_solved_for),
    cmocka_unit_test(an_indefinite_matrix_is_refused_by_its_sign),
    cmocka_unit_test(an_indefinite_preconditioner_is_refused_in_any_iteration),
    cmocka_unit_test(numbers_that_are_not_finite_are_refused),
    cmocka_unit_test(no_force_gives_no_displacement_in_no_iterations),
    cmocka_unit_test(too_few_iterations_are_reported_with_the_residual),
    cmocka_unit_test(more_than_double_precision_holds_is_refused_with_what_it_holds),
};

OST_TEST_MAIN(tests)
