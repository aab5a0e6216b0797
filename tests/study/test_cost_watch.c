/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/case_text.h"

static void watched(const char *text, OstCase **c)
{
    char whole[1024];
    snprintf(whole, sizeof whole, "%s%swatch: %s\n", cube, steel, text);
    assert_success(read_text(whole, c));
}

static void refused(const char *text, const char *expected)
{
    char whole[1024];
    snprintf(whole, sizeof whole, "%s%swatch: %s\n", cube, steel, text);
    assert_refused(whole, expected);
}

static void watches_are_read(void **state)
{
    OstCase *c = NULL;
    watched("{tip: {displacement: {nearest: [1, 0.5, 0]}, component: y}, e: strain_energy, "
            "held: {reaction: {boundary: xmin}}}",
            &c);
    assert_int_equal(c->watch_count, 3);
    assert_string_equal(c->watches[0].name, "tip");
    assert_int_equal(c->watches[0].kind, OST_WATCH_DISPLACEMENT);
    assert_int_equal(c->watches[0].on.kind, OST_SELECT_NEAREST);
    assert_close(c->watches[0].on.point[1], 0.5, 0.0);
    assert_int_equal(c->watches[0].component, 1);
    assert_int_equal(c->watches[1].kind, OST_WATCH_STRAIN_ENERGY);
    assert_int_equal(c->watches[2].kind, OST_WATCH_REACTION);
    assert_string_equal(c->watches[2].on.boundaries.name[0], "xmin");
    assert_int_equal(c->watches[2].component, OST_WATCH_LENGTH);
    assert_int_equal(c->watches[2].line, 3);
    ost_case_destroy(&c);
}

static void what_a_formula_expects_is_read(void **state)
{
    OstCase *c = NULL;
    watched("{tip: {displacement: {nearest: [1, 0, 0]}, expected: -1.5e-3, source: Timoshenko §41}, "
            "held: {reaction: {boundary: xmin}, expected: 2}, "
            "work: {strain_energy: all, expected: 0.25}, e: {strain_energy: all}, short: strain_energy}",
            &c);
    assert_int_equal(c->watch_count, 5);
    assert_close(c->watches[0].expected, -1.5e-3, 0.0);
    assert_string_equal(c->watches[0].source, "Timoshenko §41");
    assert_close(c->watches[1].expected, 2.0, 0.0);
    assert_null(c->watches[1].source);
    assert_int_equal(c->watches[2].kind, OST_WATCH_STRAIN_ENERGY);
    assert_close(c->watches[2].expected, 0.25, 0.0);
    for (int w = 3; w < 5; w++) {
        assert_int_equal(c->watches[w].kind, OST_WATCH_STRAIN_ENERGY);
        assert_true(isnan(c->watches[w].expected));
        assert_null(c->watches[w].source);
    }
    ost_case_destroy(&c);
}

static void wrong_expectations_are_refused_where_they_stand(void **state)
{
    refused("{e: {strain_energy: all, expected: much}}", "3:43: watch.e.expected: ...");
    refused("{e: {strain_energy: all, expected: .nan}}", "3:43: watch.e.expected: ...");
    refused("{e: {strain_energy: all, source: a book}}", "3:41: found a source but no value...");
    refused("{e: {strain_energy: half}}", "3:28: unknown strain_energy 'half'; did you mean 'all'?...");
    refused("{e: {strain_energy: all, component: x}}", "3:44: the strain energy has no component...");
    refused("{e: {expected: 1}}", "3:12: watch.e has none of displacement, reaction...");
}

static void wrong_watches_are_refused_where_they_stand(void **state)
{
    refused("[tip]", "3:8: watch: found a list of 1, expected a name for each quantity...");
    refused("{tip: stress}", "3:14: watch.tip: found 'stress', expected strain_energy...");
    refused("{tip: {displacement: {boundary: xmin}}}", "3:29: a displacement is taken at one vertex...");
    refused("{tip: {component: x}}", "3:14: watch.tip has none of displacement, reaction...");
    refused("{tip: {displacement: {nearest: [1, 0, 0]}, component: w}}", "3:62: ...");
    refused("{tip: {displacment: {nearest: [1, 0, 0]}}}", "3:15: unknown key 'displacment' in watch.tip...");
    refused("{tip: strain_energy, tip: strain_energy}",
            "3:29: quantity 'tip' occurs twice, the first time in line 3...");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(watches_are_read),
    cmocka_unit_test(what_a_formula_expects_is_read),
    cmocka_unit_test(wrong_expectations_are_refused_where_they_stand),
    cmocka_unit_test(wrong_watches_are_refused_where_they_stand),
};

OST_TEST_MAIN(tests)
