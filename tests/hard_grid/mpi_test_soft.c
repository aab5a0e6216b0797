/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "hard_grid/grid.h"

/* Inclusions 1e9 times softer in a body of nu = 1/2, without a factorisation: their mean pressures, which the stiff
 * body alone holds, are solved for on their own. By the mass matrix alone the first takes 316 iterations and states no
 * digit, and the second 418. */
static void soft_inclusions_are_solved_by_iterations(void **state)
{
    const HardPoint soft = {
        .shape = hard_find_shape("soft"), .order = 2, .poisson = HARD_INCOMPRESSIBLE, .iterated = 1};
    for (int ratio = 0; ratio < 2; ratio++) {
        HardPoint point = soft;
        HardReading reading;
        point.ratio = ratio;
        point.stiff = ratio > 0 ? 2 : 0;
        assert_success(hard_read(ctx, &point, &reading));
        if (reading.outcome != HARD_SOLVED)
            fail_msg("ratio %d: %s", ratio, reading.reason);
        assert_true(reading.method != OST_METHOD_DIRECT);
        assert_true(reading.iterations <= (ratio > 0 ? 130 : 70));
        assert_true(reading.truth.pressure <= 1e-4);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(soft_inclusions_are_solved_by_iterations),
};

OST_TEST_MAIN(tests)
