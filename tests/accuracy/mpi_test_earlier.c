/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/earlier.h"
#include "support.h"

#include <float.h>
#include <math.h>

/* Earlier solutions start the next solve: here of a diagonal stiffness, spread over the ranks. */

enum { SIZE = 40, ROWS = 32, LOADS = 3 }; /* the last numbers are those of functions */

/* A vector of which `x` has the rows, and all numbers after ost_earlier_finish. */
static OstEnriched open_vector(double *x, float of_functions[SIZE - ROWS])
{
    for (size_t i = ROWS; i < SIZE; i++)
        of_functions[i - ROWS] = (float)x[i];
    return (OstEnriched){x, of_functions};
}

static void close_vector(const OstEnriched *vector, double *x)
{
    for (size_t i = ROWS; i < SIZE; i++)
        x[i] = (double)vector->functions[i - ROWS];
}

static double stiffness(size_t i)
{
    return 1.0 + 100.0 * (double)((i + (size_t)ost_rank(ctx)) % 7);
}

static double load(int number, size_t i)
{
    const double place = (double)(i + SIZE * (size_t)ost_rank(ctx));
    return number == 0 ? 1.0 : number == 1 ? sin(place) : cos(0.3 * place);
}

static double sum(const double *a, const double *b)
{
    double product = 0.0;
    for (size_t i = 0; i < SIZE; i++)
        product += a[i] * b[i];
    MPI_Allreduce(MPI_IN_PLACE, &product, 1, MPI_DOUBLE, MPI_SUM, ost_comm(ctx));
    return product;
}

/* Solves for the load b, all but a share of it, from what the others give: returns how much of |b|² the start leaves.
 * The energy of the start and that of what it leaves must be the energy of the whole. */
static double solve(OstEarlier *earlier, const double *b, double missing, double *x)
{
    double r[SIZE], square, whole[SIZE], left[SIZE];
    float r_functions[SIZE - ROWS], x_functions[SIZE - ROWS];
    for (size_t i = 0; i < SIZE; i++)
        r[i] = b[i];
    const OstEnriched residual = open_vector(r, r_functions);
    assert_success(ost_earlier_start(earlier, &residual, &square));
    close_vector(&residual, r);
    const double share = sum(r, r) / fmax(sum(b, b), DBL_MIN);
    for (size_t i = 0; i < SIZE; i++) {
        whole[i] = b[i] / stiffness(i);
        left[i] = r[i] / stiffness(i);
    }
    assert_close(square + sum(left, r), sum(whole, b), 1e-5 * sum(whole, b));
    for (size_t i = 0; i < SIZE; i++) {
        x[i] = (1.0 - missing) * left[i];
        r[i] *= missing;
    }
    (void)open_vector(r, r_functions);
    const OstEnriched solution = open_vector(x, x_functions);
    assert_success(ost_earlier_finish(earlier, &residual, &solution));
    close_vector(&solution, x);
    return share;
}

static void check_sums(double unit)
{
    OstEarlier *earlier = NULL;
    double b[SIZE], x[SIZE];
    assert_success(ost_earlier_create(ctx, ROWS, SIZE - ROWS, &earlier));
    for (int number = 0; number < LOADS; number++) {
        for (size_t i = 0; i < SIZE; i++)
            b[i] = unit * load(number, i);
        assert_true(solve(earlier, b, 0.0, x) > 0.1); /* something new */
    }
    for (size_t i = 0; i < SIZE; i++)
        b[i] = unit * (2.0 * load(0, i) - 3.0 * load(1, i) + 0.5 * load(2, i));
    assert_true(solve(earlier, b, 0.0, x) < 1e-10);
    for (size_t i = 0; i < SIZE; i++)
        assert_close(x[i], b[i] / stiffness(i), 1e-5 * unit);
    assert_int_equal(earlier->count, LOADS); /* a sum is not kept */
    ost_earlier_destroy(&earlier);
}

static void a_sum_of_earlier_loads_is_solved_by_the_start(void **state)
{
    check_sums(1.0);
    check_sums(1e-6);
    check_sums(1e6);
}

static void what_a_solve_leaves_is_not_taken_for_solved(void **state)
{
    OstEarlier *earlier = NULL;
    double b[SIZE], x[SIZE];
    assert_success(ost_earlier_create(ctx, ROWS, SIZE - ROWS, &earlier));
    for (size_t i = 0; i < SIZE; i++)
        b[i] = load(1, i);
    (void)solve(earlier, b, 0.1, x);
    assert_close(x[1], 0.9 * b[1] / stiffness(1), 1e-12);
    assert_true(solve(earlier, b, 0.0, x) < 1e-10); /* x was short, but along the solution */
    assert_close(x[1], b[1] / stiffness(1), 1e-6);
    ost_earlier_destroy(&earlier);
}

static void no_more_are_kept_than_there_is_room_for(void **state)
{
    OstEarlier *earlier = NULL;
    double b[SIZE], x[SIZE];
    assert_success(ost_earlier_create(ctx, ROWS, SIZE - ROWS, &earlier));
    for (int number = 0; number < OST_MOST_EARLIER + 2; number++) {
        for (size_t i = 0; i < SIZE; i++)
            b[i] = (int)(i % (OST_MOST_EARLIER + 2)) == number;
        assert_close(solve(earlier, b, 0.0, x), 1.0, 1e-12);
        for (size_t i = 0; i < SIZE; i++)
            assert_close(x[i], b[i] / stiffness(i), 1e-7);
    }
    assert_int_equal(earlier->count, OST_MOST_EARLIER);
    for (size_t i = 0; i < SIZE; i++)
        b[i] = 0.0;
    float of_functions[SIZE - ROWS];
    const OstEnriched nothing = open_vector(b, of_functions);
    assert_success(ost_earlier_start(earlier, &nothing, &x[0]));
    assert_true(x[0] == 0.0);
    ost_earlier_destroy(&earlier);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_sum_of_earlier_loads_is_solved_by_the_start),
    cmocka_unit_test(what_a_solve_leaves_is_not_taken_for_solved),
    cmocka_unit_test(no_more_are_kept_than_there_is_room_for),
};

OST_TEST_MAIN(tests)
