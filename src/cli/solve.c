/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/command.h"
#include "cli/destination.h"
#include "cli/solve_path.h"
#include "core/error.h"
#include "core/memory.h"
#include "output/path_files.h"
#include "output/summary.h"
#include "problem/scene_data.h"
#include "study/watch.h"

#include <stdio.h>
#include <string.h>

static const struct argp_option options[] = {
    {"output", 'o', "FILE", 0, "Write the fields here (default: the case's output file)", 0},
    {"json", 'j', "FILE", 0, "Write the summary as JSON here; - for standard output", 0},
    {"keep", 'k', 0, 0, "Also write a result that did not converge or that fails a check, marked as such", 0},
    {"resume", 'r', 0, 0, "Go on with a path from its checkpoint, if there is one", 0},
    {0},
};

static const struct argp solve_argp = {
    options, ost_cli_take, "CASE", "Solves a case and writes its fields for ParaView.", NULL, NULL, NULL};

/* A call of the command. */
typedef struct Run {
    const OstArguments *arguments;
    OstCase *c;
    OstScene *scene;
    OstPath *path; /* NULL if the case has none */
    OstResult *result;
    char output[OST_LONGEST_PATH];
    char file[OST_LONGEST_PATH]; /* of the result: `output`, or beside it that of a path's last step */
} Run;

static OstStatus report(const Run *run)
{
    const OstScene *scene = run->scene;
    OstContext *ctx = scene->ctx;
    const char *json = run->arguments->text['j'];
    const char *file = run->result->checks.finite ? run->file : NULL;
    OstWatchedValue *watched = NULL;
    OstLedgerSummary ledger;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_watch_evaluate_all(scene, run->result, &watched));
    OST_TRY_DONE(ost_ledger_summarise(ctx, &ledger));
    if (ost_log_level(ctx) != OST_LOG_QUIET && !ost_cli_is_stdout(json)) {
        ost_summary_print(scene, run->result, file);
        if (ost_rank(ctx) == 0)
            ost_watch_print(watched, scene->c->watch_count);
        if (run->path)
            ost_path_print(scene, run->path, run->output);
        ost_ledger_print(scene, &ledger);
    }
    if (json)
        status = ost_agree(ctx, ost_summary_write_json(scene, run->result, run->path, &ledger, watched, file, json));
done:
    OST_FREE(watched);
    return status;
}

/* Numbers that are not finite are never written to the file of fields. */
static OstStatus write_fields(const Run *run)
{
    return run->result->checks.finite ? ost_result_write(run->result, run->c->output_fields, run->file) : OST_SUCCESS;
}

/* Writes, with --keep, a result that did not converge or failed a check; still returns that failure. */
static OstStatus keep_result(const Run *run, OstStatus failure)
{
    OstContext *ctx = run->c->ctx;
    if (!run->result || !run->result->reached || run->result->verdict.count == 0)
        return failure;
    char text[OST_MOST_OBJECTIONS * (OST_LONGEST_OBJECTION + 2)];
    snprintf(text, sizeof text, "%s", ost_error_text(ctx));
    if (!run->arguments->text['k'])
        return OST_RAISE(ctx, failure, "%s; nothing%s was written (--keep would write it, marked as %s)", text,
                         run->path ? " of this step" : "", ost_result_status(run->result));
    OST_TRY(write_fields(run));
    OST_TRY(report(run));
    return OST_RAISE(ctx, failure, "%s", text);
}

static OstStatus solve_path(Run *run)
{
    const OstStatus status =
        ost_cli_solve_path(run->scene, run->output, run->arguments->text['r'] != NULL, &run->path, &run->result);
    const int failed = status != OST_SUCCESS;
    if (run->path)
        ost_path_step_name(run->output, ost_path_done(run->path) + failed, sizeof run->file, run->file);
    return status == OST_SUCCESS ? report(run) : keep_result(run, status);
}

static OstStatus solve_once(Run *run)
{
    OstStatus status = ost_scene_solve(run->scene, &run->result);
    if (status != OST_SUCCESS)
        return keep_result(run, status);
    OST_TRY(write_fields(run));
    return report(run);
}

static OstStatus check_files(const Run *run)
{
    const char *json = run->arguments->text['j'];
    if (run->c->path_steps > 0) {
        OST_TRY(ost_cli_check_path_outputs(run->c, run->output));
        return ost_check_outputs(run->c, 1, &json);
    }
    if (run->arguments->text['r'])
        return OST_RAISE(run->c->ctx, OST_INVALID_USAGE, "%s: --resume goes on with a path, and the case has none",
                         run->c->path);
    return ost_check_outputs(run->c, 2, (const char *const[]){run->output, json});
}

static OstStatus solve(OstContext *ctx, void *input)
{
    Run run = {.arguments = input};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_case_read(ctx, run.arguments->case_path, &run.c));
    OST_TRY_DONE(ost_choose_output(run.c, run.arguments->text['o'], run.output));
    memcpy(run.file, run.output, sizeof run.file);
    OST_TRY_DONE(check_files(&run));
    OST_TRY_DONE(ost_scene_create(run.c, &run.scene));
    OST_TRY_DONE(ost_watch_check(run.scene));
    if (!ost_plan_acts(run.c, &run.scene->plan))
        ost_warn(ctx, "%s: nothing acts on the body: there is no load and no prescribed displacement", run.c->path);
    status = run.c->path_steps > 0 ? solve_path(&run) : solve_once(&run);
done:
    ost_result_destroy(&run.result);
    ost_path_destroy(&run.path);
    ost_scene_destroy(&run.scene);
    ost_case_destroy(&run.c);
    return status;
}

int ost_cli_solve(OstContext *ctx, int argc, char **argv)
{
    OstArguments arguments = {0};
    return ost_cli_run(ctx, &solve_argp, argc, argv, &arguments, solve);
}
