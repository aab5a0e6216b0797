/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_ERROR_H
#define ORTHOSTAT_CORE_ERROR_H

#include "orthostat/context.h"
#include <stdio.h>

/* Local. Records the failure's text and origin in the context and returns `status`. */
OstStatus ost_error_set(OstContext *ctx, OstStatus status, const char *file, int line, const char *format, ...)
    __attribute__((format(printf, 5, 6)));

/* Local. Appends to a text in `size` bytes, as far as there is room. */
void ost_append(char *text, size_t size, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Raises a failure: return OST_RAISE(ctx, OST_INVALID_INPUT, "...", ...); */
#define OST_RAISE(ctx, status, ...) ost_error_set((ctx), (status), __FILE__, __LINE__, __VA_ARGS__)

/* Returns a failure to the caller at once; for functions with nothing to free. */
#define OST_TRY(call)                             \
    do {                                          \
        const OstStatus ost_try_status_ = (call); \
        if (ost_try_status_ != OST_SUCCESS)       \
            return ost_try_status_;               \
    } while (0)

/* On failure jumps to the clean-up label `done`; the local variable `status` has the failure. */
#define OST_TRY_DONE(call)         \
    do {                           \
        status = (call);           \
        if (status != OST_SUCCESS) \
            goto done;             \
    } while (0)

/* Goes on with a local step unless an earlier one failed: `status` is agreed on once, after all of them. */
#define OST_THEN(call)             \
    do {                           \
        if (status == OST_SUCCESS) \
            status = (call);       \
    } while (0)

/* Turns MPI's return value into a status. */
OstStatus ost_mpi_check(OstContext *ctx, int mpi_result, const char *call, const char *file, int line);
#define OST_MPI(ctx, call) ost_mpi_check((ctx), (call), #call, __FILE__, __LINE__)

/* Local. "4 %" of 0.04, for messages: two digits, and whole per cent from 100 on. Returns `text`. */
static inline const char *ost_percent(double share, char *text, size_t size)
{
    snprintf(text, size, share >= 0.995 ? "%.0f %%" : "%.2g %%", 100.0 * share);
    return text;
}

#endif
