/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_INSTALLED_H
#define ORTHOSTAT_CLI_INSTALLED_H

#include "orthostat/context.h"

/* Scripts and cases that come with the program: in ../share/orthostat beside an installed one, else in the source from
 * which it was built. */

/* Local. Runs a script with two arguments and waits for it. Raises OST_FILE_FAILED if it does not exist or fails; the
 * script itself prints why. */
OstStatus ost_cli_run_script(OstContext *ctx, const char *name, const char *first, const char *second);

/* Collective; rank 0 draws. Writes the numbers of a study (`write` writes it as JSON to a path) to a file in a new
 * folder, where none of the user's can be in the way, and has a script draw them. Raises as ost_cli_run_script does. */
OstStatus ost_cli_draw(OstContext *ctx, const char *script, OstStatus (*write)(const void *study, const char *path),
                       const void *study, const char *picture);

/* Local. Can a picture be drawn to this path (NULL: none is asked for)? By its ending, .png, .svg or .pdf; standard
 * output is none. */
OstStatus ost_cli_check_picture(OstContext *ctx, const char *path);

/* Local. The folder of the program's cases: ORTHOSTAT_CASES of the environment, else the installed one, else ./cases,
 * else the source's. */
void ost_cli_cases_folder(char *path, size_t size);

#endif
