/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/case_text.h"
#include "case/verify.h"

/* How the verify section of a case, and the word exact, are read and refused. */

static OstCase *c;

static void section(const char *rest, char *whole, size_t size)
{
    snprintf(whole, size, "%s%sverify:\n  formula: flexure\n  source: a book\n%s", cube, steel, rest);
}

static void a_section_is_read_as_it_stands(void **state)
{
    char whole[2048];
    section(
        "  parameters: {force: 2, length: -1e3}\n"
        "  ladder: [{order: 1, refinements: [1, 2, 3], quick: 2}, {order: 2, refinements: [0]}]\n"
        "  quantities:\n"
        "    tip: {displacement: [0, 0, 2], on: {boundary: xmax}, expected: tip_deflection, error: [0.1, 1e-3], "
        "rate: [1.9, locks]}\n"
        "    hoop: {stress: hoop, on: {boundary: xmin}, expected: -3.5, scale: 2, error: [1, 1], rate: [exact, 2]}\n"
        "    all: {field: energy, error: [1, 1], rate: [1, 2]}\n",
        whole, sizeof whole);
    assert_success(read_text(whole, &c));
    const OstVerify *verify = c->verify;
    assert_string_equal(verify->formula, "flexure");
    assert_string_equal(verify->source, "a book");
    assert_int_equal(verify->parameter_count, 2);
    assert_string_equal(verify->parameter_name[1], "length");
    assert_close(verify->parameter[1], -1000.0, 0.0);
    assert_int_equal(verify->step_count, 2);
    assert_int_equal(verify->step[0].level_count, 3);
    assert_int_equal(verify->step[0].quick_count, 2);
    assert_int_equal(verify->step[0].refinement[2], 3);
    assert_int_equal(verify->step[1].quick_count, 1);
    assert_int_equal(verify->quantity_count, 3);
    const OstVerifyQuantity *tip = &verify->quantity[0], *hoop = &verify->quantity[1], *all = &verify->quantity[2];
    assert_int_equal(tip->kind, OST_MEASURE_DISPLACEMENT);
    assert_close(tip->direction[2], 1.0, 1e-15);
    assert_string_equal(tip->expected_name, "tip_deflection");
    assert_close(tip->error[1], 1e-3, 0.0);
    assert_close(tip->rate[0], 1.9, 0.0);
    assert_close(tip->rate[1], OST_RATE_LOCKED, 0.0);
    assert_int_equal(hoop->component, OST_STRESS_HOOP);
    assert_null(hoop->expected_name);
    assert_close(hoop->expected, -3.5, 0.0);
    assert_close(hoop->scale, 2.0, 0.0);
    assert_true(isnan(hoop->rate[0]));
    assert_int_equal(all->norm, OST_NORM_ENERGY);
    ost_case_destroy(&c);
}

static void a_quantitys_vertex_list_is_read_with_the_case(void **state)
{
    char whole[2048];
    section("  ladder: [{order: 1, refinements: [1]}]\n"
            "  quantities:\n"
            "    tip: {displacement: [0, 0, 2], on: {vertices: nowhere.bou}, expected: 1, error: [1], rate: [1]}\n",
            whole, sizeof whole);
    assert_failure(read_text(whole, &c), OST_FILE_FAILED, "nowhere.bou");
    assert_null(c);
}

static void the_word_exact_is_read(void **state)
{
    char whole[1024];
    snprintf(whole, sizeof whole,
             "%s%sconstraints:\n  - {on: {boundary: xmin}, displacement: exact}\n"
             "  - {on: {boundary: xmax}, displacement: [exact, free, 2]}\n"
             "loads:\n  - {on: {boundary: ymin}, traction: exact}\n  - {body_force: exact}\n",
             cube, steel);
    assert_success(read_text(whole, &c));
    for (int i = 0; i < 3; i++)
        assert_true(c->constraints[0].constrained[i] && c->constraints[0].exact[i]);
    assert_true(c->constraints[1].constrained[0] && c->constraints[1].exact[0]);
    assert_false(c->constraints[1].constrained[1] || c->constraints[1].exact[1] || c->constraints[1].exact[2]);
    assert_close(c->constraints[1].displacement[2], 2.0, 0.0);
    assert_true(c->loads[0].exact && c->loads[1].exact);
    ost_case_destroy(&c);
}

static void refuse(const char *rest, const char *expected)
{
    char whole[2048];
    section(rest, whole, sizeof whole);
    assert_refused(whole, expected);
}

static void mistakes_are_named(void **state)
{
    refuse("  ladder: [{order: 1, refinements: [0, 2]}]\n  quantities: {}\n",
           "6:40: found refinement 2 after 0, expected 1: each mesh halves the last");
    refuse("  ladder: [{order: 3, refinements: [0]}]\n  quantities: {}\n",
           "6:20: verify.ladder[0].order: found '3', expected a whole number from 1 to 2");
    refuse(
        "  ladder: [{order: 1, refinements: [0]}]\n  quantities:\n    a: {field: energy, error: [1, 2], rate: [1]}\n",
        "8:31: found 2 limits, expected 1: one for each step of the ladder");
    refuse(
        "  ladder: [{order: 1, refinements: [0]}]\n  quantities:\n    a: {stress: xx, expected: 1, error: [1], rate: "
        "[1]}\n",
        "8:8: 'stress' needs 'on': where it is measured");
    refuse("  ladder: [{order: 1, refinements: [0]}]\n  quantities:\n    a: {energy: strain, error: [1], rate: [1]}\n",
           "8:8: 'energy' needs 'expected': a value of the formula by name, or a number");
    refuse("  ladder: [{order: 1, refinements: [0]}]\n  quantities:\n    a: {field: energy, expected: 1, error: [1], "
           "rate: [1]}\n",
           "8:8: 'field' is compared with the formula's field, and has no 'expected' or 'scale'");
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_section_is_read_as_it_stands),
    cmocka_unit_test(a_quantitys_vertex_list_is_read_with_the_case),
    cmocka_unit_test(the_word_exact_is_read),
    cmocka_unit_test(mistakes_are_named),
};

OST_TEST_MAIN(tests)
