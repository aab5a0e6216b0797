/* SPDX-License-Identifier: BSD-3-Clause */
#include "output/path_files.h"

#include "core/error.h"
#include "core/json_file.h"
#include "core/memory.h"
#include "core/write_aside.h"
#include "formats/serial/output_array.h"
#include "output/series.h"
#include "output/summary.h"

#include <stdio.h>
#include <string.h>

void ost_path_file_name(const char *output, OstPathFile which, size_t size, char *name)
{
    static const char *const ending[OST_PATH_FILES] = {
        [OST_PATH_SERIES] = ".hdf.series", /* ParaView 5.11 knows the reader by the ending .hdf */
        [OST_PATH_HISTORY] = "_history.csv",
        [OST_PATH_CHECKPOINT] = ".checkpoint",
    };
    size_t stem;
    const OstResultForm form = ost_result_form(output, &stem);
    const int is_xml = form == OST_RESULT_VTU || form == OST_RESULT_PVTU;
    snprintf(name, size, "%.*s%s", (int)stem, output, is_xml && which == OST_PATH_SERIES ? ".pvd" : ending[which]);
}

void ost_path_step_name(const char *output, int step, size_t size, char *name)
{
    size_t stem;
    ost_result_form(output, &stem);
    snprintf(name, size, "%.*s_%04d%s", (int)stem, output, step, output + stem);
}

/* --- the list of files --- */

static OstStatus write_series(OstContext *ctx, OstPath *path, const char *output, OstSeriesFile *files, char *names)
{
    const size_t length = strlen(output) + 16;
    char list[4096];
    for (int i = 0; i < ost_path_done(path); i++) {
        char *name = names + (size_t)i * length;
        ost_path_step_name(output, i + 1, length, name);
        files[i] = (OstSeriesFile){name, ost_path_step(path, i)->t};
    }
    ost_path_file_name(output, OST_PATH_SERIES, sizeof list, list);
    return ost_series_write(ctx, list, ost_path_done(path), files);
}

OstStatus ost_path_write_series(OstContext *ctx, OstPath *path, const char *output)
{
    OstSeriesFile *files = NULL;
    char *names = NULL;
    if (ost_rank(ctx) != 0)
        return OST_SUCCESS;
    OstStatus status = OST_NEW(ctx, &files, ost_path_done(path));
    OST_THEN(OST_NEW(ctx, &names, (size_t)ost_path_done(path) * (strlen(output) + 16)));
    OST_THEN(write_series(ctx, path, output, files, names));
    OST_FREE(files, names);
    return status;
}

/* --- the history --- */

typedef struct History {
    const OstCase *c;
    OstPath *path;
} History;

/* Does a load, a prescribed displacement or an eigenstrain follow this function of time? */
static int is_followed(const OstCase *c, int function)
{
    int followed = 0;
    for (int i = 0; i < c->material_count; i++)
        followed |= c->materials[i].eigenstrained && c->eigen_table == function;
    for (int i = 0; i < c->load_count; i++)
        followed |= c->loads[i].table == function;
    for (int i = 0; i < c->constraint_count; i++)
        followed |= c->constraints[i].table == function && ost_constraint_moves(&c->constraints[i]);
    return followed;
}

static double factor_at(const OstCase *c, int function, double t)
{
    static const OstTimeTable ramp = {0};
    return ost_time_factor(function == 0 ? &ramp : &c->tables[function - 1], t);
}

static void write_heading(FILE *file, const OstCase *c)
{
    int functions = 0, number = 0;
    for (int f = 0; f <= c->table_count; f++)
        functions += is_followed(c, f);
    fputs("step,t", file);
    for (int f = 0; f <= c->table_count; f++)
        if (is_followed(c, f) && functions > 1)
            fprintf(file, ",load_factor_%d", ++number);
        else if (is_followed(c, f))
            fputs(",load_factor", file);
    fputs(",largest_displacement,strain_energy,newton_iterations,load_steps,iterations", file);
    for (int w = 0; w < c->watch_count; w++) {
        fputc(',', file);
        ost_csv_text(file, c->watches[w].name);
    }
    fputc('\n', file);
}

static OstStatus write_rows(FILE *file, const void *content)
{
    const History *history = content;
    const OstCase *c = history->c;
    write_heading(file, c);
    for (int i = 0; i < ost_path_done(history->path); i++) {
        const OstPathStep *step = ost_path_step(history->path, i);
        fprintf(file, "%d,%.17g", i + 1, step->t);
        for (int f = 0; f <= c->table_count; f++)
            if (is_followed(c, f))
                fprintf(file, ",%.17g", factor_at(c, f, step->t));
        fprintf(file, ",%.17g,%.17g,%d,%d,%d", step->largest_displacement, step->strain_energy, step->newton_iterations,
                step->load_steps, step->iterations);
        for (int w = 0; w < c->watch_count; w++)
            fprintf(file, ",%.17g", step->note[w]);
        fputc('\n', file);
    }
    return OST_SUCCESS;
}

OstStatus ost_path_write_history(const OstScene *scene, OstPath *path, const char *output)
{
    const History history = {scene->c, path};
    char name[4096];
    ost_path_file_name(output, OST_PATH_HISTORY, sizeof name, name);
    return ost_rank(scene->ctx) == 0 ? ost_write_aside(scene->ctx, name, write_rows, &history) : OST_SUCCESS;
}

/* --- the table of steps --- */

/* The step of which linear theory is farthest off, with a warning in words if that is too far. */
static int find_warning(OstPath *path, char text[OST_LONGEST_WARNING])
{
    int worst = 0;
    double largest = -1.0;
    OstChecks checks = {.linear = 1, .finite = 1};
    for (int i = 0; i < ost_path_done(path); i++) {
        const OstPathStep *step = ost_path_step(path, i);
        const OstChecks of_step = {.largest_strain = step->largest_strain, .largest_rotation = step->largest_rotation};
        if (!step->linear || !(ost_linear_error(&of_step) > largest))
            continue;
        largest = ost_linear_error(&of_step);
        checks.largest_strain = step->largest_strain;
        checks.largest_rotation = step->largest_rotation;
        worst = i;
    }
    return ost_linearity_warning(&checks, 0, text) ? worst + 1 : 0;
}

void ost_path_print(const OstScene *scene, OstPath *path, const char *output)
{
    const OstCase *c = scene->c;
    const int done = ost_path_done(path);
    char first[4096], last[4096], series[4096], history[4096], warning[OST_LONGEST_WARNING];
    if (ost_rank(scene->ctx) != 0)
        return;
    printf("\npath of %d step%s", ost_path_count(path), ost_path_count(path) == 1 ? "" : "s");
    if (done < ost_path_count(path))
        printf(", of which %d %s done", done, done == 1 ? "is" : "are");
    puts("");
    if (done == 0)
        return;
    printf("  %4s %10s %14s %14s %7s %7s", "step", "t", "largest |u|", "strain energy", "Newton", "solver");
    for (int w = 0; w < c->watch_count; w++)
        printf(" %14.14s", c->watches[w].name);
    puts("");
    for (int i = 0; i < done; i++) {
        const OstPathStep *step = ost_path_step(path, i);
        printf("  %4d %10.6g %14.8g %14.8g %7d %7d", i + 1, step->t, step->largest_displacement, step->strain_energy,
               step->newton_iterations, step->iterations);
        for (int w = 0; w < c->watch_count; w++)
            printf(" %14.8g", step->note[w]);
        puts("");
    }
    const int warned = find_warning(path, warning);
    if (warned > 0 && warned != done) /* the last one's stands in the summary */
        printf("  %-16s step %d: %s\n", "WARNING", warned, warning);
    ost_path_step_name(output, 1, sizeof first, first);
    ost_path_step_name(output, done, sizeof last, last);
    ost_path_file_name(output, OST_PATH_SERIES, sizeof series, series);
    ost_path_file_name(output, OST_PATH_HISTORY, sizeof history, history);
    printf("  %-16s %s%s%s, listed in %s for ParaView; history in %s\n", "written to", first, done > 1 ? " to " : "",
           done > 1 ? last : "", series, history);
}

static json_t *step_json(const OstCase *c, const OstPathStep *step)
{
    json_t *watched = json_object();
    for (int w = 0; w < c->watch_count; w++)
        json_object_set_new(watched, c->watches[w].name, ost_json_number(step->note[w]));
    return json_pack("{s:f, s:f, s:f, s:i, s:i, s:i, s:f, s:f, s:o}", "t", step->t, "largest_displacement",
                     step->largest_displacement, "strain_energy", step->strain_energy, "iterations", step->iterations,
                     "newton_iterations", step->newton_iterations, "load_steps", step->load_steps, "largest_strain",
                     step->largest_strain, "largest_rotation", step->largest_rotation, "watched", watched);
}

json_t *ost_path_json(const OstScene *scene, OstPath *path)
{
    json_t *steps = json_array();
    for (int i = 0; i < ost_path_done(path); i++)
        json_array_append_new(steps, step_json(scene->c, ost_path_step(path, i)));
    return steps;
}
