/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver_data.h"
#include "algebra/solver_options.h"

#include <math.h>
#include <stdio.h>

/* The strategy that goes on where no other is left. */

/* What an iteration with the stronger smoother costs, over one of METRIC. */
static const double strong_price = 2.0;

/* The method that converged fastest for its price, AUTO if none of those that are not left out came so far. It may be
 * one whose norms did not fall at all: where motions of the whole body are far softer than others, they fall late, and
 * then fast. */
static OstMethod fastest_but(const OstSolveReport *report, unsigned left_out)
{
    OstMethod found = OST_METHOD_AUTO;
    double most = -1.0;
    for (int s = 0; s < report->steps; s++) {
        const OstSolveStep *step = &report->step[s];
        const double gain = -log(step->factor) / (step->method == OST_METHOD_METRIC ? 1.0 : strong_price);
        if (step->iterations < OST_CONVERGENCE_WINDOW || left_out & 1U << step->method || !(gain > most))
            continue;
        found = step->method;
        most = gain;
    }
    return found;
}

/* Linear tets that lock begin well, and then take longest: a tube with E3 x 1e6 along circles 3304 iterations, over 439
 * with the strong smoother, which does without them. */
OstMethod ost_solver_fastest(const OstSolver *solver, const OstSolveReport *report)
{
    const unsigned over_linear = solver->over_linear ? 1U << OST_METHOD_METRIC : 0U;
    const OstMethod found = fastest_but(report, solver->broken | over_linear);
    return found != OST_METHOD_AUTO ? found : fastest_but(report, solver->broken);
}

/* The finest level is then smoothed over patches, and of linear tets aggregates are small on all levels. */
OstMethod ost_solver_choose_last(OstSolver *solver, const OstSolveReport *report)
{
    const OstMethod fastest = ost_solver_fastest(solver, report);
    const int may = fastest == OST_METHOD_METRIC || fastest == OST_METHOD_STRONG;
    solver->fine = may && !solver->fine;
    return solver->fine ? OST_METHOD_STRONG : fastest;
}

void ost_solver_tell_last(const OstSolver *solver, const OstGoal *goal, const OstSolveReport *report)
{
    const int left = goal->most_iterations - goal->iterations;
    char size[64] = "";
    if (solver->factors.bytes > 0.0)
        snprintf(size, sizeof size, " (%.3g MiB)", solver->factors.bytes / 1048576.0);
    for (int s = report->steps - 1; s >= 0; s--) {
        const OstSolveStep *step = &report->step[s];
        if (step->method != solver->method || step->iterations == 0)
            continue;
        ost_log(
            solver->ctx, OST_LOG_NORMAL,
            "solver: no strategy is quick here, and factors%s do not fit into memory: %s goes on, at some %.2g s an "
            "iteration, for up to %d more (solver.max_iterations), %.2g hours",
            size, ost_method_name(step->method), step->seconds / step->iterations, left,
            left * step->seconds / step->iterations / 3600.0);
        return;
    }
}

void ost_solver_learn(OstSolver *solver, const OstSolver *other)
{
    if (other->smallest > 0.0 && !(solver->smallest > 0.0 && solver->smallest <= other->smallest))
        solver->smallest = other->smallest;
}
