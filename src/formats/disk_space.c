/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/disk_space.h"

#include "core/error.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* 0, or why not. */
static int set_aside(const char *path, OstGlobal bytes)
{
    int reason = 0;
    const int descriptor = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (descriptor < 0)
        return errno;
    do
        reason = fallocate(descriptor, 0, 0, (off_t)bytes) == 0 ? 0 : errno;
    while (reason == EINTR);
    close(descriptor);
    remove(path);
    return reason == EOPNOTSUPP || reason == ENOSYS ? 0 : reason;
}

OstStatus ost_disk_space_check(OstContext *ctx, const char *path, OstGlobal bytes)
{
    OstStatus status = OST_SUCCESS;
    if (ost_rank(ctx) == 0) {
        const int reason = set_aside(path, bytes);
        if (reason != 0)
            status = OST_RAISE(ctx, OST_FILE_FAILED, "%s: cannot have the %.3g MiB that it takes: %s", path,
                               (double)bytes / 1048576.0, strerror(reason));
    }
    return ost_agree(ctx, status);
}
