/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/verify.h"

#include "core/error.h"
#include "core/json_file.h"

#include <math.h>
#include <stdio.h>

static void print_number(const char *format, int width, double number)
{
    if (isnan(number))
        printf(" %*s", width, "-");
    else
        printf(format, number);
}

static void print_verdict(const OstVerifyVerdict *verdict)
{
    printf(" %8.1e", verdict->error_limit);
    print_number(" %6.2f", 6, verdict->rate);
    if (verdict->order == OST_RATE_LOCKED || isnan(verdict->order))
        printf(" %6s", isnan(verdict->order) ? "exact" : "locks");
    else
        printf(" %6g", verdict->order);
    printf("  %s", verdict->passed ? "pass" : "FAIL");
}

static void print_quantity(const OstVerifyReport *report, int q, int all)
{
    const OstVerify *verify = report->c->verify;
    const int is_field = verify->quantity[q].kind == OST_MEASURE_FIELD;
    for (int r = 0; r < report->run_count; r++) {
        const OstVerifyRun *run = &report->run[r];
        const OstVerifyReading *reading = &run->reading[q];
        const OstVerifyVerdict *verdict = &report->verdict[q * verify->step_count + run->step];
        if (!all && verdict->run != r)
            continue;
        printf("  %-24.24s P%d %9lld", verify->quantity[q].name, verify->step[run->step].order,
               (long long)run->unknowns);
        print_number(" %13.6e", 13, is_field ? NAN : reading->expected);
        print_number(" %13.6e", 13, is_field ? NAN : reading->obtained);
        printf(" %8.1e", reading->error);
        if (verdict->run == r)
            print_verdict(verdict);
        puts("");
    }
}

/* Of each order, coarse to fine. */
static void print_effectivities(const OstVerifyReport *report)
{
    printf("  estimated over true error in energy norm:");
    for (int r = 0; r < report->run_count; r++) {
        const OstVerifyRun *run = &report->run[r];
        if (r == 0 || run->step != report->run[r - 1].step)
            printf("%s P%d", r > 0 ? "," : "", report->c->verify->step[run->step].order);
        print_number(" %.2f", 1, run->effectivity);
    }
    printf("; %s\n", report->estimated ? "pass" : "FAIL");
}

void ost_verify_print(const OstVerifyReport *report, int all)
{
    if (ost_rank(report->ctx) != 0)
        return;
    const OstVerify *verify = report->c->verify;
    printf("%s: %s\n  %s\n", report->name, report->c->title, verify->source);
    if (report->failure)
        printf("  no answer: %s\n", report->failure);
    else
        printf("  %-24s %2s %9s %13s %13s %8s %8s %6s %6s\n", "", "", "unknowns", "expected", "obtained", "error",
               "limit", "order", "theory");
    for (int q = 0; q < verify->quantity_count && !report->failure; q++)
        print_quantity(report, q, all);
    if (!report->failure)
        print_effectivities(report);
    printf("  balance: force %.1e, moment %.1e, energy %.1e; %.1f s; %s\n\n", report->force_imbalance,
           report->moment_imbalance, report->energy_imbalance, report->seconds, report->passed ? "pass" : "FAIL");
    fflush(stdout);
}

void ost_verify_print_summary(int count, OstVerifyReport *const *reports)
{
    int passed = 0;
    double force = 0.0, moment = 0.0, energy = 0.0, seconds = 0.0, least = NAN, most = NAN;
    if (count == 0 || ost_rank(reports[0]->ctx) != 0)
        return;
    for (int i = 0; i < count; i++) {
        passed += reports[i]->passed;
        force = fmax(force, reports[i]->force_imbalance);
        moment = fmax(moment, reports[i]->moment_imbalance);
        energy = fmax(energy, reports[i]->energy_imbalance);
        seconds += reports[i]->seconds;
        least = fmin(least, reports[i]->effectivity[0]);
        most = fmax(most, reports[i]->effectivity[1]);
    }
    printf("%d of %d cases pass. Worst balance: force %.1e, moment %.1e, energy %.1e. %.*f s\n", passed, count, force,
           moment, energy, seconds < 10.0, seconds);
    if (!isnan(least))
        printf("Estimated over true error in energy norm, from the second mesh on: %.2f to %.2f\n", least, most);
    for (int i = 0; i < count; i++)
        if (!reports[i]->passed)
            printf("  failed: %s\n", reports[i]->name);
}

/* --- JSON --- */

static json_t *step_json(const OstVerifyReport *report, int quantity, int step)
{
    const OstVerify *verify = report->c->verify;
    const OstVerifyVerdict *verdict = &report->verdict[quantity * verify->step_count + step];
    json_t *levels = json_array();
    for (int r = 0; r < report->run_count; r++) {
        const OstVerifyRun *run = &report->run[r];
        const OstVerifyReading *reading = &run->reading[quantity];
        if (run->step == step)
            json_array_append_new(levels, json_pack("{s:i, s:f, s:I, s:o, s:o, s:o}", "refinement", run->refinement,
                                                    "h", run->h, "unknowns", (json_int_t)run->unknowns, "expected",
                                                    ost_json_number(reading->expected), "obtained",
                                                    ost_json_number(reading->obtained), "error",
                                                    ost_json_number(reading->error)));
    }
    return json_pack("{s:i, s:o, s:f, s:o, s:o, s:b, s:b}", "order", verify->step[step].order, "levels", levels,
                     "error_limit", verdict->error_limit, "rate", ost_json_number(verdict->rate), "order_of_theory",
                     ost_json_number(verdict->order), "locks", verdict->order == OST_RATE_LOCKED, "passed",
                     verdict->passed);
}

static json_t *quantities_json(const OstVerifyReport *report)
{
    const OstVerify *verify = report->c->verify;
    json_t *quantities = json_array();
    for (int q = 0; q < verify->quantity_count && !report->failure; q++) {
        json_t *steps = json_array();
        for (int s = 0; s < verify->step_count; s++)
            if (report->verdict[q * verify->step_count + s].run >= 0)
                json_array_append_new(steps, step_json(report, q, s));
        json_array_append_new(quantities, json_pack("{s:s, s:b, s:o}", "name", verify->quantity[q].name, "field",
                                                    verify->quantity[q].kind == OST_MEASURE_FIELD, "steps", steps));
    }
    return quantities;
}

static json_t *runs_json(const OstVerifyReport *report)
{
    json_t *runs = json_array();
    for (int r = 0; r < report->run_count; r++) {
        const OstVerifyRun *run = &report->run[r];
        json_array_append_new(
            runs,
            json_pack("{s:i, s:i, s:I, s:I, s:f, s:f, s:i, s:o, s:o, s:o, s:o, s:o, s:o, s:o}", "order",
                      report->c->verify->step[run->step].order, "refinement", run->refinement, "tets",
                      (json_int_t)run->tets, "unknowns", (json_int_t)run->unknowns, "h", run->h, "seconds",
                      run->seconds, "iterations", run->iterations, "relative_residual",
                      ost_json_number(run->checks.relative_residual), "force_imbalance",
                      ost_json_number(run->checks.force_imbalance), "moment_imbalance",
                      ost_json_number(run->checks.moment_imbalance), "energy_imbalance",
                      ost_json_number(run->checks.energy_imbalance), "energy_error", ost_json_number(run->energy_error),
                      "estimate", ost_json_number(run->estimate), "effectivity", ost_json_number(run->effectivity)));
    }
    return runs;
}

static json_t *case_json(const OstVerifyReport *report)
{
    const OstVerify *verify = report->c->verify;
    return json_pack("{s:s, s:s, s:s, s:s, s:b, s:b, s:f, s:s?, s:o, s:o}", "name", report->name, "title",
                     report->c->title, "formula", verify->formula, "source", verify->source, "passed", report->passed,
                     "estimated", report->estimated, "seconds", report->seconds, "failure", report->failure,
                     "quantities", quantities_json(report), "runs", runs_json(report));
}

OstStatus ost_verify_write_json(OstContext *ctx, int count, OstVerifyReport *const *reports, int quick,
                                const char *path)
{
    int passed = 1;
    if (ost_rank(ctx) != 0)
        return OST_SUCCESS;
    json_t *cases = json_array();
    for (int i = 0; i < count; i++) {
        json_array_append_new(cases, case_json(reports[i]));
        passed &= reports[i]->passed;
    }
    json_t *document = json_pack("{s:b, s:b, s:i, s:o, s:o}", "passed", passed, "quick", quick, "ranks", ost_size(ctx),
                                 "warnings", ost_json_warnings(ctx), "cases", cases);
    if (!document)
        return OST_RAISE(ctx, OST_OUT_OF_MEMORY, "the report could not be put into JSON");
    return ost_json_write(ctx, document, path);
}
