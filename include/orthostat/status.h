/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STATUS_H
#define ORTHOSTAT_STATUS_H

/* Around the declarations of every public header: they are what the shared library shows, and C++ may call them. */
#ifdef __cplusplus
#define OST_API_BEGIN \
    extern "C" {      \
    _Pragma("GCC visibility push(default)")
#define OST_API_END               \
    _Pragma("GCC visibility pop") \
    }
#else
#define OST_API_BEGIN _Pragma("GCC visibility push(default)")
#define OST_API_END _Pragma("GCC visibility pop")
#endif

OST_API_BEGIN

/* What every fallible function returns. 0 is success; the text of a failure lives in the context (ost_error_text).
 * Columns: name, exit code of the program, meaning. */
#define OST_STATUS_TABLE(X)                                                          \
    X(OST_SUCCESS, 0, "success")                                                     \
    X(OST_INVALID_USAGE, 2, "the command line is not one the program knows")         \
    X(OST_INVALID_INPUT, 2, "a case, mesh, material or axis is not usable as given") \
    X(OST_FILE_FAILED, 2, "a file could not be opened, read or written")             \
    X(OST_LIMIT_EXCEEDED, 2, "a count exceeds what a library below can number")      \
    X(OST_OUT_OF_MEMORY, 1, "memory could not be had")                               \
    X(OST_LIBRARY_FAILED, 1, "a library below reported an error")                    \
    X(OST_NOT_CONVERGED, 1, "the solver stopped before the requested residual")      \
    X(OST_CHECK_FAILED, 1, "the result did not pass its own checks")

#define OST_STATUS_ENUM(name, exit_code, meaning) name,
enum { OST_STATUS_TABLE(OST_STATUS_ENUM) OST_STATUS_COUNT };
#undef OST_STATUS_ENUM

typedef int OstStatus;

/* Local. The status's name ("OST_INVALID_INPUT"), and the program's exit code for it. */
const char *ost_status_name(OstStatus status);
int ost_status_exit_code(OstStatus status);

OST_API_END

#endif
