/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_INSTALLED_H
#define ORTHOSTAT_CLI_INSTALLED_H

#include "orthostat/context.h"

/* Scripts and cases that come with the program: in ../share/orthostat beside an installed one, else in the source from
 * which it was built. */

/* Local. Runs a script with two arguments and waits for it. Raises OST_FILE_FAILED if it does not exist or fails; the
 * script itself prints why. */
OstStatus ost_cli_run_script(OstContext *ctx, const char *name, const char *first, const char *second);

/* Local. The folder of the program's cases: ORTHOSTAT_CASES of the environment, else the installed one, else ./cases,
 * else the source's. */
void ost_cli_cases_folder(char *path, size_t size);

#endif
