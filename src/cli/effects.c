/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/command.h"

#include "cli/destination.h"
#include "cli/installed.h"
#include "core/error.h"
#include "study/effects.h"

static const struct argp_option options[] = {
    {"json", 'j', "FILE", 0, "Write everything as JSON here; - for standard output", 0},
    {"picture", 'p', "FILE", 0, "Draw what each effect changes and costs here (.png, .svg or .pdf)", 0},
    {0},
};

static const struct argp effects_argp = {
    .options = options,
    .parser = ost_cli_take,
    .args_doc = "CASE",
    .doc =
        "Measures which effects a case calls for: solves it as it is, and once more with each effect left out. Lists "
        "seconds, memory, and by how much the pose, the strain energy and the quantities of interest change; names "
        "the effects that change the answer by less than the accuracy asked for (accuracy: relative_error).",
};

static OstStatus write_study(const void *study, const char *path)
{
    return ost_effect_study_write_json(study, path);
}

static OstStatus report(const OstEffectStudy *study, const char *json, const char *picture)
{
    OstStatus status = OST_SUCCESS;
    if (ost_log_level(study->ctx) != OST_LOG_QUIET && !ost_cli_is_stdout(json))
        ost_effect_study_print(study);
    if (json)
        status = ost_effect_study_write_json(study, json);
    if (status == OST_SUCCESS && picture)
        status = ost_cli_draw(study->ctx, "plot-effects", write_study, study, picture);
    return ost_agree(study->ctx, status);
}

/* Where reports go is checked before anything runs. */
static OstStatus run_study(OstContext *ctx, void *input)
{
    const OstArguments *arguments = input;
    const char *const paths[] = {arguments->text['j'], arguments->text['p']};
    OstCase *c = NULL;
    OstEffectStudy study;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_cli_read_one(ctx, arguments, &c));
    OST_TRY_DONE(ost_check_outputs(c, 2, paths));
    OST_TRY_DONE(ost_cli_check_picture(ctx, paths[1]));
    OST_TRY_DONE(ost_effect_study(c, &study));
    status = report(&study, paths[0], paths[1]);
done:
    ost_case_destroy(&c);
    return status;
}

int ost_cli_effects(OstContext *ctx, int argc, char **argv)
{
    OstArguments arguments = {0};
    return ost_cli_run_on_case(ctx, &effects_argp, argc, argv, &arguments, run_study);
}
