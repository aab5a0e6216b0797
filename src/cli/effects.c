/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/study_report.h"

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

static OstStatus tell(const void *study, OstStudyForm form, const char *path)
{
    if (form == OST_AS_JSON)
        return ost_effect_study_write_json(study, path);
    ost_effect_study_print(study);
    return OST_SUCCESS;
}

static OstStatus run_study(OstContext *ctx, void *input)
{
    const OstArguments *arguments = input;
    OstCase *c = NULL;
    OstEffectStudy study;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_cli_read_one(ctx, arguments, &c));
    OST_TRY_DONE(ost_cli_check_reports(c, arguments));
    OST_TRY_DONE(ost_effect_study(c, &study));
    status = ost_cli_report(ctx, arguments, tell, &study, "plot-effects");
done:
    ost_case_destroy(&c);
    return status;
}

int ost_cli_effects(OstContext *ctx, int argc, char **argv)
{
    OstArguments arguments = {0};
    return ost_cli_run_on_case(ctx, &effects_argp, argc, argv, &arguments, run_study);
}
