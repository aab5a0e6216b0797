/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/rigid_modes.h"
#include "algebra/multigrid/metric.h"
#include "algebra/solver.h"
#include "algebra/solver_options.h"
#include "elastic_block.h"
#include "support.h"

/* Solves a block on the ranks of `context`; u has room for 3 × rows numbers. */
static OstStatus solve(OstContext *context, const ElasticProblem *problem, double tolerance, double *u,
                       OstSolveReport *report)
{
    OstSolverOptions options = ost_solver_default_options();
    options.relative_residual = tolerance;
    options.coarsest_unknowns = 200;
    options.method = OST_METHOD_METRIC;
    OstSolver *solver = NULL;
    memset(report, 0, sizeof *report);
    OstStatus status = ost_solver_create(context, problem->matrix, &problem->geometry, &options, &solver);
    if (status == OST_SUCCESS)
        status = ost_solver_solve(solver, problem->force, u, report);
    ost_solver_destroy(&solver);
    return status;
}

static double *new_solution(const ElasticProblem *problem)
{
    double *u = NULL;
    assert_success(OST_NEW(ctx, &u, 3 * (size_t)problem->matrix->columns));
    return u;
}

static void an_isotropic_block_takes_few_iterations_at_any_size(void **state)
{
    for (int n = 10; n <= 20; n += 10) {
        const ElasticBlock block = {.bricks = {n, n, n}, .size = {1, 1, 1}, .modulus = 2e11, .poisson = 0.3, .held = 1};
        ElasticProblem problem;
        OstSolveReport report;
        assert_success(elastic_create(ctx, &block, &problem));
        double *u = new_solution(&problem);
        assert_success(solve(ctx, &problem, 1e-8, u, &report));
        assert_in_range(report.iterations, 2, 20);
        assert_true(report.relative_residual <= 1e-8);
        assert_in_range(report.levels, 2, OST_MAX_LEVELS);
        assert_int_equal(report.level_unknowns[0], 3 * problem.matrix->global_rows);
        for (int l = 1; l < report.levels; l++)
            assert_true(report.level_unknowns[l] > 0 && report.level_unknowns[l] < report.level_unknowns[l - 1] / 2);
        assert_true(report.operator_complexity > 1.0 && report.operator_complexity < 1.6);
        OST_FREE(u);
        elastic_destroy(&problem);
    }
}

static void answer_and_effort_do_not_depend_on_the_ranks(void **state)
{
    const ElasticBlock block = {
        .bricks = {12, 10, 14}, .size = {1, 1, 1.2}, .modulus = 1e6, .poisson = 0.3, .contrast = 50.0, .held = 1};
    OstContext *alone = NULL;
    ElasticProblem shared, whole;
    OstSolveReport report, report_alone;
    assert_int_equal(ost_context_create(MPI_COMM_SELF, &alone), OST_SUCCESS);
    assert_success(elastic_create(ctx, &block, &shared));
    assert_success(elastic_create(alone, &block, &whole));
    double *u = new_solution(&shared), *u_alone = new_solution(&whole);
    assert_success(solve(ctx, &shared, 1e-12, u, &report));
    assert_int_equal(solve(alone, &whole, 1e-12, u_alone, &report_alone), OST_SUCCESS);
    double largest = 0.0, difference = 0.0;
    for (OstLocal i = 0; i < 3 * whole.matrix->rows; i++)
        largest = fmax(largest, fabs(u_alone[i]));
    for (OstLocal i = 0; i < 3 * shared.matrix->rows; i++)
        difference = fmax(difference, fabs(u[i] - u_alone[3 * shared.matrix->first_row + i]));
    assert_true(largest > 0.0);
    assert_true(difference <= 1e-9 * largest);
    assert_true(report.iterations <= 1.3 * report_alone.iterations);
    OST_FREE(u, u_alone);
    elastic_destroy(&shared);
    elastic_destroy(&whole);
    ost_context_destroy(&alone);
}

static void a_rank_without_rows_does_no_harm(void **state)
{
    /* two free layers of nodes for up to four ranks */
    const ElasticBlock block = {.bricks = {20, 20, 2}, .size = {1, 1, 1}, .modulus = 1.0, .poisson = 0.3, .held = 1};
    ElasticProblem problem;
    OstSolveReport report;
    assert_success(elastic_create(ctx, &block, &problem));
    double *u = new_solution(&problem);
    assert_success(solve(ctx, &problem, 1e-10, u, &report));
    assert_in_range(report.levels, 2, OST_MAX_LEVELS);
    assert_in_range(report.iterations, 2, 30);
    OST_FREE(u);
    elastic_destroy(&problem);
}

static void a_matrix_below_the_coarsest_size_is_solved_directly(void **state)
{
    const ElasticBlock block = {.bricks = {2, 2, 2}, .size = {1, 1, 1}, .modulus = 1.0, .poisson = 0.3, .held = 1};
    ElasticProblem problem;
    OstSolveReport report;
    assert_success(elastic_create(ctx, &block, &problem));
    double *u = new_solution(&problem);
    assert_success(solve(ctx, &problem, 1e-12, u, &report));
    assert_int_equal(report.levels, 1);
    assert_in_range(report.iterations, 1, 2);
    assert_close(report.operator_complexity, 1.0, 0.0);
    OST_FREE(u);
    elastic_destroy(&problem);
}

static void a_matrix_of_one_row_is_solved(void **state)
{
    const int mine = ost_rank(ctx) == ost_size(ctx) - 1;
    OstLocal row_start[2] = {0, 1}, column[1] = {0}, diagonal[1] = {0};
    OstGlobal label[1] = {0};
    double value[9] = {4, 1, 0, 1, 3, 0, 0, 0, 2}, coordinates[3] = {1, 2, 3}, modes[18];
    const double about[3] = {0, 0, 0}, f[3] = {6, 7, 8}, expected[3] = {1, 2, 4};
    OstBlockMatrix matrix = {.ctx = ctx,
                             .rows = mine,
                             .columns = mine,
                             .global_rows = 1,
                             .label = label,
                             .row_start = row_start,
                             .column = column,
                             .diagonal = diagonal,
                             .value = value};
    ost_rigid_body_modes(mine, coordinates, about, modes);
    assert_success(ost_halo_create(ctx, mine, 0, 0, NULL, &matrix.halo));
    ElasticProblem problem = {
        .matrix = &matrix, .force = (double *)f, .geometry = {.coordinates = coordinates, .modes = modes}};
    OstSolveReport report;
    double u[3] = {0};
    assert_success(solve(ctx, &problem, 1e-14, u, &report));
    for (int c = 0; c < 3 && mine; c++)
        assert_close(u[c], expected[c], 1e-14);
    ost_halo_destroy(&matrix.halo);
}

/* `parts` springs of two nodes each on every rank, held at one end; and, if there is one, a long chain on rank 0. */
static OstBlockMatrix *springs(OstLocal parts, OstLocal chain, double *coordinates)
{
    OstBlockMatrix *matrix = NULL;
    const OstLocal rows = 2 * parts + (ost_rank(ctx) == 0 ? chain : 0);
    const OstGlobal mine = rows;
    assert_success(OST_NEW(ctx, &matrix, 1));
    assert_success(OST_NEW(ctx, &matrix->label, rows));
    assert_success(OST_NEW(ctx, &matrix->row_start, rows + 1));
    assert_success(OST_NEW(ctx, &matrix->column, 3 * rows));
    assert_success(OST_NEW(ctx, &matrix->diagonal, rows));
    assert_success(OST_NEW(ctx, &matrix->value, 27 * rows));
    OstLocal k = 0;
    for (OstLocal i = 0; i < rows; i++) {
        const int paired = i < 2 * parts;
        for (OstLocal j = i - 1; j <= i + 1; j++) {
            const int coupled = paired ? j / 2 == i / 2 : j >= 2 * parts;
            if (j < 0 || j >= rows || !coupled)
                continue;
            if (i == j)
                matrix->diagonal[i] = k;
            for (int c = 0; c < 3; c++)
                matrix->value[9 * k + 4 * c] = i == j ? 2.1 : -1.0;
            matrix->column[k++] = j;
        }
        matrix->row_start[i + 1] = k;
        coordinates[3 * i] = i;
    }
    matrix->ctx = ctx;
    matrix->rows = matrix->columns = rows;
    MPI_Scan(&mine, &matrix->first_row, 1, MPI_INT64_T, MPI_SUM, ost_comm(ctx));
    matrix->first_row -= rows;
    for (OstLocal i = 0; i < rows; i++)
        matrix->label[i] = matrix->first_row + i;
    MPI_Allreduce(&mine, &matrix->global_rows, 1, MPI_INT64_T, MPI_SUM, ost_comm(ctx));
    assert_success(ost_halo_create(ctx, rows, matrix->first_row, 0, NULL, &matrix->halo));
    return matrix;
}

static void parts_too_small_to_aggregate_are_solved_by_the_smoother(void **state)
{
    for (int chain = 0; chain <= 600; chain += 600) {
        double coordinates[3 * 3600] = {0}, force[3 * 3600], u[3 * 3600], modes[18 * 3600];
        const double about[3] = {0, 0, 0};
        OstBlockMatrix *matrix = springs(1500, chain, coordinates);
        OstSolveReport report;
        ost_rigid_body_modes(matrix->rows, coordinates, about, modes);
        for (OstLocal i = 0; i < 3 * matrix->rows; i++)
            force[i] = 1.0 + i % 7;
        const ElasticProblem problem = {
            .matrix = matrix, .force = force, .geometry = {.coordinates = coordinates, .modes = modes}};
        assert_success(solve(ctx, &problem, 1e-10, u, &report));
        assert_true(report.relative_residual <= 1e-10);
        assert_int_equal(report.levels == 1, chain == 0);
        assert_in_range(report.iterations, 1, 30);
        ost_block_matrix_destroy(&matrix);
    }
}

/* One cycle on the right-hand side, in scaled unknowns; `z` has room for 3 × rows. */
static void apply_cycle(const OstMetric *metric, const double *force, double *z)
{
    OstCgSystem system;
    OstPreconditioner cycle;
    ost_metric_system(metric, &system, &cycle);
    assert_success(cycle.apply(cycle.data, force, z));
}

/* An interval of the Chebyshev polynomials that ends too low makes the cycle indefinite. */
static void strong_is_as_careful_where_it_is_built_anew(void **state)
{
    const ElasticBlock block = {.bricks = {9, 8, 8}, .size = {1, 1, 1}, .modulus = 1.0, .poisson = 0.3, .held = 1};
    ElasticProblem problem;
    OstMetric *grown = NULL, *built = NULL;
    OstSolverOptions planned = ost_solver_default_options(), metric, strong;
    planned.coarsest_unknowns = 100;
    ost_solver_strategy_options(&planned, OST_METHOD_METRIC, &metric);
    ost_solver_strategy_options(&planned, OST_METHOD_STRONG, &strong);
    assert_success(elastic_create(ctx, &block, &problem));
    double *expected = new_solution(&problem), *z = new_solution(&problem);
    assert_success(ost_metric_create(problem.matrix, &problem.geometry, &metric, &grown));
    ost_metric_strengthen(grown, &strong);
    assert_success(ost_metric_create(problem.matrix, &problem.geometry, &strong, &built));
    apply_cycle(grown, problem.force, expected);
    apply_cycle(built, problem.force, z);
    for (OstLocal i = 0; i < 3 * problem.matrix->rows; i++)
        assert_true(fabs(z[i] - expected[i]) <= 1e-12 * fabs(expected[i]));
    OST_FREE(expected, z);
    ost_metric_destroy(&grown);
    ost_metric_destroy(&built);
    elastic_destroy(&problem);
}

static void levels_without_factors_are_coarsened_slowly(void **state)
{
    const ElasticBlock block = {.bricks = {16, 8, 8}, .size = {2, 1, 1}, .modulus = 1.0, .poisson = 0.3, .held = 1};
    ElasticProblem problem;
    OstSolverOptions planned = ost_solver_default_options(), strong;
    OstSolveReport report[2];
    planned.coarsest_unknowns = 100;
    assert_success(elastic_create(ctx, &block, &problem));
    for (planned.fine = 0; planned.fine < 2; planned.fine++) {
        OstMetric *metric = NULL;
        ost_solver_strategy_options(&planned, OST_METHOD_STRONG, &strong);
        assert_success(ost_metric_create(problem.matrix, &problem.geometry, &strong, &metric));
        ost_metric_report(metric, &report[planned.fine]);
        ost_metric_destroy(&metric);
    }
    const OstGlobal *many = report[1].level_unknowns, *few = report[0].level_unknowns;
    assert_true(2 * many[1] > 3 * few[1] && 6 * many[2] > many[1] && 6 * few[2] < few[1]);
    elastic_destroy(&problem);
}

static void a_bad_metric_is_refused_on_all_ranks(void **state)
{
    const ElasticBlock block = {.bricks = {3, 3, 8}, .size = {1, 1, 1}, .modulus = 1.0, .poisson = 0.3, .held = 1};
    ElasticProblem problem;
    OstSolveReport report;
    double *metric = NULL;
    assert_success(elastic_create(ctx, &block, &problem));
    assert_success(OST_NEW(ctx, &metric, 6 * (size_t)problem.matrix->rows));
    for (OstLocal i = 0; i < problem.matrix->rows; i++)
        for (int c = 0; c < 3; c++)
            metric[6 * i + c] = problem.matrix->first_row + i == 100 ? 0.0 : 1.0;
    problem.geometry.metric = metric;
    double *u = new_solution(&problem);
    assert_failure(solve(ctx, &problem, 1e-8, u, &report), OST_INVALID_INPUT, "metric at node 100");
    OST_FREE(u, metric);
    elastic_destroy(&problem);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(an_isotropic_block_takes_few_iterations_at_any_size),
    cmocka_unit_test(answer_and_effort_do_not_depend_on_the_ranks),
    cmocka_unit_test(a_rank_without_rows_does_no_harm),
    cmocka_unit_test(a_matrix_below_the_coarsest_size_is_solved_directly),
    cmocka_unit_test(a_matrix_of_one_row_is_solved),
    cmocka_unit_test(parts_too_small_to_aggregate_are_solved_by_the_smoother),
    cmocka_unit_test(strong_is_as_careful_where_it_is_built_anew),
    cmocka_unit_test(levels_without_factors_are_coarsened_slowly),
    cmocka_unit_test(a_bad_metric_is_refused_on_all_ranks),
};

OST_TEST_MAIN(tests)
