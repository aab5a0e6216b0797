/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/case_arguments.h"

#include "cli/command.h"

#include <argp.h>
#include <errno.h>

static const struct argp_option options[] = {
    {"json", 'j', 0, 0, "Print what was found as JSON", 0},
    {0},
};

static error_t parse_argument(int key, char *value, struct argp_state *state)
{
    OstCaseArguments *arguments = state->input;
    switch (key) {
    case 'j':
        arguments->json = 1;
        return 0;
    case ARGP_KEY_ARG:
        if (arguments->path) {
            argp_error(state, "one case at a time; '%s' is a second one", value);
            return EINVAL;
        }
        arguments->path = value;
        return 0;
    case ARGP_KEY_END:
        if (!arguments->path)
            argp_error(state, "which case? Name its file");
        return arguments->path ? 0 : EINVAL;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

int ost_cli_parse_case(OstContext *ctx, const char *doc, int argc, char **argv, OstCaseArguments *arguments,
                       int *exit_code)
{
    const struct argp argp = {options, parse_argument, "CASE", doc, NULL, NULL, NULL};
    return ost_cli_parse(ctx, &argp, argc, argv, arguments, exit_code);
}
