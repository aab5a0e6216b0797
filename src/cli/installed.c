/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/installed.h"

#include "cli/destination.h"
#include "core/error.h"

#include <errno.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/wait.h>
#include <unistd.h>

enum { LONGEST_PATH = 4096 };

/* ../share/orthostat/NAME beside the program. */
static int find_installed(const char *name, char *path, size_t size)
{
    char program[LONGEST_PATH] = "";
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    char *slash = length > 0 ? strrchr(program, '/') : NULL;
    if (!slash)
        return 0;
    *slash = 0;
    const int written = snprintf(path, size, "%s/../share/orthostat/%s", program, name);
    return written > 0 && (size_t)written < size && access(path, R_OK) == 0;
}

void ost_cli_cases_folder(char *path, size_t size)
{
    const char *given = getenv("ORTHOSTAT_CASES");
    if (given && given[0])
        snprintf(path, size, "%s", given);
    else if (find_installed("cases", path, size))
        return;
    else
        snprintf(path, size, "%s", access("cases/verify", R_OK) == 0 ? "cases" : ORTHOSTAT_SCRIPTS "/../cases");
}

OstStatus ost_cli_run_script(OstContext *ctx, const char *name, const char *first, const char *second)
{
    extern char **environ;
    char script[2 * LONGEST_PATH], one[LONGEST_PATH], two[LONGEST_PATH];
    char *arguments[] = {script, one, two, NULL};
    pid_t child = 0;
    int ending = 0;
    if (!find_installed(name, script, sizeof script))
        snprintf(script, sizeof script, "%s/%s", ORTHOSTAT_SCRIPTS, name);
    if (access(script, X_OK) != 0)
        return OST_RAISE(ctx, OST_FILE_FAILED, "the script '%s' is not at '%s': %s", name, script, strerror(errno));
    snprintf(one, sizeof one, "%s", first);
    snprintf(two, sizeof two, "%s", second);
    const int failure = posix_spawn(&child, script, NULL, NULL, arguments, environ);
    if (failure != 0)
        return OST_RAISE(ctx, OST_FILE_FAILED, "cannot run '%s': %s", script, strerror(failure));
    while (waitpid(child, &ending, 0) < 0)
        if (errno != EINTR)
            return OST_RAISE(ctx, OST_FILE_FAILED, "cannot wait for '%s': %s", script, strerror(errno));
    return WIFEXITED(ending) && WEXITSTATUS(ending) == 0 ? OST_SUCCESS
                                                         : OST_RAISE(ctx, OST_FILE_FAILED, "'%s' failed", script);
}

OstStatus ost_cli_check_picture(OstContext *ctx, const char *path)
{
    static const char *const endings[] = {".png", ".svg", ".pdf"};
    const char *dot = path ? strrchr(path, '.') : NULL;
    if (!path)
        return OST_SUCCESS;
    if (ost_cli_is_stdout(path))
        return OST_RAISE(ctx, OST_INVALID_USAGE, "a picture cannot go to standard output; name a file for it");
    for (int e = 0; dot && dot > path && dot[-1] != '/' && e < 3; e++)
        if (strcasecmp(dot, endings[e]) == 0)
            return OST_SUCCESS;
    return OST_RAISE(ctx, OST_INVALID_USAGE, "a picture ends with .png, .svg or .pdf; found '%s'", path);
}

OstStatus ost_cli_draw(OstContext *ctx, const char *script, OstStatus (*write)(const void *study, const char *path),
                       const void *study, const char *picture)
{
    enum { LONGEST = 4096 };
    char folder[LONGEST], numbers[LONGEST + 16];
    const char *place = getenv("TMPDIR");
    if (ost_rank(ctx) != 0)
        return OST_SUCCESS;
    if (!place || !place[0])
        place = "/tmp";
    snprintf(folder, sizeof folder, "%s/orthostat-study-XXXXXX", place); /* if truncated, mkdtemp fails with EINVAL */
    if (!mkdtemp(folder))
        return OST_RAISE(
            ctx, OST_FILE_FAILED,
            "cannot make a folder in '%.200s' for the picture's numbers: %s; TMPDIR can name another place", place,
            strerror(errno));
    snprintf(numbers, sizeof numbers, "%s/study.json", folder);
    OstStatus status = write(study, numbers);
    OST_THEN(ost_cli_run_script(ctx, script, numbers, picture));
    remove(numbers);
    rmdir(folder);
    return status;
}
