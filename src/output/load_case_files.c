/* SPDX-License-Identifier: BSD-3-Clause */
#include "output/load_case_files.h"

#include "core/error.h"
#include "core/json_file.h"
#include "core/memory.h"
#include "core/write_aside.h"
#include "formats/serial/output_array.h"
#include "output/path_files.h"
#include "output/series.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LONGEST_PATH = 4096 };

OstStatus ost_load_case_note(const OstScene *scene, const OstResult *result, OstWatchedValue *watched,
                             const OstAdaption *adaption, const char *file, OstLoadCaseReport *report)
{
    OstContext *ctx = scene->ctx;
    report->is_known = 1;
    report->largest_displacement = result->largest_displacement;
    report->strain_energy = result->checks.strain_energy;
    report->relative_error = result->answer.known ? result->answer.relative : NAN;
    report->iterations = result->solve.iterations;
    report->newton_iterations = result->newton.iterations;
    report->nonzeros = result->solve.nonzeros;
    report->failing = result->failure;
    report->watched = watched;
    if (file)
        OST_TRY(ost_copy_string(ctx, file, &report->file));
    if (ost_rank(ctx) == 0) {
        report->json = ost_summary_json(scene, result, NULL, watched, file);
        if (report->json)
            json_object_set_new_nocheck(report->json, "load_case", json_string(report->name));
        if (report->json && adaption)
            json_object_set_new(report->json, "adaption", ost_adaption_json(adaption));
    }
    return OST_SUCCESS;
}

void ost_load_case_report_release(OstLoadCaseReport *report)
{
    OST_FREE(report->failure, report->watched, report->file);
    json_decref(report->json);
    report->json = NULL;
}

/* --- names --- */

int ost_load_cases_in_one_file(const OstCase *c, const char *output)
{
    size_t stem;
    return ost_result_form(output, &stem) == OST_RESULT_VTKHDF && !c->asks_error; /* each refines its own mesh */
}

/* What to open in ParaView. */
static void name_whole(const OstCase *c, const char *output, size_t size, char *name)
{
    if (ost_load_cases_in_one_file(c, output))
        snprintf(name, size, "%s", output);
    else
        ost_path_file_name(output, OST_PATH_SERIES, size, name);
}

void ost_load_case_fields_name(const char *output, const char *name, size_t size, char *path)
{
    size_t stem;
    ost_result_form(output, &stem);
    snprintf(path, size, "%.*s_%s%s", (int)stem, output, name, output + stem);
}

void ost_load_case_table_name(const char *output, size_t size, char *path)
{
    size_t stem;
    ost_result_form(output, &stem);
    snprintf(path, size, "%.*s_cases.csv", (int)stem, output);
}

/* --- the list of files --- */

static OstStatus write_series(OstContext *ctx, int count, const OstLoadCaseReport *reports, const char *output)
{
    char list[LONGEST_PATH];
    OstSeriesFile *files = NULL;
    int written = 0;
    OST_TRY(OST_NEW(ctx, &files, count));
    for (int k = 0; k < count; k++)
        if (reports[k].file)
            files[written++] = (OstSeriesFile){reports[k].file, k + 1};
    ost_path_file_name(output, OST_PATH_SERIES, sizeof list, list);
    const OstStatus status = ost_series_write(ctx, list, written, files);
    OST_FREE(files);
    return status;
}

/* --- the table --- */

/* The names of all quantities of interest, each once. */
typedef struct Columns {
    int count;
    const char **name;
} Columns;

static int column_of(const Columns *columns, const char *name)
{
    int column = 0;
    while (column < columns->count && strcmp(columns->name[column], name) != 0)
        column++;
    return column;
}

static OstStatus find_columns(OstContext *ctx, int count, const OstLoadCaseReport *reports, Columns *columns)
{
    *columns = (Columns){0};
    for (int k = 0; k < count; k++)
        for (int w = 0; w < reports[k].c->watch_count; w++) {
            const char *name = reports[k].c->watches[w].name;
            if (column_of(columns, name) < columns->count)
                continue;
            OST_TRY(OST_RESIZE(ctx, &columns->name, columns->count + 1));
            columns->name[columns->count++] = name;
        }
    return OST_SUCCESS;
}

/* The value of a quantity; NAN where the case does not have it, or no answer. */
static double value_of(const OstLoadCaseReport *report, const char *name)
{
    for (int w = 0; report->watched && w < report->c->watch_count; w++)
        if (strcmp(report->c->watches[w].name, name) == 0)
            return report->watched[w].value;
    return NAN;
}

/* Does any case say by how much its loads may grow? */
static int knows_failure(int count, const OstLoadCaseReport *reports)
{
    int known = 0;
    for (int k = 0; k < count; k++)
        known = known || reports[k].failing.known;
    return known;
}

/* The least factor of a criterion; NAN where it is not known, or nothing fails. */
static double factor_of(const OstLoadCaseReport *report, int criterion)
{
    const double factor = report->failing.known ? report->failing.least[criterion].factor : NAN;
    return factor < OST_MOST_LOAD_FACTOR ? factor : NAN;
}

static int is_answer(const OstLoadCaseReport *report)
{
    return report->status == OST_SUCCESS || report->is_short;
}

static const char *state_of(const OstLoadCaseReport *report)
{
    return report->is_short                ? "not met"
           : report->status == OST_SUCCESS ? "accepted"
           : report->is_known              ? "refused"
                                           : "failed";
}

typedef struct Table {
    int count;
    const OstLoadCaseReport *reports;
    int failing; /* are there load factors? */
    Columns columns;
} Table;

static OstStatus write_rows(FILE *file, const void *content)
{
    const Table *table = content;
    fputs("case,status,largest_displacement,strain_energy,relative_error,newton_iterations,iterations", file);
    if (table->failing)
        fputs(",tsai_wu_load_factor,hill_load_factor,maximum_stress_load_factor", file);
    for (int w = 0; w < table->columns.count; w++) {
        fputc(',', file);
        ost_csv_text(file, table->columns.name[w]);
    }
    fputc('\n', file);
    for (int k = 0; k < table->count; k++) {
        const OstLoadCaseReport *report = &table->reports[k];
        fprintf(file, "%s,%s", report->name, state_of(report));
        ost_csv_number(file, report->is_known ? report->largest_displacement : NAN);
        ost_csv_number(file, report->is_known ? report->strain_energy : NAN);
        ost_csv_number(file, report->is_known ? report->relative_error : NAN);
        fprintf(file, ",%d,%d", report->newton_iterations, report->iterations);
        for (int c = 0; table->failing && c < OST_CRITERIA; c++)
            ost_csv_number(file, factor_of(report, c));
        for (int w = 0; w < table->columns.count; w++)
            ost_csv_number(file, value_of(report, table->columns.name[w]));
        fputc('\n', file);
    }
    return OST_SUCCESS;
}

OstStatus ost_load_cases_write(const OstCase *c, int count, const OstLoadCaseReport *reports, const char *output)
{
    OstContext *ctx = c->ctx;
    Table table = {count, reports, knows_failure(count, reports), {0}};
    char name[LONGEST_PATH];
    if (ost_rank(ctx) != 0)
        return OST_SUCCESS;
    OstStatus status = find_columns(ctx, count, reports, &table.columns);
    ost_load_case_table_name(output, sizeof name, name);
    OST_THEN(ost_write_aside(ctx, name, write_rows, &table));
    if (!ost_load_cases_in_one_file(c, output))
        OST_THEN(write_series(ctx, count, reports, output));
    OST_FREE(table.columns.name);
    return status;
}

/* Under which case the loads may grow by least, by each criterion. */
static void print_first_to_fail(const Table *table)
{
    static const char *const word[OST_CRITERIA] = {
        [OST_TSAI_WU] = "Tsai-Wu", [OST_HILL] = "Hill", [OST_MAXIMUM_STRESS] = "maximum stress"};
    const char *label = "strength";
    for (int c = 0; table->failing && c < OST_CRITERIA; c++) {
        const OstLoadCaseReport *first = NULL;
        for (int k = 0; k < table->count; k++)
            if (is_answer(&table->reports[k]) && isfinite(factor_of(&table->reports[k], c)) &&
                (!first || factor_of(&table->reports[k], c) < factor_of(first, c)))
                first = &table->reports[k];
        if (!first)
            continue;
        printf("  %-16s %s: the first case to fail is %s, at %.5g times its load\n", label, word[c], first->name,
               factor_of(first, c));
        label = "";
    }
}

static void print_rows(const Table *table)
{
    printf("  %-16s %14s %14s %9s %7s %7s", "case", "largest |u|", "strain energy", "off by", "Newton", "solver");
    if (table->failing)
        printf(" %9s %9s %9s", "Tsai-Wu", "Hill", "stress");
    for (int w = 0; w < table->columns.count; w++)
        printf(" %14.14s", table->columns.name[w]);
    puts("");
    for (int k = 0; k < table->count; k++) {
        const OstLoadCaseReport *report = &table->reports[k];
        printf("  %-16s ", report->name);
        if (!report->is_known) {
            puts("no answer");
            continue;
        }
        printf("%14.8g %14.8g ", report->largest_displacement, report->strain_energy);
        if (isfinite(report->relative_error))
            printf("%7.2g %%", 100.0 * report->relative_error);
        else
            printf("%9s", "-");
        printf(" %7d %7d", report->newton_iterations, report->iterations);
        for (int c = 0; table->failing && c < OST_CRITERIA; c++)
            if (isfinite(factor_of(report, c)))
                printf(" %9.4g", factor_of(report, c));
            else
                printf(" %9s", "-");
        for (int w = 0; w < table->columns.count; w++)
            if (isfinite(value_of(report, table->columns.name[w])))
                printf(" %14.8g", value_of(report, table->columns.name[w]));
            else
                printf(" %14s", "-");
        puts(report->is_short ? "  NOT MET" : is_answer(report) ? "" : "  NO ANSWER");
    }
}

void ost_load_cases_print(const OstScene *scene, int count, const OstLoadCaseReport *reports, const char *output)
{
    Table table = {count, reports, knows_failure(count, reports), {0}};
    char whole[LONGEST_PATH], csv[LONGEST_PATH];
    int written = 0;
    if (ost_rank(scene->ctx) != 0 || find_columns(scene->ctx, count, reports, &table.columns) != OST_SUCCESS)
        return;
    printf("\n%d load case%s\n", count, count == 1 ? "" : "s");
    print_rows(&table);
    print_first_to_fail(&table);
    OST_FREE(table.columns.name);
    for (int k = 0; k < count; k++)
        written += reports[k].file != NULL;
    name_whole(scene->c, output, sizeof whole, whole);
    ost_load_case_table_name(output, sizeof csv, csv);
    printf("  %-16s ", "written to");
    if (!ost_load_cases_in_one_file(scene->c, output))
        printf("%d file%s, listed in %s for ParaView", written, written == 1 ? "" : "s", whole);
    else if (written > 0)
        printf("%d step%s of %s, for ParaView", written, written == 1 ? "" : "s", whole);
    else
        printf("no file");
    printf("; this table in %s\n", csv);
}

/* --- JSON --- */

static json_t *case_json(OstLoadCaseReport *report)
{
    json_t *object = report->json;
    report->json = NULL;
    if (!object)
        return json_pack("{s:s, s:b, s:s, s:[s]}", "load_case", report->name, "accepted", 0, "status", "failed",
                         "reasons", report->failure ? report->failure : "");
    return object;
}

OstStatus ost_load_cases_write_json(const OstScene *scene, int count, OstLoadCaseReport *reports, json_t *envelope,
                                    const OstLedgerSummary *summary, const char *output, const char *to)
{
    OstContext *ctx = scene->ctx;
    json_t *cases = json_array();
    char whole[LONGEST_PATH];
    double nonzeros = 0.0;
    int accepted = 1;
    if (ost_rank(ctx) != 0) {
        json_decref(cases);
        json_decref(envelope);
        return OST_SUCCESS;
    }
    for (int k = 0; k < count; k++) {
        accepted &= is_answer(&reports[k]);
        nonzeros = fmax(nonzeros, reports[k].nonzeros);
        json_array_append_new(cases, case_json(&reports[k]));
    }
    name_whole(scene->c, output, sizeof whole, whole);
    json_t *document =
        json_pack("{s:s, s:s?, s:b, s:o, s:i, s:I, s:I, s:o, s:o?, s:o, s:o, s:s}", "case", scene->c->path, "title",
                  scene->c->title, "accepted", accepted, "warnings", ost_json_warnings(ctx), "ranks", ost_size(ctx),
                  "vertices", (json_int_t)scene->mesh->global_nodes, "tets", (json_int_t)scene->mesh->global_tets,
                  "cases", cases, "envelope", envelope, "effects", ost_effects_json(&scene->plan.effects), "ledger",
                  ost_ledger_json(ctx, nonzeros, summary), "output", whole);
    if (!document)
        return OST_RAISE(ctx, OST_CHECK_FAILED, "the summary holds what JSON cannot hold");
    return ost_json_write(ctx, document, to);
}
