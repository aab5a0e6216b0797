/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/level/smoother_blocks.h"
#include "algebra/multigrid/spectrum.h"
#include "elastic_block.h"
#include "support.h"

static const ElasticBlock block = {
    .bricks = {5, 4, 9}, .size = {1, 1, 1}, .modulus = 1.0, .poisson = 0.3, .contrast = 30.0, .held = 1};

static OstLevelMatrix *level_matrix(const OstBlockMatrix *matrix)
{
    OstDoubleMatrix *source = NULL;
    OstLevelMatrix *level = NULL;
    assert_success(ost_double_matrix_borrow(matrix, NULL, &source));
    assert_success(ost_level_matrix_create(source, &level));
    ost_double_matrix_destroy(&source);
    return level;
}

static double *level_vector(const OstLevelMatrix *matrix)
{
    double *vector = NULL;
    assert_success(ost_level_vector_create(ctx, matrix->size, (size_t)matrix->columns, &vector));
    return vector;
}

static double *noise(const OstLevelMatrix *matrix)
{
    double *x = level_vector(matrix);
    for (size_t i = 0; i < ost_level_unknowns(matrix); i++)
        x[i] = sin(12.9898 * (double)(i + 1) * (2 + ost_rank(ctx)));
    return x;
}

static void half_a_matrix_multiplies_as_the_whole_does(void **state)
{
    ElasticProblem problem;
    assert_success(elastic_create(ctx, &block, &problem));
    OstLevelMatrix *level = level_matrix(problem.matrix);
    double *x = noise(level), *y = level_vector(level), *expected = level_vector(level);
    assert_success(ost_block_matrix_apply(problem.matrix, x, expected));
    for (size_t i = 0; i < ost_level_unknowns(level); i++)
        y[i] = 5.0;
    ost_level_matrix_add(level, -2.0, x, y);
    for (size_t i = 0; i < ost_level_unknowns(level); i++)
        assert_close(y[i], 5.0 - 2.0 * expected[i], 1e-4); /* entries up to 30 in single precision */
    assert_int_equal(level->nonzeros, 9 * problem.matrix->row_start[problem.matrix->rows]);
    OST_FREE(x, y, expected);
    ost_level_matrix_destroy(&level);
    elastic_destroy(&problem);
}

/* direction = 1/2 direction + 3 B^-1 r, x += direction, with r = B v for a v of noise. From zero, what stood in
 * direction and x does not count. */
static void check_step(const OstLevelMatrix *level, const OstSmootherBlocks *blocks, const double *r, const double *v)
{
    double *direction = level_vector(level), *x = level_vector(level);
    for (size_t i = 0; i < ost_level_unknowns(level); i++) {
        direction[i] = 8.0;
        x[i] = (double)i;
    }
    ost_smoother_blocks_step(blocks, &(OstBlockStep){.keep = 0.5, .add = 3.0, .direction = direction, .x = x}, r);
    for (size_t i = 0; i < ost_level_unknowns(level); i++) {
        assert_close(direction[i], 4.0 + 3.0 * v[i], 1e-3); /* single precision */
        assert_close(x[i], direction[i] + (double)i, 1e-9);
    }
    ost_smoother_blocks_step(blocks, &(OstBlockStep){.add = 3.0, .direction = direction, .x = x, .from_zero = 1}, r);
    for (size_t i = 0; i < ost_level_unknowns(level); i++) {
        assert_close(direction[i], 3.0 * v[i], 1e-3); /* single precision */
        assert_close(x[i], direction[i], 0.0);
    }
    OST_FREE(direction, x);
}

/* Where blocks are larger than the matrix' couplings reach, they are the matrix itself. */
static void one_block_of_any_size_inverts_its_nodes(void **state)
{
    const int bricks[5][3] = {{0, 0, 1}, {1, 1, 1}, {2, 1, 1}, {3, 3, 1}, {5, 3, 1}}; /* 1, 4, 6, 16, 24 nodes */
    for (int k = 0; k < 5; k++) {
        OstContext *alone = NULL;
        ElasticProblem problem;
        OstMetricGraph *graph = NULL;
        OstSmootherBlocks *blocks = NULL;
        ElasticBlock small = block;
        memcpy(small.bricks, bricks[k], sizeof small.bricks);
        assert_int_equal(ost_context_create(MPI_COMM_SELF, &alone), OST_SUCCESS);
        assert_success(elastic_create(alone, &small, &problem));
        if (k == 0) /* no brick at all: a node of its own */
            for (int c = 0; c < 3; c++)
                problem.matrix->value[4 * c] = 2.0 + c;
        OstLevelMatrix *level = level_matrix(problem.matrix);
        double *v = noise(level), *r = level_vector(level);
        ost_level_matrix_add(level, 1.0, v, r);
        assert_success(ost_metric_graph_create(problem.matrix, &problem.geometry, &graph));
        assert_success(ost_smoother_blocks_create(level, graph, 1000.0, &blocks));
        assert_int_equal(blocks->count, 1);
        check_step(level, blocks, r, v);
        OST_FREE(v, r);
        ost_smoother_blocks_destroy(&blocks);
        ost_metric_graph_destroy(&graph);
        ost_level_matrix_destroy(&level);
        elastic_destroy(&problem);
        ost_context_destroy(&alone);
    }
}

static void divide(const void *data, const double *r, double *z)
{
    const OstLevelMatrix *matrix = data;
    for (size_t i = 0; i < ost_level_unknowns(matrix); i++)
        z[i] = r[i] / 4.0;
}

/* A chain of springs: eigenvalues 2 - 2 cos(k pi / (n + 1)). Conjugate gradients find n of them in n steps. */
static void the_largest_eigenvalue_of_a_chain_is_found(void **state)
{
    enum { NODES = 8 };
    const int rank = ost_rank(ctx), size = ost_size(ctx);
    const OstLocal low = NODES * rank / size, high = NODES * (rank + 1) / size, rows = high - low;
    OstLocal row_start[NODES + 1] = {0}, column[3 * NODES], diagonal[NODES];
    double value[27 * NODES] = {0}, largest;
    OstGlobal ghost[2];
    OstLocal ghosts = 0, count = 0;
    for (OstLocal i = low; i < high; i++) {
        for (OstLocal j = i - 1; j <= i + 1; j++) {
            const int other = j < low || j >= high;
            if (j < 0 || j >= NODES || other)
                continue;
            if (i == j)
                diagonal[i - low] = count;
            for (int c = 0; c < 3; c++)
                value[9 * count + 4 * c] = i == j ? 2.0 : -1.0;
            column[count++] = j - low;
        }
        for (OstLocal j = i - 1; j <= i + 1; j += 2) {
            if (j < 0 || j >= NODES || (j >= low && j < high))
                continue;
            ghost[ghosts] = j;
            for (int c = 0; c < 3; c++)
                value[9 * count + 4 * c] = -1.0;
            column[count++] = rows + ghosts++;
        }
        row_start[i - low + 1] = count;
    }
    OstBlockMatrix chain = {.ctx = ctx, .rows = rows, .columns = rows + ghosts, .first_row = low, .global_rows = NODES};
    chain.row_start = row_start;
    chain.column = column;
    chain.diagonal = diagonal;
    chain.value = value;
    assert_success(ost_halo_create(ctx, rows, low, ghosts, ghost, &chain.halo));
    OstLevelMatrix *level = level_matrix(&chain);
    assert_success(ost_largest_eigenvalue(level, divide, level, &largest));
    assert_close(largest, (2.0 + 2.0 * cos(acos(-1.0) / (NODES + 1))) / 4.0, 1e-10);
    ost_level_matrix_destroy(&level);
    ost_halo_destroy(&chain.halo);
}

/* --- 6 × 6 blocks: a band on each rank --- */

enum { BAND = 400, REACH = 4, BLOCK = 36 };

static void set_block(OstLocal row, OstLocal column, double *to)
{
    for (int r = 0; r < 6; r++)
        for (int c = 0; c < 6; c++)
            to[6 * r + c] =
                row <= column ? sin(1.0 + row + 7 * column + 6 * r + c) : sin(1.0 + column + 7 * row + 6 * c + r);
    for (int r = 0; r < 6 && row == column; r++)
        for (int c = 0; c < r; c++)
            to[6 * r + c] = to[6 * c + r];
}

static OstDoubleMatrix *create_band(void)
{
    OstDoubleMatrix *band = NULL;
    assert_success(OST_NEW(ctx, &band, 1));
    *band = (OstDoubleMatrix){.ctx = ctx, .size = 6, .rows = BAND, .columns = BAND};
    assert_success(OST_NEW(ctx, &band->row_start, BAND + 1));
    assert_success(OST_NEW(ctx, &band->column, BAND * (2 * REACH + 1)));
    assert_success(OST_NEW(ctx, &band->value, BLOCK * BAND * (2 * REACH + 1)));
    OstLocal end = 0;
    for (OstLocal i = 0; i < BAND; i++) {
        for (OstLocal j = i - REACH; j <= i + REACH; j++) {
            if (j < 0 || j >= BAND)
                continue;
            set_block(i, j, band->value + BLOCK * (size_t)end);
            band->column[end++] = j;
        }
        band->row_start[i + 1] = end;
    }
    assert_success(ost_halo_create(ctx, BAND, (OstGlobal)BAND * ost_rank(ctx), 0, NULL, &band->halo));
    return band;
}

/* As the product works, but number by number. */
static void multiply_plainly(const OstLevelMatrix *matrix, const double *x, double *y)
{
    for (OstLocal i = 0; i < matrix->rows; i++) {
        for (int r = 0; r < 6; r++)
            for (int c = 0; c < 6; c++)
                y[6 * i + r] += (double)matrix->diagonal[BLOCK * i + 6 * r + c] * x[6 * i + c];
        for (OstLocal k = matrix->row_start[i]; k < matrix->row_start[i + 1]; k++) {
            const OstLocal j = matrix->column[k];
            for (int r = 0; r < 6; r++)
                for (int c = 0; c < 6; c++) {
                    const double a = (double)matrix->value[BLOCK * k + 6 * r + c];
                    y[6 * i + r] += a * x[6 * j + c];
                    y[6 * j + c] += a * x[6 * i + r];
                }
        }
    }
}

static void blocks_of_six_multiply_as_plain_loops_do(void **state)
{
    OstDoubleMatrix *band = create_band();
    OstLevelMatrix *level = NULL;
    assert_success(ost_level_matrix_create(band, &level));
    double *x = noise(level), *y = level_vector(level), *expected = level_vector(level);
    multiply_plainly(level, x, expected);
    ost_level_matrix_add(level, 1.0, x, y);
    for (size_t i = 0; i < ost_level_unknowns(level); i++)
        assert_close(y[i], expected[i], 1e-12 * REACH * BLOCK);
    OST_FREE(x, y, expected);
    ost_level_matrix_destroy(&level);
    ost_double_matrix_destroy(&band);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(blocks_of_six_multiply_as_plain_loops_do),
    cmocka_unit_test(half_a_matrix_multiplies_as_the_whole_does),
    cmocka_unit_test(one_block_of_any_size_inverts_its_nodes),
    cmocka_unit_test(the_largest_eigenvalue_of_a_chain_is_found),
};

OST_TEST_MAIN(tests)
