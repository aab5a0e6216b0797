/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "soft_pair.h"

#include "algebra/krylov/refine.h"

typedef struct Inner {
    size_t n;
    double share; /* of the correction that is due */
} Inner;

static OstStatus take_share(void *data, const double *r, double *u, OstGoal *goal)
{
    const Inner *inner = data;
    goal->iterations++;
    for (size_t i = 0; i < inner->n; i++)
        u[i] = inner->share * r[i] / 2.0;
    return OST_SUCCESS;
}

/* Refines from 0 towards half the right-hand side; gives what is missing, over u. */
static double refined(double share, double settled, OstGoal *goal)
{
    ElasticProblem problem = diagonal_bar((const double[3]){2.0, 2.0, 2.0}); /* so that what a step leaves is known */
    OstSolverOptions options = ost_solver_default_options();
    Inner inner = {.n = 3 * (size_t)problem.matrix->rows, .share = share};
    double *u = NULL, missing = 0.0;
    options.relative_residual = 0.5;
    assert_success(OST_NEW(ctx, &u, inner.n + 1));
    assert_success(ost_goal_set(problem.matrix, problem.force, &options, goal));
    goal->settled = settled;
    assert_success(ost_refine(problem.matrix, take_share, &inner, problem.force, u, goal));
    for (size_t i = 0; i < inner.n; i++)
        missing = fmax(missing, fabs(u[i] - 0.5) / 0.5);
    MPI_Allreduce(MPI_IN_PLACE, &missing, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    OST_FREE(u);
    elastic_destroy(&problem);
    return missing;
}

static void the_residual_asked_for_is_enough_where_nothing_else_is(void **state)
{
    OstGoal goal;
    assert_close(refined(0.7, 0.0, &goal), 0.3, 1e-15);
    assert_int_equal(goal.iterations, 1);
    assert_int_equal(goal.end, OST_END_REACHED);
    assert_true(goal.drift == 0.0);
}

static void u_is_refined_until_it_has_settled(void **state)
{
    OstGoal goal;
    const double missing = refined(0.7, 1e-3, &goal); /* corrections of 0.7 × 0.3^k */
    assert_close(missing, pow(0.3, 7), 1e-15);
    assert_int_equal(goal.iterations, 7);
    assert_true(goal.drift >= 0.99 * missing && goal.drift <= 1.01 * missing);
}

/* A strategy that takes over may begin with a correction that is small, and right. */
static void a_small_first_correction_is_no_drift(void **state)
{
    OstGoal goal;
    const double missing = refined(1.0, 2.0, &goal); /* from 0, so the correction is as large as u */
    assert_close(missing, 0.0, 1e-15);
    assert_int_equal(goal.iterations, 1);
    assert_true(goal.drift == 0.0);
}

/* Each correction is 0.95 of the one before: too slow, and what would follow is 19 times the last. */
static void what_does_not_settle_is_told_by_its_drift(void **state)
{
    OstGoal goal;
    const double missing = refined(0.05, 1e-3, &goal);
    assert_true(goal.norm <= goal.target || goal.end == OST_END_STALLED);
    assert_true(missing > 0.1);
    assert_true(goal.drift >= missing && goal.drift <= 10.0 * missing);
}

/* What factors do that miss the soft mode by 2.75. */
static OstStatus miss_the_soft_mode(void *data, const double *r, double *u, OstGoal *goal)
{
    goal->iterations++;
    miss_soft_mode(data, 2.75, r, u);
    return OST_SUCCESS;
}

/* Refinement by such factors alone diverges by 1.75 a step, and the residual shows only the rounding of u. */
static void cg_finds_the_soft_mode_that_factors_miss(void **state)
{
    ElasticProblem problem = bar_with_pair();
    OstSolverOptions options = ost_solver_default_options();
    double *u = NULL, expected[2];
    OstGoal goal;
    assert_success(OST_NEW(ctx, &u, 3 * (size_t)problem.matrix->rows + 1));
    assert_success(ost_goal_set(problem.matrix, problem.force, &options, &goal));
    goal.settled = 1e-3;
    assert_success(ost_refine(problem.matrix, miss_the_soft_mode, problem.matrix, problem.force, u, &goal));
    solve_pair(softness(), problem.force, expected);
    if (has_pair(problem.matrix))
        assert_close(u[1], expected[1], 1e-3 * expected[1]);
    assert_true(goal.compensated && goal.drift <= 1e-3);
    OST_FREE(u);
    elastic_destroy(&problem);
}

/* What factors do that miss many modes, by eight factors of up to 2^-7. */
static OstStatus miss_many_modes(void *data, const double *r, double *u, OstGoal *goal)
{
    const OstBlockMatrix *matrix = data;
    goal->iterations++;
    miss_soft_mode(matrix, 1.0, r, u);
    for (OstLocal i = has_pair(matrix) ? 2 : 0; i < 3 * matrix->rows; i++)
        u[i] *= pow(0.5, (double)((3 * matrix->first_row + i) % 8));
    return OST_SUCCESS;
}

/* CG takes nine steps, of which three in a row gain nothing. */
static void cg_finds_the_many_modes_that_factors_miss(void **state)
{
    ElasticProblem problem = bar_with_pair();
    OstSolverOptions options = ost_solver_default_options();
    double *u = NULL;
    OstGoal goal;
    assert_success(OST_NEW(ctx, &u, 3 * (size_t)problem.matrix->rows + 1));
    for (OstLocal i = has_pair(problem.matrix) ? 2 : 0; i < 3 * problem.matrix->rows; i++)
        problem.force[i] = 0.1; /* beside which the pair's rounding is near from the start */
    assert_success(ost_goal_set(problem.matrix, problem.force, &options, &goal));
    goal.settled = 1e-6;
    assert_success(ost_refine(problem.matrix, miss_many_modes, problem.matrix, problem.force, u, &goal));
    for (OstLocal i = has_pair(problem.matrix) ? 2 : 0; i < 3 * problem.matrix->rows; i++)
        assert_close(u[i], 0.05, 1e-6);
    assert_true(goal.compensated && goal.drift <= 1e-6);
    OST_FREE(u);
    elastic_destroy(&problem);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_residual_asked_for_is_enough_where_nothing_else_is),
    cmocka_unit_test(u_is_refined_until_it_has_settled),
    cmocka_unit_test(a_small_first_correction_is_no_drift),
    cmocka_unit_test(what_does_not_settle_is_told_by_its_drift),
    cmocka_unit_test(cg_finds_the_soft_mode_that_factors_miss),
    cmocka_unit_test(cg_finds_the_many_modes_that_factors_miss),
};

OST_TEST_MAIN(tests)
