/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_STUDY_REPORT_H
#define ORTHOSTAT_CLI_STUDY_REPORT_H

#include "cli/command.h"

/* What a study says, as the options --csv, --json and --picture ask for it. */

/* How a study is told: printed (`path` is NULL), or written to a file as CSV or JSON. */
typedef enum { OST_AS_TEXT, OST_AS_CSV, OST_AS_JSON } OstStudyForm;
typedef OstStatus OstTellStudy(const void *study, OstStudyForm form, const char *path);

/* Collective. Can all reports be written where the arguments say? Asked before anything runs. Raises as
 * ost_check_outputs and ost_cli_check_picture do. */
OstStatus ost_cli_check_reports(const OstCase *c, const OstArguments *arguments);

/* Collective. Prints the study, unless that would get in the way of what goes to standard output, writes the files, and
 * has `script` draw the picture from the study's JSON. */
OstStatus ost_cli_report(OstContext *ctx, const OstArguments *arguments, OstTellStudy *tell, const void *study,
                         const char *script);

#endif
