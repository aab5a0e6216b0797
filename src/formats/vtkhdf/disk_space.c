/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/disk_space.h"

#include "core/error.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <unistd.h>

/* Returns 0, or errno. A file that cannot be opened is left to the writer, whose message is better. */
static int allocate(const char *path, OstGlobal bytes, int empties)
{
    int reason = 0;
    const int descriptor = open(path, O_WRONLY);
    if (descriptor < 0)
        return 0;
    do
        reason = fallocate(descriptor, 0, 0, (off_t)bytes) == 0 ? 0 : errno;
    while (reason == EINTR);
    if (empties && ftruncate(descriptor, 0) != 0 && reason == 0)
        reason = errno;
    close(descriptor);
    return reason == EOPNOTSUPP || reason == ENOSYS ? 0 : reason;
}

static OstStatus allocate_on_first(OstContext *ctx, const OstAside *file, OstGlobal bytes, int empties)
{
    const int reason = ost_rank(ctx) == 0 ? allocate(file->aside, bytes, empties) : 0;
    return ost_agree(ctx, reason == 0 ? OST_SUCCESS
                                      : OST_RAISE(ctx, OST_FILE_FAILED,
                                                  "%s: needs %.3g MiB of disk space, which cannot be reserved: %s",
                                                  file->path, (double)bytes / 1048576.0, strerror(reason)));
}

OstStatus ost_disk_space_check(OstContext *ctx, const OstAside *file, OstGlobal bytes)
{
    return allocate_on_first(ctx, file, bytes, 1);
}

OstStatus ost_disk_space_keep(OstContext *ctx, const OstAside *file, OstGlobal bytes)
{
    return allocate_on_first(ctx, file, bytes, 0);
}
