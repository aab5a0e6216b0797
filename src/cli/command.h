/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_COMMAND_H
#define ORTHOSTAT_CLI_COMMAND_H

#include "orthostat/case.h"

#include <argp.h>

/* The commands of the program. Each parses its own arguments (argp; argv[0] is "orthostat NAME"), does the work on all
 * ranks, and returns the program's exit code. */
int ost_cli_solve(OstContext *ctx, int argc, char **argv);
int ost_cli_check(OstContext *ctx, int argc, char **argv);
int ost_cli_explain(OstContext *ctx, int argc, char **argv);
int ost_cli_effects(OstContext *ctx, int argc, char **argv);
int ost_cli_cost(OstContext *ctx, int argc, char **argv);
int ost_cli_scale(OstContext *ctx, int argc, char **argv);
int ost_cli_sweep(OstContext *ctx, int argc, char **argv);
int ost_cli_verify(OstContext *ctx, int argc, char **argv);
int ost_cli_mesh(OstContext *ctx, int argc, char **argv);
int ost_cli_material(OstContext *ctx, int argc, char **argv);

/* Collective. Parses by argp into `input`, does the work, and returns the program's exit code. Rank 0 prints help, and
 * mistakes of usage (exit code 2), instead of the work; and "orthostat: error: text" after a failure. */
int ost_cli_run(OstContext *ctx, const struct argp *argp, int argc, char **argv, void *input,
                OstStatus (*work)(OstContext *ctx, void *input));

/* What a command that takes a case is called with. First member of `input` where ost_cli_take is the argp's parser, or
 * is called by it. */
enum { OST_MOST_SETTINGS = 200 };
typedef struct OstArguments {
    const char *case_path;
    const char *text['z' + 1]; /* by the option's letter: its value, "" for an option without one; NULL: not given */
    int settings;
    const char *setting[OST_MOST_SETTINGS]; /* --set */
    const char *load_case;                  /* --case, or NULL */
} OstArguments;

error_t ost_cli_take(int key, char *value, struct argp_state *state);

/* Local. Where JSON goes of a command whose --json may do without a file: "-" then, standard output; NULL: not asked
 * for. */
const char *ost_cli_json(const OstArguments *arguments);

/* Values of options; return 0, or EINVAL with a message. "1,2,3", up to `most`, into `integers` or `numbers`, of which
 * the other is NULL; and --max-time. */
error_t ost_cli_list(struct argp_state *state, const char *name, const char *text, int most, int *count, int *integers,
                     double *numbers);
error_t ost_cli_max_time(struct argp_state *state, const char *text, double *seconds);

/* Collective. ost_cli_run of a command that takes a case: with the options --set and --case. */
int ost_cli_run_on_case(OstContext *ctx, const struct argp *argp, int argc, char **argv, void *input,
                        OstStatus (*work)(OstContext *ctx, void *input));

/* Collective. The same of a command that takes several cases, none of which has load cases: with --set alone. */
int ost_cli_run_on_cases(OstContext *ctx, const struct argp *argp, int argc, char **argv, void *input,
                         OstStatus (*work)(OstContext *ctx, void *input));

/* Collective. The case, as the arguments change it, or the one of its load cases that they name. ost_cli_read_one
 * refuses several load cases of which none is named. */
OstStatus ost_cli_read(OstContext *ctx, const OstArguments *arguments, OstCase **c);
OstStatus ost_cli_read_one(OstContext *ctx, const OstArguments *arguments, OstCase **c);

#endif
