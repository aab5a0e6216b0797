/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver_plan.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Factoring so few unknowns takes less than building a hierarchy. */
static const OstGlobal direct_below = 3000;

/* Measured on the paper's tube at ratio 1e6, 74,340 unknowns: METRIC 111 and 471 iterations (radial, tangential),
 * TWO_LEVEL 25 and 143, at two thirds of the work. At ratio 1000 METRIC is the cheaper by half. */
static const double extreme_anisotropy = 1e5;

/* About what the coarse matrix of TWO_LEVEL may come from before its factorisation rules. */
static const OstGlobal two_level_below = 500000;

/* Above: measured at 0.4999, where METRIC took 288 iterations for 14, and no other multigrid rung less time. */
static const double nearly_incompressible = 0.49;
static const double uneven = 1e3, sliver = 1e-2;

static void say(OstSolverPlan *plan, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void say(OstSolverPlan *plan, const char *format, ...)
{
    va_list arguments;
    if (plan->reasons == OST_PLAN_REASONS)
        return;
    char *reason = plan->reason[plan->reasons++];
    va_start(arguments, format);
    vsnprintf(reason, sizeof plan->reason[0], format, arguments);
    va_end(arguments);
}

/* MUMPS on tubes: 505 MB at 74,340 unknowns, 6.8 GB at 556,920; in between a power law. */
double ost_solver_factor_bytes(OstGlobal unknowns)
{
    return 505e6 * pow((double)unknowns / 74340.0, 1.29);
}

static void plan_rung(const OstSolverFacts *facts, OstSolverPlan *plan)
{
    const long long unknowns = (long long)facts->unknowns;
    if (plan->options.recipe != OST_RECIPE_AUTO) {
        plan->first = plan->options.recipe;
        say(plan, "the case asks for it");
    } else if (facts->unknowns < direct_below) {
        plan->first = OST_RECIPE_DIRECT;
        say(plan, "%lld unknowns are fewer than %lld: a factorisation is at hand at once", unknowns,
            (long long)direct_below);
    } else if (facts->anisotropy >= extreme_anisotropy && facts->unknowns < two_level_below) {
        plan->first = OST_RECIPE_TWO_LEVEL;
        say(plan,
            "moduli differ by a factor of %.3g at one place: two levels, as their coarse matrix is still small (%lld "
            "unknowns in all)",
            facts->anisotropy, unknowns);
    } else {
        plan->first = OST_RECIPE_METRIC;
        say(plan, "%lld unknowns: multigrid on aggregates that are round in the material's metric", unknowns);
    }
}

/* What makes the work harder, so that a climb comes as no surprise: no other first rung was found to be better. */
static void plan_trouble(const OstSolverFacts *facts, OstSolverPlan *plan)
{
    if (plan->options.recipe != OST_RECIPE_AUTO || plan->first == OST_RECIPE_DIRECT)
        return;
    if (facts->anisotropy > 1.0 && facts->anisotropy < extreme_anisotropy)
        say(plan, "moduli differ by a factor of %.3g at one place, which the metric takes care of", facts->anisotropy);
    if (facts->poisson > nearly_incompressible)
        say(plan, "Poisson's ratio of %.6g is close to 1/2: slow, and likely to climb", facts->poisson);
    if (facts->contrast > uneven && facts->contrast > facts->anisotropy)
        say(plan, "moduli of different places differ by a factor of %.3g: each node is scaled by its own stiffness",
            facts->contrast);
    if (facts->quality > 0.0 && facts->quality < sliver)
        say(plan, "the worst tet has a quality of %.2g (1: regular): may be slow, and may climb", facts->quality);
}

static void plan_memory(const OstSolverFacts *facts, OstSolverPlan *plan)
{
    const double wanted = ost_solver_factor_bytes(facts->unknowns);
    const double allowed = plan->options.factor_memory > 0.0 ? plan->options.factor_memory : facts->free_memory;
    if (plan->options.recipe != OST_RECIPE_AUTO || plan->first == OST_RECIPE_DIRECT || !(allowed > 0.0))
        return;
    say(plan, "a factorisation would take about %.2g GiB of the %.2g GiB %s: the last rung is %s reach",
        wanted / 1073741824.0, allowed / 1073741824.0, plan->options.factor_memory > 0.0 ? "allowed" : "free",
        wanted <= allowed ? "in" : "out of");
}

void ost_solver_plan(const OstSolverOptions *options, const OstSolverFacts *facts, OstSolverPlan *plan)
{
    memset(plan, 0, sizeof *plan);
    plan->options = *options;
    plan_rung(facts, plan);
    plan_trouble(facts, plan);
    plan_memory(facts, plan);
}
