/* SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L
#include "core/context.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

/* A progress line is redrawn at most this often. */
static const double progress_interval = 0.1;

double ost_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void ost_log_set_level(OstContext *ctx, OstLogLevel level)
{
    ctx->level = level;
}

OstLogLevel ost_log_level(const OstContext *ctx)
{
    return ctx->level;
}

static void print_line(OstContext *ctx, const char *prefix, const char *format, va_list arguments)
{
    ost_progress(ctx, "", -1.0);
    fputs(prefix, stderr);
    vfprintf(stderr, format, arguments);
    fputc('\n', stderr);
}

void ost_log(OstContext *ctx, OstLogLevel level, const char *format, ...)
{
    if (ctx->rank != 0 || level > ctx->level || ctx->level == OST_LOG_QUIET)
        return;
    va_list arguments;
    va_start(arguments, format);
    print_line(ctx, "", format, arguments);
    va_end(arguments);
}

void ost_warn_listen(OstContext *ctx, void (*hear)(void *listener, const char *text), void *listener)
{
    ctx->hear = hear;
    ctx->listener = listener;
}

void ost_warn(OstContext *ctx, const char *format, ...)
{
    va_list arguments;
    if (ctx->rank == 0 && ctx->hear) {
        char text[OST_ERROR_TEXT_SIZE];
        va_start(arguments, format);
        vsnprintf(text, sizeof text, format, arguments);
        va_end(arguments);
        ctx->hear(ctx->listener, text);
    }
    if (ctx->rank != 0 || ctx->level == OST_LOG_QUIET)
        return;
    va_start(arguments, format);
    print_line(ctx, "orthostat: warning: ", format, arguments);
    va_end(arguments);
}

/* Does standard error end at a terminal? mpirun stands between, so scripts/orthostat finds out before it starts that
 * and sets the variable. */
static int is_on_terminal(void)
{
    return isatty(STDERR_FILENO) || getenv("ORTHOSTAT_ON_TERMINAL") != NULL;
}

void ost_progress(OstContext *ctx, const char *what, double fraction)
{
    if (ctx->rank != 0 || ctx->level == OST_LOG_QUIET)
        return;
    if (fraction < 0.0) {
        if (ctx->progress_shown)
            fputs("\r\033[K", stderr);
        ctx->progress_shown = 0;
        return;
    }
    const double now = ost_seconds();
    if (now - ctx->progress_time < progress_interval || !is_on_terminal())
        return;
    ctx->progress_time = now;
    ctx->progress_shown = 1;
    fprintf(stderr, "\r\033[K%s %3.0f %%", what, 100.0 * (fraction > 1.0 ? 1.0 : fraction));
    fflush(stderr);
}
