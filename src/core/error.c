/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"

#include "core/context.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const struct {
    const char *name;
    int exit_code;
} status_table[OST_STATUS_COUNT] = {
#define OST_STATUS_ROW(name, exit_code, meaning) {#name, exit_code},
    OST_STATUS_TABLE(OST_STATUS_ROW)
#undef OST_STATUS_ROW
};

static int is_known(OstStatus status)
{
    return status >= 0 && status < OST_STATUS_COUNT;
}

const char *ost_status_name(OstStatus status)
{
    return is_known(status) ? status_table[status].name : "unknown status";
}

int ost_status_exit_code(OstStatus status)
{
    return is_known(status) ? status_table[status].exit_code : 1;
}

const char *ost_error_text(const OstContext *ctx)
{
    return ctx->error_text;
}

const char *ost_error_origin(const OstContext *ctx)
{
    return ctx->error_origin;
}

OstStatus ost_error_set(OstContext *ctx, OstStatus status, const char *file, int line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(ctx->error_text, sizeof ctx->error_text, format, arguments);
    va_end(arguments);
    const char *source = strstr(file, "src/");
    snprintf(ctx->error_origin, sizeof ctx->error_origin, "%s:%d", source ? source : file, line);
    return status;
}

void ost_append(char *text, size_t size, const char *format, ...)
{
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, size - used, format, arguments);
    va_end(arguments);
}

OstStatus ost_mpi_check(OstContext *ctx, int mpi_result, const char *call, const char *file, int line)
{
    if (mpi_result == MPI_SUCCESS)
        return OST_SUCCESS;
    char text[MPI_MAX_ERROR_STRING] = "";
    int length = 0;
    MPI_Error_string(mpi_result, text, &length);
    return ost_error_set(ctx, OST_LIBRARY_FAILED, file, line, "MPI failed in %.60s: %s", call, text);
}

OstStatus ost_agree(OstContext *ctx, OstStatus status)
{
    if (ctx->size == 1)
        return status;
    ost_ledger_reduced(ctx, 1);
    int failed = status == OST_SUCCESS ? ctx->size : ctx->rank;
    int first = ctx->size;
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(&failed, &first, 1, MPI_INT, MPI_MIN, ctx->comm)));
    if (first == ctx->size)
        return OST_SUCCESS;
    int agreed = status;
    OST_TRY(OST_MPI(ctx, MPI_Bcast(&agreed, 1, MPI_INT, first, ctx->comm)));
    OST_TRY(OST_MPI(ctx, MPI_Bcast(ctx->error_text, sizeof ctx->error_text, MPI_CHAR, first, ctx->comm)));
    OST_TRY(OST_MPI(ctx, MPI_Bcast(ctx->error_origin, sizeof ctx->error_origin, MPI_CHAR, first, ctx->comm)));
    return agreed;
}
