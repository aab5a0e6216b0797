/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "study/cost.h"

#include <math.h>
#include <stdio.h>

enum { ERROR_WIDTH = 12, NORM_WIDTH = 9, CELL_SIZE = 40 };
static const double mebibyte = 1048576.0;

/* 1,234,567 */
static void with_commas(OstGlobal number, char *text, size_t size)
{
    char digits[CELL_SIZE];
    const int count = snprintf(digits, sizeof digits, "%lld", (long long)number);
    size_t out = 0;
    for (int i = 0; i < count && out + 2 < size; i++) {
        if (i > 0 && (count - i) % 3 == 0)
            text[out++] = ',';
        text[out++] = digits[i];
    }
    text[out] = 0;
}

static void percent(double share, char *text, size_t size)
{
    const double hundredths = 100.0 * share;
    if (hundredths != 0.0 && (hundredths < 1e-3 || hundredths >= 1e4))
        snprintf(text, size, "%.0e %%", hundredths);
    else
        ost_percent(share, text, size);
}

/* An error smaller than its estimate is printed as an upper bound. */
static void error_cell(const OstCost *cost, const OstCostRun *run, int quantity, char *text, size_t size)
{
    const double error = run->error[quantity];
    const double claim = ost_cost_claim(cost, run, quantity);
    char number[CELL_SIZE - 2];
    if (isnan(error)) {
        snprintf(text, size, cost->quantity[quantity].reference.kind == OST_REFERENCE_FINEST ? "(finest)" : "-");
        return;
    }
    percent(isinf(claim) ? error : claim, number, sizeof number);
    snprintf(text, size, "%s%s", isinf(claim) ? "~ " : claim > error ? "< " : "", number);
}

static void print_heading(const OstCost *cost)
{
    printf("  order  refine  tolerance     unknowns %*s %*s", NORM_WIDTH, "estimated", NORM_WIDTH, "true");
    for (int q = 0; q < cost->quantity_count; q++)
        printf(" %*.*s", ERROR_WIDTH, ERROR_WIDTH, cost->quantity[q].name);
    for (int p = OST_STAGE_MESH; p < OST_STAGE_OUTPUT; p++)
        printf(" %9s", ost_stage_label[p]);
    printf(" %9s %9s %12s\n", ost_stage_label[OST_STAGE_REST], "total", "memory");
}

static void print_seconds(double seconds)
{
    if (seconds < 0.9995)
        printf(" %6.1f ms", 1e3 * seconds);
    else
        printf(seconds < 99.95 ? " %7.2f s" : " %7.0f s", seconds);
}

static void print_norm(double error)
{
    char cell[CELL_SIZE] = "-";
    if (!isnan(error))
        percent(error, cell, sizeof cell);
    printf(" %*s", NORM_WIDTH, cell);
}

static void print_setting(const OstCostRun *run)
{
    if (run->accuracy == 0.0)
        printf("  %5d  %6d  %9.0e", run->order, run->refinement, run->tolerance);
    else
        printf("  adaptively to %6.2g %%", 100.0 * run->accuracy);
}

/* What else the run is, and how Newton's method went. */
static void print_more(const OstCostRun *run)
{
    char more[64];
    ost_cost_describe(run, more, sizeof more);
    printf("%s%s", more[0] ? "  " : "", more);
    if (run->newton.used)
        printf("%s%d load step%s, %d Newton iterations", more[0] ? ": " : "  ", run->newton.load_steps,
               run->newton.load_steps == 1 ? "" : "s", run->newton.iterations);
}

static void print_run(const OstCost *cost, const OstCostRun *run)
{
    char cell[CELL_SIZE];
    print_setting(run);
    if (run->state != OST_COST_DONE) {
        char more[64];
        ost_cost_describe(run, more, sizeof more);
        printf("%s%s", more[0] ? "  " : "", more);
        printf("     %s%s%s%s\n", ost_cost_state_word[run->state], run->state == OST_COST_NOT_RUN ? " (" : ": ",
               run->reason, run->state == OST_COST_NOT_RUN ? ")" : "");
        return;
    }
    with_commas(run->unknowns, cell, sizeof cell);
    printf(" %12s", cell);
    print_norm(run->estimate);
    print_norm(run->true_norm);
    for (int q = 0; q < cost->quantity_count; q++) {
        error_cell(cost, run, q, cell, sizeof cell);
        printf(" %*s", ERROR_WIDTH, cell);
    }
    for (int p = OST_STAGE_MESH; p < OST_STAGE_OUTPUT; p++)
        print_seconds(run->phase[p]);
    print_seconds(run->phase[OST_STAGE_REST]);
    print_seconds(run->seconds);
    printf(" %8.1f MiB", run->bytes / mebibyte);
    print_more(run);
    printf("\n");
    if (run->reason[0])
        printf("      %s\n", run->reason);
}

static void print_reference(const OstCostQuantity *quantity)
{
    const OstCostReference *reference = &quantity->reference;
    const char *source = quantity->watch ? quantity->watch->source : NULL;
    char known[CELL_SIZE] = "";
    printf("  %-14s ", quantity->name);
    percent(reference->uncertainty, known, sizeof known);
    if (reference->kind == OST_REFERENCE_NONE)
        printf("none: no run has an answer");
    else if (reference->kind == OST_REFERENCE_FORMULA)
        printf("%s %.10g%s%s", reference->note, reference->value, source ? ", " : "", source ? source : "");
    else if (reference->kind == OST_REFERENCE_ESTIMATED)
        printf("%.10g: %s; good to %s", reference->value, reference->note, known);
    else
        printf("%.10g, order %d, up to refinement %d: %s; %s%s", reference->value, reference->order, reference->finest,
               reference->note, isinf(reference->uncertainty) ? "not to be trusted" : "good to ",
               isinf(reference->uncertainty) ? "" : known);
    if (reference->kind != OST_REFERENCE_NONE && reference->size > fabs(reference->value))
        printf("; that is negligible beside %.4g, to which errors are relative", reference->size);
    printf("\n");
}

/* Where no run reaches the target: the smallest estimated error. None is told to be smaller than that of the reference.
 */
static void print_out_of_reach(const OstCost *cost, int quantity)
{
    const double uncertainty = cost->quantity[quantity].reference.uncertainty;
    double best = INFINITY;
    char number[CELL_SIZE];
    for (int i = 0; i < cost->run_count; i++)
        best = fmin(best, ost_cost_claim(cost, &cost->run[i], quantity)); /* fmin ignores NaN */
    percent(best, number, sizeof number);
    if (isinf(best))
        printf("no run reaches it: the accuracy of the reference is not known\n");
    else if (best <= uncertainty)
        printf("no run is known to reach it: the reference is good to %s alone; give more --refinements\n", number);
    else
        printf("no run reaches it: the best has %s\n", number);
}

static void print_cheapest_for(const OstCost *cost, int quantity, double target)
{
    const int cheapest = ost_cost_cheapest(cost, quantity, target);
    const int next = ost_cost_cheapest(cost, quantity, 0.1 * target);
    printf(" %4.3g %%  ", 100.0 * target);
    if (cheapest < 0) {
        print_out_of_reach(cost, quantity);
        return;
    }
    const OstCostRun *run = &cost->run[cheapest];
    char more[64];
    ost_cost_describe(run, more, sizeof more);
    if (run->accuracy == 0.0)
        printf("order %d, refinement %d, tolerance %.0e%s%s ", run->order, run->refinement, run->tolerance,
               more[0] ? ", " : "", more);
    else
        printf("adaptively to %-4.2g %%: %d meshes, order %d ", 100.0 * run->accuracy, run->levels, run->order);
    print_seconds(run->seconds);
    printf(" %8.1f MiB", run->bytes / mebibyte);
    const double ratio = next >= 0 ? cost->run[next].seconds / run->seconds : 0.0;
    if (next >= 0 && next != cheapest)
        printf("   a tenth of that costs %.*f times as much", ratio < 10.0, ratio);
    else if (next == cheapest)
        printf("   and less than a tenth of that");
    printf("\n");
}

/* What one more refinement would give. */
static void print_next(const OstCost *cost, int quantity)
{
    OstCostNext next;
    char error[CELL_SIZE], unknowns[CELL_SIZE];
    for (int order = 1; order <= 2; order++) {
        if (!ost_cost_next(cost, quantity, order, &next))
            continue;
        percent(next.error, error, sizeof error);
        with_commas((OstGlobal)next.unknowns, unknowns, sizeof unknowns);
        printf("  %-14s order %d, refinement %d: %s unknowns, about %s", cost->quantity[quantity].name, order,
               next.refinement, unknowns, error);
        print_seconds(next.seconds);
        printf(" %8.1f MiB   (an error %.2g times as large for %.2g times the seconds)\n", next.bytes / mebibyte,
               next.error_factor, next.seconds_factor);
    }
}

/* An accuracy asked for beside the settings that someone might have chosen. */
static void print_request(const OstCost *cost, const OstCostRun *run)
{
    const int by_hand = ost_cost_by_hand(cost, run);
    char found[CELL_SIZE];
    percent(run->true_norm, found, sizeof found);
    printf(" %4.3g %%  ", 100.0 * run->accuracy);
    if (isnan(run->true_norm))
        printf("%.2g %% off as it estimates; what is true is not known so well", 100.0 * run->estimate);
    else
        printf("%s off, %.2f of that", found, run->true_norm / run->accuracy);
    if (by_hand >= 0)
        printf("; %.2g times the seconds of order %d, refinement %d, tolerance %.0e\n",
               run->seconds / cost->run[by_hand].seconds, cost->run[by_hand].order, cost->run[by_hand].refinement,
               cost->run[by_hand].tolerance);
    else
        printf("; no setting above is known to be as good\n");
}

static void print_requests(const OstCost *cost)
{
    int count = 0;
    for (int i = 0; i < cost->run_count; i++) {
        const OstCostRun *run = &cost->run[i];
        if (run->accuracy == 0.0 || run->state != OST_COST_DONE || run->reason[0])
            continue;
        if (count == 0)
            printf("\nwhat was asked for, and the cheapest setting by hand that meets it\n");
        printf("  %-14s", count++ == 0 ? "energy norm" : "");
        print_request(cost, run);
    }
}

void ost_cost_print(const OstCost *cost)
{
    if (ost_rank(cost->ctx) != 0)
        return;
    int done = 0;
    for (int i = 0; i < cost->run_count; i++)
        done += cost->run[i].state == OST_COST_DONE;
    printf("%s: %s\n  %d of %d runs done in %.3g s on %d rank%s\n\n"
           "errors and costs (estimated, true: of the whole answer in the norm of the energy, the former by the run "
           "itself; seconds of the slowest rank, memory of Orthostat's own arrays on all ranks)\n",
           cost->c->path, cost->c->title, done, cost->run_count, cost->seconds, ost_size(cost->ctx),
           ost_size(cost->ctx) == 1 ? "" : "s");
    print_heading(cost);
    for (int i = 0; i < cost->run_count; i++)
        print_run(cost, &cost->run[i]);
    printf("\nerrors are relative to\n");
    for (int q = 0; q < cost->quantity_count; q++)
        print_reference(&cost->quantity[q]);
    printf("\ncheapest for an error of\n");
    for (int q = 0; q < cost->quantity_count; q++)
        for (int t = 0; t < OST_COST_TARGETS; t++) {
            printf("  %-14s", t == 0 ? cost->quantity[q].name : "");
            print_cheapest_for(cost, q, ost_cost_target[t]);
        }
    print_requests(cost);
    printf("\nthe next refinement would give\n");
    for (int q = 0; q < cost->quantity_count; q++)
        print_next(cost, q);
}
