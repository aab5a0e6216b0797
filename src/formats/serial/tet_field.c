/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "formats/serial/formats.h"

OstStatus ost_tet_field_check(OstContext *ctx, const char *path, const char *name, int width)
{
    return width == 1 || width == 3 || width == 6 || width == 9
               ? OST_SUCCESS
               : OST_RAISE(ctx, OST_INVALID_INPUT,
                           "%s: the field '%s' has %d numbers a tet, expected 1, 3, 6 or 9 (a tensor)", path, name,
                           width);
}
