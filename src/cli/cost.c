/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/command.h"

#include "cli/cost_picture.h"
#include "cli/destination.h"
#include "core/error.h"
#include "core/parallel/free_memory.h"
#include "study/cost.h"

#include <argp.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct Arguments {
    const char *case_path;
    const char *csv, *json, *picture;
    OstCostVariants variants;
} Arguments;

enum { MAX_TIME = 't', CSV = 'c', JSON = 'j', PICTURE = 'p', ORDERS = 256, REFINEMENTS, TOLERANCES };

static const struct argp_option options[] = {
    {"max-time", MAX_TIME, "SECONDS", 0, "Skip runs that would take the total beyond this time (default: 600)", 0},
    {"orders", ORDERS, "LIST", 0, "Orders of the elements (default: 1,2)", 0},
    {"refinements", REFINEMENTS, "LIST", 0, "Uniform refinements of the mesh (default: 0,1,2)", 0},
    {"tolerances", TOLERANCES, "LIST", 0, "Relative residuals to solve to (default: 1e-2,1e-4,1e-8)", 0},
    {"csv", CSV, "FILE", 0, "Write the list as CSV here; - for standard output", 0},
    {"json", JSON, "FILE", 0, "Write everything as JSON here; - for standard output", 0},
    {"picture", PICTURE, "FILE", 0, "Draw error against seconds here (.png, .svg or .pdf)", 0},
    {0},
};

/* Reads "1,2,3", each number by `number`, which says where it stopped. Returns 0, or EINVAL with a message. */
static error_t read_list(struct argp_state *state, const char *name, const char *text, void *variants, int *count,
                         int (*number)(const char *, char **, OstCostVariants *, int))
{
    const char *at = text;
    for (*count = 0; *count < OST_COST_MOST_VALUES;) {
        char *end = NULL;
        if (!number(at, &end, variants, *count) || end == at || (*end != ',' && *end != 0))
            break;
        ++*count;
        if (*end == 0)
            return 0;
        at = end + 1;
    }
    argp_error(state, "--%s takes up to %d numbers with commas between them, found '%s'", name, OST_COST_MOST_VALUES,
               text);
    return EINVAL;
}

static int small_integer(const char *text, char **end, int *number)
{
    const long found = strtol(text, end, 10);
    *number = (int)found;
    return found >= 0 && found <= 1000;
}

static int read_order(const char *text, char **end, OstCostVariants *variants, int i)
{
    return small_integer(text, end, &variants->order[i]);
}

static int read_refinement(const char *text, char **end, OstCostVariants *variants, int i)
{
    return small_integer(text, end, &variants->refinement[i]);
}

static int read_tolerance(const char *text, char **end, OstCostVariants *variants, int i)
{
    variants->tolerance[i] = strtod(text, end);
    return 1;
}

static error_t read_max_time(struct argp_state *state, const char *text, OstCostVariants *variants)
{
    char *end = NULL;
    variants->max_seconds = strtod(text, &end);
    if (end != text && *end == 0 && variants->max_seconds > 0.0)
        return 0;
    argp_error(state, "--max-time takes a number of seconds above 0, found '%s'", text);
    return EINVAL;
}

static error_t take_case(struct argp_state *state, char *value, Arguments *arguments)
{
    if (arguments->case_path) {
        argp_error(state, "one case at a time: '%s' came after '%s'", value, arguments->case_path);
        return EINVAL;
    }
    arguments->case_path = value;
    return 0;
}

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    Arguments *arguments = state->input;
    OstCostVariants *variants = &arguments->variants;
    switch (key) {
    case MAX_TIME:
        return read_max_time(state, value, variants);
    case ORDERS:
        return read_list(state, "orders", value, variants, &variants->order_count, read_order);
    case REFINEMENTS:
        return read_list(state, "refinements", value, variants, &variants->refinement_count, read_refinement);
    case TOLERANCES:
        return read_list(state, "tolerances", value, variants, &variants->tolerance_count, read_tolerance);
    case CSV:
        arguments->csv = value;
        return 0;
    case JSON:
        arguments->json = value;
        return 0;
    case PICTURE:
        arguments->picture = value;
        return 0;
    case ARGP_KEY_ARG:
        return take_case(state, value, arguments);
    case ARGP_KEY_END:
        if (!arguments->case_path)
            argp_error(state, "which case? Give the path of its YAML file");
        return arguments->case_path ? 0 : EINVAL;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp cost_argp = {
    options,
    parse_option,
    "CASE",
    "Measures what accuracy costs: solves a case with every combination of element order, refinement and solver "
    "tolerance, and lists each run's error (of the strain energy and of the case's quantities of interest), seconds "
    "and memory, and the cheapest run for errors of 10, 3, 1 and 0.3 %.",
    NULL,
    NULL,
    NULL};

static int is_stdout(const char *path)
{
    return path && strcmp(path, "-") == 0;
}

static OstStatus report(const OstCost *cost, const Arguments *arguments)
{
    OstStatus status = OST_SUCCESS;
    if (ost_log_level(cost->ctx) != OST_LOG_QUIET && !is_stdout(arguments->csv) && !is_stdout(arguments->json))
        ost_cost_print(cost);
    if (arguments->csv)
        status = ost_cost_write_csv(cost, arguments->csv);
    if (status == OST_SUCCESS && arguments->json)
        status = ost_cost_write_json(cost, arguments->json);
    if (status == OST_SUCCESS && arguments->picture)
        status = ost_cli_draw_cost(cost, arguments->picture);
    return ost_agree(cost->ctx, status);
}

/* Checked before anything runs. */
static OstStatus check_reports(const OstCase *c, const Arguments *arguments)
{
    const char *const paths[] = {arguments->csv, arguments->json, arguments->picture};
    if (is_stdout(arguments->picture))
        return OST_RAISE(c->ctx, OST_INVALID_USAGE, "a picture cannot go to standard output; name a file for it");
    return ost_check_outputs(c, (int)(sizeof paths / sizeof *paths), paths);
}

static OstStatus run_study(OstContext *ctx, Arguments *arguments)
{
    OstCase *c = NULL;
    OstCost *cost = NULL;
    OstStatus status = ost_memory_installed(ctx, &arguments->variants.max_bytes);
    if (status == OST_SUCCESS)
        status = ost_case_read(ctx, arguments->case_path, &c);
    if (status == OST_SUCCESS)
        status = check_reports(c, arguments);
    if (status == OST_SUCCESS)
        status = ost_cost_create(c, &arguments->variants, &cost);
    if (status == OST_SUCCESS)
        status = ost_cost_run(cost);
    if (status == OST_SUCCESS)
        status = report(cost, arguments);
    ost_cost_destroy(&cost);
    ost_case_destroy(&c);
    return status;
}

int ost_cli_cost(OstContext *ctx, int argc, char **argv)
{
    Arguments arguments = {.variants = ost_cost_default_variants()};
    int exit_code = 0;
    if (!ost_cli_parse(ctx, &cost_argp, argc, argv, &arguments, &exit_code))
        return exit_code;
    return ost_cli_finish(ctx, run_study(ctx, &arguments));
}
