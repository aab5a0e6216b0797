/* SPDX-License-Identifier: BSD-3-Clause */
#define _POSIX_C_SOURCE 200809L
#include "core/context.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

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

void ost_log(OstContext *ctx, OstLogLevel level, const char *format, ...)
{
    if (ctx->rank != 0 || level > ctx->level || ctx->level == OST_LOG_QUIET)
        return;
    va_list arguments;
    ost_progress(ctx, "", -1.0);
    va_start(arguments, format);
    vfprintf(stderr, format, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

void ost_warn_listen(OstContext *ctx, void (*hear)(void *listener, const char *text), void *listener)
{
    ctx->hear = hear;
    ctx->listener = listener;
}

int ost_warning_count(const OstContext *ctx)
{
    return ctx->warnings;
}

const char *ost_warning(const OstContext *ctx, int number)
{
    return ctx->warning[number];
}

void ost_forget_warnings(OstContext *ctx)
{
    for (int i = 0; i < ctx->warnings; i++)
        free(ctx->warning[i]);
    free(ctx->warning);
    ctx->warning = NULL;
    ctx->warnings = 0;
}

/* Is it new? Not booked to the ledger, and left out where memory is short: the warning is printed all the same. */
static int keep_warning(OstContext *ctx, const char *text)
{
    for (int i = 0; i < ctx->warnings; i++)
        if (strcmp(ctx->warning[i], text) == 0)
            return 0;
    char **grown = realloc(ctx->warning, ((size_t)ctx->warnings + 1) * sizeof *grown);
    if (!grown)
        return 1;
    ctx->warning = grown;
    grown[ctx->warnings] = strdup(text);
    ctx->warnings += grown[ctx->warnings] != NULL;
    return 1;
}

void ost_warn(OstContext *ctx, const char *format, ...)
{
    char text[OST_ERROR_TEXT_SIZE];
    va_list arguments;
    if (ctx->rank != 0)
        return;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    const int is_new = keep_warning(ctx, text);
    if (ctx->hear)
        ctx->hear(ctx->listener, text);
    if (ctx->level == OST_LOG_QUIET || !is_new) /* ten load cases say it once */
        return;
    ost_progress(ctx, "", -1.0);
    fprintf(stderr, "orthostat: warning: %s\n", text);
}
