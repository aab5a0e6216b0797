/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_EXODUS_PARTS_H
#define ORTHOSTAT_FORMATS_EXODUS_PARTS_H

#include "orthostat/context.h"

/* The files of a mesh: one, or those that the ranks of a parallel run wrote, x.e.4.0 to x.e.4.3. */
typedef struct OstExodusParts {
    int count;
    char **path;
} OstExodusParts;

/* Local. All of them, by the path of any one, or by that of the whole, x.e, where there is none. Raises
 * OST_INVALID_INPUT if one is missing. Free them even after a failure. */
OstStatus ost_exodus_parts_find(OstContext *ctx, const char *path, OstExodusParts *parts);
void ost_exodus_parts_free(OstExodusParts *parts);

#endif
