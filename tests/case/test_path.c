/* SPDX-License-Identifier: BSD-3-Clause */
#include "case_text.h"

/* Paths and time tables as a case states them, and what is said about mistakes. */

#define CUBE "mesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}\n"
#define STEEL "materials: [{region: all, youngs_modulus: 2, poissons_ratio: 0.3, density: 1}]\n"
#define PATH CUBE STEEL "path: {steps: 4}\n"
#define LOAD(time) PATH "loads:\n  - {gravity: [0, 0, 1], time: " time "}\n"

static void a_path_has_its_outputs(void **state)
{
    OstCase *c = NULL;
    assert_success(read_text(PATH, &c));
    assert_int_equal(c->path_steps, 4);
    for (int i = 0; i < 4; i++)
        assert_true(c->path_times[i] == 0.25 * (i + 1));
    ost_case_destroy(&c);
    assert_success(read_text(CUBE STEEL "path: {times: [0, 0.2, 1]}\n", &c));
    assert_int_equal(c->path_steps, 3);
    assert_true(c->path_times[0] == 0.0 && c->path_times[1] == 0.2 && c->path_times[2] == 1.0);
    ost_case_destroy(&c);
    assert_success(read_text(CUBE STEEL, &c));
    assert_int_equal(c->path_steps, 0);
    assert_null(c->path_times);
    assert_null(c->tables);
    ost_case_destroy(&c);
}

static void equal_tables_are_one(void **state)
{
    OstCase *c = NULL;
    assert_success(read_text(PATH "constraints:\n"
                                  "  - {on: {boundary: xmin}, displacement: [0, 0, 0]}\n"
                                  "  - {on: {boundary: xmax}, displacement: [1, 0, 0], time: [[0, 0], [0.5, 2]]}\n"
                                  "loads:\n"
                                  "  - {gravity: [0, 0, 1]}\n"
                                  "  - {gravity: [0, 0, 1], time: [[0, 1]]}\n"
                                  "  - {body_force: [0, 1, 1], time: [[0, 0], [0.5, 2]]}\n",
                             &c));
    assert_int_equal(c->table_count, 2);
    assert_int_equal(c->constraints[0].table, 0);
    assert_int_equal(c->constraints[1].table, 1);
    assert_int_equal(c->loads[0].table, 0);
    assert_int_equal(c->loads[1].table, 2);
    assert_int_equal(c->loads[2].table, 1);
    ost_case_destroy(&c);
}

static void factors_lie_on_the_line_between_points(void **state)
{
    double time[] = {0.25, 0.5, 1.0}, factor[] = {2.0, 4.0, -1.0};
    const OstTimeTable table = {3, time, factor}, ramp = {0};
    assert_true(ost_time_factor(&table, 0.0) == 2.0 && ost_time_factor(&table, 0.25) == 2.0);
    assert_true(ost_time_factor(&table, 0.375) == 3.0 && ost_time_factor(&table, 0.5) == 4.0);
    assert_close(ost_time_factor(&table, 0.9), 0.0, 1e-15);
    assert_true(ost_time_factor(&table, 1.0) == -1.0 && ost_time_factor(&table, 7.0) == -1.0);
    assert_true(ost_time_factor(&ramp, 0.3) == 0.3 && ost_time_factor(&ramp, 2.0) == 2.0);
    /* before t = 0 what is there at t = 0 is brought up */
    assert_true(ost_time_factor(&table, -1.0) == 0.0 && ost_time_factor(&table, -0.25) == 1.5);
    assert_true(ost_time_factor(&ramp, -0.5) == 0.0);
}

static void mistakes_are_named(void **state)
{
    assert_refused(CUBE STEEL "path: {steps: 0}\n",
                   "3:15: path.steps: found '0', expected a whole number from 1 to ...");
    assert_refused(CUBE STEEL "path: {steps: 2, times: [1]}\n", "3:7: ...");
    assert_refused(CUBE STEEL "path: {times: []}\n",
                   "3:15: found no pseudo-time, expected at least one, as in [0.2, 0.5, 1]");
    assert_refused(CUBE STEEL "path: {times: [-1, 1]}\n", "3:16: a path begins at t = 0; found the earlier time -1");
    assert_refused(CUBE STEEL "path: {times: [0.5, 0.5]}\n", "3:21: times of a path ascend; found 0.5 after 0.5");
    assert_refused(LOAD("[]"), "5:32: loads[0].time: found a list of 0, expected a list of points [t, factor], ...");
    assert_refused(LOAD("[1, 2]"), "5:33: loads[0].time[0]: found '1', expected a list of 2 numbers");
    assert_refused(LOAD("[[0, 1], [0, 2]]"), "5:41: times of a table ascend; found 0 after 0");
    assert_refused(
        CUBE STEEL "loads:\n  - {gravity: [0, 0, 1], time: [[0, 1]]}\n",
        "4: 'time' has a meaning along a path only, and the case has none; add one, as in path: {steps: 10}");
    assert_refused(PATH "constraints:\n  - {on: {boundary: xmin}, displacement: [0, 0, free], time: [[0, 1]]}\n",
                   "5:62: 'time' belongs to a displacement other than zero; leave it out here");
    assert_refused(PATH "constraints:\n  - {on: {boundary: xmin}, slide: [0, 0, 1], time: [[0, 1]]}\n",
                   "5:52: 'time' belongs to a displacement other than zero; leave it out here");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_path_has_its_outputs),
    cmocka_unit_test(equal_tables_are_one),
    cmocka_unit_test(factors_lie_on_the_line_between_points),
    cmocka_unit_test(mistakes_are_named),
};

OST_TEST_MAIN(tests)
