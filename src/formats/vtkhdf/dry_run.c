/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/vtkhdf/dry_run.h"

#include "core/error.h"

#include <errno.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

OstStatus ost_hdf5_dry_run(OstContext *ctx, const char *path, OstReading *read, const char *name)
{
    int how = 0;
    const pid_t child = fork();
    if (child == 0) {
        ost_hdf5_dry_run_here(ctx, path, read, name);
        _exit(0);
    }
    if (child < 0)
        return OST_RAISE(ctx, OST_FILE_FAILED, "%s: no process could be started to test it: %s", path, strerror(errno));
    while (waitpid(child, &how, 0) < 0)
        if (errno != EINTR)
            return OST_RAISE(ctx, OST_FILE_FAILED, "%s: could not be tested: %s", path, strerror(errno));
    return WIFEXITED(how) && WEXITSTATUS(how) == 0 ? OST_SUCCESS : ost_hdf5_raise_lost(ctx, path, how);
}
