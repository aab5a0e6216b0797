/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "algebra/krylov/lanczos.h"

/* Conjugate gradients on diag(values), all of them excited. */
static double condition_after(int n, const double *values, int steps)
{
    double r[64];
    double p[64];
    double rr = 0.0;
    OstLanczos lanczos;
    assert_success(ost_lanczos_create(ctx, steps, &lanczos));
    for (int i = 0; i < n; i++) {
        r[i] = p[i] = 1.0;
        rr += 1.0;
    }
    for (int k = 0; k < steps; k++) {
        double energy = 0.0;
        double next = 0.0;
        for (int i = 0; i < n; i++)
            energy += values[i] * p[i] * p[i];
        for (int i = 0; i < n; i++) {
            r[i] -= rr / energy * values[i] * p[i];
            next += r[i] * r[i];
        }
        assert_success(ost_lanczos_add(&lanczos, rr / energy, rr));
        const double beta = next / rr;
        rr = next;
        for (int i = 0; i < n; i++)
            p[i] = r[i] + beta * p[i];
    }
    double smallest, largest;
    ost_lanczos_extremes(&lanczos, &smallest, &largest);
    ost_lanczos_destroy(&lanczos);
    return smallest > 0.0 ? largest / smallest : 0.0;
}

static void as_many_steps_as_eigenvalues_give_the_condition_number(void **state)
{
    const double values[] = {0.5, 1.0, 3.0, 7.0, 20.0};
    assert_close(condition_after(5, values, 5), 40.0, 1e-8);
}

static void fewer_steps_give_a_lower_bound(void **state)
{
    double values[64];
    double before = 1.0;
    for (int i = 0; i < 64; i++)
        values[i] = 1.0 + i;
    for (int steps = 2; steps <= 16; steps += 2) {
        const double condition = condition_after(64, values, steps);
        assert_true(condition > before && condition < 64.0);
        before = condition;
    }
    assert_true(before > 32.0);
}

static void no_steps_give_no_estimate_and_one_gives_1(void **state)
{
    const double values[] = {4.0, 9.0};
    assert_close(condition_after(2, values, 0), 0.0, 0.0);
    assert_close(condition_after(2, values, 1), 1.0, 1e-10);
}

/* Room grows with the steps, up to those asked for. */
static void slow_solves_keep_all_steps(void **state)
{
    enum { MOST = 3000 };
    OstLanczos lanczos;
    assert_success(ost_lanczos_create(ctx, MOST, &lanczos));
    for (int k = 0; k < MOST + 5; k++)
        assert_success(ost_lanczos_add(&lanczos, k, -k));
    assert_int_equal(lanczos.count, MOST);
    for (int k = 0; k < MOST; k++)
        assert_true(lanczos.alpha[k] == k && lanczos.weight[k] == -k);
    ost_lanczos_destroy(&lanczos);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(as_many_steps_as_eigenvalues_give_the_condition_number),
    cmocka_unit_test(fewer_steps_give_a_lower_bound),
    cmocka_unit_test(no_steps_give_no_estimate_and_one_gives_1),
    cmocka_unit_test(slow_solves_keep_all_steps),
};

OST_TEST_MAIN(tests)
