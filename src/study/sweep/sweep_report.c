/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/sweep/sweep.h"

#include "core/error.h"
#include "core/json_file.h"
#include "core/write_aside.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The width of a key's column: of the key, or of a number. */
static int width_of(const OstSweep *sweep, int key)
{
    enum { OF_A_NUMBER = 18 };
    const int length = (int)strlen(sweep->key[key].key);
    return length > OF_A_NUMBER ? length : OF_A_NUMBER;
}

/* A value as a number, where it is one. */
static int read_number(const char *text, double *number)
{
    char *end = NULL;
    *number = strtod(text, &end);
    return end != text && *end == 0;
}

void ost_sweep_print(const OstSweep *sweep)
{
    if (ost_rank(sweep->ctx) != 0)
        return;
    printf("%s: %d run%s\n", sweep->path, sweep->run_count, sweep->run_count == 1 ? "" : "s");
    for (int k = 0; k < sweep->key_count; k++)
        printf("  %*s", width_of(sweep, k), sweep->key[k].key);
    if (sweep->case_count > 0)
        printf("  %-16s", "load case");
    printf(" %14s %14s %9s %7s", "largest |u|", "strain energy", "off by", "Newton");
    for (int w = 0; w < sweep->watch_count; w++)
        printf(" %14.14s", sweep->watch[w]);
    puts("");
    for (int r = 0; r < sweep->done; r++) {
        const OstSweepRun *run = &sweep->run[r];
        for (int k = 0; k < sweep->key_count; k++)
            printf("  %*.*s", width_of(sweep, k), width_of(sweep, k), run->value[k]);
        if (run->load_case)
            printf("  %-16s", run->load_case);
        if (run->failure) {
            printf("  no answer: %.120s\n", run->failure);
            continue;
        }
        printf(" %14.8g %14.8g", run->largest_displacement, run->strain_energy);
        if (isfinite(run->relative_error))
            printf(" %7.2g %%", 100.0 * run->relative_error);
        else
            printf(" %9s", "-");
        printf(" %7d", run->newton_iterations);
        for (int w = 0; w < sweep->watch_count; w++)
            if (isfinite(run->watched[w]))
                printf(" %14.8g", run->watched[w]);
            else
                printf(" %14s", "-");
        puts("");
    }
}

static OstStatus write_rows(FILE *file, const void *content)
{
    const OstSweep *sweep = content;
    for (int k = 0; k < sweep->key_count; k++) {
        ost_csv_text(file, sweep->key[k].key);
        fputc(',', file);
    }
    if (sweep->case_count > 0)
        fputs("load_case,", file);
    fputs("answered,largest_displacement,strain_energy,relative_error,unknowns,newton_iterations,iterations,seconds",
          file);
    for (int w = 0; w < sweep->watch_count; w++) {
        fputc(',', file);
        ost_csv_text(file, sweep->watch[w]);
    }
    fputc('\n', file);
    for (int r = 0; r < sweep->done; r++) {
        const OstSweepRun *run = &sweep->run[r];
        double number;
        for (int k = 0; k < sweep->key_count; k++) {
            if (read_number(run->value[k], &number))
                fputs(run->value[k], file);
            else
                ost_csv_text(file, run->value[k]);
            fputc(',', file);
        }
        if (run->load_case)
            fprintf(file, "%s,", run->load_case);
        if (run->failure) {
            fputs("0,,,,,,", file);
            fprintf(file, ",%.6g", run->seconds);
        } else {
            fprintf(file, "1,%.17g,%.17g", run->largest_displacement, run->strain_energy);
            ost_csv_number(file, run->relative_error);
            fprintf(file, ",%lld,%d,%d,%.6g", (long long)run->unknowns, run->newton_iterations, run->iterations,
                    run->seconds);
        }
        for (int w = 0; w < sweep->watch_count; w++)
            ost_csv_number(file, run->failure ? NAN : run->watched[w]);
        fputc('\n', file);
    }
    return OST_SUCCESS;
}

OstStatus ost_sweep_write_csv(const OstSweep *sweep, const char *to)
{
    return ost_rank(sweep->ctx) == 0 ? ost_write_aside(sweep->ctx, to, write_rows, sweep) : OST_SUCCESS;
}

static json_t *run_json(const OstSweep *sweep, const OstSweepRun *run)
{
    json_t *values = json_object(), *watched = json_object();
    for (int k = 0; k < sweep->key_count; k++) {
        double number;
        json_object_set_new(values, sweep->key[k].key,
                            read_number(run->value[k], &number) ? ost_json_number(number)
                                                                : ost_json_text(run->value[k]));
    }
    for (int w = 0; w < sweep->watch_count; w++)
        json_object_set_new(watched, sweep->watch[w], ost_json_number(run->failure ? NAN : run->watched[w]));
    return json_pack("{s:o, s:s?, s:b, s:s?, s:o, s:o, s:o, s:I, s:i, s:i, s:f, s:o}", "values", values, "load_case",
                     run->load_case, "answered", run->failure == NULL, "failure", run->failure, "largest_displacement",
                     run->failure ? json_null() : ost_json_number(run->largest_displacement), "strain_energy",
                     run->failure ? json_null() : ost_json_number(run->strain_energy), "relative_error",
                     run->failure ? json_null() : ost_json_number(run->relative_error), "unknowns",
                     (json_int_t)run->unknowns, "newton_iterations", run->newton_iterations, "iterations",
                     run->iterations, "seconds", run->seconds, "watched", watched);
}

OstStatus ost_sweep_write_json(const OstSweep *sweep, const char *to)
{
    if (ost_rank(sweep->ctx) != 0)
        return OST_SUCCESS;
    json_t *runs = json_array(), *keys = json_array(), *cases = json_array(), *watches = json_array();
    for (int k = 0; k < sweep->key_count; k++)
        json_array_append_new(keys, ost_json_text(sweep->key[k].key));
    for (int k = 0; k < sweep->case_count; k++)
        json_array_append_new(cases, ost_json_text(sweep->cases[k].name));
    for (int w = 0; w < sweep->watch_count; w++)
        json_array_append_new(watches, ost_json_text(sweep->watch[w]));
    for (int r = 0; r < sweep->done; r++)
        json_array_append_new(runs, run_json(sweep, &sweep->run[r]));
    json_t *document = json_pack("{s:s, s:o, s:o, s:o, s:o, s:o}", "case", sweep->path, "keys", keys, "load_cases",
                                 cases, "watched", watches, "warnings", ost_json_warnings(sweep->ctx), "runs", runs);
    return document ? ost_json_write(sweep->ctx, document, to)
                    : OST_RAISE(sweep->ctx, OST_LIBRARY_FAILED, "%s: the runs cannot be written as JSON", sweep->path);
}
