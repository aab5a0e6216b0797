/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver_plan.h"

#include "algebra/solver_seconds.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Factoring fewer unknowns takes less time than building a hierarchy. */
static const OstGlobal direct_below = 3000;

/* Poisson's ratio; at 0.4999 METRIC took 288 iterations instead of 14, and no other multigrid method less time. */
static const double nearly_incompressible = 0.49;

/* Above these values of Poisson's ratio aggregates must be smaller. Aggregates of rigid modes represent
 * volume-preserving fields badly: their error at the aggregates' borders changes the volume, so its energy is 1 / (1 -
 * 2 nu) times too large; smaller aggregates reduce it. Iterations on the paper's tube (isotropic, stiff along, around,
 * through the wall) with aggregates of 40, 15 and 10 nodes: nu 0.49: 34 47 72 53, 25 37 46 50, 23 38 33 43; nu 0.499:
 * 101 135 165 158, 76 106 116 158, 70 110 69 129, and 60 97 67 124 with one more degree of smoothing. */
static const struct {
    double poisson, aggregate_nodes;
    int more_degree;
} smaller_above[2] = {{0.495, 10.0, 1}, {0.45, 15.0, 0}};

static const double jump = 1e4; /* of moduli from place to place */

static const double uneven = 1e3, sliver = 1e-2; /* ratio of moduli; quality of a tet */

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

/* Bytes a factorisation may take; 0 if unknown. */
static double allowed_memory(const OstSolverOptions *options, const OstSolverFacts *facts)
{
    return options->factor_memory > 0.0 ? options->factor_memory : facts->free_memory;
}

/* Multigrid for few unknowns whose factors do not fit into memory; its coarsest level must be smaller than they are. */
static void plan_around_memory(const OstSolverFacts *facts, OstSolverPlan *plan)
{
    const OstGlobal fewer = facts->unknowns / 4;
    plan->first = OST_METHOD_METRIC;
    if (!(plan->options.given & OST_GIVEN_COARSEST) && plan->options.coarsest_unknowns > fewer)
        plan->options.coarsest_unknowns = fewer > 0 ? (int)fewer : 1;
    say(plan, "%lld unknowns are few, but a factorisation would not fit into the %.3g MiB %s: multigrid",
        (long long)facts->unknowns, allowed_memory(&plan->options, facts) / 1048576.0,
        plan->options.factor_memory > 0.0 ? "allowed" : "free");
}

/* With memory to spare, as the rule for it is a rough one. */
static int has_room(const OstSolverFacts *facts, const OstSolverOptions *options, double unknowns)
{
    const double allowed = allowed_memory(options, facts);
    return !(allowed > 0.0) || 2.0 * ost_solver_factor_bytes((OstGlobal)unknowns) <= allowed;
}

/* Is a factorisation, of all unknowns or of the vertices', quicker than multigrid? Asked of quadratic tets, of which a
 * hierarchy costs more than of linear ones. */
static OstMethod quickest(const OstSolverFacts *facts, const OstSolverOptions *options)
{
    const double multigrid = ost_solver_multigrid_seconds(facts), factors = ost_solver_factor_seconds(facts);
    const double two_level = ost_solver_two_level_seconds(facts);
    if (!(facts->thickness > 0.0) || facts->repeated)
        return OST_METHOD_METRIC;
    if (factors < fmin(multigrid, two_level) && has_room(facts, options, (double)facts->unknowns))
        return OST_METHOD_DIRECT;
    return two_level < multigrid && has_room(facts, options, ost_solver_vertex_unknowns(facts)) ? OST_METHOD_TWO_LEVEL
                                                                                                : OST_METHOD_METRIC;
}

static void plan_first(const OstSolverFacts *facts, int fits, OstSolverPlan *plan)
{
    const long long unknowns = (long long)facts->unknowns;
    const OstMethod quick = fits ? quickest(facts, &plan->options) : OST_METHOD_METRIC;
    if (plan->options.method != OST_METHOD_AUTO) {
        plan->first = plan->options.method;
        say(plan, "the case asks for it");
    } else if (facts->unknowns < direct_below && !fits) {
        plan_around_memory(facts, plan);
    } else if (facts->unknowns < direct_below) {
        plan->first = OST_METHOD_DIRECT;
        say(plan, "%lld unknowns are fewer than %lld: factoring is fastest", unknowns, (long long)direct_below);
    } else if (quick == OST_METHOD_TWO_LEVEL && !ost_solver_is_over_vertices(facts)) {
        plan->first = OST_METHOD_TWO_LEVEL;
        say(plan,
            "%lld unknowns of quadratic tets, %.2g times as long as the body is thick: over vertices whose matrix is "
            "factored about %.2g s, multigrid %.2g s",
            unknowns, facts->slenderness, ost_solver_two_level_seconds(facts), ost_solver_multigrid_seconds(facts));
    } else if (quick == OST_METHOD_TWO_LEVEL) {
        plan->first = OST_METHOD_TWO_LEVEL;
        say(plan,
            "%lld unknowns of quadratic tets whose edges cross the stiff directions by %.3g (along them: 1): over "
            "vertices whose matrix is factored about %.2g s, multigrid %.2g s",
            unknowns, facts->misalignment, ost_solver_two_level_seconds(facts), ost_solver_multigrid_seconds(facts));
    } else if (quick == OST_METHOD_DIRECT) {
        plan->first = OST_METHOD_DIRECT;
        say(plan, "%lld unknowns of quadratic tets, %.2g nodes across: factoring takes about %.2g s, multigrid %.2g s",
            unknowns, facts->thickness, ost_solver_factor_seconds(facts), ost_solver_multigrid_seconds(facts));
    } else {
        plan->first = OST_METHOD_METRIC;
        say(plan, "%lld unknowns: multigrid on aggregates that are round in the material metric", unknowns);
    }
}

/* Under a contrast smaller aggregates cost more than they save: their coarse nodes have 180 neighbours. Checkerboards,
 * soft and stiff inclusions of linear tets, 20,000 unknowns, nu 0.49 and 0.499, take 0.6 to 0.9 of the iterations and
 * 1.2 to 3.8 times the seconds with 15 and 10 nodes in place of 40. */
static int is_uneven(const OstSolverFacts *facts)
{
    return facts->contrast > jump * facts->anisotropy;
}

static void plan_aggregates(const OstSolverFacts *facts, OstSolverPlan *plan)
{
    for (int k = 0; k < 2; k++) {
        if (!(facts->poisson > smaller_above[k].poisson) || plan->first == OST_METHOD_DIRECT)
            continue;
        if (!(plan->options.given & OST_GIVEN_DEGREE))
            plan->options.smoother_degree += smaller_above[k].more_degree;
        if (plan->options.given & OST_GIVEN_AGGREGATE || plan->first == OST_METHOD_TWO_LEVEL || is_uneven(facts))
            return;
        plan->options.aggregate_nodes = smaller_above[k].aggregate_nodes;
        say(plan, "Poisson's ratio of %.6g is above %g: aggregates of %g nodes, which keep the volume better",
            facts->poisson, smaller_above[k].poisson, smaller_above[k].aggregate_nodes);
        return;
    }
}

/* Names what makes the system hard to solve. It changes nothing: no other first strategy was found to be better. */
static void plan_trouble(const OstSolverFacts *facts, OstSolverPlan *plan)
{
    if (plan->options.method != OST_METHOD_AUTO || plan->first == OST_METHOD_DIRECT)
        return;
    if (facts->anisotropy > 1.0)
        say(plan, "moduli differ by a factor of %.3g at one place: the material metric accounts for it",
            facts->anisotropy);
    if (facts->poisson > nearly_incompressible)
        say(plan, "Poisson's ratio of %.6g is close to 1/2: slow, and likely to need the next strategy",
            facts->poisson);
    if (facts->contrast > uneven && facts->contrast > facts->anisotropy)
        say(plan, "moduli of different places differ by a factor of %.3g: each node is scaled by its own stiffness",
            facts->contrast);
    if (facts->quality > 0.0 && facts->quality < sliver)
        say(plan, "the worst tet has a quality of %.2g (1: regular): may be slow, and may need the next strategy",
            facts->quality);
}

static void plan_memory(const OstSolverFacts *facts, OstSolverPlan *plan)
{
    const double wanted = ost_solver_factor_bytes(facts->unknowns);
    const double allowed = allowed_memory(&plan->options, facts);
    if (plan->options.method != OST_METHOD_AUTO || plan->first == OST_METHOD_DIRECT || !(allowed > 0.0))
        return;
    say(plan, "a factorisation would take about %.2g GiB of the %.2g GiB %s: the method direct is %s reach",
        wanted / 1073741824.0, allowed / 1073741824.0, plan->options.factor_memory > 0.0 ? "allowed" : "free",
        wanted <= allowed ? "in" : "out of");
}

static void make_plan(const OstSolverOptions *options, const OstSolverFacts *facts, int fits, OstSolverPlan *plan)
{
    memset(plan, 0, sizeof *plan);
    plan->options = *options;
    plan_first(facts, fits, plan);
    plan_aggregates(facts, plan);
    plan_trouble(facts, plan);
    plan_memory(facts, plan);
}

int ost_solver_may_be_multigrid(const OstSolverPlan *plan)
{
    const int is_multigrid = plan->first != OST_METHOD_PLAIN && plan->first != OST_METHOD_DIRECT;
    return is_multigrid || (plan->options.method == OST_METHOD_AUTO && plan->options.factor_memory > 0.0);
}

void ost_solver_plan(const OstSolverOptions *options, const OstSolverFacts *facts, OstSolverPlan *plan)
{
    const double allowed = allowed_memory(options, facts);
    make_plan(options, facts, !(allowed > 0.0) || ost_solver_factor_bytes(facts->unknowns) <= allowed, plan);
}

void ost_solver_plan_without_factors(const OstSolverOptions *options, const OstSolverFacts *facts, OstSolverPlan *plan)
{
    make_plan(options, facts, 0, plan);
}
