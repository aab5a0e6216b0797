/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/command.h"
#include "cli/destination.h"
#include "core/error.h"
#include "core/memory.h"

#include "output/summary.h"
#include "problem/scene_data.h"
#include "study/watch.h"

#include <argp.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

typedef struct Arguments {
    const char *case_path;
    const char *output;
    const char *json;
    int keep;
} Arguments;

static const struct argp_option options[] = {
    {"output", 'o', "FILE", 0, "Write the fields here (default: the case's output file)", 0},
    {"json", 'j', "FILE", 0, "Write the summary as JSON here; - for standard output", 0},
    {"keep", 'k', 0, 0, "Also write a result that did not converge or that fails a check, marked as such", 0},
    {0},
};

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    Arguments *arguments = state->input;
    switch (key) {
    case 'o':
        arguments->output = value;
        return 0;
    case 'j':
        arguments->json = value;
        return 0;
    case 'k':
        arguments->keep = 1;
        return 0;
    case ARGP_KEY_ARG:
        if (arguments->case_path) {
            argp_error(state, "one case at a time: '%s' came after '%s'", value, arguments->case_path);
            return EINVAL;
        }
        arguments->case_path = value;
        return 0;
    case ARGP_KEY_END:
        if (!arguments->case_path) {
            argp_error(state, "which case? Give the path of its YAML file");
            return EINVAL;
        }
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp solve_argp = {
    options, parse_option, "CASE", "Solves a case and writes its fields for ParaView.", NULL, NULL, NULL};

static OstStatus report_watched(const OstScene *scene, const OstResult *result, const OstWatchedValue *watched,
                                const Arguments *arguments, const char *file)
{
    OstLedgerSummary ledger;
    OST_TRY(ost_ledger_summarise(scene->ctx, &ledger));
    const int json_on_stdout = arguments->json && strcmp(arguments->json, "-") == 0;
    if (ost_log_level(scene->ctx) != OST_LOG_QUIET && !json_on_stdout) {
        ost_summary_print(scene, result, file);
        if (ost_rank(scene->ctx) == 0)
            ost_watch_print(watched, scene->c->watch_count);
        ost_ledger_print(scene, &ledger);
    }
    if (!arguments->json)
        return OST_SUCCESS;
    return ost_agree(scene->ctx, ost_summary_write_json(scene, result, &ledger, watched, file, arguments->json));
}

static OstStatus report(const OstScene *scene, const OstResult *result, const Arguments *arguments, const char *file)
{
    OstWatchedValue *watched = NULL;
    OST_TRY(ost_watch_evaluate_all(scene, result, &watched));
    const OstStatus status = report_watched(scene, result, watched, arguments, file);
    OST_FREE(watched);
    return status;
}

/* Writes fields and summary. Numbers that are not finite are never written to the file of fields. */
static OstStatus write_result(const OstScene *scene, const OstResult *result, const Arguments *arguments,
                              const char *file)
{
    OstStatus status = OST_SUCCESS;
    if (result->checks.finite)
        status = ost_result_write(result, scene->c->output_fields, file);
    return status == OST_SUCCESS ? report(scene, result, arguments, result->checks.finite ? file : NULL) : status;
}

/* Writes, with --keep, a result that did not converge or failed a check; still returns that failure. */
static OstStatus keep_result(const OstScene *scene, const OstResult *result, const Arguments *arguments,
                             const char *file, OstStatus failure)
{
    OstContext *ctx = scene->ctx;
    if (!result || !result->reached || result->verdict.count == 0)
        return failure;
    char text[OST_MOST_OBJECTIONS * (OST_LONGEST_OBJECTION + 2)];
    snprintf(text, sizeof text, "%s", ost_error_text(ctx));
    if (!arguments->keep)
        return OST_RAISE(ctx, failure, "%s; nothing was written (--keep would write it, marked as %s)", text,
                         ost_result_status(result));
    const OstStatus written = write_result(scene, result, arguments, file);
    return written == OST_SUCCESS ? OST_RAISE(ctx, failure, "%s", text) : written;
}

static OstStatus solve(OstContext *ctx, const Arguments *arguments)
{
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    OstStatus status = ost_case_read(ctx, arguments->case_path, &c);
    char file[OST_LONGEST_PATH] = "";
    if (status == OST_SUCCESS)
        status = ost_choose_output(c, arguments->output, file);
    if (status == OST_SUCCESS)
        status = ost_check_outputs(c, 2, (const char *const[]){file, arguments->json});
    if (status == OST_SUCCESS)
        status = ost_scene_create(c, &scene);
    if (status == OST_SUCCESS)
        status = ost_watch_check(scene);
    if (status == OST_SUCCESS && !ost_plan_acts(c, &scene->plan))
        ost_warn(ctx, "%s: nothing acts on the body: there is no load and no prescribed displacement", c->path);
    if (status == OST_SUCCESS)
        status = ost_scene_solve(scene, &result);
    if (status == OST_SUCCESS)
        status = write_result(scene, result, arguments, file);
    else if (scene)
        status = keep_result(scene, result, arguments, file, status);
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
    return status;
}

int ost_cli_solve(OstContext *ctx, int argc, char **argv)
{
    Arguments arguments = {NULL, NULL, NULL, 0};
    int exit_code = 0;
    if (!ost_cli_parse(ctx, &solve_argp, argc, argv, &arguments, &exit_code))
        return exit_code;
    return ost_cli_finish(ctx, solve(ctx, &arguments));
}
