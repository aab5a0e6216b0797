/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/trilinos/cycle.h"
#include "support.h"

enum { LEVELS = 4 };

/* A = a I on every level, with one unknown a rank less than on the level before; transfers that copy; smoothers that do
 * nothing but on the last level, which solves. What the cycle makes of the first unknown can then be written down. */
typedef struct Scalar {
    double a;
    int unknowns;
    int is_last;
    int visits;
    OstStatus failure; /* of `multiply` */
} Scalar;

static OstStatus multiply(void *data, const double *x, double *y)
{
    const Scalar *level = data;
    for (int i = 0; i < level->unknowns; i++)
        y[i] = level->a * x[i];
    return level->failure;
}

static OstStatus smooth(void *data, const double *b, double *x, int from_zero)
{
    Scalar *level = data;
    level->visits++;
    for (int i = 0; i < level->unknowns; i++)
        x[i] = level->is_last ? b[i] / level->a : from_zero ? 0.0 : x[i];
    return OST_SUCCESS;
}

static OstStatus restrict_to(void *data, const double *fine, double *coarse)
{
    const Scalar *level = data;
    memcpy(coarse, fine, (size_t)(level->unknowns - 1) * sizeof *coarse);
    return OST_SUCCESS;
}

static OstStatus prolong(void *data, const double *coarse, double *fine)
{
    const Scalar *level = data;
    memcpy(fine, coarse, (size_t)(level->unknowns - 1) * sizeof *fine);
    fine[level->unknowns - 1] = 0.0;
    return OST_SUCCESS;
}

static OstMlCycle *new_cycle(Scalar *scalar)
{
    OstMlLevel level[LEVELS];
    OstMlCycle *cycle = NULL;
    for (int l = 0; l < LEVELS; l++) {
        scalar[l].unknowns = LEVELS - l;
        level[l] = (OstMlLevel){.data = &scalar[l],
                                .unknowns = scalar[l].unknowns,
                                .multiply = multiply,
                                .smooth = smooth,
                                .restrict_to = restrict_to,
                                .prolong = prolong};
    }
    assert_success(ost_ml_cycle_create(ctx, LEVELS, level, &cycle));
    return cycle;
}

static void every_level_between_is_visited_twice_with_fixed_weights(void **state)
{
    Scalar scalar[LEVELS] = {{.a = 2.0}, {.a = 1.1}, {.a = 0.9}, {.a = 1.25, .is_last = 1}};
    OstMlCycle *cycle = new_cycle(scalar);
    double r[LEVELS] = {-2.0, 1.0, 3.5, 0.5}, z[LEVELS];
    double b = 1.0 / scalar[LEVELS - 1].a; /* one cycle on the level before */
    for (int l = LEVELS - 2; l > 0; l--)
        b = b + 2.25 * b * (1.0 - scalar[l].a * b);
    for (int time = 0; time < 2; time++) {
        assert_success(ost_ml_cycle_apply(cycle, 0, r, z));
        assert_close(z[0], b * r[0], 1e-14);
    }
    assert_int_equal(scalar[0].visits, 2 * 2);     /* before and after */
    assert_int_equal(scalar[1].visits, 2 * 2 * 2); /* in each of two visits */
    assert_int_equal(scalar[3].visits, 2 * 4);     /* once in each visit to the level above */
    ost_ml_cycle_destroy(&cycle);
    assert_null(cycle);
}

static void half_a_cycle_smooths_the_finest_level_once_and_visits_the_others_once(void **state)
{
    Scalar scalar[LEVELS] = {{.a = 2.0}, {.a = 1.1}, {.a = 0.9}, {.a = 1.25, .is_last = 1}};
    OstMlCycle *cycle = new_cycle(scalar);
    double r[LEVELS] = {-2.0, 1.0, 3.5, 0.5}, whole[LEVELS], half[LEVELS];
    assert_success(ost_ml_cycle_apply(cycle, 0, r, whole));
    assert_success(ost_ml_cycle_apply(cycle, 1, r, half));
    assert_close(half[0], r[0] / scalar[LEVELS - 1].a, 1e-14);
    assert_int_equal(scalar[0].visits, 2 + 1);
    assert_int_equal(scalar[1].visits, 2 * 2 + 2);
    assert_int_equal(scalar[3].visits, 4 + 1);
    const double before = whole[0];
    assert_success(ost_ml_cycle_apply(cycle, 0, r, whole));
    assert_close(whole[0], before, 1e-14);
    assert_int_equal(scalar[0].visits, 2 + 1 + 2);
    assert_int_equal(scalar[3].visits, 4 + 1 + 4);
    ost_ml_cycle_destroy(&cycle);
}

static void a_failure_inside_comes_back(void **state)
{
    Scalar scalar[LEVELS] = {
        {.a = 2.0}, {.a = 1.1}, {.a = 0.9, .failure = OST_LIBRARY_FAILED}, {.a = 1.0, .is_last = 1}};
    OstMlCycle *cycle = new_cycle(scalar);
    double r[LEVELS] = {1.0, 1.0, 1.0, 1.0}, z[LEVELS];
    assert_int_equal(ost_ml_cycle_apply(cycle, 0, r, z), OST_LIBRARY_FAILED);
    ost_ml_cycle_destroy(&cycle);
}

/* ML would end the process. */
static void a_level_that_is_no_smaller_is_refused(void **state)
{
    Scalar scalar[2] = {{.a = 2.0, .unknowns = 2}, {.a = 1.0, .unknowns = 2, .is_last = 1}};
    OstMlLevel level[2];
    OstMlCycle *cycle = NULL;
    for (int l = 0; l < 2; l++)
        level[l] = (OstMlLevel){.data = &scalar[l], .unknowns = 2, .multiply = multiply, .smooth = smooth};
    assert_failure(ost_ml_cycle_create(ctx, 2, level, &cycle), OST_LIMIT_EXCEEDED, "no fewer");
    assert_null(cycle);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(every_level_between_is_visited_twice_with_fixed_weights),
    cmocka_unit_test(half_a_cycle_smooths_the_finest_level_once_and_visits_the_others_once),
    cmocka_unit_test(a_failure_inside_comes_back),
    cmocka_unit_test(a_level_that_is_no_smaller_is_refused),
};

OST_TEST_MAIN(tests)
