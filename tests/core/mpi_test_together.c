/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/together/together.h"
#include "support.h"

/* Tasks that wait for the same are served together, whatever they did before; alone where there are none. */

enum { TASKS = 5 };

typedef struct Sums {
    int services, most;
    int at_once; /* so many may be served */
    OstStatus fails;
} Sums;

typedef struct Data {
    Sums *sums;
    double found[TASKS];
    OstStatus status[TASKS];
} Data;

/* OstServe: each number's square, summed over the ranks. */
static OstStatus square(void *common, int count, void *const *request)
{
    Sums *sums = common;
    sums->services++;
    sums->most = count > sums->most ? count : sums->most;
    for (int k = 0; k < count; k++) {
        double *number = request[k];
        *number *= *number;
        OST_TRY(ost_sum(ctx, 1, number));
    }
    return sums->fails == OST_SUCCESS ? OST_SUCCESS : OST_RAISE(ctx, sums->fails, "the service says no");
}

/* Task k asks k + 1 times. */
static void ask(void *data, int number)
{
    Data *all = data;
    assert_true(ost_together_any(ctx));
    for (int k = 0; k <= number && all->status[number] == OST_SUCCESS; k++) {
        double value = number + k;
        ost_ledger_enter(ctx, OST_LEDGER_CHECKS);
        all->status[number] = ost_together(ctx, square, all->sums->at_once, all->sums, &value);
        ost_ledger_leave(ctx);
        all->found[number] += value;
    }
    if (all->status[number] != OST_SUCCESS)
        assert_non_null(strstr(ost_error_text(ctx), "the service says no"));
}

static void ask_five_times(void *data, int number)
{
    Data *all = data;
    for (int k = 0; k < TASKS && all->status[number] == OST_SUCCESS; k++) {
        double value = number;
        all->status[number] = ost_together(ctx, square, all->sums->at_once, all->sums, &value);
        all->found[number] += value;
    }
}

static void requests_of_one_kind_are_served_at_once(void **state)
{
    Sums sums = {.at_once = TASKS};
    Data data = {.sums = &sums};
    assert_success(ost_together_run(ctx, TASKS, ask, &data));
    assert_false(ost_together_any(ctx));
    assert_int_equal(sums.services, TASKS);
    assert_int_equal(sums.most, TASKS);
    for (int n = 0; n < TASKS; n++) {
        double expected = 0.0;
        for (int k = 0; k <= n; k++)
            expected += (double)((n + k) * (n + k)) * ost_size(ctx);
        assert_success(data.status[n]);
        assert_close(data.found[n], expected, 1e-12);
    }
}

/* 25 requests by threes: two that are left over do not go by themselves, but with the first that comes back. */
static void what_a_full_service_leaves_waits_for_more(void **state)
{
    Sums sums = {.at_once = 3};
    Data data = {.sums = &sums};
    assert_success(ost_together_run(ctx, TASKS, ask_five_times, &data));
    assert_int_equal(sums.most, 3);
    assert_int_equal(sums.services, (TASKS * TASKS + 2) / 3);
    for (int n = 0; n < TASKS; n++) {
        assert_success(data.status[n]);
        assert_close(data.found[n], TASKS * n * n * ost_size(ctx), 1e-12);
    }
}

enum { MANY = 10, STEPS = 3 };

/* Two kinds in turn, of which eight are served at once. */
static void ask_in_turn(void *sums, int number)
{
    double value = number;
    for (int k = 0; k < 2 * STEPS; k++)
        assert_success(ost_together(ctx, square, 8, (Sums *)sums + k % 2, &value));
}

/* 30 requests of each kind: who waited for a place goes before those who have gone ahead, so that as few services as
 * can be suffice, and none is for two. */
static void tasks_stay_in_step(void **state)
{
    (void)state;
    Sums sums[2] = {{0}, {0}};
    assert_success(ost_together_run(ctx, MANY, ask_in_turn, sums));
    assert_int_equal(sums[0].services, (MANY * STEPS + 7) / 8);
    assert_int_equal(sums[0].most, 8);
}

/* Task k asks k + 1 times, gathers, and asks for something else, which begins alike for all; the last is over before.
 */
static void ask_and_gather(void *data, int number)
{
    Data *all = data;
    double value = 1.0;
    ask(data, number);
    if (number == TASKS - 1)
        return;
    ost_together_gather(ctx);
    all->status[number] = ost_together(ctx, square, TASKS, all->sums + 1, &value);
}

static void those_that_gather_go_on_together(void **state)
{
    (void)state;
    Sums sums[2] = {{.at_once = TASKS}, {.at_once = TASKS}};
    Data data = {.sums = sums};
    assert_success(ost_together_run(ctx, TASKS, ask_and_gather, &data));
    assert_int_equal(sums[0].services, TASKS);
    assert_int_equal(sums[1].services, 1);
    assert_int_equal(sums[1].most, TASKS - 1);
    ost_together_gather(ctx); /* outside there is nobody to wait for */
}

static void a_failure_reaches_all_that_were_served(void **state)
{
    Sums sums = {.at_once = TASKS, .fails = OST_NOT_CONVERGED};
    Data data = {.sums = &sums};
    assert_success(ost_together_run(ctx, TASKS, ask, &data));
    for (int n = 0; n < TASKS; n++)
        assert_int_equal(data.status[n], OST_NOT_CONVERGED);
}

static void outside_of_tasks_a_request_is_served_alone(void **state)
{
    Sums sums = {0};
    double value = 3.0;
    assert_success(ost_together(ctx, square, TASKS, &sums, &value));
    assert_close(value, 9.0 * ost_size(ctx), 1e-12);
    assert_int_equal(sums.most, 1);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(requests_of_one_kind_are_served_at_once),
    cmocka_unit_test(what_a_full_service_leaves_waits_for_more),
    cmocka_unit_test(tasks_stay_in_step),
    cmocka_unit_test(those_that_gather_go_on_together),
    cmocka_unit_test(a_failure_reaches_all_that_were_served),
    cmocka_unit_test(outside_of_tasks_a_request_is_served_alone),
};

OST_TEST_MAIN(tests)
