/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/command.h"
#include "cli/destination.h"
#include "core/error.h"
#include "core/memory.h"

#include "output/summary.h"
#include "problem/scene_data.h"
#include "study/watch.h"

#include <stdio.h>
#include <string.h>

static const struct argp_option options[] = {
    {"output", 'o', "FILE", 0, "Write the fields here (default: the case's output file)", 0},
    {"json", 'j', "FILE", 0, "Write the summary as JSON here; - for standard output", 0},
    {"keep", 'k', 0, 0, "Also write a result that did not converge or that fails a check, marked as such", 0},
    {0},
};

static const struct argp solve_argp = {
    options, ost_cli_take, "CASE", "Solves a case and writes its fields for ParaView.", NULL, NULL, NULL};

static OstStatus report(const OstScene *scene, const OstResult *result, const OstArguments *arguments, const char *file)
{
    OstContext *ctx = scene->ctx;
    const char *json = arguments->text['j'];
    OstWatchedValue *watched = NULL;
    OstLedgerSummary ledger;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_watch_evaluate_all(scene, result, &watched));
    OST_TRY_DONE(ost_ledger_summarise(ctx, &ledger));
    if (ost_log_level(ctx) != OST_LOG_QUIET && !ost_cli_is_stdout(json)) {
        ost_summary_print(scene, result, file);
        if (ost_rank(ctx) == 0)
            ost_watch_print(watched, scene->c->watch_count);
        ost_ledger_print(scene, &ledger);
    }
    if (json)
        status = ost_agree(ctx, ost_summary_write_json(scene, result, &ledger, watched, file, json));
done:
    OST_FREE(watched);
    return status;
}

/* Writes fields and summary. Numbers that are not finite are never written to the file of fields. */
static OstStatus write_result(const OstScene *scene, const OstResult *result, const OstArguments *arguments,
                              const char *file)
{
    OstStatus status = OST_SUCCESS;
    if (result->checks.finite)
        status = ost_result_write(result, scene->c->output_fields, file);
    return status == OST_SUCCESS ? report(scene, result, arguments, result->checks.finite ? file : NULL) : status;
}

/* Writes, with --keep, a result that did not converge or failed a check; still returns that failure. */
static OstStatus keep_result(const OstScene *scene, const OstResult *result, const OstArguments *arguments,
                             const char *file, OstStatus failure)
{
    OstContext *ctx = scene->ctx;
    if (!result || !result->reached || result->verdict.count == 0)
        return failure;
    char text[OST_MOST_OBJECTIONS * (OST_LONGEST_OBJECTION + 2)];
    snprintf(text, sizeof text, "%s", ost_error_text(ctx));
    if (!arguments->text['k'])
        return OST_RAISE(ctx, failure, "%s; nothing was written (--keep would write it, marked as %s)", text,
                         ost_result_status(result));
    const OstStatus written = write_result(scene, result, arguments, file);
    return written == OST_SUCCESS ? OST_RAISE(ctx, failure, "%s", text) : written;
}

static OstStatus solve(OstContext *ctx, void *input)
{
    const OstArguments *arguments = input;
    OstCase *c = NULL;
    OstScene *scene = NULL;
    OstResult *result = NULL;
    char file[OST_LONGEST_PATH] = "";
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_case_read(ctx, arguments->case_path, &c));
    OST_TRY_DONE(ost_choose_output(c, arguments->text['o'], file));
    OST_TRY_DONE(ost_check_outputs(c, 2, (const char *const[]){file, arguments->text['j']}));
    OST_TRY_DONE(ost_scene_create(c, &scene));
    OST_TRY_DONE(ost_watch_check(scene));
    if (!ost_plan_acts(c, &scene->plan))
        ost_warn(ctx, "%s: nothing acts on the body: there is no load and no prescribed displacement", c->path);
    status = ost_scene_solve(scene, &result);
    status = status == OST_SUCCESS ? write_result(scene, result, arguments, file)
                                   : keep_result(scene, result, arguments, file, status);
done:
    ost_result_destroy(&result);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
    return status;
}

int ost_cli_solve(OstContext *ctx, int argc, char **argv)
{
    OstArguments arguments = {0};
    return ost_cli_run(ctx, &solve_argp, argc, argv, &arguments, solve);
}
