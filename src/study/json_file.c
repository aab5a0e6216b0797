/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/json_file.h"

#include "core/error.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

OstStatus ost_json_file_write(OstContext *ctx, const json_t *document, const char *path)
{
    const size_t flags = JSON_INDENT(1) | JSON_REAL_PRECISION(12);
    char partial[4096];
    if (strcmp(path, "-") == 0) {
        if (json_dumpf(document, stdout, flags) == 0 && puts("") >= 0)
            return OST_SUCCESS;
        return OST_RAISE(ctx, OST_FILE_FAILED, "cannot write JSON to standard output");
    }
    const int length = snprintf(partial, sizeof partial, "%s.partial", path);
    if (length < 0 || (size_t)length >= sizeof partial)
        return OST_RAISE(ctx, OST_FILE_FAILED, "the path of the JSON file is too long: %.200s...", path);
    if (json_dump_file(document, partial, flags) == 0 && rename(partial, path) == 0)
        return OST_SUCCESS;
    const char *reason = strerror(errno);
    remove(partial);
    return OST_RAISE(ctx, OST_FILE_FAILED, "cannot write '%s': %s", path, reason);
}
