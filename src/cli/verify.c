/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/verify.h"

#include "cli/command.h"
#include "cli/destination.h"
#include "cli/installed.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/gather.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_CASES = 256, LOAD_CASE = 0x200 };

typedef struct Arguments {
    OstArguments common;
    int name_count;
    const char *name[MOST_CASES];
    int all_passed; /* did all cases that were run? */
} Arguments;

static const struct argp_option options[] = {
    {"quick", 'Q', 0, 0, "Coarse meshes only: under a minute", 0},
    {"hard", 'H', 0, OPTION_HIDDEN, 0, 0},
    {"case", LOAD_CASE, "NAME", OPTION_HIDDEN, 0, 0},
    {"json", 'j', "FILE", 0, "Write every reading as JSON here; - for standard output", 0},
    {"picture", 'p', "FOLDER", 0,
     "Draw how far each case is from its formula here, as verify.png (and write verify.json)", 0},
    {0},
};

static error_t parse_option(int key, char *value, struct argp_state *state)
{
    Arguments *arguments = state->input;
    switch (key) {
    case 'H':
        argp_error(state, "the hard grid is a study of its own, in the source: scripts/hard-grid");
        return EINVAL;
    case LOAD_CASE:
        argp_error(state,
                   "--case takes a load case, and what is verified has none: a formula is of one answer. State the "
                   "load of '%s' in a case of its own, or with --set, and compare that",
                   value);
        return EINVAL;
    case ARGP_KEY_ARG:
        if (arguments->name_count == MOST_CASES) {
            argp_error(state, "at most %d cases at a time", MOST_CASES);
            return EINVAL;
        }
        arguments->name[arguments->name_count++] = value;
        return 0;
    case ARGP_KEY_END: /* no name: all cases */
        return 0;
    default:
        return ost_cli_take(key, value, state);
    }
}

static const struct argp verify_argp = {
    options,
    parse_option,
    "[NAME...]",
    "Compares answers with closed-form solutions: solves the cases of cases/verify, or those named (a name without "
    "ending, or the path of a case with a verify section), on ever finer meshes.\vThe folder of cases is "
    "ORTHOSTAT_CASES of the environment, else the installed one, else ./cases. Exit status 1 if any case fails.",
    NULL,
    NULL,
    NULL};

/* --- which cases --- */

typedef struct CaseList {
    int count;
    char (*path)[OST_LONGEST_PATH];
} CaseList;

static int is_case(const struct dirent *entry)
{
    const size_t length = strlen(entry->d_name);
    return length > 5 && strcmp(entry->d_name + length - 5, ".yaml") == 0;
}

/* All cases of a folder; where `missing` is a name, refuses it and lists those that there are. */
static OstStatus list_folder(OstContext *ctx, const char *folder, const char *missing, CaseList *list)
{
    struct dirent **entries = NULL;
    char names[OST_LONGEST_PATH] = "";
    size_t length = 0;
    const int count = scandir(folder, &entries, is_case, alphasort);
    if (count < 0 && !missing)
        return OST_RAISE(ctx, OST_FILE_FAILED,
                         "cannot read the folder '%s': %s; say where the cases are: ORTHOSTAT_CASES=/path/to/cases",
                         folder, strerror(errno));
    for (int i = 0; i < count; i++) {
        const char *name = entries[i]->d_name;
        if (!missing && count <= MOST_CASES)
            snprintf(list->path[list->count++], OST_LONGEST_PATH, "%.3000s/%.1000s", folder, name);
        if (length < sizeof names)
            length += (size_t)snprintf(names + length, sizeof names - length, "%s%.*s", i > 0 ? ", " : "",
                                       (int)strlen(name) - 5, name);
        free(entries[i]);
    }
    free(entries);
    if (missing)
        return OST_RAISE(ctx, OST_FILE_FAILED, "there is no case '%s' in '%s', which has: %s", missing, folder,
                         count > 0 ? names : "none");
    return list->count > 0
               ? OST_SUCCESS
               : OST_RAISE(ctx, OST_FILE_FAILED, "found %d cases in '%s', expected 1 to %d", count, folder, MOST_CASES);
}

static OstStatus list_cases(OstContext *ctx, const Arguments *arguments, CaseList *list)
{
    char folder[OST_LONGEST_PATH];
    char cases[OST_LONGEST_PATH - 16];
    ost_cli_cases_folder(cases, sizeof cases);
    snprintf(folder, sizeof folder, "%s/verify", cases);
    if (arguments->name_count == 0)
        return list_folder(ctx, folder, NULL, list);
    for (int i = 0; i < arguments->name_count; i++) {
        const char *name = arguments->name[i];
        const int is_path = strchr(name, '/') != NULL || strstr(name, ".yaml") != NULL;
        char *path = list->path[list->count++];
        if (is_path)
            snprintf(path, OST_LONGEST_PATH, "%s", name);
        else
            snprintf(path, OST_LONGEST_PATH, "%.3000s/%.1000s.yaml", folder, name);
        if (!is_path && access(path, F_OK) != 0)
            return list_folder(ctx, folder, name, list);
    }
    return OST_SUCCESS;
}

/* Rank 0 looks and tells the others. */
static OstStatus find_cases(OstContext *ctx, const Arguments *arguments, CaseList *list)
{
    OstStatus status = OST_NEW(ctx, &list->path, MOST_CASES);
    if (status == OST_SUCCESS && ost_rank(ctx) == 0)
        status = list_cases(ctx, arguments, list);
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(ost_broadcast(ctx, sizeof list->count, &list->count));
    return ost_broadcast(ctx, (size_t)list->count * sizeof *list->path, list->path);
}

/* --- where reports go --- */

/* The files in the folder of the picture. */
typedef struct PicturePaths {
    char readings[OST_LONGEST_PATH];
    char picture[OST_LONGEST_PATH];
} PicturePaths;

/* No report may replace a file of a case. */
static OstStatus check_paths(OstContext *ctx, const OstArguments *arguments, const CaseList *list, int count,
                             const char *const *paths)
{
    OstStatus status = OST_SUCCESS;
    for (int i = 0; i < list->count && status == OST_SUCCESS; i++) {
        OstCase *c = NULL;
        status = ost_case_read_with(ctx, list->path[i], arguments->settings, arguments->setting, &c);
        OST_THEN(ost_check_outputs(c, count, paths));
        ost_case_destroy(&c);
    }
    return status;
}

/* Checked before anything runs. The readings beside the picture may be the file of --json. */
static OstStatus choose_destinations(OstContext *ctx, const OstArguments *arguments, const CaseList *list,
                                     PicturePaths *beside)
{
    const char *folder = arguments->text['p'];
    const char *const drawn[] = {beside->readings, beside->picture};
    OstStatus made = OST_SUCCESS;
    if (arguments->text['j'])
        OST_TRY(check_paths(ctx, arguments, list, 1, &arguments->text['j']));
    if (!folder)
        return OST_SUCCESS;
    const int length = snprintf(beside->readings, OST_LONGEST_PATH, "%s/verify.json", folder);
    if (length < 0 || length >= OST_LONGEST_PATH)
        return OST_RAISE(ctx, OST_FILE_FAILED, "the path of the folder is too long: %.200s...", folder);
    snprintf(beside->picture, OST_LONGEST_PATH, "%.4000s/verify.png", folder);
    if (ost_rank(ctx) == 0 && mkdir(folder, 0777) != 0 && errno != EEXIST)
        made = OST_RAISE(ctx, OST_FILE_FAILED, "cannot make the folder '%s': %s", folder, strerror(errno));
    OST_TRY(ost_agree(ctx, made));
    return check_paths(ctx, arguments, list, 2, drawn);
}

/* --- the runs --- */

static OstStatus run_all(OstContext *ctx, const OstArguments *arguments, const CaseList *list,
                         const PicturePaths *beside, OstVerifyReport **reports)
{
    const int quick = arguments->text['Q'] != NULL;
    const char *json = arguments->text['j'], *folder = arguments->text['p'];
    const int prints = ost_log_level(ctx) != OST_LOG_QUIET && !ost_cli_is_stdout(json);
    for (int i = 0; i < list->count; i++) {
        OST_TRY(ost_verify_case(ctx, list->path[i], arguments->settings, arguments->setting, quick, &reports[i]));
        if (prints)
            ost_verify_print(reports[i], ost_log_level(ctx) == OST_LOG_VERBOSE);
    }
    if (prints)
        ost_verify_print_summary(list->count, reports);
    OstStatus status = json ? ost_verify_write_json(ctx, list->count, reports, quick, json) : OST_SUCCESS;
    OST_TRY(ost_agree(ctx, status));
    if (folder)
        status = ost_verify_write_json(ctx, list->count, reports, quick, beside->readings);
    if (folder && status == OST_SUCCESS && ost_rank(ctx) == 0)
        status = ost_cli_run_script(ctx, "plot-verify", beside->readings, folder);
    return ost_agree(ctx, status);
}

static OstStatus verify(OstContext *ctx, void *input)
{
    Arguments *arguments = input;
    CaseList list = {0, NULL};
    PicturePaths beside;
    OstVerifyReport **reports = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(find_cases(ctx, arguments, &list));
    OST_TRY_DONE(choose_destinations(ctx, &arguments->common, &list, &beside));
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &reports, list.count)));
    status = run_all(ctx, &arguments->common, &list, &beside, reports);
done:
    for (int i = 0; reports && i < list.count; i++) {
        arguments->all_passed &= reports[i] != NULL && reports[i]->passed;
        ost_verify_report_destroy(&reports[i]);
    }
    OST_FREE(reports, list.path);
    return status;
}

int ost_cli_verify(OstContext *ctx, int argc, char **argv)
{
    Arguments arguments = {.all_passed = 1};
    const int exit_code = ost_cli_run_on_cases(ctx, &verify_argp, argc, argv, &arguments, verify);
    return exit_code == 0 && !arguments.all_passed ? ost_status_exit_code(OST_CHECK_FAILED) : exit_code;
}
