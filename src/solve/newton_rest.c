/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "solve/error.h"
#include "solve/newton_data.h"

#include <float.h>
#include <math.h>

/* Forcing terms of the inexact method: how far each linear solve goes (Eisenstat and Walker, Choosing the forcing terms
 * in an inexact Newton method, SIAM J. Sci. Comput. 17, 1996, choice 2 with its safeguard). */
static const double loosest = 1e-2, tightest = 1e-8, forcing_share = 0.9, guard_above = 1e-3;

/* That of a mixed form, whose solver does not minimise the energy: what it leaves out first is bending. A cantilever 50
 * times as long as thick takes 19 iterations, and 108 with the other. */
static const double loosest_mixed = 1e-4;

/* Where a step has stretched the body, so that the residual has risen or is far beyond the loads, what a solve leaves
 * of that may be as large as what bends it: it goes further by as much, and at most by this. */
static const double most_risen = 10.0;

static double loosest_forcing(const OstNewton *newton, double before)
{
    if (ost_newton_is_saddle(newton))
        return loosest_mixed;
    const double risen = fmax(0.1 * newton->norm / newton->size, before > 0.0 ? newton->norm / before : 0.0);
    return loosest / fmin(fmax(risen, 1.0), most_risen);
}

/* Back to the exact stiffness once the residual has fallen by this since it was found indefinite, and every few
 * iterations (RETRIED). */
static const double recovered = 0.1;

/* The last correction may be this large, relative to the displacement, and the state still be taken for that at rest:
 * the next one is about its square. */
static const double settled = 1e-2;

/* A residual that no longer falls is rounding's if it is below this many times what rounding of the displacement
 * leaves; above that, a line search that takes no step is the reason. */
static const double most_rounding = 100.0;

/* Of a residual this small, relative to the loads, rounding is all that is left: where nothing moves, corrections are
 * then rounding too, and may be as large as the displacement. */
static const double drowned_residual = 1e-14;

/* Corrections below this, relative to the displacement, that no longer lower the residual are rounding. */
static const double rounding_change = 1e-9;

/* Where couplings move the body the strain energy may rise to so many times that of the predicted state. */
static const double most_strained = 10.0;

/* Iterations with the definite stiffness do not count as those of a slow search; every few of them the exact one is
 * tried again. */
enum { RETRIED = 3 };

/* Sums over the rows and nodes of this rank. */
enum { SUM_RESIDUAL, SUM_LOAD, SUM_REACTION, SUM_WORK, SUM_DISPLACEMENT, SUMS };

/* What supports and links take of a node's load and internal force is reaction. */
static void add_node(const OstNewton *newton, OstLocal node, double sums[SUMS])
{
    const OstProblem *problem = newton->problem;
    const double *load = newton->load + 3 * (size_t)node, *internal = newton->internal + 3 * (size_t)node;
    const OstLocal row = problem->system->row_of_node[node];
    const double *kept = row >= 0 ? newton->residual + 3 * (size_t)row : NULL;
    double projector[9], free_load[3];
    ost_supports_get(problem->supports, node, projector, NULL);
    ost_apply3(projector, load, free_load);
    for (int i = 0; i < 3; i++) {
        const double residual = kept ? kept[i] : 0.0, taken = load[i] - internal[i] - residual;
        sums[SUM_RESIDUAL] += residual * residual;
        sums[SUM_LOAD] += kept ? free_load[i] * free_load[i] : 0.0;
        sums[SUM_REACTION] += taken * taken;
    }
}

static OstStatus find_residual(OstNewton *newton)
{
    const size_t count = 3 * (size_t)newton->problem->mesh->owned_nodes;
    double *force = NULL;
    OST_TRY(ost_agree(newton->ctx, OST_NEW(newton->ctx, &force, count)));
    for (size_t i = 0; i < count; i++)
        force[i] = newton->load[i] - newton->internal[i];
    const OstStatus status = ost_system_take_rows(newton->problem->system, force, newton->residual);
    OST_FREE(force);
    return status;
}

OstStatus ost_newton_evaluate(OstNewton *newton, const double *displacement)
{
    const OstProblem *problem = newton->problem;
    double sums[SUMS] = {0.0}, strain_energy = 0.0, work = 0.0;
    const int load_depends_on_u = problem->follower || problem->lever || newton->couplings;
    if (ost_newton_is_mixed(newton))
        ost_newton_take_pressure(newton, displacement);
    OST_TRY(ost_problem_turn(problem, displacement));
    OST_TRY(ost_agree(newton->ctx, ost_problem_force(problem, newton->t, displacement, newton->internal)));
    if (ost_newton_has_energy(newton))
        OST_TRY(ost_problem_energy(problem, newton->t, displacement, &strain_energy));
    if (load_depends_on_u) {
        ost_problem_load(problem, newton->t, displacement, newton->load);
        OST_TRY(ost_problem_load_work(problem, newton->t, displacement, &work));
    }
    if (newton->couplings) {
        OST_TRY(ost_turned_couplings_move(newton->couplings, newton->t, displacement,
                                          displacement + newton->count - newton->multipliers));
        ost_turned_couplings_add(newton->couplings, newton->load);
    }
    OST_TRY(find_residual(newton));
    for (OstLocal node = 0; node < problem->mesh->owned_nodes; node++) {
        add_node(newton, node, sums);
        sums[SUM_WORK] += ost_dot3(newton->load + 3 * (size_t)node, displacement + 3 * (size_t)node);
        sums[SUM_DISPLACEMENT] += ost_dot3(displacement + 3 * (size_t)node, displacement + 3 * (size_t)node);
    }
    OST_TRY(ost_sum(newton->ctx, SUMS, sums));
    work = load_depends_on_u ? work : sums[SUM_WORK];
    newton->norm = sqrt(sums[SUM_RESIDUAL]);
    if (ost_newton_is_mixed(newton)) {
        OST_TRY(ost_agree(newton->ctx, ost_newton_find_volume(newton, displacement)));
        OST_TRY(ost_newton_mixed_norm(newton, &newton->norm));
    }
    newton->driven = newton->norm;
    if (newton->couplings)
        newton->norm = sqrt(newton->norm * newton->norm + ost_turned_couplings_lack(newton->couplings));
    newton->energy = ost_newton_has_energy(newton) ? strain_energy - work : 0.0;
    newton->strain_energy = strain_energy;
    newton->energy_size = fabs(strain_energy) + fabs(work);
    /* What rounding of the displacement leaves counts as small: a body that only turns has neither load nor reaction.
     */
    const double mean = sqrt(sums[SUM_DISPLACEMENT] / (double)problem->mesh->global_nodes);
    newton->rounding = 0.5 * DBL_EPSILON * mean * newton->stiffness->size;
    const double least = fmax(newton->rounding / newton->options.relative_residual, DBL_MIN);
    newton->size = fmax(sqrt(sums[SUM_LOAD] + sums[SUM_REACTION]), fmax(newton->driving, least));
    return OST_SUCCESS;
}

/* The forcing term that follows from how the residual fell. */
static double next_forcing(const OstNewton *newton, double before, double norm_before)
{
    const double ratio = norm_before > 0.0 ? newton->norm / norm_before : 1.0;
    const double target = newton->options.relative_residual * newton->size;
    double forcing = forcing_share * ratio * ratio;
    if (forcing_share * before * before > guard_above)
        forcing = fmax(forcing, forcing_share * before * before);
    forcing = fmax(forcing, 0.1 * target / newton->norm); /* no further than the state at rest needs */
    return fmin(fmax(forcing, tightest), loosest_forcing(newton, norm_before));
}

/* The size of the last correction relative to the displacement. */
static OstStatus measure_change(OstNewton *newton, double length)
{
    double sums[2] = {0.0};
    for (size_t i = 0; i < 3 * (size_t)newton->problem->mesh->owned_nodes; i++) {
        sums[0] += newton->direction[i] * newton->direction[i];
        sums[1] += newton->displacement[i] * newton->displacement[i];
    }
    OST_TRY(ost_sum(newton->ctx, 2, sums));
    newton->change = length * sqrt(sums[0] / fmax(sums[1], DBL_MIN));
    return OST_SUCCESS;
}

/* The correction's norm in the energy, sqrt(d·K d) = sqrt(d·r); with pressures sqrt(d·A d + p·C p) (coupling.h). */
static OstStatus measure_decrement(OstNewton *newton)
{
    const size_t rows = 3 * (size_t)newton->problem->system->matrix->rows;
    const size_t pressures = ost_newton_is_mixed(newton) ? (size_t)newton->problem->pressures->owned : 0;
    double work = 0.0;
    for (size_t i = 0; i < rows; i++)
        work += newton->residual[i] * newton->correction[i];
    for (size_t i = rows; i < rows + pressures; i++)
        work -= newton->residual[i] * newton->correction[i];
    OST_TRY(ost_sum(newton->ctx, 1, &work));
    newton->decrement = work >= 0.0 && !newton->couplings ? sqrt(work) : INFINITY;
    return OST_SUCCESS;
}

static void tell(const OstNewton *newton, int definite, double length)
{
    ost_log(
        newton->ctx, OST_LOG_VERBOSE,
        "newton: t %.6g, iteration %d: residual %.2e, energy %.10g, %d iterations to %.0e%s, step %.3g%s, change %.1e",
        newton->t, newton->step_iterations, newton->norm / newton->size, newton->energy, newton->solve.iterations,
        newton->forcing, definite ? " with the definite stiffness" : "", length,
        newton->trial.steps > 0 ? " on trial" : "", newton->change);
}

/* One iteration: a correction by the exact stiffness or, where that is indefinite, by the definite one; a step along
 * it. */
static OstStatus iterate(OstNewton *newton, int *definite, double forcing, double *length, OstRest *rest)
{
    int found = 0;
    *length = 0.0;
    if (!*definite) {
        OST_TRY(ost_newton_solve_held(newton, forcing, newton->residual, &found));
        *definite = !found;
        newton->indefinite |= !found;
    }
    if (!found)
        OST_TRY(ost_newton_solve(newton, 1, forcing, newton->residual, &found));
    *rest = OST_REST_NO_STEP;
    if (!found)
        return OST_SUCCESS;
    newton->forcing = forcing;
    OST_TRY(measure_decrement(newton));
    newton->leaving = *definite && ost_newton_has_energy(newton) && !newton->couplings;
    OST_TRY(ost_newton_search(newton, length));
    if (*definite || *length != 1.0)
        newton->decrement = INFINITY;
    *rest = OST_REST_STALLED;
    newton->step_iterations++;
    newton->report.iterations++;
    newton->report.definite += *definite;
    OST_TRY(measure_change(newton, *length));
    tell(newton, *definite, *length);
    return OST_SUCCESS;
}

/* Whole corrections that lead away strain the body more and more. */
static int leads_away(const OstNewton *newton, double strained)
{
    return newton->couplings && strained > 0.0 && newton->strain_energy > most_strained * strained;
}

static int is_enough(const OstNewton *newton)
{
    return newton->decrement <= newton->enough * sqrt(2.0 * fmax(newton->strain_energy, 0.0)) && newton->enough > 0.0;
}

OstStatus ost_newton_find_rest(OstNewton *newton, int most_iterations, OstRest *rest)
{
    int definite = 0, descents = 0;
    double forcing = 0.0, fallen_from = 0.0, before = 0.0;
    OST_TRY(ost_newton_evaluate(newton, newton->displacement));
    forcing = loosest_forcing(newton, 0.0);
    newton->change = newton->norm > 0.0 ? 1.0 : 0.0;
    for (int k = 0; k < OST_RECENT; k++)
        newton->recent[k] = newton->energy;
    newton->decrement = INFINITY;
    newton->stopped = newton->trial.steps = 0;
    const double strained = newton->strain_energy;
    for (int k = 0;; k++) {
        const double target = newton->options.relative_residual * newton->size;
        const int is_rounding = newton->norm <= drowned_residual * newton->size;
        const int is_settled = newton->change <= settled || (is_rounding && k > 0); /* else `change` says nothing */
        newton->stopped = newton->norm > target && is_enough(newton);
        *rest = (newton->norm <= target || newton->stopped) && is_settled ? OST_REST_FOUND : OST_REST_SLOW;
        if (*rest == OST_REST_FOUND || k - descents == most_iterations || descents == newton->most_descents ||
            leads_away(newton, strained))
            return OST_SUCCESS;
        if (k > 0)
            forcing = next_forcing(newton, forcing, before);
        if (definite && (newton->norm < recovered * fallen_from || descents % RETRIED == 0))
            definite = 0;
        const int was_definite = definite;
        double length;
        before = newton->norm;
        OST_TRY(iterate(newton, &definite, forcing, &length, rest));
        descents += definite;
        if (definite && !was_definite)
            fallen_from = before;
        const int hidden = newton->change <= rounding_change && !(newton->norm < 0.5 * before);
        if (hidden && *rest != OST_REST_NO_STEP)
            *rest = newton->norm <= target                             ? OST_REST_FOUND
                    : newton->norm <= most_rounding * newton->rounding ? OST_REST_ROUNDING
                                                                       : OST_REST_STALLED;
        if (hidden || length == 0.0)
            return OST_SUCCESS;
    }
}

/* Forces with a skew part, and the equations of a mixed form, are not looked at; nor is what is left of a body that
 * nothing moves. */
OstStatus ost_newton_find_errors(OstNewton *newton)
{
    newton->errors = (OstErrors){0};
    if (ost_newton_is_saddle(newton) || ost_newton_is_unsymmetric(newton))
        return OST_SUCCESS;
    OST_TRY(ost_newton_evaluate(newton, newton->displacement));
    if (newton->norm <= drowned_residual * newton->size)
        return OST_SUCCESS;
    const OstTurned state = {newton->t, newton->displacement, newton->internal, newton->load, newton->residual};
    return ost_find_turned_errors(newton->problem, newton->stiffness->solver, &state, &newton->errors);
}
