/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "algebra/krylov/algebraic_error.h"

enum { UNKNOWNS = 400, MOST_STEPS = 400 };

/* Conjugate gradients on a diagonal matrix, from 0 towards u* = `solution`. */
typedef struct Run {
    double value[UNKNOWNS], solution[UNKNOWNS], u[UNKNOWNS], r[UNKNOWNS], p[UNKNOWNS];
    double weight;
    OstLanczos lanczos;
} Run;

static Run *begin(double (*value)(int), double (*solution)(int))
{
    Run *run = calloc(1, sizeof *run);
    assert_non_null(run);
    assert_success(ost_lanczos_create(ctx, MOST_STEPS, &run->lanczos));
    for (int i = 0; i < UNKNOWNS; i++) {
        run->value[i] = value(i);
        run->solution[i] = solution(i);
        run->r[i] = run->p[i] = value(i) * solution(i);
        run->weight += run->r[i] * run->r[i];
    }
    return run;
}

static void step(Run *run)
{
    double energy = 0.0, next = 0.0;
    for (int i = 0; i < UNKNOWNS; i++)
        energy += run->value[i] * run->p[i] * run->p[i];
    const double alpha = run->weight / energy;
    for (int i = 0; i < UNKNOWNS; i++) {
        run->u[i] += alpha * run->p[i];
        run->r[i] -= alpha * run->value[i] * run->p[i];
        next += run->r[i] * run->r[i];
    }
    assert_success(ost_lanczos_add(&run->lanczos, alpha, run->weight));
    for (int i = 0; i < UNKNOWNS; i++)
        run->p[i] = run->r[i] + next / run->weight * run->p[i];
    run->weight = next;
}

static void end(Run **run)
{
    ost_lanczos_destroy(&(*run)->lanczos);
    free(*run);
    *run = NULL;
}

static double true_error(const Run *run)
{
    double square = 0.0;
    for (int i = 0; i < UNKNOWNS; i++)
        square += run->value[i] * (run->solution[i] - run->u[i]) * (run->solution[i] - run->u[i]);
    return sqrt(square);
}

static double energy_norm(const Run *run)
{
    double square = 0.0;
    for (int i = 0; i < UNKNOWNS; i++)
        square += run->value[i] * run->u[i] * run->u[i];
    return sqrt(square);
}

static double one(int i)
{
    (void)i;
    return 1.0;
}

/* What a good preconditioner leaves: from 0.4 to 1.2. */
static double clustered(int i)
{
    return 0.4 + 0.8 * i / (UNKNOWNS - 1.0);
}

/* ... and six small eigenvalues that it missed, which the steps find one after another. */
static double with_outliers(int i)
{
    static const double small[] = {0.003, 0.006, 0.012, 0.025, 0.06, 0.15};
    return i < 6 ? small[i] : clustered(i);
}

/* Over four orders of magnitude, evenly by their logarithms. */
static double spread_out(int i)
{
    return pow(10.0, -4.0 * i / (UNKNOWNS - 1.0));
}

/* Half of the energy in the softest modes. */
static double soft(int i)
{
    return i < 6 ? 30.0 : 1.0;
}

/* From the third step until the error has fallen by `least`. */
static void stays_within(double (*value)(int), double (*solution)(int), double least, double low, double high,
                         double bound_low)
{
    Run *run = begin(value, solution);
    OstAlgebraicError error;
    double first = true_error(run), exact = first;
    int seen = 0;
    step(run);
    for (int k = 1; k < MOST_STEPS && exact > least * first; k++) {
        step(run);
        exact = true_error(run);
        ost_algebraic_error(&run->lanczos, &error);
        assert_close(error.size, energy_norm(run), 1e-3 * error.size);
        if (isinf(error.estimate))
            continue;
        seen++;
        if (!(error.estimate >= low * exact && error.estimate <= high * exact))
            fail_msg("step %d: estimate %g of an error of %g", k + 1, error.estimate, exact);
        if (!(error.bound >= bound_low * exact))
            fail_msg("step %d: bound %g of an error of %g", k + 1, error.bound, exact);
    }
    assert_true(exact <= least * first);
    assert_true(seen > 6);
    end(&run);
}

static void with_a_good_preconditioner_the_error_is_known_to_a_factor_of_two(void **state)
{
    stays_within(clustered, one, 1e-6, 0.5, 2.0, 1.0);
}

/* It is too large for some steps once the last one is found and convergence becomes fast. */
static void while_small_eigenvalues_are_found_it_is_no_smaller_than_a_third(void **state)
{
    stays_within(with_outliers, one, 1e-6, 1.0 / 3.0, 40.0, 0.7);
    stays_within(with_outliers, soft, 1e-6, 1.0 / 3.0, 40.0, 0.7);
}

static void of_a_spectrum_over_four_decades_too(void **state)
{
    stays_within(spread_out, one, 1e-2, 1.0 / 3.0, 7.0, 0.8);
}

static void the_rate_foretells_the_next_steps(void **state)
{
    Run *run = begin(clustered, one);
    OstAlgebraicError error;
    for (int k = 0; k < 4; k++)
        step(run);
    ost_algebraic_error(&run->lanczos, &error);
    const double rate = ost_algebraic_error_rate(&run->lanczos, &error), before = true_error(run);
    for (int k = 0; k < 4; k++)
        step(run);
    const double truth = pow(true_error(run) / before, 0.25);
    assert_true(rate > 0.5 * truth && rate < 2.0 * truth);
    end(&run);
}

static void two_steps_tell_too_little_and_the_estimate_says_so(void **state)
{
    Run *run = begin(with_outliers, one);
    OstAlgebraicError error;
    step(run);
    step(run);
    ost_algebraic_error(&run->lanczos, &error);
    assert_true(isinf(error.estimate));
    assert_close(ost_algebraic_error_rate(&run->lanczos, &error), 1.0, 0.0);
    end(&run);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(with_a_good_preconditioner_the_error_is_known_to_a_factor_of_two),
    cmocka_unit_test(while_small_eigenvalues_are_found_it_is_no_smaller_than_a_third),
    cmocka_unit_test(of_a_spectrum_over_four_decades_too),
    cmocka_unit_test(the_rate_foretells_the_next_steps),
    cmocka_unit_test(two_steps_tell_too_little_and_the_estimate_says_so),
};

OST_TEST_MAIN(tests)
