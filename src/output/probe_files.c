/* SPDX-License-Identifier: BSD-3-Clause */
#include "output/probe_files.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "core/write_aside.h"
#include "formats/serial/output_array.h"
#include "probe/sample.h"

#include <stdio.h>

static const char *const measure_word[OST_STRESS_MEASURES] = {
#define MEASURE_WORD(name, word) [name] = word,
    OST_STRESS_MEASURE_TABLE(MEASURE_WORD)
#undef MEASURE_WORD
};

void ost_probe_file_name(const char *fields, const OstProbe *probe, size_t size, char *name)
{
    size_t stem;
    ost_result_form(fields, &stem);
    snprintf(name, size, "%.*s_%s.csv", (int)stem, fields, probe->name);
}

typedef struct Table {
    const OstProbe *probe;
    const OstSample *samples;
} Table;

static void write_cell(FILE *file, const OstSample *sample, double value)
{
    fputc(',', file);
    if (sample->tet > 0)
        fprintf(file, "%.10g", value);
}

/* `distance`: along the straight lines from point to point. */
static OstStatus write_rows(FILE *file, const void *content)
{
    const Table *table = content;
    const double *before = table->probe->points;
    double distance = 0.0;
    fputs("point,distance,x,y,z,tet,displacement_x,displacement_y,displacement_z", file);
    for (int m = 0; m < OST_STRESS_MEASURES; m++)
        fprintf(file, ",stress_%s", measure_word[m]);
    fputc('\n', file);
    for (OstLocal p = 0; p < table->probe->count; p++) {
        const double *x = table->probe->points + 3 * (size_t)p;
        const OstSample *sample = &table->samples[p];
        distance += ost_norm3((const double[3]){x[0] - before[0], x[1] - before[1], x[2] - before[2]});
        before = x;
        fprintf(file, "%ld,%.10g,%.10g,%.10g,%.10g,", (long)p + 1, distance, x[0], x[1], x[2]);
        if (sample->tet > 0)
            fprintf(file, "%lld", (long long)sample->tet);
        for (int i = 0; i < 3; i++)
            write_cell(file, sample, sample->displacement[i]);
        for (int m = 0; m < OST_STRESS_MEASURES; m++)
            write_cell(file, sample, sample->stress[m]);
        fputc('\n', file);
    }
    return OST_SUCCESS;
}

static void warn_of_outside(const OstScene *scene, const OstProbe *probe, const OstSample *samples)
{
    OstLocal outside = 0, first = 0;
    for (OstLocal p = probe->count; p-- > 0;)
        if (samples[p].tet == 0) {
            outside++;
            first = p;
        }
    if (outside > 0)
        ost_warn(scene->ctx,
                 "%s:%d: %d of %d points of '%s' are outside the body, the first of them point %d at (%g, %g, %g); "
                 "their rows are empty",
                 scene->c->path, probe->line, (int)outside, (int)probe->count, probe->name, (int)first + 1,
                 probe->points[3 * (size_t)first], probe->points[3 * (size_t)first + 1],
                 probe->points[3 * (size_t)first + 2]);
}

static OstStatus write_probe(const OstScene *scene, const OstResult *result, const OstProbe *probe, const char *fields)
{
    OstContext *ctx = scene->ctx;
    OstSample *samples = NULL;
    char name[4096];
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &samples, probe->count)));
    OstStatus status = ost_sample_points(result, probe->count, probe->points, samples);
    if (status == OST_SUCCESS) {
        const Table table = {probe, samples};
        warn_of_outside(scene, probe, samples);
        ost_probe_file_name(fields, probe, sizeof name, name);
        status = ost_agree(ctx, ost_rank(ctx) == 0 ? ost_write_aside(ctx, name, write_rows, &table) : OST_SUCCESS);
    }
    OST_FREE(samples);
    return status;
}

OstStatus ost_probe_write(const OstScene *scene, const OstResult *result, const char *fields)
{
    OstStatus status = OST_SUCCESS;
    ost_ledger_enter(scene->ctx, OST_EFFECT_RECOVERY);
    for (int p = 0; p < scene->c->probe_count && status == OST_SUCCESS; p++)
        status = write_probe(scene, result, &scene->c->probes[p], fields);
    ost_ledger_leave(scene->ctx);
    return status;
}
