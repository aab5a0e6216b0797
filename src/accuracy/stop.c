/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/stop.h"

#include "core/error.h"
#include "core/memory.h"

#include <math.h>

/* Relative to the solution; the error of the equations is never left above this. */
static const double largest_error = 1e-2;

/* Where the equations' error is more than this share of the discretisation error, the latter's estimate may have a part
 * of it, and is made again. */
static const double small_share = 0.5;

void ost_solve_stop_close(OstSolveStop *stop)
{
    ost_estimate_destroy(&stop->own);
    OST_FREE(stop->displacement);
}

/* Below this share the estimate has nothing of it, even where moduli differ by 1e6. */
static const double no_share = 1e-3;

/* Errors of the equations are a share of what moves. Where an eigenstrain is free, or an incompressible part bears the
 * loads, what has an energy of its own may be far less: there the answer's norm is to be this often the equations'
 * error. */
static const double clear_of_error = 10.0;

static int is_clear(const OstSolveStop *stop, double size, double error)
{
    const OstProblem *problem = stop->problem;
    const double of_mesh = stop->answer->energy_norm;
    return !(problem->pressures || ost_field_is_eigenstrained(problem->field)) ||
           sqrt(fmax(size * size - of_mesh * of_mesh, 0.0)) >= clear_of_error * error;
}

/* The error of a watched displacement is the product of that of the answer and that of its adjoint problem, both as a
 * share of the whole about alike: so the share of it that the equations may leave is that of the norm, times the error.
 */
double ost_stop_share(const OstProblem *problem, double share, const OstAnswerError *answer)
{
    const int of_quantity = problem->scene && problem->scene->c->interest > 0 &&
                            problem->scene->c->watches[problem->scene->c->interest - 1].kind == OST_WATCH_DISPLACEMENT;
    return of_quantity ? share * answer->relative : share;
}

/* The error of the equations to go on to; 0 where the discretisation error is not known. */
static double next_error(OstSolveStop *stop, double error)
{
    OstAnswerError *answer = stop->answer;
    if (!answer->known || !(answer->relative > 0.0))
        return 0.0;
    const double size = answer->energy_norm / answer->relative;
    answer->known = is_clear(stop, size, error);
    if (!answer->known)
        return 0.0;
    stop->settled = error <= small_share * answer->energy_norm;
    const double share = stop->settled ? ost_stop_share(stop->problem, stop->share, answer) : small_share;
    return fmin(share * answer->energy_norm, largest_error * size);
}

/* Is the energy of the solver's own unknowns that of the answer, as loads alone act? */
static int is_loaded_alone(const OstScene *scene)
{
    static const OstEffect moves[] = {OST_EFFECT_PRESCRIBED_DISPLACEMENT, OST_EFFECT_RIGID_FACE, OST_EFFECT_PERIODIC,
                                      OST_EFFECT_MOVED_COUPLING, OST_EFFECT_EIGENSTRAIN};
    int alone = scene != NULL;
    for (size_t k = 0; k < sizeof moves / sizeof moves[0] && alone; k++)
        alone = !ost_effect_on(&scene->plan.effects, moves[k]);
    return alone;
}

/* A solver compares its error with its own unknowns, whose energy is far larger than the answer's where supports are
 * moved: nodes beside one that has moved follow it. */
static OstStatus is_early(const OstSolveStop *stop, double error, double *next, int *early)
{
    double energy = 0.0;
    if (is_loaded_alone(stop->problem->scene))
        return OST_SUCCESS;
    OST_TRY(ost_problem_energy(stop->problem, 1.0, stop->displacement, &energy));
    const double enough = largest_error * sqrt(fmax(2.0 * energy, 0.0));
    *early = error > enough && enough > 0.0;
    if (*early)
        *next = enough;
    return OST_SUCCESS;
}

/* OstErrorStop's. */
static OstStatus ask(void *data, const double *u, double error, double *next)
{
    OstSolveStop *stop = data;
    OstContext *ctx = stop->problem->ctx;
    int early = 0;
    if (stop->settled) {
        *next = error;
        return OST_SUCCESS;
    }
    OST_TRY(ost_problem_displacement(stop->problem, 1.0, u, stop->displacement));
    OST_TRY(is_early(stop, error, next, &early));
    if (early)
        return OST_SUCCESS;
    ost_ledger_enter(ctx, OST_EFFECT_ERROR_ESTIMATE);
    const OstStatus status =
        ost_estimate_find(stop->estimate, stop->solver, 1.0, stop->displacement, stop->answer, &stop->surplus);
    ost_ledger_leave(ctx);
    stop->error = error;
    *next = next_error(stop, error);
    ost_log(ctx, OST_LOG_VERBOSE, "solver: error of the equations %.2e, of the discretisation %.2e: on to %.2e", error,
            stop->answer->energy_norm, *next);
    return status;
}

OstStatus ost_solve_stop_open(const OstProblem *problem, OstSolver *solver, double share, OstEstimate *estimate,
                              const OstSurplus *surplus, OstAnswerError *answer, OstSolveStop *stop)
{
    *stop = (OstSolveStop){.stop = {.ask = ask, .data = stop, .first = largest_error, .relative = 1},
                           .problem = problem,
                           .solver = solver,
                           .estimate = estimate,
                           .share = share,
                           .surplus = *surplus,
                           .answer = answer};
    ost_ledger_enter(problem->ctx, OST_EFFECT_ERROR_ESTIMATE);
    OstStatus status =
        ost_agree(problem->ctx, OST_NEW(problem->ctx, &stop->displacement, 3 * (size_t)problem->mesh->node_count));
    if (!estimate) {
        OST_THEN(ost_estimate_create(problem, &stop->own));
        stop->estimate = stop->own;
    }
    ost_ledger_leave(problem->ctx);
    if (status != OST_SUCCESS)
        ost_solve_stop_close(stop);
    return status;
}

void ost_solve_stop_tighten(OstSolveStop *stop, double error)
{
    stop->stop.first = error;
    stop->stop.relative = 0;
    stop->settled = stop->error <= no_share * stop->answer->energy_norm;
}
