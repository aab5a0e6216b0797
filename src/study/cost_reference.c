/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/cost_reference.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double lowest_rate = 0.4;
static const double rate_surplus = 0.5;

/* An estimated error of the strain energy is 0.66 to 1.05 of the true one (docs/accuracy.md). */
static const double estimate_doubt = 0.5;

/* A value is negligible if it is smaller than this, relative to the scale of its kind. */
static const double negligible = 1e-6;

/* (q1 - q0) / (q2 - q1) at a rate; grows with it. */
static double ratio_at(const double h[3], double rate)
{
    return (pow(h[0] / h[1], rate) - 1.0) / (1.0 - pow(h[2] / h[1], rate));
}

int ost_extrapolate(const double h[3], const double q[3], OstExtrapolation *found)
{
    double low = 1e-6;
    double high = 30.0;
    const double ratio = (q[1] - q[0]) / (q[2] - q[1]);
    if (!(ratio > ratio_at(h, low) && ratio < ratio_at(h, high)))
        return 0;
    while (high - low > 1e-12 * high) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high)
            break;
        if (ratio_at(h, middle) < ratio)
            low = middle;
        else
            high = middle;
    }
    found->rate = 0.5 * (low + high);
    found->limit = q[2] + (q[2] - q[1]) / (pow(h[1] / h[2], found->rate) - 1.0);
    return 1;
}

/* Errors are relative to the value, or to the scale of its kind where the value is negligible or smaller than `doubt`,
 * by which it may be off. */
static void set_value(OstCostReference *reference, OstReferenceKind kind, double value, double doubt, double scale)
{
    const int counts = fabs(value) > negligible * scale && fabs(value) > doubt;
    reference->kind = kind;
    reference->value = value;
    reference->size = counts ? fabs(value) : scale;
    reference->uncertainty = reference->size > 0.0 ? doubt / reference->size : 0.0;
}

static double in_percent(const OstCostReference *reference, double difference)
{
    return reference->size > 0.0 ? 100.0 * difference / reference->size : 0.0;
}

/* The larger of the last two differences bounds the uncertainty: just before they change sign, one may be small. */
static void take_finest(const OstAnswers *a, OstCostReference *reference)
{
    const double *q = a->value + a->count - 1;
    const double last = a->count > 1 ? q[0] - q[-1] : 0.0;
    const double before = a->count > 2 ? q[-1] - q[-2] : 0.0;
    set_value(reference, OST_REFERENCE_FINEST, q[0], fmax(fabs(last), fabs(before)), a->scale);
    if (a->count < 3) {
        reference->uncertainty = a->count == 1 ? INFINITY : reference->uncertainty;
        snprintf(reference->note, sizeof reference->note,
                 a->count == 1 ? "it is the only refinement, so its own error is not known"
                               : "two refinements give no rate to extrapolate by");
        return;
    }
    const int grows = before * last > 0.0 && fabs(last) >= fabs(before);
    reference->uncertainty = grows ? INFINITY : reference->uncertainty;
    snprintf(reference->note, sizeof reference->note, "the last two refinements changed it by %+.2g %% and %+.2g %%%s",
             in_percent(reference, before), in_percent(reference, last),
             grows ? ": it may have no limit (a force on a vertex moves that vertex without bound)"
                   : ", which is no rate to extrapolate by");
}

double ost_best_rate_factor(int order)
{
    return exp2(2.0 * order + rate_surplus);
}

static int is_sensible(const OstAnswers *a, double rate)
{
    return rate >= lowest_rate && exp2(rate) <= ost_best_rate_factor(a->order);
}

static int take_limit(const OstAnswers *a, OstCostReference *reference)
{
    OstExtrapolation found;
    double h[3];
    const double *q = a->value + a->count - 3;
    for (int i = 0; i < 3; i++)
        h[i] = ldexp(1.0, -a->refinement[a->count - 3 + i]);
    if (!ost_extrapolate(h, q, &found))
        return 0;
    reference->rate = found.rate;
    if (!is_sensible(a, found.rate) || (a->positive && found.limit < 0.0))
        return 0;
    const double moved = fabs(found.limit - q[2]);
    set_value(reference, OST_REFERENCE_EXTRAPOLATED, found.limit, moved + a->noise * fabs(q[2]), a->scale);
    snprintf(reference->note, sizeof reference->note, "extrapolated at the observed rate %.2f", found.rate);
    return 1;
}

static int take_settled(const OstAnswers *a, OstCostReference *reference)
{
    const double *q = a->value + a->count - 1;
    const double size = fabs(q[0]) > negligible * a->scale ? fabs(q[0]) : a->scale;
    if (fabs(q[0] - q[-1]) > a->noise * size)
        return 0;
    set_value(reference, OST_REFERENCE_SETTLED, q[0], a->noise * size, a->scale);
    snprintf(reference->note, sizeof reference->note, "refinement no longer changes it");
    return 1;
}

void ost_reference_of(const OstAnswers *answers, OstCostReference *reference)
{
    memset(reference, 0, sizeof *reference);
    reference->uncertainty = INFINITY;
    if (answers->count == 0)
        return;
    reference->order = answers->order;
    reference->finest = answers->refinement[answers->count - 1];
    if (answers->count > 1 && take_settled(answers, reference))
        return;
    if (answers->count > 2 && take_limit(answers, reference))
        return;
    take_finest(answers, reference);
}

void ost_reference_of_formula(double value, double scale, OstCostReference *reference)
{
    memset(reference, 0, sizeof *reference);
    set_value(reference, OST_REFERENCE_FORMULA, value, 0.0, scale);
    snprintf(reference->note, sizeof reference->note, "the formula's value");
}

void ost_reference_improve(double value, double error, int run, OstCostReference *reference)
{
    const double exact = value + error, doubt = estimate_doubt * fabs(error);
    if (!(exact != 0.0 && doubt < reference->uncertainty * fabs(exact)))
        return;
    *reference = (OstCostReference){.run = run};
    set_value(reference, OST_REFERENCE_ESTIMATED, exact, doubt, fabs(exact));
    snprintf(reference->note, sizeof reference->note, "a run's value and its estimated error, %.2g %%",
             in_percent(reference, fabs(error)));
}

const char *const ost_reference_kind_word[] = {"none", "extrapolated", "finest", "settled", "formula", "estimated"};

void ost_reference_compare(OstCostReference *lone, double lower)
{
    const double share = lone->size > 0.0 ? fabs(lone->value - lower) / lone->size : 0.0;
    lone->uncertainty = share;
    snprintf(lone->note, sizeof lone->note,
             "it is the only refinement of its order; the order below differs by %.2g %%", 100.0 * share);
}
