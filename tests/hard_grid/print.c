/* SPDX-License-Identifier: BSD-3-Clause */
#include "hard_grid/grid.h"

#include <math.h>
#include <stdio.h>

/* Printed in place of a number. */
static const char *mark_of(const HardReading *reading)
{
    switch (reading->outcome) {
    case HARD_GIVEN_UP:
        return "no";
    case HARD_FALSE:
        return "FALSE";
    default:
        return NULL;
    }
}

static const HardReading *find(const HardReport *report, int shape, int order, int poisson, int column)
{
    for (int i = 0; i < report->count; i++) {
        const HardPoint *point = &report->reading[i].point;
        if (point->flaw == HARD_SOUND && point->shape == shape && point->order == order && point->poisson == poisson &&
            hard_column(point) == column)
            return &report->reading[i];
    }
    return NULL;
}

static void print_cell(const HardReading *reading, int digits)
{
    char text[16] = "";
    const char *mark = reading ? mark_of(reading) : ".";
    if (mark)
        snprintf(text, sizeof text, "%s", mark);
    else if (digits)
        snprintf(text, sizeof text, "%.0f%s", floor(reading->digits),
                 reading->outcome == HARD_SOLVED_TO_ROUNDING ? "*" : "");
    else
        snprintf(text, sizeof text, "%d", reading->iterations);
    printf(" %4.5s", text);
}

static void print_row(const HardReport *report, int shape, int order, int poisson, int digits)
{
    char label[32];
    hard_describe_poisson(poisson, label, sizeof label);
    printf("  %-15s", label);
    for (int column = 0; column < HARD_COLUMNS; column++) {
        printf("%s", column > 0 && column % HARD_AXES == 0 ? " |" : "");
        print_cell(find(report, shape, order, poisson, column), digits);
    }
    puts("");
}

static int has_points(const HardReport *report, int shape, int order)
{
    for (int i = 0; i < report->count; i++)
        if (report->reading[i].point.shape == shape && report->reading[i].point.order == order)
            return 1;
    return 0;
}

static void print_matrices(const HardReport *report, int shape, int order)
{
    static const char *const heads[] = {"E alike",  "E1 x 1e3", "E2 x 1e3", "E3 x 1e3",
                                        "E1 x 1e6", "E2 x 1e6", "E3 x 1e6"};
    for (int digits = 0; digits < 2; digits++) {
        printf("%s, order %d: %s\n  %-15s", hard_shape_name(shape), order,
               digits ? "correct digits of the displacement" : "iterations", "");
        for (size_t h = 0; h < sizeof heads / sizeof *heads; h++)
            printf("%s%15s", h > 0 ? " |" : "", heads[h]);
        puts("");
        for (int poisson = report->run.mixed ? HARD_INCOMPRESSIBLE : 0; poisson < HARD_POISSONS + report->run.mixed;
             poisson++)
            print_row(report, shape, order, poisson, digits);
    }
    puts("");
}

/* A body at size in a line. */
static void print_line(const HardReading *reading)
{
    char name[160];
    hard_describe(&reading->point, name, sizeof name);
    printf("%-62s %9lld %-18s %4d %d %-9s %5.1f %8.1f\n", name, (long long)reading->unknowns,
           hard_outcome_name[reading->outcome], reading->iterations, reading->steps,
           reading->unknowns > 0 ? ost_method_name(reading->method) : "", reading->digits, reading->seconds);
}

static void print_lines(const HardReport *report)
{
    printf("%-62s %9s %-18s iterations, strategies, the last, digits, seconds\n", "", "unknowns", "");
    for (int i = 0; i < report->count; i++)
        print_line(&report->reading[i]);
    puts("");
}

static void print_failures(const HardReport *report)
{
    for (int i = 0; i < report->count; i++) {
        const HardReading *reading = &report->reading[i];
        char name[160];
        if (reading->outcome != HARD_GIVEN_UP && reading->outcome != HARD_FALSE)
            continue;
        hard_describe(&reading->point, name, sizeof name);
        printf("%s: %s: %s\n", name, hard_outcome_name[reading->outcome], reading->reason);
    }
}

typedef struct Total {
    int points, outcome[HARD_OUTCOMES];
    int most_iterations;
    double fewest_digits, seconds, slowest;
} Total;

static void add(const HardReading *reading, Total *total)
{
    total->points++;
    total->outcome[reading->outcome]++;
    total->seconds += reading->seconds;
    total->slowest = fmax(total->slowest, reading->seconds);
    if (reading->outcome != HARD_SOLVED && reading->outcome != HARD_SOLVED_TO_ROUNDING)
        return;
    if (reading->iterations > total->most_iterations)
        total->most_iterations = reading->iterations;
    total->fewest_digits = fmin(total->fewest_digits, reading->digits);
}

static void print_total(const char *name, const Total *total)
{
    printf("%-10s %6d", name, total->points);
    for (int o = 0; o < HARD_OUTCOMES; o++)
        printf(" %18d", total->outcome[o]);
    printf(" %15d %13.1f %8.1f %8.1f\n", total->most_iterations, total->fewest_digits, total->seconds, total->slowest);
}

static void print_totals(const HardReport *report)
{
    Total all = {.fewest_digits = INFINITY};
    printf("%-10s %6s", "", "points");
    for (int o = 0; o < HARD_OUTCOMES; o++)
        printf(" %18s", hard_outcome_name[o]);
    printf(" %15s %13s %8s %8s\n", "most iterations", "fewest digits", "seconds", "slowest");
    for (int shape = 0; shape < HARD_SHAPES; shape++) {
        Total total = {.fewest_digits = INFINITY};
        for (int i = 0; i < report->count; i++)
            if (report->reading[i].point.shape == shape) {
                add(&report->reading[i], &total);
                add(&report->reading[i], &all);
            }
        if (total.points > 0)
            print_total(hard_shape_name(shape), &total);
    }
    print_total("all", &all);
}

void hard_print(const HardReport *report)
{
    if (ost_rank(report->ctx) != 0)
        return;
    if (report->run.size > 0)
        print_lines(report);
    else if (!report->run.quick || ost_log_level(report->ctx) == OST_LOG_VERBOSE) {
        puts("Columns of three: axes aligned, cylindrical, smooth. *: as far as double precision allows; no: given "
             "up.\n");
        for (int shape = 0; shape < HARD_SHAPES; shape++)
            for (int order = 1; order <= HARD_ORDERS; order++)
                if (has_points(report, shape, order))
                    print_matrices(report, shape, order);
    }
    print_failures(report);
    print_totals(report);
    printf("%s; %.0f s with %s\n", hard_passed(report) ? "pass" : "FAIL", report->seconds,
           report->run.size > 0 ? "residuals in 64 bits" : "the direct solutions");
}
