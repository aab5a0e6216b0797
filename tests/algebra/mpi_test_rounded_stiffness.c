/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "elastic_block.h"

#include "algebra/matrix/rounded_stiffness.h"

#include <float.h>

static const ElasticBlock uneven = {
    .bricks = {2, 3, 5}, .size = {1.0, 0.2, 3.0}, .modulus = 1e9, .poisson = 0.4, .contrast = 1e-6, .held = 1};

typedef struct Rounded {
    ElasticProblem problem;
    double *u, *force; /* u with ghosts */
} Rounded;

static Rounded make(void)
{
    Rounded rounded = {.u = NULL};
    assert_success(elastic_create(ctx, &uneven, &rounded.problem));
    const OstBlockMatrix *matrix = rounded.problem.matrix;
    assert_success(OST_NEW(ctx, &rounded.u, 3 * (size_t)matrix->columns));
    assert_success(OST_NEW(ctx, &rounded.force, 3 * (size_t)matrix->rows));
    return rounded;
}

static void destroy(Rounded *rounded)
{
    elastic_destroy(&rounded->problem);
    OST_FREE(rounded->u, rounded->force);
}

/* Something of every mode, the same on any ranks; `kind` of many. */
static double wave(const Rounded *rounded, OstLocal column, int c, int kind)
{
    return sin((1.0 + 0.7 * kind) * (double)(3 * rounded->problem.matrix->label[column] + c) + kind);
}

static void throw_at_wave(Rounded *rounded, int kind, int which)
{
    const OstBlockMatrix *matrix = rounded->problem.matrix;
    for (OstLocal column = 0; column < matrix->columns; column++)
        for (int c = 0; c < 3; c++)
            rounded->u[3 * column + c] = wave(rounded, column, c, kind);
    ost_rounded_stiffness_force(matrix, rounded->u, which, rounded->force);
}

static double sum_over_ranks(double sum)
{
    assert_int_equal(MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, ost_comm(ctx)), MPI_SUCCESS);
    return sum;
}

/* A wave times the force of another. */
static double work_of(const Rounded *rounded, int kind)
{
    double sum = 0.0;
    for (OstLocal row = 0; row < rounded->problem.matrix->rows; row++)
        for (int c = 0; c < 3; c++)
            sum += wave(rounded, row, c, kind) * rounded->force[3 * row + c];
    return sum_over_ranks(sum);
}

/* Both entries of a pair are one number, on whichever ranks they are: v·(K' - K) u = u·(K' - K) v. */
static void a_rounded_stiffness_is_symmetric(void **state)
{
    Rounded rounded = make();
    for (int which = 0; which < 5; which++) {
        throw_at_wave(&rounded, 0, which);
        const double one = work_of(&rounded, 1);
        throw_at_wave(&rounded, 1, which);
        const double other = work_of(&rounded, 0);
        assert_true(fabs(one) > 0.0);
        assert_close(one, other, 1e-10 * fabs(one));
    }
    destroy(&rounded);
}

/* Of a u that is 1 in one unknown, the force is that column of K' - K. */
static void throw_at_unknown(Rounded *rounded, OstGlobal node, int component, int which)
{
    const OstBlockMatrix *matrix = rounded->problem.matrix;
    for (OstLocal column = 0; column < matrix->columns; column++)
        for (int c = 0; c < 3; c++)
            rounded->u[3 * column + c] = rounded->problem.matrix->label[column] == node && c == component;
    ost_rounded_stiffness_force(matrix, rounded->u, which, rounded->force);
}

/* The random signs of each row's entries in a node's columns; 0 where K has no entry. */
typedef signed char Signs[3][3];

static void find_signs(Rounded *rounded, OstGlobal node, int which, Signs *signs)
{
    const OstBlockMatrix *matrix = rounded->problem.matrix;
    memset(signs, 0, (size_t)matrix->rows * sizeof *signs);
    for (int c = 0; c < 3; c++) {
        throw_at_unknown(rounded, node, c, which);
        for (OstLocal row = 0; row < matrix->rows; row++)
            for (OstLocal k = matrix->row_start[row]; k < matrix->row_start[row + 1]; k++)
                for (int r = 0; r < 3 && rounded->problem.matrix->label[matrix->column[k]] == node; r++) {
                    const double entry = matrix->value[9 * (size_t)k + (size_t)(3 * r + c)];
                    if (entry == 0.0)
                        continue;
                    const double off = rounded->force[3 * row + r] / entry;
                    assert_close(fabs(off), 0.5 * DBL_EPSILON, 0.0);
                    signs[row][r][c] = off > 0.0 ? 1 : -1;
                }
    }
}

/* Sums over a block of signs, and of products of neighbours among them. */
static void add_signs(Signs block, int is_diagonal, double sum[2], double count[2])
{
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            sum[0] += block[r][c];
            count[0] += abs(block[r][c]);
            if (is_diagonal) /* where neighbours may be a pair */
                continue;
            const int along = block[r][c] * block[r][(c + 1) % 3], across = block[r][c] * block[(r + 1) % 3][c];
            sum[1] += along + across;
            count[1] += abs(along) + abs(across);
        }
}

/* The sums stay within five standard errors of 0; the two signs of a pair are one. */
static void every_entry_is_off_by_half_an_epsilon_of_itself_up_or_down(void **state)
{
    enum { THROWS = 16 };
    Rounded rounded = make();
    const OstBlockMatrix *matrix = rounded.problem.matrix;
    Signs *signs = NULL;
    double sum[2] = {0.0}, count[2] = {0.0};
    assert_success(OST_NEW(ctx, &signs, matrix->rows));
    for (OstGlobal node = 0; node < matrix->global_rows; node++)
        for (int which = 0; which < THROWS; which++) {
            find_signs(&rounded, node, which, signs);
            for (OstLocal row = 0; row < matrix->rows; row++)
                add_signs(signs[row], matrix->label[row] == node, sum, count);
        }
    for (int k = 0; k < 2; k++)
        assert_true(fabs(sum_over_ranks(sum[k])) < 5.0 * sqrt(2.0 * sum_over_ranks(count[k])));
    OST_FREE(signs);
    destroy(&rounded);
}

static void throws_differ(void **state)
{
    Rounded rounded = make();
    const size_t n = 3 * (size_t)rounded.problem.matrix->rows;
    double *first = NULL, product = 0.0, square = 0.0;
    assert_success(OST_NEW(ctx, &first, n));
    throw_at_wave(&rounded, 0, 0);
    memcpy(first, rounded.force, n * sizeof *first);
    for (int which = 1; which < 20; which++) {
        throw_at_wave(&rounded, 0, which);
        for (size_t i = 0; i < n; i++) {
            product += first[i] * rounded.force[i] / 19.0;
            square += first[i] * first[i] / 19.0;
        }
    }
    assert_true(fabs(sum_over_ranks(product)) < 0.2 * sum_over_ranks(square));
    OST_FREE(first);
    destroy(&rounded);
}

/* Signs of a row's terms that are independent add up, in the mean square, to the root of the sum of their squares. */
static void entries_of_a_row_are_rounded_independently(void **state)
{
    enum { THROWS = 64 };
    Rounded rounded = make();
    const size_t n = 3 * (size_t)rounded.problem.matrix->rows;
    double *expected = NULL, squares[2] = {0.0, 0.0};
    assert_success(OST_NEW(ctx, &expected, n));
    for (int which = 0; which < THROWS; which++) {
        throw_at_wave(&rounded, 0, which);
        for (size_t i = 0; i < n; i++)
            squares[0] += rounded.force[i] * rounded.force[i] / THROWS;
    }
    ost_term_rounding(rounded.problem.matrix, rounded.u, expected);
    for (size_t i = 0; i < n; i++)
        squares[1] += 0.25 * expected[i] * expected[i];
    const double all = sum_over_ranks(squares[1]);
    assert_close(sum_over_ranks(squares[0]), all, 0.1 * all);
    OST_FREE(expected);
    destroy(&rounded);
}

/* On this rank alone and on all of them, of the same labels. */
static void signs_do_not_depend_on_ranks(void **state)
{
    OstContext *world = ctx;
    double work[2];
    for (int alone = 0; alone < 2; alone++) {
        if (alone)
            assert_int_equal(ost_context_create(MPI_COMM_SELF, &ctx), OST_SUCCESS);
        Rounded rounded = make();
        throw_at_wave(&rounded, 0, 3);
        work[alone] = work_of(&rounded, 1);
        destroy(&rounded);
    }
    ost_context_destroy(&ctx);
    ctx = world;
    assert_close(work[0], work[1], 1e-10 * fabs(work[1]));
}

static void sizes_are_told_by_the_root_of_their_mean_square(void **state)
{
    OstSamples samples = {0, 0.0};
    ost_samples_add(&samples, 3.0);
    ost_samples_add(&samples, 4.0);
    assert_close(ost_samples_size(&samples), sqrt(12.5), 1e-15);
    assert_close(ost_samples_spread(&samples), 0.5, 1e-15); /* of chi squared with 2 degrees of freedom: 1/sqrt(2·2) */
}

/* Three standard errors are 75 % of the size with 8 samples (3/sqrt(2·8)), 37.5 % with 32. */
static void more_samples_are_called_for_near_the_limit(void **state)
{
    OstSamples samples = {7, 7 * 100.0};
    assert_true(ost_samples_undecided(&samples, 1.0, 8, 32)); /* too few, whatever they say */
    const double decided[] = {0.24, 1.76, (double)NAN, (double)INFINITY}, undecided[] = {0.26, 1.0, 1.74};
    for (int i = 0; i < 4; i++) {
        samples = (OstSamples){8, 8 * decided[i] * decided[i]};
        assert_false(ost_samples_undecided(&samples, 1.0, 8, 32));
    }
    for (int i = 0; i < 3; i++) {
        samples = (OstSamples){8, 8 * undecided[i] * undecided[i]};
        assert_true(ost_samples_undecided(&samples, 1.0, 8, 32));
        samples = (OstSamples){32, 32 * undecided[i] * undecided[i]};
        assert_false(ost_samples_undecided(&samples, 1.0, 8, 32)); /* as many as there may be */
    }
}

static void what_is_surely_beyond_is_three_standard_errors_beyond(void **state)
{
    assert_false(ost_surely_beyond(0.1, 0.0, 0.1));
    assert_true(ost_surely_beyond(0.1001, 0.0, 0.1));
    assert_false(ost_surely_beyond(0.129, 0.1, 0.1));
    assert_true(ost_surely_beyond(0.131, 0.1, 0.1));
    assert_true(ost_surely_beyond((double)NAN, 0.1, 0.1));
    assert_true(ost_surely_beyond((double)INFINITY, 0.1, 0.1));
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_rounded_stiffness_is_symmetric),
    cmocka_unit_test(every_entry_is_off_by_half_an_epsilon_of_itself_up_or_down),
    cmocka_unit_test(throws_differ),
    cmocka_unit_test(entries_of_a_row_are_rounded_independently),
    cmocka_unit_test(signs_do_not_depend_on_ranks),
    cmocka_unit_test(sizes_are_told_by_the_root_of_their_mean_square),
    cmocka_unit_test(more_samples_are_called_for_near_the_limit),
    cmocka_unit_test(what_is_surely_beyond_is_three_standard_errors_beyond),
};

OST_TEST_MAIN(tests)
