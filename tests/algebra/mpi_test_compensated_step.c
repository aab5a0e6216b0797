/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "elastic_block.h"

#include "algebra/matrix/compensated_step.h"

static const double diagonal[3] = {1.0, 2.0, 3.0};

/* What factors with one mode 2.75 times too soft make of a residual: repeated alone, 1 - 2.75 a step. */
static void miss_one_mode(const OstBlockMatrix *matrix, const double *residual, double *correction)
{
    for (OstLocal i = 0; i < matrix->rows; i++)
        for (int c = 0; c < 3; c++)
            correction[3 * i + c] = residual[3 * i + c] / diagonal[c];
    if (matrix->first_row == 0 && matrix->rows > 0)
        correction[0] *= 2.75;
}

static double largest_residual(const ElasticProblem *problem, const double *u, double *residual)
{
    double largest = 0.0;
    for (OstLocal i = 0; i < 3 * problem->matrix->rows; i++) {
        residual[i] = problem->force[i] - diagonal[i % 3] * u[i];
        largest = fmax(largest, fabs(residual[i]));
    }
    MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, ost_comm(ctx));
    return largest;
}

/* M^-1 A has two eigenvalues, so that conjugate gradients take two steps. */
static void a_mode_that_factors_miss_takes_one_step_more(void **state)
{
    ElasticProblem problem = diagonal_bar(diagonal);
    const size_t n = 3 * (size_t)problem.matrix->rows;
    double *u = NULL, *residual = NULL, *correction = NULL;
    OstCompensatedStep *step = NULL;
    assert_success(OST_NEW(ctx, &u, n + 1));
    assert_success(OST_NEW(ctx, &residual, n + 1));
    assert_success(OST_NEW(ctx, &correction, n + 1));
    assert_success(ost_compensated_step_create(problem.matrix, &step));
    for (int k = 0; k < 2; k++) {
        assert_true(largest_residual(&problem, u, residual) > 0.01);
        miss_one_mode(problem.matrix, residual, correction);
        assert_success(ost_compensated_step_turn(step, residual, correction));
        for (size_t i = 0; i < n; i++)
            u[i] += correction[i];
    }
    assert_true(largest_residual(&problem, u, residual) < 1e-14);
    ost_compensated_step_destroy(&step);
    OST_FREE(u, residual, correction);
    elastic_destroy(&problem);
}

/* p·Ap of one stiff pair that moves together, (a, -a; -a, a + d): in double precision alone 1 % of it is rounding. */
static void what_rounding_hides_of_an_energy_is_found(void **state)
{
    const double a = 1e8, d = 1e-6, p[2] = {1.0 / 3.0, (1.0 + 1e-9) / 3.0};
    const double stiff = a + d;
    ElasticProblem problem = diagonal_bar(diagonal);
    OstBlockMatrix *matrix = problem.matrix;
    const size_t n = 3 * (size_t)matrix->rows;
    const int first = matrix->first_row == 0 && matrix->rows > 0;
    double *correction = NULL, *residual = NULL;
    OstCompensatedStep *step = NULL;
    assert_success(OST_NEW(ctx, &correction, n + 1));
    assert_success(OST_NEW(ctx, &residual, n + 1));
    assert_success(ost_compensated_step_create(matrix, &step));
    if (first) {
        double *block = matrix->value + 9 * (size_t)matrix->diagonal[0];
        block[0] = a;
        block[1] = block[3] = -a;
        block[4] = stiff;
        memcpy(correction, p, sizeof p);
        residual[0] = 1.0;
    }
    assert_success(ost_compensated_step_turn(step, residual, correction));
    const double apart = p[0] - p[1], more = stiff - a; /* both exact */
    const double expected = a * apart * apart + more * p[1] * p[1];
    assert_close(step->energy, expected, 1e-9 * expected);
    if (first) /* r·p / p·Ap of p */
        assert_close(correction[1], p[0] / expected * p[1], 1e-9 * p[0] / expected * p[1]);
    ost_compensated_step_destroy(&step);
    OST_FREE(correction, residual);
    elastic_destroy(&problem);
}

/* A step without a gain in energy is left as it was. */
static void a_direction_without_energy_is_left_alone(void **state)
{
    ElasticProblem problem = diagonal_bar(diagonal);
    const size_t n = 3 * (size_t)problem.matrix->rows;
    double *zero = NULL, *correction = NULL;
    OstCompensatedStep *step = NULL;
    assert_success(OST_NEW(ctx, &zero, n + 1));
    assert_success(OST_NEW(ctx, &correction, n + 1));
    for (OstLocal k = 0; k < problem.matrix->row_start[problem.matrix->rows]; k++)
        for (int c = 0; c < 9; c++)
            problem.matrix->value[9 * (size_t)k + (size_t)c] *= -1.0;
    for (size_t i = 0; i < n; i++)
        correction[i] = 1.0;
    assert_success(ost_compensated_step_create(problem.matrix, &step));
    assert_success(ost_compensated_step_turn(step, zero, correction));
    for (size_t i = 0; i < n; i++)
        assert_true(correction[i] == 1.0);
    assert_true(step->energy == 0.0);
    ost_compensated_step_destroy(&step);
    OST_FREE(zero, correction);
    elastic_destroy(&problem);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_mode_that_factors_miss_takes_one_step_more),
    cmocka_unit_test(what_rounding_hides_of_an_energy_is_found),
    cmocka_unit_test(a_direction_without_energy_is_left_alone),
};

OST_TEST_MAIN(tests)
