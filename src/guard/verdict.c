/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "guard/guard.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void ost_object(OstVerdict *verdict, OstStatus status, const char *format, ...)
{
    va_list arguments;
    if (verdict->count == OST_MOST_OBJECTIONS)
        return;
    if (verdict->count == 0)
        verdict->status = status;
    va_start(arguments, format);
    vsnprintf(verdict->text[verdict->count++], OST_LONGEST_OBJECTION, format, arguments);
    va_end(arguments);
}

OstStatus ost_verdict_raise(OstContext *ctx, const OstVerdict *verdict)
{
    char text[OST_MOST_OBJECTIONS * (OST_LONGEST_OBJECTION + 2)] = "";
    if (verdict->count == 0)
        return OST_SUCCESS;
    for (int i = 0; i < verdict->count; i++) {
        strcat(text, i > 0 ? "; " : "");
        strcat(text, verdict->text[i]);
    }
    return OST_RAISE(ctx, verdict->status, "%s", text);
}
