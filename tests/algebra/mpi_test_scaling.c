/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "elastic_block.h"

#include "algebra/matrix/scaling.h"
#include "core/small.h"

static const ElasticBlock uneven = {
    .bricks = {2, 3, 5}, .size = {1.0, 0.2, 3.0}, .modulus = 1e9, .poisson = 0.4, .contrast = 1e-6, .held = 1};

static void diagonal_blocks_become_identities(void **state)
{
    ElasticProblem problem;
    OstScaling *scaling = NULL;
    assert_success(elastic_create(ctx, &uneven, &problem));
    const OstBlockMatrix *matrix = problem.matrix;
    assert_success(ost_scaling_create(matrix, &scaling));
    for (OstLocal i = 0; i < matrix->rows; i++) {
        double block[9];
        ost_scaling_block(scaling, i, i, matrix->value + 9 * (size_t)matrix->diagonal[i], block);
        for (int c = 0; c < 9; c++)
            assert_close(block[c], c % 4 == 0 ? 1.0 : 0.0, 1e-14);
    }
    ost_scaling_destroy(&scaling);
    elastic_destroy(&problem);
}

/* A' x, block by block; x has its ghosts. */
static void multiply_scaled(const OstScaling *scaling, const OstBlockMatrix *matrix, const double *x, double *y)
{
    for (OstLocal i = 0; i < matrix->rows; i++)
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++) {
            double block[9], part[3];
            ost_scaling_block(scaling, i, matrix->column[k], matrix->value + 9 * (size_t)k, block);
            ost_apply3(block, x + 3 * (size_t)matrix->column[k], part);
            for (int c = 0; c < 3; c++)
                y[3 * (size_t)i + (size_t)c] += part[c];
        }
}

/* A' u' = S (A (S^T u')), in which the ghosts' S must be the owners'. */
static void the_scaled_blocks_are_those_of_the_factors(void **state)
{
    ElasticProblem problem;
    OstScaling *scaling = NULL;
    assert_success(elastic_create(ctx, &uneven, &problem));
    const OstBlockMatrix *matrix = problem.matrix;
    assert_success(ost_scaling_create(matrix, &scaling));
    const size_t n = 3 * (size_t)matrix->rows;
    double *x = NULL;
    double *y[2] = {NULL, NULL};
    assert_success(OST_NEW(ctx, &x, 3 * (size_t)matrix->columns));
    assert_success(OST_NEW(ctx, &y[0], n));
    assert_success(OST_NEW(ctx, &y[1], n));
    memcpy(x, problem.force, n * sizeof *x);
    assert_success(ost_halo_import(matrix->halo, 3 * sizeof *x, x));
    multiply_scaled(scaling, matrix, x, y[0]);
    ost_scaling_from_scaled(scaling, problem.force, x);
    assert_success(ost_block_matrix_apply(matrix, x, y[1]));
    ost_scaling_to_scaled(scaling, y[1], y[1]);
    for (size_t i = 0; i < n; i++)
        assert_close(y[0][i], y[1][i], 1e-12);
    OST_FREE(x, y[0], y[1]);
    ost_scaling_destroy(&scaling);
    elastic_destroy(&problem);
}

static void scaling_there_and_back_changes_nothing(void **state)
{
    ElasticProblem problem;
    OstScaling *scaling = NULL;
    assert_success(elastic_create(ctx, &uneven, &problem));
    assert_success(ost_scaling_create(problem.matrix, &scaling));
    const size_t n = 3 * (size_t)problem.matrix->rows;
    const double *f = problem.force;
    double *there = NULL;
    double *back = NULL;
    double square = 0.0;
    assert_success(OST_NEW(ctx, &there, n));
    assert_success(OST_NEW(ctx, &back, n));
    ost_scaling_to_scaled(scaling, f, there);
    ost_scaling_unscale_residual(scaling, there, back);
    for (size_t i = 0; i < n; i++) {
        assert_close(back[i], f[i], 1e-13);
        square += f[i] * f[i];
    }
    assert_close(ost_scaling_residual_square(scaling, there), square, 1e-12 * square);
    ost_scaling_to_scaled_mode(scaling, f, there);
    ost_scaling_from_scaled(scaling, there, back);
    for (size_t i = 0; i < n; i++)
        assert_close(back[i], f[i], 1e-13);
    OST_FREE(there, back);
    ost_scaling_destroy(&scaling);
    elastic_destroy(&problem);
}

static void a_block_that_is_not_definite_is_refused_by_its_global_row(void **state)
{
    const double bad[2] = {-1.0, NAN};
    for (int k = 0; k < 2; k++) {
        ElasticProblem problem;
        OstScaling *scaling = NULL;
        assert_success(elastic_create(ctx, &uneven, &problem));
        OstBlockMatrix *matrix = problem.matrix;
        const OstGlobal last = matrix->global_rows - 1;
        if (last >= matrix->first_row && last < matrix->first_row + matrix->rows)
            matrix->value[9 * (size_t)matrix->diagonal[last - matrix->first_row] + 4] = bad[k];
        char row[32];
        snprintf(row, sizeof row, "row %lld ", (long long)last);
        assert_failure(ost_scaling_create(matrix, &scaling), OST_INVALID_INPUT, row);
        assert_null(scaling);
        elastic_destroy(&problem);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(diagonal_blocks_become_identities),
    cmocka_unit_test(the_scaled_blocks_are_those_of_the_factors),
    cmocka_unit_test(scaling_there_and_back_changes_nothing),
    cmocka_unit_test(a_block_that_is_not_definite_is_refused_by_its_global_row),
};

OST_TEST_MAIN(tests)
