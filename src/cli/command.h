/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_COMMAND_H
#define ORTHOSTAT_CLI_COMMAND_H

#include "orthostat/context.h"

#include <argp.h>

/* A command of the program. `run` parses its own arguments (argp; argv[0] is "orthostat NAME"), does the work on all
 * ranks, and returns the program's exit code. */
typedef struct OstCommand {
    const char *name;
    const char *summary;
    int (*run)(OstContext *ctx, int argc, char **argv);
} OstCommand;

int ost_cli_solve(OstContext *ctx, int argc, char **argv);
int ost_cli_check(OstContext *ctx, int argc, char **argv);
int ost_cli_explain(OstContext *ctx, int argc, char **argv);
int ost_cli_cost(OstContext *ctx, int argc, char **argv);
int ost_cli_verify(OstContext *ctx, int argc, char **argv);
int ost_cli_material(OstContext *ctx, int argc, char **argv);

/* Prints "orthostat: error: text" once (rank 0, standard error) and returns the status's exit code; 0 for OST_SUCCESS.
 */
int ost_cli_finish(OstContext *ctx, OstStatus status);

/* Collective. Parses by argp; rank 0 prints errors and help. Returns 1 to go on; else 0, and the program ends with
 * *exit_code: 0 after --help, 2 after a mistake. */
int ost_cli_parse(OstContext *ctx, const struct argp *argp, int argc, char **argv, void *input, int *exit_code);

/* What a command that takes a case is called with. First member of `input` where ost_cli_take is the argp's parser, or
 * is called by it. */
typedef struct OstArguments {
    const char *case_path;
    const char *text['z' + 1]; /* by the option's letter: its value, "" for an option without one; NULL: not given */
} OstArguments;

error_t ost_cli_take(int key, char *value, struct argp_state *state);

#endif
