/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/yaml/tree.h"
#include "case_text.h"

static void text_that_is_not_yaml_is_refused_with_its_place(void **state)
{
    assert_refused("", "1:1: the file is empty; a case needs a mesh at least");
    assert_refused("# only a comment\n", "1:1: the file is empty; a case needs a mesh at least");
    assert_refused("mesh: {block\n", "2:1: not YAML: ...");
    assert_refused("title: a beam: the first\n", "1:14: not YAML: mapping values are not allowed in this context (a "
                                                 "colon within a text? put the text between quotes)");
    assert_refused("mesh:\n\tblock: 1\n",
                   "2:1: not YAML: while scanning for the next token, found character that cannot "
                   "start any token (a tab? YAML indents by blanks)");
    assert_refused("mesh: 1\n---\nmesh: 2\n", "2:1: a second document; a file holds one case");
    assert_refused("title: \"a\\0b\"\n", "1:8: a zero byte within a text; take it out");
    assert_refused("title: *a\n", "1:8: an alias (*name) to an anchor (&name) that is not there before it");
    assert_refused("title: &a [*a]\n", "1:12: an alias (*name) within the value it stands for");
    assert_refused("title: \xff\xfe\n", "1:8: not text in UTF-8: ...");
    assert_refused("[1]: 2\n", "1:1: found a list or mapping, expected a key");
}

static void nesting_is_limited(void **state)
{
    char deep[100001];
    memset(deep, '[', sizeof deep - 1);
    deep[sizeof deep - 1] = 0;
    assert_refused(deep, "1:33: nested more than 32 deep; no case is");
}

/* Each level doubles the one before; written out it would be 2^60 values. */
static void aliases_cannot_multiply_a_file(void **state)
{
    char bomb[4096] = "a0: &a0 [1]\n";
    for (int level = 1; level < 60; level++)
        snprintf(bomb + strlen(bomb), sizeof bomb - strlen(bomb), "a%d: &a%d [*a%d, *a%d]\n", level, level, level - 1,
                 level - 1);
    assert_refused(bomb, "12:12: more values than a file of this size can state; use fewer aliases");
}

/* Peak memory of reading files that are nothing but structure, against their size. */
static void memory_stays_under_ten_times_the_input(void **state)
{
    enum { SIZE = 1 << 20 };
    static const char *const patterns[] = {"[1,1,1,1,1,1,1,1,",
                                           "- - - - -\n",
                                           "a: {b: c}\n",
                                           "[0.25, 100, 1000000, ",
                                           "{a,b,c,d,",
                                           "\"\\L\\L\\L\", ",
                                           "? ? ? ?\n",
                                           "&a b\n- ",
                                           "x"};
    char *text = malloc(SIZE);
    assert_non_null(text);
    for (size_t p = 0; p < sizeof patterns / sizeof *patterns; p++) {
        const size_t length = strlen(patterns[p]);
        text[0] = '[';
        for (size_t i = 1; i < SIZE; i++)
            text[i] = patterns[p][i % length];
        OstYaml *yaml = NULL;
        const size_t before = ost_ledger_peak_bytes(ctx);
        const double start = ost_seconds();
        (void)ost_yaml_parse(ctx, "pattern", text, SIZE, &yaml);
        ost_yaml_destroy(&yaml);
        assert_true(ost_ledger_peak_bytes(ctx) < before + 10 * (size_t)SIZE);
        assert_true(ost_seconds() - start < 20.0);
    }
    free(text);
}

/* Every prefix and every single changed byte of a good case is read or refused; nothing else. */
static void damaged_cases_never_do_worse_than_fail(void **state)
{
    static const char good[] =
        "mesh: {tube: {axis: y, length: 10, radii: [0.9, 1.5], divisions: {around: 60, radial: 6, axial: 60}}}\n"
        "materials:\n  - region: all\n    youngs_modulus: [1e6, 1e9, 1e6]\n    poissons_ratio: 0.3\n"
        "    axes: {cylindrical: {origin: [0, 0, 0], axis: [0, 1, 0], order: [axial, radial, tangential]}}\n"
        "constraints:\n  - {on: {boundary: &b ends}, displacement: [0, free, 0]}\n"
        "loads:\n  - {on: {boundary: *b}, total_force: [1, 0, 0]}\n";
    char text[sizeof good];
    OstCase *c = NULL;
    for (size_t length = 0; length < sizeof good - 1; length++) {
        const OstStatus status = read_bytes_of(good, length, &c);
        assert_true(status == OST_SUCCESS || status == OST_INVALID_INPUT);
        assert_true((status == OST_SUCCESS) == (c != NULL));
        ost_case_destroy(&c);
    }
    static const char replacements[] = {'[', '}', ':', '\n', '*', '"', '\t', '\xc3', 0};
    for (size_t at = 0; at < sizeof good - 1; at++)
        for (size_t r = 0; r < sizeof replacements; r++) {
            memcpy(text, good, sizeof good);
            text[at] = replacements[r];
            const OstStatus status = read_bytes_of(text, sizeof good - 1, &c);
            assert_true(status == OST_SUCCESS || status == OST_INVALID_INPUT);
            ost_case_destroy(&c);
        }
}

static void a_byte_order_mark_is_no_part_of_the_case(void **state)
{
    char text[512];
    OstCase *c = NULL;
    snprintf(text, sizeof text, "\xef\xbb\xbf%s%s", cube, steel);
    assert_success(read_text(text, &c));
    ost_case_destroy(&c);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(text_that_is_not_yaml_is_refused_with_its_place),
    cmocka_unit_test(nesting_is_limited),
    cmocka_unit_test(aliases_cannot_multiply_a_file),
    cmocka_unit_test(memory_stays_under_ten_times_the_input),
    cmocka_unit_test(damaged_cases_never_do_worse_than_fail),
    cmocka_unit_test(a_byte_order_mark_is_no_part_of_the_case),
};

OST_TEST_MAIN(tests)
