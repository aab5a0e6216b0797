/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/cost.h"

#include "core/write_aside.h"

#include <math.h>
#include <stdio.h>

/* In quotes; quotes within the text are doubled. */
static void write_text(FILE *file, const char *text)
{
    fputc('"', file);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', file);
        fputc(*text, file);
    }
    fputc('"', file);
}

/* An empty field where there is no number. */
static void write_number(FILE *file, int known, double number)
{
    fputc(',', file);
    if (known && isfinite(number))
        fprintf(file, "%.17g", number);
}

static void write_heading(FILE *file, const OstCost *cost)
{
    fputs("order,refinement,tolerance,state,reason,predicted_seconds,unknowns,tets,iterations,residual,repeats,seconds",
          file);
    for (int p = 0; p < OST_COST_PHASES; p++)
        fprintf(file, ",%s_seconds", ost_cost_phase_label((OstCostPhase)p));
    fputs(",bytes", file);
    for (int q = 0; q < cost->quantity_count; q++) {
        static const char *const columns[] = {"",       " reference", " reference uncertainty", " reference kind",
                                              " error", " claim"};
        for (size_t c = 0; c < sizeof columns / sizeof *columns; c++) {
            char name[256];
            snprintf(name, sizeof name, "%.200s%s", cost->quantity[q].name, columns[c]);
            fputc(',', file);
            write_text(file, name);
        }
    }
    fputc('\n', file);
}

static void write_run(FILE *file, const OstCost *cost, const OstCostRun *run)
{
    const int done = run->state == OST_COST_DONE;
    fprintf(file, "%d,%d,%g,%s,", run->order, run->refinement, run->tolerance, ost_cost_state_word(run->state));
    write_text(file, run->reason);
    write_number(file, run->predicted_seconds > 0.0, run->predicted_seconds);
    if (done)
        fprintf(file, ",%lld,%lld,%d", (long long)run->unknowns, (long long)run->tets, run->iterations);
    else
        fputs(",,,", file);
    write_number(file, done, run->residual);
    write_number(file, done, run->repeats);
    write_number(file, done, run->seconds);
    for (int p = 0; p < OST_COST_PHASES; p++)
        write_number(file, done, run->phase[p]);
    write_number(file, done, run->bytes);
    for (int q = 0; q < cost->quantity_count; q++) {
        const OstCostReference *reference = &cost->quantity[q].reference;
        write_number(file, done, run->watched[q].value);
        write_number(file, reference->kind != OST_REFERENCE_NONE, reference->value);
        write_number(file, reference->kind != OST_REFERENCE_NONE, reference->uncertainty);
        fprintf(file, ",%s", ost_reference_kind_word(reference->kind));
        write_number(file, done, run->error[q]);
        write_number(file, done, ost_cost_claim(cost, run, q));
    }
    fputc('\n', file);
}

static OstStatus write_csv(FILE *file, const void *content)
{
    const OstCost *cost = content;
    write_heading(file, cost);
    for (int i = 0; i < cost->run_count; i++)
        write_run(file, cost, &cost->run[i]);
    return OST_SUCCESS;
}

OstStatus ost_cost_write_csv(const OstCost *cost, const char *path)
{
    return ost_rank(cost->ctx) == 0 ? ost_write_aside(cost->ctx, path, write_csv, cost) : OST_SUCCESS;
}
