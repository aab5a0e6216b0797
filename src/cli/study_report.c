/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/study_report.h"

#include "cli/destination.h"
#include "cli/installed.h"
#include "core/error.h"

OstStatus ost_cli_check_reports(const OstCase *c, const OstArguments *arguments)
{
    const char *const *text = arguments->text;
    const char *const paths[] = {text['c'], text['j'], text['p']};
    OST_TRY(ost_check_outputs(c, 3, paths));
    return ost_cli_check_picture(c->ctx, text['p']);
}

typedef struct Told {
    OstTellStudy *tell;
    const void *study;
} Told;

static OstStatus write_numbers(const void *told, const char *path)
{
    const Told *all = told;
    return all->tell(all->study, OST_AS_JSON, path);
}

OstStatus ost_cli_report(OstContext *ctx, const OstArguments *arguments, OstTellStudy *tell, const void *study,
                         const char *script)
{
    const char *csv = arguments->text['c'], *json = arguments->text['j'], *picture = arguments->text['p'];
    OstStatus status = OST_SUCCESS;
    if (ost_log_level(ctx) != OST_LOG_QUIET && !ost_cli_is_stdout(csv) && !ost_cli_is_stdout(json))
        status = tell(study, OST_AS_TEXT, NULL);
    if (csv)
        OST_THEN(tell(study, OST_AS_CSV, csv));
    if (json)
        OST_THEN(tell(study, OST_AS_JSON, json));
    if (picture)
        OST_THEN(ost_cli_draw(ctx, script, write_numbers, &(Told){tell, study}, picture));
    return ost_agree(ctx, status);
}
