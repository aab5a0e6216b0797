/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/goal.h"

#include "algebra/matrix/vector.h"
#include "core/error.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

OstStatus ost_goal_set(const OstBlockMatrix *matrix, const double *f, const OstSolverOptions *options, OstGoal *goal)
{
    OstContext *ctx = matrix->ctx;
    double square;
    memset(goal, 0, sizeof *goal);
    goal->ctx = ctx;
    goal->most_iterations = options->max_iterations;
    goal->accept_attainable = options->accept_attainable;
    OST_TRY(ost_vector_dot(ctx, 3 * (size_t)matrix->rows, f, f, &square));
    goal->start = goal->norm = sqrt(square);
    goal->target = options->relative_residual * goal->start;
    ost_convergence_start(&goal->convergence, goal->start);
    if (!isfinite(goal->start))
        return OST_RAISE(ctx, OST_INVALID_INPUT, "the right-hand side holds a number that is not finite");
    return OST_SUCCESS;
}

static void end_by_iterations(OstGoal *goal)
{
    goal->end = OST_END_ITERATIONS;
    snprintf(goal->words, sizeof goal->words, "after %d iterations, the most allowed", goal->iterations);
}

double ost_goal_next(const OstGoal *goal)
{
    const OstErrorStop *stop = goal->stop;
    return goal->next > 0.0 ? goal->next : stop->first * (stop->relative ? goal->error.size : 1.0);
}

/* Iterations still needed, by the residual or by the error, whichever takes fewer; 0 before that can be said. */
static double remaining(const OstGoal *goal)
{
    const double of_residual = ost_convergence_remaining(&goal->convergence, goal->target);
    if (!goal->stop || !(goal->error.estimate > 0.0 && isfinite(goal->error.estimate)))
        return of_residual;
    const double next = ost_goal_next(goal);
    return fmin(of_residual, log(next / goal->error.estimate) / log(ost_convergence_factor(&goal->convergence)));
}

int ost_goal_saved(const OstGoal *goal)
{
    if (!goal->enough || !(goal->norm > goal->target && goal->rate > 0.0 && goal->rate < 1.0))
        return 0;
    return (int)fmin(ceil(log(goal->target / goal->norm) / log(goal->rate)), goal->most_iterations - goal->iterations);
}

void ost_goal_begin_pass(OstGoal *goal)
{
    goal->stagnates = 0;
    ost_convergence_begin_pass(&goal->convergence);
}

/* A long solve says now and then how far it is, and foretells its end from all of its iterations. */
static void tell_progress(const OstGoal *goal)
{
    enum { EVERY = 500 };
    const OstConvergence *convergence = &goal->convergence;
    const int left = goal->most_iterations - goal->iterations;
    if (convergence->count % EVERY != 0)
        return;
    const double gain = log(ost_convergence_whole_factor(convergence));
    const double more = gain < 0.0 ? log(goal->target / convergence->residual.least) / gain : INFINITY;
    if (!(more > 0.0))
        return;
    char words[64] = "more than are left";
    if (more <= left)
        snprintf(words, sizeof words, "some %.0f more", more);
    ost_log(goal->ctx, OST_LOG_NORMAL,
            "solver: after %d iterations the residual is %.2g, %.2g is asked for: %s at this rate; %d are left "
            "(solver.max_iterations)",
            convergence->count, convergence->residual.least / goal->start, goal->target / goal->start, words, left);
}

int ost_goal_count(OstGoal *goal, double norm, double weight)
{
    const double whole = log(goal->start / goal->target);
    goal->iterations++;
    ost_convergence_add(&goal->convergence, norm, weight);
    ost_progress(goal->ctx, "solve", whole > 0.0 ? fmin(fmax(log(goal->start / norm) / whole, 0.0), 1.0) : 1.0);
    if (norm <= goal->target)
        return 0;
    tell_progress(goal);
    const double more = remaining(goal);
    if (goal->iterations >= goal->most_iterations) {
        end_by_iterations(goal);
    } else if (goal->patience > 0 && more > goal->patience) {
        goal->end = OST_END_SLOW;
        snprintf(goal->words, sizeof goal->words,
                 "after %d iterations each still multiplies the residual by %.4f: too slow", goal->convergence.count,
                 ost_convergence_factor(&goal->convergence));
    }
    goal->stagnates = ost_convergence_stagnates(&goal->convergence);
    return goal->end == OST_END_REACHED && !goal->stagnates;
}

int ost_goal_at_limit(const OstGoal *goal)
{
    static const double slack = 3.0;
    return goal->norm <= slack * goal->limit;
}

void ost_goal_explain_end(OstGoal *goal, const char *stall)
{
    if (ost_goal_at_limit(goal)) {
        goal->end = OST_END_ROUNDING;
        snprintf(goal->words, sizeof goal->words,
                 "rounding in double precision allows about %.2g here: request no smaller one, or look for what makes "
                 "the stiffness so uneven",
                 ost_goal_attainable(goal));
    } else if (goal->end == OST_END_REACHED && goal->iterations >= goal->most_iterations) {
        end_by_iterations(goal);
    } else if (goal->end == OST_END_REACHED) {
        goal->end = OST_END_STALLED;
        snprintf(goal->words, sizeof goal->words, "after %d iterations further ones gain nothing%s",
                 goal->convergence.count, stall);
    }
}

static const char *what_is_wrong(double value)
{
    return !isfinite(value) ? "is not finite" : value < 0.0 ? "is negative" : "is zero";
}

int ost_goal_accepts(OstGoal *goal, double weight)
{
    if (weight > 0.0 && isfinite(weight))
        return 1;
    goal->end = OST_END_PRECONDITIONER;
    snprintf(goal->words, sizeof goal->words,
             "in iteration %d r·z = %g %s: the preconditioner is not positive definite", goal->iterations + 1, weight,
             what_is_wrong(weight));
    return 0;
}

OstStatus ost_goal_refuse_indefinite(OstGoal *goal, double energy)
{
    goal->indefinite = 1;
    return OST_RAISE(goal->ctx, OST_NOT_CONVERGED,
                     "iteration %d: p·Ap = %g %s: the stiffness is not positive definite; check supports and materials",
                     goal->iterations + 1, energy, what_is_wrong(energy));
}

double ost_goal_attainable(const OstGoal *goal)
{
    return fmin(goal->norm, goal->limit) / goal->start;
}

OstStatus ost_goal_verdict(const OstGoal *goal)
{
    if (goal->end == OST_END_REACHED || (goal->end == OST_END_ROUNDING && goal->accept_attainable))
        return OST_SUCCESS;
    const double reached = goal->norm / goal->start;
    const double requested = goal->target / goal->start;
    if (goal->end == OST_END_ROUNDING)
        return OST_RAISE(goal->ctx, OST_NOT_CONVERGED,
                         "after %d iterations the relative residual stays at %.3g, not the requested %.3g; %s",
                         goal->iterations, reached, requested, goal->words);
    return OST_RAISE(goal->ctx, OST_NOT_CONVERGED, "%s; the relative residual is %.3g, not the requested %.3g",
                     goal->words, reached, requested);
}
