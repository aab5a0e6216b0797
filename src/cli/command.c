/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/command.h"

#include "case/case_data.h"
#include "case/yaml/message.h"
#include "core/error.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct argp_option common_options[] = {
    {"quiet", 'q', 0, 0, "Print nothing but errors, and JSON or CSV where that is asked for", -1},
    {"verbose", 'v', 0, 0, "Say more", -1},
    {0},
};

enum { SET = 0x100, LOAD_CASE };

#define SET_OPTION                                                                                                    \
    {                                                                                                                 \
        "set", SET, "KEY=VALUE", 0, "Change the case before it is used: loads.0.pressure=2e5; as often as needed", -2 \
    }
static const struct argp_option set_options[] = {SET_OPTION, {0}};
static const struct argp_option case_options[] = {
    SET_OPTION,
    {"case", LOAD_CASE, "NAME", 0, "Take the one of its load cases that has this name", -2},
    {0},
};

static error_t take_change(int key, char *value, struct argp_state *state)
{
    OstArguments *arguments = state->input;
    switch (key) {
    case SET:
        if (arguments->settings == OST_MOST_SETTINGS) {
            argp_error(state, "--set is possible %d times; put some into the case", OST_MOST_SETTINGS);
            return EINVAL;
        }
        arguments->setting[arguments->settings++] = value;
        return 0;
    case LOAD_CASE:
        arguments->load_case = value;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* What a command takes of what changes a case, with its options. */
typedef enum { TAKES_NO_CASE, TAKES_SETTINGS, TAKES_CASE } Takes;
static const struct argp change_argp[] = {
    [TAKES_SETTINGS] = {.options = set_options, .parser = take_change},
    [TAKES_CASE] = {.options = case_options, .parser = take_change},
};

typedef struct Common {
    OstContext *ctx;
    void *input; /* of the command's own parser */
    Takes takes;
} Common;

static error_t parse_common(int key, char *value, struct argp_state *state)
{
    const Common *common = state->input;
    (void)value;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = common->input;
        if (common->takes != TAKES_NO_CASE)
            state->child_inputs[1] = common->input;
        return 0;
    case 'q':
        ost_log_set_level(common->ctx, OST_LOG_QUIET);
        return 0;
    case 'v':
        ost_log_set_level(common->ctx, OST_LOG_VERBOSE);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static int asks_for_help(int argc, char **argv)
{
    for (int i = 1; i < argc; i++) {
        if (strcmp(argv[i], "--") == 0)
            return 0;
        if (strcmp(argv[i], "--help") == 0 || strcmp(argv[i], "-?") == 0 || strcmp(argv[i], "-h") == 0)
            return 1;
    }
    return 0;
}

static int ends_in_json(const char *path)
{
    const size_t length = strlen(path);
    return length > 5 && strcmp(path + length - 5, ".json") == 0;
}

error_t ost_cli_take(int key, char *value, struct argp_state *state)
{
    OstArguments *arguments = state->input;
    const char *path = arguments->case_path;
    if (key == ARGP_KEY_ARG && path) {
        const char *json = ends_in_json(path) ? path : ends_in_json(value) ? value : NULL;
        argp_error(state, "one case at a time: '%s' came after '%s'%s%s", value, path,
                   json ? "; to write JSON into that file, say --json=" : "", json ? json : "");
        return EINVAL;
    }
    if (key == ARGP_KEY_ARG) {
        arguments->case_path = value;
    } else if (key == ARGP_KEY_END && !path) {
        argp_error(state, "which case? Give the path of its YAML file, or - for standard input");
        return EINVAL;
    } else if (key > 0 && key <= 'z') {
        arguments->text[key] = value ? value : "";
    } else {
        return ARGP_ERR_UNKNOWN;
    }
    return 0;
}

const char *ost_cli_json(const OstArguments *arguments)
{
    const char *path = arguments->text['j'];
    return path && !*path ? "-" : path;
}

error_t ost_cli_list(struct argp_state *state, const char *name, const char *text, int most, int *count, int *integers,
                     double *numbers)
{
    const char *at = text;
    for (*count = 0; *count < most;) {
        char *end = NULL;
        const double number = numbers ? strtod(at, &end) : (double)strtol(at, &end, 10);
        if (end == at || (*end != ',' && *end != 0) || (integers && !(number >= 0.0 && number <= 1000.0)))
            break;
        if (integers)
            integers[*count] = (int)number;
        else
            numbers[*count] = number;
        ++*count;
        if (*end == 0)
            return 0;
        at = end + 1;
    }
    argp_error(state, "--%s takes up to %d %s with commas between them, found '%s'", name, most,
               integers ? "whole numbers from 0 on" : "numbers", text);
    return EINVAL;
}

error_t ost_cli_max_time(struct argp_state *state, const char *text, double *seconds)
{
    char *end = NULL;
    *seconds = strtod(text, &end);
    if (end != text && *end == 0 && *seconds > 0.0)
        return 0;
    argp_error(state, "--max-time takes a number of seconds above 0, found '%s'", text);
    return EINVAL;
}

/* The one load case that may be named has no envelope. */
static OstStatus read_case(OstContext *ctx, const OstArguments *arguments, OstCase **c)
{
    OST_TRY(ost_case_read_with(ctx, arguments->case_path, arguments->settings, arguments->setting, c));
    const int envelope = (*c)->envelope;
    if (!arguments->load_case)
        return OST_SUCCESS;
    OST_TRY(ost_case_pick(c, arguments->load_case));
    if (envelope)
        ost_log(ctx, OST_LOG_NORMAL, "%s:%d: no envelope is written: it is of all load cases, and --case takes '%s'",
                (*c)->path, envelope, arguments->load_case);
    return OST_SUCCESS;
}

OstStatus ost_cli_read(OstContext *ctx, const OstArguments *arguments, OstCase **c)
{
    OST_TRY(read_case(ctx, arguments, c));
    return ost_case_check_envelope(*c);
}

OstStatus ost_cli_read_one(OstContext *ctx, const OstArguments *arguments, OstCase **c)
{
    OST_TRY(read_case(ctx, arguments, c));
    const int count = (*c)->load_case_count;
    if (count == 0)
        return OST_SUCCESS;
    return OST_RAISE(ctx, OST_INVALID_USAGE,
                     "%s: there are %d load cases, and this command takes one: name it, as in --case %s", (*c)->path,
                     count, (*c)->load_cases[0].name);
}

/* --- options that nobody knows --- */

enum { MOST_OPTIONS = 64 };

static void add_names(const struct argp_option *options, const char *names[MOST_OPTIONS], int *count)
{
    for (; options && (options->name || options->key || options->doc); options++)
        if (options->name && *count < MOST_OPTIONS)
            names[(*count)++] = options->name;
}

/* getopt takes the beginning of a name for the name. */
static int is_known(const char *word, size_t length, const char *const names[MOST_OPTIONS], int count)
{
    for (int i = 0; i < count; i++)
        if (strncmp(names[i], word, length) == 0)
            return 1;
    return 0;
}

/* A long option that the command does not have, but whose name is near to one that it has: says so. */
static int refuses_option(OstContext *ctx, const struct argp *argp, Takes takes, int argc, char **argv)
{
    const char *names[MOST_OPTIONS] = {"help", "usage"};
    int count = 2;
    add_names(common_options, names, &count);
    add_names(change_argp[takes].options, names, &count);
    add_names(argp->options, names, &count);
    for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++) {
        char word[64];
        const size_t length = strcspn(argv[i], "=");
        if (strncmp(argv[i], "--", 2) != 0 || is_known(argv[i] + 2, length - 2, names, count))
            continue;
        snprintf(word, sizeof word, "%.*s", (int)(length - 2), argv[i] + 2);
        const char *nearest = ost_nearest_word(word, names, count);
        if (!nearest)
            continue;
        if (ost_rank(ctx) == 0)
            fprintf(stderr, "%s: there is no option '--%s'; did you mean '--%s'?\n", argv[0], word, nearest);
        return 1;
    }
    return 0;
}

static int run(OstContext *ctx, Takes takes, const struct argp *argp, int argc, char **argv, void *input,
               OstStatus (*work)(OstContext *ctx, void *input))
{
    const struct argp_child children[] = {
        {argp, 0, NULL, 0}, {takes == TAKES_NO_CASE ? NULL : &change_argp[takes], 0, NULL, 0}, {0}};
    const struct argp whole = {common_options, parse_common, NULL, NULL, children, NULL, NULL};
    Common common = {ctx, input, takes};
    if (asks_for_help(argc, argv)) {
        if (ost_rank(ctx) == 0)
            argp_help(&whole, stdout, ARGP_HELP_USAGE | ARGP_HELP_LONG | ARGP_HELP_DOC, argv[0]);
        return 0;
    }
    if (refuses_option(ctx, argp, takes, argc, argv))
        return ost_status_exit_code(OST_INVALID_USAGE);
    const unsigned flags = ARGP_NO_EXIT | ARGP_NO_HELP | (ost_rank(ctx) == 0 ? 0U : (unsigned)ARGP_NO_ERRS);
    if (argp_parse(&whole, argc, argv, flags, NULL, &common) != 0)
        return ost_status_exit_code(OST_INVALID_USAGE);
    const OstStatus status = work(ctx, input);
    ost_progress(ctx, "", -1.0);
    if (status != OST_SUCCESS && ost_rank(ctx) == 0) {
        fprintf(stderr, "orthostat: error: %s\n", ost_error_text(ctx));
        if (ost_log_level(ctx) == OST_LOG_VERBOSE)
            fprintf(stderr, "orthostat: %s, raised at %s\n", ost_status_name(status), ost_error_origin(ctx));
    }
    return ost_status_exit_code(status);
}

int ost_cli_run(OstContext *ctx, const struct argp *argp, int argc, char **argv, void *input,
                OstStatus (*work)(OstContext *ctx, void *input))
{
    return run(ctx, TAKES_NO_CASE, argp, argc, argv, input, work);
}

int ost_cli_run_on_case(OstContext *ctx, const struct argp *argp, int argc, char **argv, void *input,
                        OstStatus (*work)(OstContext *ctx, void *input))
{
    return run(ctx, TAKES_CASE, argp, argc, argv, input, work);
}

int ost_cli_run_on_cases(OstContext *ctx, const struct argp *argp, int argc, char **argv, void *input,
                         OstStatus (*work)(OstContext *ctx, void *input))
{
    return run(ctx, TAKES_SETTINGS, argp, argc, argv, input, work);
}
