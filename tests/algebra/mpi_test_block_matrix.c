/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "elastic_block.h"

#include "algebra/matrix/fold.h"
#include "core/small.h"

static const ElasticBlock held = {
    .bricks = {3, 2, 5}, .size = {1.0, 0.8, 1.3}, .modulus = 2.0, .poisson = 0.3, .held = 1};
static const ElasticBlock afloat = {.bricks = {3, 3, 4}, .size = {0.5, 1.0, 0.7}, .modulus = 3.0, .poisson = 0.25};

static double norm(OstContext *context, size_t n, const double *x)
{
    double square = 0.0;
    for (size_t i = 0; i < n; i++)
        square += x[i] * x[i];
    MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, ost_comm(context));
    return sqrt(square);
}

/* y = A x on the rows of a context's ranks, x given by the problem's force. */
static double *product(const ElasticProblem *problem)
{
    const OstBlockMatrix *matrix = problem->matrix;
    double *x = NULL;
    double *y = NULL;
    assert_success(OST_NEW(matrix->ctx, &x, 3 * (size_t)matrix->columns));
    assert_success(OST_NEW(matrix->ctx, &y, 3 * (size_t)matrix->rows));
    memcpy(x, problem->force, 3 * (size_t)matrix->rows * sizeof *x);
    assert_success(ost_block_matrix_apply(matrix, x, y));
    OST_FREE(x);
    return y;
}

static void the_product_does_not_depend_on_the_ranks(void **state)
{
    OstContext *alone = NULL;
    ElasticProblem shared;
    ElasticProblem whole;
    assert_int_equal(ost_context_create(MPI_COMM_SELF, &alone), OST_SUCCESS);
    assert_success(elastic_create(ctx, &held, &shared));
    assert_success(elastic_create(alone, &held, &whole));
    double *y = product(&shared);
    double *expected = product(&whole);
    const size_t first = 3 * (size_t)shared.matrix->first_row;
    for (size_t i = 0; i < 3 * (size_t)shared.matrix->rows; i++)
        assert_close(y[i], expected[first + i], 1e-13);
    OST_FREE(y, expected);
    elastic_destroy(&shared);
    elastic_destroy(&whole);
    ost_context_destroy(&alone);
}

static void rigid_motions_of_a_free_body_take_no_force(void **state)
{
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &afloat, &problem));
    const OstBlockMatrix *matrix = problem.matrix;
    const size_t n = 3 * (size_t)matrix->rows;
    double *x = NULL;
    double *y = NULL;
    assert_success(OST_NEW(ctx, &x, 3 * (size_t)matrix->columns));
    assert_success(OST_NEW(ctx, &y, n));
    for (size_t mode = 0; mode < 6; mode++) {
        memcpy(x, problem.modes + mode * n, n * sizeof *x);
        assert_true(norm(ctx, n, x) > 1.0);
        assert_success(ost_block_matrix_apply(matrix, x, y));
        assert_true(norm(ctx, n, y) < 1e-12 * norm(ctx, n, x));
    }
    OST_FREE(x, y);
    elastic_destroy(&problem);
}

static void the_six_modes_are_independent(void **state)
{
    ElasticProblem problem;
    double gram[36];
    assert_success(elastic_create(ctx, &afloat, &problem));
    const size_t n = 3 * (size_t)problem.matrix->rows;
    for (size_t a = 0; a < 6; a++)
        for (size_t b = 0; b < 6; b++) {
            gram[6 * a + b] = 0.0;
            for (size_t i = 0; i < n; i++)
                gram[6 * a + b] += problem.modes[a * n + i] * problem.modes[b * n + i];
        }
    MPI_Allreduce(MPI_IN_PLACE, gram, 36, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    double values[6];
    assert_success(ost_symmetric_eigen(ctx, 6, gram, values, NULL));
    assert_true(values[0] > 1e-3 * values[5]);
    elastic_destroy(&problem);
}

/* Half of the blocks, the same product, compensated residual and entries; unfolded, every bit as before. */
static void a_folded_matrix_is_the_same_in_half_the_memory(void **state)
{
    ElasticProblem problem, folded;
    assert_success(elastic_create(ctx, &held, &problem));
    assert_success(elastic_create(ctx, &held, &folded));
    const OstBlockMatrix *matrix = problem.matrix;
    const size_t n = 3 * (size_t)matrix->rows, blocks = (size_t)matrix->row_start[matrix->rows];
    double *f = NULL, *u = NULL, *left = NULL;
    const size_t before = ost_ledger_bytes(ctx);
    assert_success(ost_block_matrix_fold(folded.matrix));
    if (matrix->rows > 0)
        assert_true(ost_ledger_bytes(ctx) < before - blocks * 72 / 4);
    double *y = product(&folded), *expected = product(&problem);
    assert_success(OST_NEW(ctx, &f, 2 * n));
    assert_success(OST_NEW(ctx, &u, 3 * (size_t)matrix->columns));
    assert_success(OST_NEW(ctx, &left, n));
    memcpy(u, problem.force, n * sizeof *u);
    assert_success(ost_compensated_residual(matrix, f, u, left));
    assert_success(ost_compensated_residual(folded.matrix, f, u, f + n));
    for (size_t i = 0; i < n; i++) {
        assert_close(y[i], expected[i], 1e-14);
        assert_close(f[n + i], left[i], 1e-14);
    }
    assert_success(ost_block_matrix_unfold(folded.matrix));
    for (size_t i = 0; i < 9 * blocks; i++)
        assert_close(folded.matrix->value[i], matrix->value[i], 1e-15);
    OST_FREE(y, expected, f, u, left);
    elastic_destroy(&problem);
    elastic_destroy(&folded);
}

/* The diagonal of a row without its transpose. */
static void a_matrix_that_is_not_symmetric_stays_as_it_is(void **state)
{
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &held, &problem));
    OstBlockMatrix *matrix = problem.matrix;
    if (matrix->rows > 1) { /* the last row has one block fewer */
        const OstLocal row = matrix->rows - 1, first = matrix->row_start[row];
        const size_t moved = (size_t)(matrix->row_start[row + 1] - first - 1);
        assert_true(matrix->column[first] < row);
        memmove(matrix->column + first, matrix->column + first + 1, moved * sizeof *matrix->column);
        matrix->row_start[row + 1]--;
        matrix->diagonal[row]--;
        assert_success(ost_block_matrix_fold(matrix));
        assert_null(matrix->upper);
    }
    elastic_destroy(&problem);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_folded_matrix_is_the_same_in_half_the_memory),
    cmocka_unit_test(a_matrix_that_is_not_symmetric_stays_as_it_is),
    cmocka_unit_test(the_product_does_not_depend_on_the_ranks),
    cmocka_unit_test(rigid_motions_of_a_free_body_take_no_force),
    cmocka_unit_test(the_six_modes_are_independent),
};

OST_TEST_MAIN(tests)
