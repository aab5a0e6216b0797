/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/disk_space.h"

#include "core/error.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* 0, or why not. Whoever makes the file says better why it cannot be opened. */
static int set_aside(const char *path, int flags, OstGlobal bytes)
{
    int reason = 0;
    const int descriptor = open(path, O_WRONLY | flags, 0666);
    if (descriptor < 0)
        return 0;
    do
        reason = fallocate(descriptor, 0, 0, (off_t)bytes) == 0 ? 0 : errno;
    while (reason == EINTR);
    close(descriptor);
    return reason == EOPNOTSUPP || reason == ENOSYS ? 0 : reason;
}

static OstStatus answer(OstContext *ctx, const char *path, OstGlobal bytes, int reason)
{
    return reason == 0 ? OST_SUCCESS
                       : OST_RAISE(ctx, OST_FILE_FAILED, "%s: cannot have the %.3g MiB that it takes: %s", path,
                                   (double)bytes / 1048576.0, strerror(reason));
}

OstStatus ost_disk_space_check(OstContext *ctx, const char *path, OstGlobal bytes)
{
    OstStatus status = OST_SUCCESS;
    if (ost_rank(ctx) == 0) {
        status = answer(ctx, path, bytes, set_aside(path, O_CREAT | O_TRUNC, bytes));
        remove(path);
    }
    return ost_agree(ctx, status);
}

OstStatus ost_disk_space_keep(OstContext *ctx, const char *path, OstGlobal bytes)
{
    const int reason = ost_rank(ctx) == 0 ? set_aside(path, 0, bytes) : 0;
    return ost_agree(ctx, answer(ctx, path, bytes, reason));
}
