/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver_seconds.h"

#include "algebra/multigrid/metric.h"

#include <math.h>

/* Nested dissection of a wall of N unknowns, w nodes thick, has separators of about sqrt(N w); dense fronts of that
 * size take its cube. Fitted to gears, brackets, spindles and pins of 9,000 to 227,000 unknowns, w from 4 to 11: 0.13
 * to 27 s, right to a factor of 1.5. */
static const double front_second = 7e-9, entry_second = 8.5e-6;

/* Setup, and an iteration, of an unknown; iterations to 1e-8. Over linear tets (16 iterations for isotropic bodies, 10
 * to 31 where the mesh follows stiff axes, and more the less it does), and over aggregates of quadratic ones where it
 * does not at all (23 to 39), whose levels have the more nonzeros the thicker the body is: their rate is that of so
 * many nodes across. */
typedef struct Rate {
    double setup, iteration, iterations;
} Rate;
static const Rate linear = {3e-6, 4e-7, 18.0}, aggregated = {1.55e-5, 1.1e-6, 35.0};
static const double usual_thickness = 5.0;
static const double misaligned = 1.3; /* power of iterations over linear tets: 33 at 1.5, 50 at 2, 60 at 2.4 */

static const double early = 0.25;              /* of the iterations, where the mesh's error ends them */
static const double usual = 0.45, power = 0.5; /* Poisson's ratio from which on iterations grow, and how */

double ost_solver_factor_seconds(const OstSolverFacts *facts)
{
    const double unknowns = (double)facts->unknowns;
    return entry_second * unknowns + front_second * pow(unknowns * facts->thickness, 1.5);
}

double ost_solver_multigrid_seconds(const OstSolverFacts *facts)
{
    const int crosses = facts->misalignment > ost_metric_misaligned;
    const Rate *rate = crosses ? &aggregated : &linear;
    const double volume = (1.0 - 2.0 * usual) / fmax(1.0 - 2.0 * facts->poisson, 1e-6);
    const double slower = crosses ? 1.0 : pow(fmax(facts->misalignment, 1.0), misaligned);
    const double iterations =
        rate->iterations * (facts->stops_early ? early : 1.0) * pow(fmax(volume, 1.0), power) * slower;
    const double seconds = (double)facts->unknowns * (rate->setup + iterations * rate->iteration);
    return crosses ? seconds * facts->thickness / usual_thickness : seconds;
}
