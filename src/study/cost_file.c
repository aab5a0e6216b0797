/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/cost_file.h"

#include "core/error.h"

#include <errno.h>
#include <string.h>

enum { LONGEST_PATH = 4096 };

static OstStatus raise_unwritten(const OstCost *cost, const char *path, int reason)
{
    return OST_RAISE(cost->ctx, OST_FILE_FAILED, "cannot write '%s': %s", path, strerror(reason));
}

static OstStatus write_aside(const OstCost *cost, const char *path, const char *partial,
                             OstStatus (*write)(FILE *, const OstCost *))
{
    FILE *file = fopen(partial, "w");
    if (!file)
        return raise_unwritten(cost, path, errno);
    OstStatus status = write(file, cost);
    const int broken = ferror(file);
    const int unclosed = fclose(file) != 0;
    if (status == OST_SUCCESS && (broken || unclosed))
        status = raise_unwritten(cost, path, errno);
    if (status == OST_SUCCESS && rename(partial, path) != 0)
        status = raise_unwritten(cost, path, errno);
    if (status != OST_SUCCESS)
        remove(partial);
    return status;
}

OstStatus ost_cost_write_file(const OstCost *cost, const char *path, OstStatus (*write)(FILE *, const OstCost *))
{
    char partial[LONGEST_PATH];
    if (ost_rank(cost->ctx) != 0)
        return OST_SUCCESS;
    if (strcmp(path, "-") == 0) {
        const OstStatus status = write(stdout, cost);
        return status == OST_SUCCESS && fflush(stdout) != 0 ? raise_unwritten(cost, "standard output", errno) : status;
    }
    const int length = snprintf(partial, sizeof partial, "%s.partial", path);
    if (length < 0 || (size_t)length >= sizeof partial)
        return raise_unwritten(cost, path, ENAMETOOLONG);
    return write_aside(cost, path, partial, write);
}
