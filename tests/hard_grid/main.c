/* SPDX-License-Identifier: BSD-3-Clause */
#include "hard_grid/grid.h"

#include "cli/command.h"
#include "cli/destination.h"
#include "core/error.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The program behind scripts/hard-grid. */

enum { MOST_REPORTS = 2, MOST_CASES = 100 };

typedef struct Arguments {
    HardRun run;
    int report_count;
    const char *report[MOST_REPORTS];
    int case_count;
    const char *case_path[MOST_CASES];
    int shape_count; /* 0: all, unless there are cases */
    int passed;      /* did all points that were run? */
} Arguments;

static const struct argp_option options[] = {
    {"quick", 'Q', 0, 0, "A sample of the points in which every value of every parameter occurs", 0},
    {"mixed", 'M', 0, 0, "Quadratic tets at nu = 1/2 by the mixed form, in place of the other points", 0},
    {"size", 'S', "N", 0,
     "Bodies of about N unknowns (1000 to 1e8), six of each shape and order, solved without a factorisation, judged by "
     "their residual in 64 bits",
     0},
    {"iterated", 'I', 0, 0, "Leave the solver no factorisation but that of the coarsest level", 0},
    {"usual", 'U', 0, 0, "With --size: solved as a case is by default, with factors that fit and the mixed form", 0},
    {"all", 'a', 0, 0, "With --size: all points and not six of each shape and order", 0},
    {"iterations", 'L', "N", 0, "Without a factorisation: at most N iterations, in place of the program's own limit",
     0},
    {"like", 'l', "TEXT", 0, "Only points whose description, as it is printed, has this", 0},
    {"sample", 'N', "N", 0, "Of the points, N of each shape, the same in every run", 0},
    {"json", 'j', "FILE", 0, "Write every reading as JSON here; - for standard output; may be given twice", 0},
    {0},
};

static error_t want_shape(struct argp_state *state, const char *name, Arguments *arguments)
{
    const int shape = hard_find_shape(name);
    const char *ending = strrchr(name, '.');
    if (ending && strcmp(ending, ".yaml") == 0 && arguments->case_count < MOST_CASES) {
        arguments->case_path[arguments->case_count++] = name;
        return 0;
    }
    if (shape >= 0) {
        arguments->run.wanted[shape] = 1;
        arguments->shape_count++;
        return 0;
    }
    char known[256] = "";
    for (int s = 0; s < HARD_SHAPES; s++)
        snprintf(known + strlen(known), sizeof known - strlen(known), "%s%s", s > 0 ? ", " : "", hard_shape_name(s));
    argp_error(state, "there is no shape '%s'; there are: %s", name, known);
    return EINVAL;
}

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    Arguments *arguments = state->input;
    char *end = NULL;
    switch (key) {
    case 'Q':
        arguments->run.quick = 1;
        return 0;
    case 'U':
        arguments->run.usual = 1;
        return 0;
    case 'a':
        arguments->run.all = 1;
        return 0;
    case 'I':
        arguments->run.iterated = 1;
        return 0;
    case 'M':
        arguments->run.mixed = 1;
        return 0;
    case 'S':
        arguments->run.size = (OstGlobal)strtod(value, &end);
        if (!*end && arguments->run.size >= 1000 && arguments->run.size <= 100000000)
            return 0;
        argp_error(state, "--size wants a number of unknowns, 1000 to 1e8, and got '%s'", value);
        return EINVAL;
    case 'N':
        arguments->run.sample = (int)strtol(value, &end, 10);
        if (!*end && arguments->run.sample >= 1 && arguments->run.sample <= 10000)
            return 0;
        argp_error(state, "--sample wants a number of bodies of each shape, 1 to 10,000, and got '%s'", value);
        return EINVAL;
    case 'L':
        arguments->run.iterations = (int)strtol(value, &end, 10);
        if (!*end && arguments->run.iterations >= 1)
            return 0;
        argp_error(state, "--iterations wants a number, 1 or more, and got '%s'", value);
        return EINVAL;
    case 'l':
        arguments->run.like = value;
        return 0;
    case 'j':
        if (arguments->report_count == MOST_REPORTS) {
            argp_error(state, "--json is given more than %d times", MOST_REPORTS);
            return EINVAL;
        }
        arguments->report[arguments->report_count++] = value;
        return 0;
    case ARGP_KEY_ARG:
        return want_shape(state, value, arguments);
    case ARGP_KEY_END:
        if (arguments->run.mixed && arguments->run.size > 0) {
            argp_error(state, "--mixed has small bodies alone: leave out --size");
            return EINVAL;
        }
        for (int s = 0; s < HARD_SHAPES && arguments->shape_count + arguments->case_count == 0; s++)
            arguments->run.wanted[s] = 1;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp grid_argp = {
    options,
    parse_option,
    "[SHAPE|CASE.yaml...]",
    "Solves small bodies of every kind that solvers are known to fail on, and compares each answer with a direct "
    "solution. Without a SHAPE or CASE.yaml, all of them. The errors of a CASE.yaml are printed, stated and "
    "true.\vExit status 1 if any point fails.",
    NULL,
    NULL,
    NULL};

static OstStatus write_reports(const HardReport *report, const Arguments *arguments)
{
    int to_output = 0;
    for (int i = 0; i < arguments->report_count; i++)
        to_output |= strcmp(arguments->report[i], "-") == 0;
    if (ost_log_level(report->ctx) != OST_LOG_QUIET && !to_output)
        hard_print(report);
    for (int i = 0; i < arguments->report_count; i++)
        OST_TRY(hard_write_json(report, arguments->report[i]));
    return OST_SUCCESS;
}

/* The grid takes a while, so the destinations of its reports are checked first. */
static OstStatus run(OstContext *ctx, void *input)
{
    Arguments *arguments = input;
    static char name[] = "hard grid";
    const OstCase nothing = {.ctx = ctx, .path = name};
    HardReport *report = NULL;
    OST_TRY(ost_check_outputs(&nothing, arguments->report_count, arguments->report));
    for (int i = 0; i < arguments->case_count; i++) {
        int passed = 0;
        OST_TRY(hard_read_case(ctx, arguments->case_path[i], &passed));
        arguments->passed &= passed;
    }
    if (arguments->case_count > 0 && arguments->shape_count == 0)
        return OST_SUCCESS;
    OST_TRY(hard_run(ctx, &arguments->run, &report));
    arguments->passed &= hard_passed(report);
    const OstStatus status = ost_agree(ctx, write_reports(report, arguments));
    hard_report_destroy(&report);
    return status;
}

int main(int argc, char **argv)
{
    Arguments arguments = {.passed = 1};
    OstContext *ctx = NULL;
    int exit_code = 0;
    if (MPI_Init(&argc, &argv) != MPI_SUCCESS || ost_context_create(MPI_COMM_WORLD, &ctx) != OST_SUCCESS) {
        fputs("hard_grid: error: MPI could not be started\n", stderr);
        return 1;
    }
    exit_code = ost_cli_run(ctx, &grid_argp, argc, argv, &arguments, run);
    if (exit_code == 0 && !arguments.passed)
        exit_code = ost_status_exit_code(OST_CHECK_FAILED);
    ost_context_destroy(&ctx);
    MPI_Finalize();
    return exit_code;
}
