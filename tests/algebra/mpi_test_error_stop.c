/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "elastic_block.h"

static const ElasticBlock easy = {
    .bricks = {9, 9, 12}, .size = {1.0, 1.0, 1.0}, .modulus = 1e3, .poisson = 0.3, .held = 1};
static const ElasticBlock uneven = {
    .bricks = {9, 9, 12}, .size = {1.0, 1.0, 1.0}, .modulus = 1e3, .poisson = 0.3, .contrast = 1e6, .held = 1};
static const ElasticBlock nearly_incompressible = {
    .bricks = {9, 9, 12}, .size = {1.0, 1.0, 1.0}, .modulus = 1e3, .poisson = 0.499, .held = 1};
static const ElasticBlock slender = {
    .bricks = {2, 2, 120}, .size = {1.0, 1.0, 1.0}, .modulus = 1e3, .poisson = 0.3, .held = 1};

typedef struct Body {
    ElasticProblem problem;
    OstSolver *solver;
    size_t n;
    double *u, *solution;
} Body;

static Body create(const ElasticBlock *block)
{
    Body body = {.solver = NULL};
    OstSolverOptions options = ost_solver_default_options();
    options.method = OST_METHOD_METRIC;
    options.coarsest_unknowns = 300;
    options.relative_residual = 1e-11;
    options.accept_attainable = 1;
    assert_success(elastic_create(ctx, block, &body.problem));
    body.n = 3 * (size_t)body.problem.matrix->rows;
    assert_success(OST_NEW(ctx, &body.u, body.n));
    assert_success(OST_NEW(ctx, &body.solution, body.n));
    assert_success(ost_solver_create(ctx, body.problem.matrix, &body.problem.geometry, &options, &body.solver));
    OstSolveReport report;
    assert_success(ost_solver_solve(body.solver, body.problem.force, body.solution, &report));
    assert_false(report.stopped);
    assert_int_equal(report.iterations_saved, 0);
    return body;
}

static void destroy(Body *body)
{
    ost_solver_destroy(&body->solver);
    OST_FREE(body->u, body->solution);
    elastic_destroy(&body->problem);
}

/* |v|_A */
static double energy_norm(const Body *body, const double *v)
{
    const OstBlockMatrix *matrix = body->problem.matrix;
    double *x = NULL, *y = NULL, square = 0.0;
    assert_success(OST_NEW(ctx, &x, 3 * (size_t)matrix->columns));
    assert_success(OST_NEW(ctx, &y, body->n));
    for (size_t i = 0; i < body->n; i++)
        x[i] = v[i];
    assert_success(ost_block_matrix_apply(matrix, x, y));
    for (size_t i = 0; i < body->n; i++)
        square += x[i] * y[i];
    MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    OST_FREE(x, y);
    return sqrt(square);
}

static double true_error(const Body *body, const double *u)
{
    double *e = NULL;
    assert_success(OST_NEW(ctx, &e, body->n));
    for (size_t i = 0; i < body->n; i++)
        e[i] = u[i] - body->solution[i];
    const double error = energy_norm(body, e);
    OST_FREE(e);
    return error;
}

/* Looks at the error after every step or two, and stops at `enough`. */
typedef struct Watch {
    const Body *body;
    double low, high; /* the least and the largest of estimated over true error */
    double enough;
    int asked;
} Watch;

static OstStatus watch(void *data, const double *u, double error, double *next)
{
    Watch *seen = data;
    const double ratio = error / true_error(seen->body, u);
    seen->low = fmin(seen->low, ratio);
    seen->high = fmax(seen->high, ratio);
    seen->asked++;
    *next = fmax(0.9 * error, seen->enough);
    return OST_SUCCESS;
}

static void follow(const ElasticBlock *block)
{
    Body body = create(block);
    Watch seen = {.body = &body, .low = HUGE_VAL, .enough = 1e-6 * energy_norm(&body, body.solution)};
    const OstErrorStop stop = {.ask = watch, .data = &seen, .first = 0.9, .relative = 1};
    OstSolveReport report;
    ost_solver_aim(body.solver, (OstSolverAim){.stop = &stop});
    assert_success(ost_solver_solve(body.solver, body.problem.force, body.u, &report));
    assert_true(report.stopped);
    assert_true(seen.asked > 2);
    if (!(seen.low > 1.0 / 3.0 && seen.high < 7.0))
        fail_msg("estimated over true error from %g to %g", seen.low, seen.high);
    const double error = true_error(&body, body.u);
    assert_true(report.algebraic_error <= seen.enough && error <= 3.0 * seen.enough);
    assert_true(report.algebraic_bound > 0.9 * error);
    assert_true(report.iterations_saved > 0);
    destroy(&body);
}

static void the_error_is_known_while_cg_runs_within_a_third_and_seven_times(void **state)
{
    follow(&easy);
    follow(&uneven);
    follow(&nearly_incompressible);
    follow(&slender);
}

/* One share of |u| wanted, by a first target; another asked for then. */
static OstStatus ask_for_less(void *data, const double *u, double error, double *next)
{
    double *share = data;
    (void)u;
    *next = *share * error;
    *share = 1.0;
    return OST_SUCCESS;
}

static void a_stop_saves_what_it_says_and_the_solve_goes_on_from_there(void **state)
{
    Body body = create(&uneven);
    double share = 0.1;
    const OstErrorStop stop = {.ask = ask_for_less, .data = &share, .first = 0.1, .relative = 1};
    OstSolveReport whole, report, rest;
    assert_success(ost_solver_solve(body.solver, body.problem.force, body.u, &whole));
    ost_solver_aim(body.solver, (OstSolverAim){.stop = &stop});
    assert_success(ost_solver_solve(body.solver, body.problem.force, body.u, &report));
    assert_true(report.stopped && share == 1.0);
    assert_true(2 * report.iterations < whole.iterations);
    const double foretold = report.iterations + report.iterations_saved;
    assert_true(foretold > 0.6 * whole.iterations && foretold < 1.6 * whole.iterations);
    const double stopped = true_error(&body, body.u);
    assert_true(stopped > 1e-6 * energy_norm(&body, body.u));
    ost_solver_aim(body.solver, (OstSolverAim){.goes_on = 1});
    assert_success(ost_solver_solve(body.solver, body.problem.force, body.u, &rest));
    assert_false(rest.stopped);
    assert_true(rest.relative_residual <= 1e-11);
    assert_true(rest.iterations < whole.iterations);
    assert_true(true_error(&body, body.u) < 1e-3 * stopped);
    destroy(&body);
}

static OstStatus give_up(void *data, const double *u, double error, double *next)
{
    (void)u;
    (void)error;
    ++*(int *)data;
    *next = 0.0;
    return OST_SUCCESS;
}

static void without_an_answer_the_residual_ends_the_iteration(void **state)
{
    Body body = create(&easy);
    int asked = 0;
    const OstErrorStop stop = {.ask = give_up, .data = &asked, .first = 0.1, .relative = 1};
    OstSolveReport report;
    ost_solver_aim(body.solver, (OstSolverAim){.stop = &stop});
    assert_success(ost_solver_solve(body.solver, body.problem.force, body.u, &report));
    assert_int_equal(asked, 1);
    assert_false(report.stopped);
    assert_true(report.relative_residual <= 1e-11);
    destroy(&body);
}

static OstStatus fail_alone(void *data, const double *u, double error, double *next)
{
    (void)data;
    (void)u;
    (void)error;
    (void)next;
    return OST_RAISE(ctx, OST_CHECK_FAILED, "the estimate fails");
}

static void a_failure_of_the_stop_is_passed_on(void **state)
{
    Body body = create(&easy);
    const OstErrorStop stop = {.ask = fail_alone, .first = 0.1, .relative = 1};
    OstSolveReport report;
    ost_solver_aim(body.solver, (OstSolverAim){.stop = &stop});
    assert_failure(ost_solver_solve(body.solver, body.problem.force, body.u, &report), OST_CHECK_FAILED,
                   "the estimate fails");
    destroy(&body);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_error_is_known_while_cg_runs_within_a_third_and_seven_times),
    cmocka_unit_test(a_stop_saves_what_it_says_and_the_solve_goes_on_from_there),
    cmocka_unit_test(without_an_answer_the_residual_ends_the_iteration),
    cmocka_unit_test(a_failure_of_the_stop_is_passed_on),
};

OST_TEST_MAIN(tests)
