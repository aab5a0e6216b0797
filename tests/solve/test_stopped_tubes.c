/* SPDX-License-Identifier: BSD-3-Clause */
#include "stopped.h"

/* The paper's four tubes: the stop saves two fifths of the iterations to 1e-8 at the least. */
static void the_stop_saves_most_iterations_of_the_papers_tubes(void **state)
{
    static const char *const scenes[] = {"isotropic", "longitudinal", "radial", "tangential"};
    const char *source = getenv("ORTHOSTAT_SOURCE");
    assert_non_null(source);
    for (int s = 0; s < 4; s++) {
        char path[1024];
        OstCase *c = NULL;
        Stopped stopped;
        snprintf(path, sizeof path, "%s/cases/tube/%s.yaml", source, scenes[s]);
        assert_success(ost_case_read(ctx, path, &c));
        solve_twice(c, NULL, &stopped);
        assert_honest(&stopped);
        const OstSolveReport *report = &stopped.result->solve;
        const double saved = 0.8 * stopped.whole->solve.iterations - report->iterations; /* 1e-8 takes 4/5 of 1e-10 */
        if (!(saved >= 0.4 * 0.8 * stopped.whole->solve.iterations))
            fail_msg("%s: %d iterations of %d", scenes[s], report->iterations, stopped.whole->solve.iterations);
        assert_true(report->iterations_saved > 0.5 * saved && report->iterations_saved < 2.0 * saved);
        destroy(&stopped);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_stop_saves_most_iterations_of_the_papers_tubes),
};

OST_TEST_MAIN(tests)
