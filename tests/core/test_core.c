/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/json_file.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"
#include "core/small.h"
#include "support.h"

static void memory_is_booked_and_released(void **state)
{
    double *values = NULL;
    ost_ledger_enter(ctx, OST_LEDGER_MESH);
    assert_success(OST_NEW(ctx, &values, 1000));
    ost_ledger_leave(ctx);
    assert_int_equal(ost_ledger_entry(ctx, OST_LEDGER_MESH).bytes, 8000);
    assert_success(OST_RESIZE(ctx, &values, 2000));
    assert_true(values[1999] == 0.0);
    assert_int_equal(ost_ledger_entry(ctx, OST_LEDGER_MESH).bytes, 16000);
    OST_FREE(values);
    assert_int_equal(ost_ledger_entry(ctx, OST_LEDGER_MESH).bytes, 0);
    assert_int_equal(ost_ledger_entry(ctx, OST_LEDGER_MESH).peak_bytes, 16000);
}

static void impossible_sizes_are_refused(void **state)
{
    double *values = NULL;
    assert_failure(OST_NEW(ctx, &values, SIZE_MAX / 4), OST_OUT_OF_MEMORY, "out of memory");
    assert_null(values);
}

static void accounts_nest_and_add_up(void **state)
{
    const double start = ost_seconds();
    const double before =
        ost_ledger_entry(ctx, OST_LEDGER_SOLVE).seconds + ost_ledger_entry(ctx, OST_LEDGER_OUTPUT).seconds;
    ost_ledger_enter(ctx, OST_LEDGER_SOLVE);
    while (ost_seconds() - start < 0.01) {
    }
    ost_ledger_enter(ctx, OST_LEDGER_OUTPUT);
    while (ost_seconds() - start < 0.02) {
    }
    ost_ledger_leave(ctx);
    ost_ledger_leave(ctx);
    const double after =
        ost_ledger_entry(ctx, OST_LEDGER_SOLVE).seconds + ost_ledger_entry(ctx, OST_LEDGER_OUTPUT).seconds;
    assert_true(after - before >= 0.019 && after - before <= ost_seconds() - start + 1e-3);
    assert_int_equal(ost_ledger_entry(ctx, OST_LEDGER_PHASES).entries, 0);
}

static void eigenvalues_of_a_known_matrix(void **state)
{
    const double a[9] = {2, -1, 0, -1, 2, -1, 0, -1, 2}; /* eigenvalues 2 - 2 cos(k π / 4), k = 1..3 */
    double values[3], vectors[9];
    assert_success(ost_symmetric_eigen(ctx, 3, a, values, vectors));
    for (int k = 0; k < 3; k++) {
        assert_close(values[k], 2.0 - 2.0 * cos((k + 1) * M_PI / 4.0), 1e-14);
        double av[3];
        ost_apply3(a, vectors + 3 * k, av);
        for (int i = 0; i < 3; i++)
            assert_close(av[i], values[k] * vectors[3 * k + i], 1e-14);
    }
}

static void cholesky_finds_the_bad_pivot(void **state)
{
    double good[9] = {4, 2, 0, 2, 5, 3, 0, 3, 10};
    double bad[9] = {4, 2, 0, 2, 1, 3, 0, 3, 10};
    assert_int_equal(ost_cholesky(3, good), 0);
    const double expected[9] = {2, 0, 0, 1, 2, 0, 0, 1.5, sqrt(7.75)};
    for (int i = 0; i < 9; i++)
        assert_close(good[i], expected[i], 1e-15);
    assert_int_equal(ost_cholesky(3, bad), 2);
}

static void inverse_times_matrix_is_identity(void **state)
{
    const double a[9] = {3, 1, 2, 0, 4, -1, 2, 2, 5};
    double b[9], c[9];
    assert_close(ost_invert3(a, b), ost_determinant3(a), 0.0);
    ost_multiply3(a, b, c);
    for (int i = 0; i < 9; i++)
        assert_close(c[i], i % 4 == 0 ? 1.0 : 0.0, 1e-15);
}

static void hear(void *listener, const char *text)
{
    snprintf(listener, 64, "%s", text);
}

static void warnings_are_heard_even_when_quiet(void **state)
{
    char heard[64] = "";
    const OstLogLevel before = ost_log_level(ctx);
    ost_log_set_level(ctx, OST_LOG_QUIET);
    ost_warn_listen(ctx, hear, heard);
    ost_warn(ctx, "%d of %d", 2, 3);
    ost_warn_listen(ctx, NULL, NULL);
    ost_warn(ctx, "unheard");
    ost_log_set_level(ctx, before);
    assert_string_equal(heard, "2 of 3");
    ost_warn(ctx, "unheard");
    assert_int_equal(ost_warning_count(ctx), 2); /* each once */
    assert_string_equal(ost_warning(ctx, 0), "2 of 3");
    assert_string_equal(ost_warning(ctx, 1), "unheard");
}

static void every_status_has_its_exit_code(void **state)
{
    assert_int_equal(ost_status_exit_code(OST_SUCCESS), 0);
    assert_int_equal(ost_status_exit_code(OST_INVALID_INPUT), 2);
    assert_int_equal(ost_status_exit_code(OST_NOT_CONVERGED), 1);
    assert_string_equal(ost_status_name(OST_FILE_FAILED), "OST_FILE_FAILED");
    assert_string_equal(ost_status_name(99), "unknown status");
}

static void assert_json_text(const char *text, const char *expected)
{
    json_t *json = ost_json_text(text);
    assert_non_null(json);
    assert_string_equal(json_string_value(json), expected);
    json_decref(json);
}

/* JSON refuses a text whose last character a buffer has cut, and with it all that it stands in. */
static void a_text_that_was_cut_is_json_all_the_same(void **state)
{
    assert_json_text("", "");
    assert_json_text("p·Ap", "p·Ap");
    assert_json_text("p\xc2", "p");         /* of a character of two bytes */
    assert_json_text("√E \xe2\x88", "√E "); /* of three */
}

/* Asked before libraries are called that end the process where memory runs out. */
static void memory_that_is_not_there_is_refused_before_it_is_asked_for(void **state)
{
    assert_success(ost_memory_foresee(ctx, 1e6, "a library"));
    assert_failure(ost_memory_foresee(ctx, 1e16, "a library"), OST_OUT_OF_MEMORY, "a library would need another");
    assert_int_equal(ost_ledger_bytes(ctx), 0);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(memory_is_booked_and_released),
    cmocka_unit_test(impossible_sizes_are_refused),
    cmocka_unit_test(accounts_nest_and_add_up),
    cmocka_unit_test(eigenvalues_of_a_known_matrix),
    cmocka_unit_test(cholesky_finds_the_bad_pivot),
    cmocka_unit_test(inverse_times_matrix_is_identity),
    cmocka_unit_test(every_status_has_its_exit_code),
    cmocka_unit_test(warnings_are_heard_even_when_quiet),
    cmocka_unit_test(memory_that_is_not_there_is_refused_before_it_is_asked_for),
    cmocka_unit_test(a_text_that_was_cut_is_json_all_the_same),
};

OST_TEST_MAIN(tests)
