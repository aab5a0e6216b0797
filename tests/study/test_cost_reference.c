/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/cost_reference.h"
#include "support.h"

/* q(h) = limit + c h^rate */
static void fill(const double *h, int count, double limit, double c, double rate, double *q)
{
    for (int i = 0; i < count; i++)
        q[i] = limit + c * pow(h[i], rate);
}

static void a_power_law_is_found_exactly(void **state)
{
    const double rates[] = {0.5, 1.0, 1.8, 2.0, 4.0};
    const double h[3] = {1.0, 0.5, 0.25};
    for (int i = 0; i < 5; i++)
        for (int sign = -1; sign <= 1; sign += 2) {
            double q[3];
            OstExtrapolation found;
            fill(h, 3, -0.7, sign * 0.3, rates[i], q);
            assert_true(ost_extrapolate(h, q, &found));
            assert_close(found.rate, rates[i], 1e-9);
            assert_close(found.limit, -0.7, 1e-11);
        }
}

static void steps_of_refinement_may_differ(void **state)
{
    const double h[3] = {1.0, 0.5, 0.125};
    double q[3];
    OstExtrapolation found;
    fill(h, 3, 2.0, 5.0, 1.5, q);
    assert_true(ost_extrapolate(h, q, &found));
    assert_close(found.rate, 1.5, 1e-10);
    assert_close(found.limit, 2.0, 1e-11);
}

static void what_does_not_tend_anywhere_has_no_limit(void **state)
{
    const double h[3] = {1.0, 0.5, 0.25};
    OstExtrapolation found;
    assert_false(ost_extrapolate(h, (const double[]){1.0, 2.0, 3.0}, &found)); /* log h */
    assert_false(ost_extrapolate(h, (const double[]){1.0, 2.0, 4.0}, &found)); /* 1 / h */
    assert_false(ost_extrapolate(h, (const double[]){1.0, 2.0, 1.5}, &found)); /* changes sign */
    assert_false(ost_extrapolate(h, (const double[]){1.0, 2.0, 2.0}, &found));
    assert_false(ost_extrapolate(h, (const double[]){2.0, 2.0, 2.0}, &found));
}

static OstCostReference reference_of(int order, int count, const double *value)
{
    static const int refinement[] = {0, 1, 2, 3, 4};
    const OstAnswers answers = {
        .order = order, .count = count, .refinement = refinement, .value = value, .noise = 1e-7, .scale = 1.0};
    OstCostReference reference;
    ost_reference_of(&answers, &reference);
    return reference;
}

static void a_sensible_rate_is_extrapolated(void **state)
{
    const double h[4] = {1.0, 0.5, 0.25, 0.125};
    double q[4];
    fill(h, 4, 3.0, 1.0, 2.0, q);
    q[0] = 17.0; /* only the last three count */
    const OstCostReference found = reference_of(1, 4, q);
    assert_int_equal(found.kind, OST_REFERENCE_EXTRAPOLATED);
    assert_close(found.value, 3.0, 1e-11);
    assert_close(found.rate, 2.0, 1e-9);
    assert_close(found.size, 3.0, 1e-11);
    assert_close(found.uncertainty, 1.0 / 64.0 / 3.0, 2e-7); /* what it was moved by, and the noise */
    assert_int_equal(found.finest, 3);
}

static void a_rate_beyond_the_order_is_not_believed(void **state)
{
    const double h[3] = {1.0, 0.5, 0.25};
    double q[3];
    fill(h, 3, 3.0, 1.0, 3.9, q);
    assert_int_equal(reference_of(2, 3, q).kind, OST_REFERENCE_EXTRAPOLATED);
    const OstCostReference found = reference_of(1, 3, q);
    assert_int_equal(found.kind, OST_REFERENCE_FINEST);
    assert_close(found.value, q[2], 0.0);
    assert_close(found.uncertainty, fabs(q[1] - q[0]) / q[2], 1e-12);
    fill(h, 3, 3.0, 1.0, 0.2, q);
    assert_int_equal(reference_of(2, 3, q).kind, OST_REFERENCE_FINEST);
}

/* A least load factor that a singular stress lowers without end. */
static void what_is_positive_has_no_negative_limit(void **state)
{
    static const int refinement[] = {0, 1, 2};
    const double value[] = {1.0, 0.6, 0.3}; /* tend to -0.6, at a rate of 0.415 */
    OstAnswers answers = {.order = 1, .count = 3, .refinement = refinement, .value = value, .scale = 1.0};
    OstCostReference found;
    ost_reference_of(&answers, &found);
    assert_int_equal(found.kind, OST_REFERENCE_EXTRAPOLATED);
    assert_close(found.value, -0.6, 1e-11);
    answers.positive = 1;
    ost_reference_of(&answers, &found);
    assert_int_equal(found.kind, OST_REFERENCE_FINEST);
    assert_close(found.value, 0.3, 0.0);
    assert_close(found.uncertainty, 0.4, 1e-12); /* more than the value: a share of the scale */
    assert_non_null(strstr(found.note, "no rate to extrapolate by"));
}

static void growing_differences_are_called_so(void **state)
{
    const OstCostReference found = reference_of(1, 3, (const double[]){1.0, 2.0, 4.0});
    assert_int_equal(found.kind, OST_REFERENCE_FINEST);
    assert_true(isinf(found.uncertainty));
    assert_non_null(strstr(found.note, "no limit"));
}

static void few_answers_say_how_little_they_know(void **state)
{
    assert_int_equal(reference_of(1, 0, NULL).kind, OST_REFERENCE_NONE);
    const OstCostReference one = reference_of(1, 1, (const double[]){2.0});
    assert_int_equal(one.kind, OST_REFERENCE_FINEST);
    assert_true(isinf(one.uncertainty));
    const OstCostReference two = reference_of(1, 2, (const double[]){2.2, 2.0});
    assert_int_equal(two.kind, OST_REFERENCE_FINEST);
    assert_close(two.uncertainty, 0.1, 1e-14);
}

static void an_answer_that_stays_is_the_reference(void **state)
{
    const OstCostReference found = reference_of(1, 2, (const double[]){2.0 + 1e-9, 2.0});
    assert_int_equal(found.kind, OST_REFERENCE_SETTLED);
    assert_close(found.uncertainty, 1e-7, 1e-12);
}

static void errors_of_nothing_are_shares_of_its_scale(void **state)
{
    const OstCostReference tiny = reference_of(1, 3, (const double[]){4e-8, 1e-8, 0.0});
    assert_close(tiny.size, 1.0, 0.0);
    /* tends to 0 as h²: whatever is left of it is lost in the doubt */
    const OstCostReference vanishing = reference_of(1, 3, (const double[]){0.16 + 1e-5, 0.04 + 1e-5, 0.01 + 1e-5});
    assert_int_equal(vanishing.kind, OST_REFERENCE_EXTRAPOLATED);
    assert_close(vanishing.size, 1.0, 0.0);
    assert_close(vanishing.uncertainty, 0.01, 1e-6);
}

static void a_formula_is_exact(void **state)
{
    OstCostReference found;
    ost_reference_of_formula(-0.25, 3.0, &found);
    assert_int_equal(found.kind, OST_REFERENCE_FORMULA);
    assert_string_equal(ost_reference_kind_word[found.kind], "formula");
    assert_close(found.value, -0.25, 0.0);
    assert_close(found.size, 0.25, 0.0);
    assert_close(found.uncertainty, 0.0, 0.0);
    ost_reference_of_formula(0.0, 3.0, &found);
    assert_close(found.value, 0.0, 0.0);
    assert_close(found.size, 3.0, 0.0);
}

/* An error of 1 is 0.66 to 1.05 of the true one. */
static void an_estimate_replaces_what_is_less_certain(void **state)
{
    OstCostReference found = {.kind = OST_REFERENCE_FINEST, .value = 98.0, .size = 98.0, .uncertainty = 0.004};
    ost_reference_improve(99.0, 1.0, 3, &found);
    assert_int_equal(found.kind, OST_REFERENCE_FINEST);
    found.uncertainty = 0.006;
    ost_reference_improve(99.0, 1.0, 3, &found);
    assert_int_equal(found.kind, OST_REFERENCE_ESTIMATED);
    assert_string_equal(ost_reference_kind_word[found.kind], "estimated");
    assert_int_equal(found.run, 3);
    assert_close(found.value, 100.0, 0.0);
    assert_close(found.uncertainty, 0.005, 1e-15);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_power_law_is_found_exactly),
    cmocka_unit_test(steps_of_refinement_may_differ),
    cmocka_unit_test(what_does_not_tend_anywhere_has_no_limit),
    cmocka_unit_test(a_sensible_rate_is_extrapolated),
    cmocka_unit_test(a_rate_beyond_the_order_is_not_believed),
    cmocka_unit_test(what_is_positive_has_no_negative_limit),
    cmocka_unit_test(growing_differences_are_called_so),
    cmocka_unit_test(few_answers_say_how_little_they_know),
    cmocka_unit_test(an_answer_that_stays_is_the_reference),
    cmocka_unit_test(errors_of_nothing_are_shares_of_its_scale),
    cmocka_unit_test(a_formula_is_exact),
    cmocka_unit_test(an_estimate_replaces_what_is_less_certain),
};

OST_TEST_MAIN(tests)
