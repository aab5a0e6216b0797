/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_SCRIPT_H
#define ORTHOSTAT_CLI_SCRIPT_H

#include "orthostat/context.h"

/* What belongs to the program and lies beside it: in ../share/orthostat where it is installed, in the source where it
 * was built. */

/* Local. Runs a script of that name with two arguments and waits for it. Raises OST_FILE_FAILED if it is not there or
 * fails; it says why itself. */
OstStatus ost_cli_run_script(OstContext *ctx, const char *name, const char *first, const char *second);

/* Local. The folder of the program's cases: ORTHOSTAT_CASES of the environment, else the installed one, else ./cases,
 * else the source's. */
void ost_cli_cases_folder(char *path, size_t size);

#endif
