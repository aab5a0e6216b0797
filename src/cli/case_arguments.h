/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_CASE_ARGUMENTS_H
#define ORTHOSTAT_CLI_CASE_ARGUMENTS_H

#include "orthostat/context.h"

/* The arguments of commands that look at one case and report: CASE [--json]. */
typedef struct OstCaseArguments {
    const char *path;
    int json;
} OstCaseArguments;

/* As ost_cli_parse; `doc` is what the command says of itself in its help. */
int ost_cli_parse_case(OstContext *ctx, const char *doc, int argc, char **argv, OstCaseArguments *arguments,
                       int *exit_code);

#endif
