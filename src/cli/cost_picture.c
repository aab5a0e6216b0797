/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/cost_picture.h"

#include "core/error.h"

#include <errno.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { LONGEST_PATH = 4096 };

/* Where the program is installed, its scripts are in ../share/orthostat; where it was built, they are in the source. */
static int find_script(char *path, size_t size)
{
    char program[LONGEST_PATH] = "";
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    char *slash = length > 0 ? strrchr(program, '/') : NULL;
    if (slash) {
        *slash = 0;
        const int written = snprintf(path, size, "%s/../share/orthostat/plot-cost", program);
        if (written > 0 && (size_t)written < size && access(path, X_OK) == 0)
            return 1;
    }
    snprintf(path, size, "%s/plot-cost", ORTHOSTAT_SCRIPTS);
    return access(path, X_OK) == 0;
}

static OstStatus run_script(OstContext *ctx, char *script, char *prices, char *picture)
{
    extern char **environ;
    char *arguments[] = {script, prices, picture, NULL};
    pid_t child = 0;
    int ending = 0;
    const int failure = posix_spawn(&child, script, NULL, NULL, arguments, environ);
    if (failure != 0)
        return OST_RAISE(ctx, OST_FILE_FAILED, "cannot run '%s': %s", script, strerror(failure));
    while (waitpid(child, &ending, 0) < 0)
        if (errno != EINTR)
            return OST_RAISE(ctx, OST_FILE_FAILED, "cannot wait for '%s': %s", script, strerror(errno));
    return WIFEXITED(ending) && WEXITSTATUS(ending) == 0
               ? OST_SUCCESS
               : OST_RAISE(ctx, OST_FILE_FAILED, "'%s' could not be drawn", picture);
}

OstStatus ost_cli_draw_cost(const OstCost *cost, const char *picture)
{
    char script[2 * LONGEST_PATH], prices[LONGEST_PATH], target[LONGEST_PATH];
    if (ost_rank(cost->ctx) != 0)
        return OST_SUCCESS;
    const int length = snprintf(prices, sizeof prices, "%s.prices.json", picture);
    if (length < 0 || (size_t)length >= sizeof prices)
        return OST_RAISE(cost->ctx, OST_FILE_FAILED, "the path of the picture is too long: %.200s...", picture);
    if (!find_script(script, sizeof script))
        return OST_RAISE(cost->ctx, OST_FILE_FAILED,
                         "the script that draws is not at '%s'; write --json FILE and call plot-cost FILE %s yourself",
                         script, picture);
    snprintf(target, sizeof target, "%s", picture);
    OST_TRY(ost_cost_write_json(cost, prices));
    const OstStatus status = run_script(cost->ctx, script, prices, target);
    remove(prices);
    return status;
}
