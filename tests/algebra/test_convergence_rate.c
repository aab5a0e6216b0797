/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "algebra/krylov/convergence_rate.h"

static void a_steady_fall_is_projected(void **state)
{
    OstConvergence convergence;
    ost_convergence_start(&convergence, 1.0);
    for (int k = 1; k <= 50; k++)
        ost_convergence_add(&convergence, pow(0.9, k), pow(0.9, 2 * k));
    assert_close(ost_convergence_factor(&convergence), 0.9, 1e-12);
    assert_close(ost_convergence_whole_factor(&convergence), 0.9, 1e-12);
    assert_close(ost_convergence_remaining(&convergence, pow(0.9, 80)), 30.0, 1e-9);
    assert_close(ost_convergence_remaining(&convergence, pow(0.9, 40)), 0.0, 0.0); /* reached */
}

static void two_windows_are_waited_for(void **state)
{
    OstConvergence convergence;
    ost_convergence_start(&convergence, 1.0);
    for (int k = 1; k < 2 * OST_CONVERGENCE_WINDOW; k++) {
        ost_convergence_add(&convergence, 1.0, 1.0);
        assert_close(ost_convergence_remaining(&convergence, 1e-8), 0.0, 0.0);
    }
    ost_convergence_add(&convergence, 1.0, 1.0);
    assert_true(isinf(ost_convergence_remaining(&convergence, 1e-8)));
}

/* Thin bodies: the residual rises by orders before it falls, while the energy falls all along. */
static void a_rising_residual_is_forgiven_while_the_energy_falls(void **state)
{
    OstConvergence convergence;
    ost_convergence_start(&convergence, 1.0);
    for (int k = 1; k <= 60; k++)
        ost_convergence_add(&convergence, 1.0 + 10.0 * k, pow(0.8, 2 * k));
    assert_close(ost_convergence_factor(&convergence), 0.8, 1e-12);
    assert_close(ost_convergence_remaining(&convergence, pow(0.8, 30)), 30.0, 1e-9);
}

/* Only the last window counts: what was fast once may stand still now. */
static void a_standstill_after_a_fast_start_is_seen(void **state)
{
    OstConvergence convergence;
    ost_convergence_start(&convergence, 1.0);
    for (int k = 1; k <= 60; k++) {
        const double norm = k <= 35 ? pow(0.5, k) : pow(0.5, 35) * (1.0 + k % 3);
        ost_convergence_add(&convergence, norm, norm * norm);
    }
    assert_close(ost_convergence_factor(&convergence), 1.0, 0.0);
    assert_true(isinf(ost_convergence_remaining(&convergence, 1e-12)));
    assert_true(ost_convergence_whole_factor(&convergence) < 0.7);
}

/* Long without a gain: a third of the pass, and 500 iterations. What an earlier pass reached does not count. */
static void a_pass_that_gains_nothing_stagnates(void **state)
{
    OstConvergence convergence;
    ost_convergence_start(&convergence, 1.0);
    for (int k = 1; k <= 2000; k++) {
        ost_convergence_add(&convergence, pow(0.5, k / 300.0), 1.0); /* slow, but steady */
        assert_false(ost_convergence_stagnates(&convergence));
    }
    for (int k = 1; k < 600; k++)
        ost_convergence_add(&convergence, 1.0, 1.0);
    assert_false(ost_convergence_stagnates(&convergence));
    for (int k = 0; k < 300; k++)
        ost_convergence_add(&convergence, 1.0, 1.0);
    assert_true(ost_convergence_stagnates(&convergence));
    ost_convergence_begin_pass(&convergence);
    for (int k = 1; k <= 600; k++) {
        ost_convergence_add(&convergence, 1e3, pow(0.99, k)); /* the energy falls, from above what was reached */
        assert_false(ost_convergence_stagnates(&convergence));
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_steady_fall_is_projected),
    cmocka_unit_test(two_windows_are_waited_for),
    cmocka_unit_test(a_rising_residual_is_forgiven_while_the_energy_falls),
    cmocka_unit_test(a_standstill_after_a_fast_start_is_seen),
    cmocka_unit_test(a_pass_that_gains_nothing_stagnates),
};

OST_TEST_MAIN(tests)
