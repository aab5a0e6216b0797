/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/study_report.h"

#include "cli/destination.h"
#include "core/error.h"
#include "core/parallel/free_memory.h"
#include "study/cost.h"
#include "study/forecast/calibrate.h"

#include <string.h>

typedef struct Arguments {
    OstArguments common;
    OstCostVariants variants;
    int calibrate;
} Arguments;

enum { ORDERS = 256, REFINEMENTS, TOLERANCES, ACCURACIES, FORMULATIONS, LOAD_STEPS, CALIBRATE };

static const struct argp_option options[] = {
    {"max-time", 't', "SECONDS", 0, "Skip runs that would take the total beyond this time (default: 600)", 0},
    {"orders", ORDERS, "LIST", 0, "Orders of the elements (default: 1,2)", 0},
    {"refinements", REFINEMENTS, "LIST", 0, "Uniform refinements of the mesh (default: 0,1,2)", 0},
    {"tolerances", TOLERANCES, "LIST", 0, "Relative residuals to solve to (default: 1e-2,1e-4,1e-8)", 0},
    {"accuracies", ACCURACIES, "LIST", 0,
     "Errors in the norm of the energy to solve to adaptively; - for none (default: 0.1,0.03)", 0},
    {"formulations", FORMULATIONS, "LIST", 0,
     "Where rotations are large: other ways to take them, from linear, consistent, classical; - for none (default: "
     "all)",
     0},
    {"load-steps", LOAD_STEPS, "LIST", 0,
     "Where rotations are large: at least so many load steps; - for none (default: 4,16)", 0},
    {"csv", 'c', "FILE", 0, "Write the list as CSV here; - for standard output", 0},
    {"json", 'j', "FILE", 0, "Write everything as JSON here; - for standard output", 0},
    {"picture", 'p', "FILE", 0, "Draw error against seconds here (.png, .svg or .pdf)", 0},
    {"calibrate", CALIBRATE, 0, 0,
     "Without a case: measure in less than a minute what this machine can do, for the seconds that `explain` foretells",
     0},
    {0},
};

/* "linear,classical"; - for none. */
static error_t read_formulations(struct argp_state *state, const char *text, OstCostVariants *variants)
{
    variants->formulation_count = 0;
    for (const char *at = strcmp(text, "-") == 0 ? "" : text; *at;) {
        const size_t length = strcspn(at, ",");
        int which = OST_FORMULATION_CLASSICAL;
        while (which >= 0 && (strlen(ost_cost_formulation_word[which]) != length ||
                              strncmp(at, ost_cost_formulation_word[which], length) != 0))
            which--;
        if (which < 0 || variants->formulation_count == OST_COST_MOST_VALUES) {
            argp_error(state,
                       "--formulations takes linear, consistent and classical, with commas between them, found '%s'",
                       text);
            return EINVAL;
        }
        variants->formulation[variants->formulation_count++] = (OstFormulation)which;
        at += length + (at[length] == ',');
    }
    return 0;
}

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    Arguments *arguments = state->input;
    OstCostVariants *v = &arguments->variants;
    switch (key) {
    case CALIBRATE:
        arguments->calibrate = 1;
        return 0;
    case ARGP_KEY_ARG:
        if (!arguments->calibrate)
            return ost_cli_take(key, value, state);
        argp_error(state, "--calibrate runs bodies of its own, and takes no case: '%s'", value);
        return EINVAL;
    case ARGP_KEY_END:
        return arguments->calibrate ? 0 : ost_cli_take(key, value, state);
    case 't':
        return ost_cli_max_time(state, value, &v->max_seconds);
    case ORDERS:
        return ost_cli_list(state, "orders", value, OST_COST_MOST_VALUES, &v->order_count, v->order, NULL);
    case REFINEMENTS:
        return ost_cli_list(state, "refinements", value, OST_COST_MOST_VALUES, &v->refinement_count, v->refinement,
                            NULL);
    case TOLERANCES:
        return ost_cli_list(state, "tolerances", value, OST_COST_MOST_VALUES, &v->tolerance_count, NULL, v->tolerance);
    case ACCURACIES:
        v->accuracy_count = 0;
        return strcmp(value, "-") == 0 ? 0
                                       : ost_cli_list(state, "accuracies", value, OST_COST_MOST_VALUES,
                                                      &v->accuracy_count, NULL, v->accuracy);
    case FORMULATIONS:
        return read_formulations(state, value, v);
    case LOAD_STEPS:
        v->load_step_count = 0;
        return strcmp(value, "-") == 0 ? 0
                                       : ost_cli_list(state, "load-steps", value, OST_COST_MOST_VALUES,
                                                      &v->load_step_count, v->load_steps, NULL);
    default:
        return ost_cli_take(key, value, state);
    }
}

static const struct argp cost_argp = {
    options,
    parse_option,
    "CASE\n--calibrate",
    "Measures what accuracy costs: solves a case with every combination of element order, refinement and solver "
    "tolerance, and adaptively, and lists each run's error (of the strain energy and of the case's quantities of "
    "interest), seconds "
    "and memory, and the cheapest run for errors of 10, 3, 1, 0.3 and 0.1 %, and what the next refinement would give.",
    NULL,
    NULL,
    NULL};

static OstStatus tell(const void *study, OstStudyForm form, const char *path)
{
    if (form == OST_AS_CSV)
        return ost_cost_write_csv(study, path);
    if (form == OST_AS_JSON)
        return ost_cost_write_json(study, path);
    ost_cost_print(study);
    return OST_SUCCESS;
}

/* Keeps the rates of this machine, and shows how well they foretell the runs that they come from, and others. */
static OstStatus calibrate(OstContext *ctx, const char *json)
{
    char path[4096];
    OstCalibration calibration;
    OST_TRY(ost_calibrate(ctx, ORTHOSTAT_VERSION, &calibration));
    const int quiet = ost_log_level(ctx) == OST_LOG_QUIET || ost_cli_is_stdout(json);
    if (!quiet)
        ost_calibration_print(ctx, &calibration);
    OST_TRY(ost_agree(ctx, ost_rates_save(ctx, &calibration.rates)));
    if (json)
        OST_TRY(ost_agree(ctx, ost_calibration_write_json(ctx, &calibration, json)));
    if (!quiet && ost_rates_path(path, sizeof path))
        ost_log(ctx, OST_LOG_NORMAL, "the rates are in %s", path);
    return OST_SUCCESS;
}

static OstStatus run_study(OstContext *ctx, void *input)
{
    Arguments *arguments = input;
    OstCase *c = NULL;
    OstCost *cost = NULL;
    OstStatus status = OST_SUCCESS;
    if (arguments->calibrate)
        return calibrate(ctx, arguments->common.text['j']);
    OST_TRY_DONE(ost_memory_installed(ctx, &arguments->variants.max_bytes));
    OST_TRY_DONE(ost_cli_read_one(ctx, &arguments->common, &c));
    OST_TRY_DONE(ost_cli_check_reports(c, &arguments->common));
    OST_TRY_DONE(ost_cost_create(c, &arguments->variants, &cost));
    OST_TRY_DONE(ost_cost_run(cost));
    status = ost_cli_report(ctx, &arguments->common, tell, cost, "plot-cost");
done:
    ost_cost_destroy(&cost);
    ost_case_destroy(&c);
    return status;
}

int ost_cli_cost(OstContext *ctx, int argc, char **argv)
{
    Arguments arguments = {.variants = ost_cost_default_variants(), .calibrate = 0};
    arguments.variants.formulation_count = 3;
    for (int f = 0; f < 3; f++)
        arguments.variants.formulation[f] = (OstFormulation)f;
    arguments.variants.load_step_count = 2;
    arguments.variants.load_steps[0] = 4;
    arguments.variants.load_steps[1] = 16;
    arguments.variants.accuracy_count = 2;
    arguments.variants.accuracy[0] = 0.1;
    arguments.variants.accuracy[1] = 0.03;
    return ost_cli_run_on_case(ctx, &cost_argp, argc, argv, &arguments, run_study);
}
