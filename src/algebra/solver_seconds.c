/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver_seconds.h"

#include "algebra/multigrid/metric.h"

#include <math.h>

/* Nested dissection of a wall of N unknowns, w nodes thick, has separators of about sqrt(N w); dense fronts of that
 * size take its cube. Fitted to gears, brackets, spindles and pins of 9,000 to 227,000 unknowns, w from 4 to 11: 0.13
 * to 27 s, right to a factor of 1.5. */
static const double front_second = 7e-9, entry_second = 8.5e-6;

/* Setup, and an iteration, of an unknown; iterations to 1e-8, and by which power of the misalignment they grow. Over
 * linear tets 16 iterations for isotropic bodies, 10 to 31 where the mesh follows stiff axes, 33 and 50 at a
 * misalignment of 1.5 and 2; over vertices that turn 21 to 41 at 3 to 5 (gears, brackets, spindles and pins of 9,000 to
 * 99,000 unknowns), and stopped early 32, 84 and 145 at 7.6, 22 and 68 (a bracket; 60 at 67 a pin). Vertices whose
 * matrix is factored take 4 to 15, stopped early, whatever it is. */
typedef struct Rate {
    double setup, iteration, iterations, misaligned;
} Rate;
static const Rate over_linear = {3e-6, 4e-7, 18.0, 1.3}, over_vertices = {4e-6, 3.7e-7, 7.5, 1.0},
                  over_factors = {5e-6, 9e-7, 20.0, 0.0};

/* Tets that are longer than the body is thick, from this length on: over linear tets 1 + slender x length^1.5 times the
 * iterations (18 for a length of 3, 40 to 75 for 6, stopped early), up to over_nodes_from; then over aggregates of
 * nodes. Single precision often does not suffice there, so that a hierarchy is set up twice. Plates, and a fern of
 * 55,000 to 1.2 million unknowns. */
static const double thin_from = 4.0, over_nodes_from = 6.0, slender = 0.65, slender_power = 1.5, set_up_again = 1.5;
static const Rate over_aggregates = {1.5e-5, 2e-6, 24.0, 0.0};

/* Vertices that turn have so many unknowns, and their factors' fronts so much work, for one of the quadratic tets; of
 * thin bodies, whose leaves are factored one by one, between 0.14 (a plate) and 0.025 (the fern). */
static const double of_unknowns = 0.3, of_fronts = 0.17, of_thin_fronts = 0.035;

double ost_solver_vertex_unknowns(const OstSolverFacts *facts)
{
    return of_unknowns * (double)facts->unknowns;
}

static const double early = 0.25;              /* of the iterations, where the mesh's error ends them */
static const double usual = 0.45, power = 0.5; /* Poisson's ratio from which on iterations grow, and how */

double ost_solver_factor_seconds(const OstSolverFacts *facts)
{
    const double unknowns = (double)facts->unknowns;
    return entry_second * unknowns + front_second * pow(unknowns * facts->thickness, 1.5);
}

static double iterated(const OstSolverFacts *facts, const Rate *rate)
{
    const double volume = (1.0 - 2.0 * usual) / fmax(1.0 - 2.0 * facts->poisson, 1e-6);
    const double iterations = rate->iterations * (facts->stops_early ? early : 1.0) * pow(fmax(volume, 1.0), power) *
                              pow(fmax(facts->misalignment, 1.0), rate->misaligned);
    return (double)facts->unknowns * (rate->setup + iterations * rate->iteration);
}

int ost_solver_is_over_vertices(const OstSolverFacts *facts)
{
    return facts->misalignment > ost_metric_misaligned;
}

/* Of small bodies either takes a fraction of a second. */
static int is_thin(const OstSolverFacts *facts)
{
    static const OstGlobal small = 40000;
    return facts->unknowns > small && facts->slenderness > thin_from &&
           facts->slenderness <= ost_metric_longest_of_vertices;
}

double ost_solver_multigrid_seconds(const OstSolverFacts *facts)
{
    Rate longer = over_linear;
    if (ost_solver_is_over_vertices(facts))
        return iterated(facts, &over_vertices);
    if (!is_thin(facts))
        return iterated(facts, &over_linear);
    longer.iterations *= 1.0 + slender * pow(facts->slenderness, slender_power);
    return set_up_again * iterated(facts, facts->slenderness > over_nodes_from ? &over_aggregates : &longer);
}

double ost_solver_two_level_seconds(const OstSolverFacts *facts)
{
    const double unknowns = (double)facts->unknowns;
    const int crosses = ost_solver_is_over_vertices(facts);
    if (!crosses && !is_thin(facts))
        return INFINITY;
    return iterated(facts, &over_factors) + entry_second * ost_solver_vertex_unknowns(facts) +
           (crosses ? of_fronts : of_thin_fronts) * front_second * pow(unknowns * facts->thickness, 1.5);
}

/* Corrections of thin bodies that a hierarchy leaves unfinished stretch them, which takes further ones: a strip of
 * 15,120 unknowns bent by 28 degrees takes 30 and 3 load steps, by factors 4 and one, in a fifth of the time; leaves,
 * and beams of 2 × 2 hexes, a half. A correction by factors may take so many times the seconds of a linear solve by
 * multigrid: plates of 40 × 40 hexes, where it takes more, gain nothing. */
static const double longer_by_factors = 1.65;

int ost_solver_factors_spare_corrections(const OstSolverFacts *facts)
{
    OstSolverFacts to_residual = *facts;
    to_residual.stops_early = 0;
    return facts->thickness > 0.0 &&
           ost_solver_factor_seconds(facts) < longer_by_factors * ost_solver_multigrid_seconds(&to_residual);
}
