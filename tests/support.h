/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_SUPPORT_H
#define ORTHOSTAT_TESTS_SUPPORT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "orthostat/context.h"

#include <math.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* cmocka hands a state to every test; few look at it. */
#pragma GCC diagnostic ignored "-Wunused-parameter"

/* The one context of a test program; nothing may be left allocated at its end. */
static OstContext *ctx;

/* The call succeeds. */
#define assert_success(call)                                                                               \
    do {                                                                                                   \
        const OstStatus status_ = (call);                                                                  \
        if (status_ != OST_SUCCESS)                                                                        \
            fail_msg("%s: %s (%s)", ost_status_name(status_), ost_error_text(ctx), ost_error_origin(ctx)); \
    } while (0)

/* The call fails with this status, and its message contains `text`. */
#define assert_failure(call, expected, text)                                                               \
    do {                                                                                                   \
        const OstStatus status_ = (call);                                                                  \
        if (status_ != (expected))                                                                         \
            fail_msg("expected %s, got %s: %s", #expected, ost_status_name(status_), ost_error_text(ctx)); \
        if (!strstr(ost_error_text(ctx), (text)))                                                          \
            fail_msg("message '%s' does not contain '%s'", ost_error_text(ctx), (text));                   \
    } while (0)

#define assert_close(a, b, tolerance)                                                 \
    do {                                                                              \
        const double a_ = (a), b_ = (b), tolerance_ = (tolerance);                    \
        if (!(fabs(a_ - b_) <= tolerance_))                                           \
            fail_msg("%s = %.17g, expected %.17g within %g", #a, a_, b_, tolerance_); \
    } while (0)

/* Runs the tests of a program under MPI; the result is that of the worst rank. */
#define OST_TEST_MAIN(tests)                                                       \
    int main(int argc, char **argv)                                                \
    {                                                                              \
        MPI_Init(&argc, &argv);                                                    \
        if (ost_context_create(MPI_COMM_WORLD, &ctx) != OST_SUCCESS)               \
            return 1;                                                              \
        int failed = cmocka_run_group_tests(tests, NULL, NULL);                    \
        if (failed == 0 && ost_ledger_bytes(ctx) != 0) {                           \
            fprintf(stderr, "%zu bytes were not freed\n", ost_ledger_bytes(ctx));  \
            failed = 1;                                                            \
        }                                                                          \
        MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD); \
        ost_context_destroy(&ctx);                                                 \
        MPI_Finalize();                                                            \
        return failed != 0;                                                        \
    }

#endif
