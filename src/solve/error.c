/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/error.h"

#include "algebra/krylov/lanczos.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "core/together/together.h"
#include "problem/free_body.h"

#include <math.h>
#include <string.h>

/* One application of the preconditioner tells up to the condition too much; beyond this one that is not good enough. */
static const double worst_condition = 100.0;

/* An error of the forces above this seems lost where the displacement's is smaller. */
static const double large_error = 1e-3;

/* What is stated of a displacement whose stresses stay that far off, over what was measured. */
static const double lost_caution = 10.0;

/* Corrections end where the last few have not halved the error. */
enum { MOST_CORRECTIONS = 40, FEW = 3 };

/* Rounding is the reason for a residual this many times that of the solve. */
static const double unasked = 2.0;

/* An error that was asked for need not be known to more than a factor of about two, for which one application of the
 * preconditioner will do up to this condition. */
static const double good_condition = 5.0;

const double ost_small_error = 1e-6, ost_forces_caution = 2.0, ost_worth_correcting = 1e-4, ost_past_correcting = 0.5,
             ost_large_residual = 1e-4;

typedef struct Search {
    const OstProblem *problem;
    OstSolver *solver;
    const OstSolved *solved;
    double *residual;        /* of the rows */
    double *of_rows;         /* the error, of the rows */
    double *internal;        /* forces */
    double stress;           /* the sum of its squares over this rank's tets */
    double *error;           /* of all local nodes */
    double caution;          /* what is stated over what is measured; 1 until corrections show more */
    const OstTurned *turned; /* the state where rotations are large; else NULL */
} Search;

/* P (f - K u) */
static OstStatus find_residual(Search *search)
{
    const OstProblem *problem = search->problem;
    double *load = NULL;
    OstStatus status = OST_NEW_UNCLEARED(problem->ctx, &load, 3 * (size_t)problem->mesh->owned_nodes);
    OST_THEN(
        ost_problem_force_and_stress(problem, 1.0, search->solved->displacement, search->internal, &search->stress));
    OST_TRY_DONE(ost_agree(problem->ctx, status));
    ost_problem_load(problem, 1.0, NULL, load);
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->owned_nodes; i++)
        load[i] -= search->internal[i];
    status = ost_system_take_rows(problem->system, load, search->residual);
done:
    OST_FREE(load);
    return status;
}

/* States what was measured with the caution that the corrections have shown to be needed. */
static void state(const Search *search, OstErrors *errors)
{
    errors->displacement *= search->caution;
    errors->reaction *= search->caution;
    errors->stress *= search->caution;
    errors->corrected = search->caution > 1.0;
}

static OstStatus measure(const Search *search, double missing, OstErrors *errors)
{
    const OstProblem *problem = search->problem;
    int found;
    errors->known = 0;
    OST_TRY(ost_solver_error(search->solver, missing, search->residual, search->of_rows, &found));
    ost_together_gather(problem->ctx); /* the tets are visited for all load cases at once, from here on */
    if (!found)
        return OST_SUCCESS;
    OST_TRY(ost_system_displacement(problem->system, 0.0, search->of_rows, search->error));
    if (problem->free_body)
        OST_TRY(ost_free_body_centre(problem->mesh, search->error));
    const OstTurned *turned = search->turned;
    OST_TRY(turned ? ost_guard_turned_errors(problem, turned->t, turned->displacement, turned->internal, turned->load,
                                             search->error, errors)
                   : ost_guard_errors(problem, problem, search->solved->displacement, search->internal, search->stress,
                                      search->error, errors));
    state(search, errors);
    ost_log(
        problem->ctx, OST_LOG_VERBOSE,
        "solver: to %g, the error of the equations is %.1e in the displacement, %.1e in reactions, %.1e in stresses",
        missing, errors->displacement, errors->reaction, errors->stress);
    return OST_SUCCESS;
}

static double of_forces(const OstErrors *errors)
{
    return fmax(errors->reaction, errors->stress);
}

/* In a part that is 1e9 times stiffer, what little is missing of the error may have large stresses. */
static int seem_lost(const OstErrors *errors)
{
    return of_forces(errors) > large_error && of_forces(errors) > 2.0 * errors->displacement;
}

static double largest(const OstErrors *errors)
{
    return errors->known ? fmax(errors->displacement, of_forces(errors)) : 0.0;
}

/* Is an error half of what it was, or less? What is small does not count. */
static int halves(double error, double before)
{
    return before > ost_small_error && error < 0.5 * before;
}

/* Did rounding, not the residual asked for, leave this one? */
static OstStatus blame_rounding(const Search *search, int *is_rounding)
{
    const OstSolved *solved = search->solved;
    double squares[2] = {0.0};
    for (size_t i = 0; i < 3 * (size_t)search->problem->system->matrix->rows; i++) {
        squares[0] += search->residual[i] * search->residual[i];
        squares[1] += solved->rhs[i] * solved->rhs[i];
    }
    OST_TRY(ost_sum(search->problem->ctx, 2, squares));
    *is_rounding = solved->report->rounding_limited ||
                   sqrt(squares[0]) > unasked * solved->report->relative_residual * sqrt(squares[1]);
    return OST_SUCCESS;
}

/* Conjugate gradients for the tets' equations, preconditioned by what the solver finds for a residual. */
typedef struct Correction {
    double *step;     /* of the rows */
    double *of_nodes; /* the step, of all local nodes */
    double *force;    /* K times the step, summed tet by tet, of the owned nodes */
    double *before;   /* the residual before, of the rows */
    double weight;    /* error · residual, of the step before */
    OstLanczos lanczos;
} Correction;

/* step = error + beta step, with Polak and Ribière's beta as the solver's error is not linear in the residual. */
static OstStatus turn(const Search *search, Correction *correction, int is_first, double *beta)
{
    const size_t rows = 3 * (size_t)search->problem->system->matrix->rows;
    double sums[2] = {0.0};
    for (size_t i = 0; i < rows; i++) {
        sums[0] += search->of_rows[i] * search->residual[i];
        sums[1] += search->of_rows[i] * correction->before[i];
    }
    OST_TRY(ost_sum(search->problem->ctx, 2, sums));
    *beta = is_first ? 0.0 : (sums[0] - sums[1]) / correction->weight;
    correction->weight = sums[0];
    for (size_t i = 0; i < rows; i++) {
        correction->step[i] = search->of_rows[i] + *beta * correction->step[i];
        correction->before[i] = search->residual[i];
    }
    for (size_t i = 0; i < 3 * (size_t)search->problem->mesh->node_count; i++)
        correction->of_nodes[i] = search->error[i] + *beta * correction->of_nodes[i];
    return OST_SUCCESS;
}

/* *taken: 0 if the step has no energy. */
static OstStatus take_step(const Search *search, Correction *correction, double beta, int *taken)
{
    const OstProblem *problem = search->problem;
    const size_t rows = 3 * (size_t)problem->system->matrix->rows;
    double sums[2] = {0.0};
    OST_TRY(ost_agree(problem->ctx, ost_problem_force(problem, 0.0, correction->of_nodes, correction->force)));
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->owned_nodes; i++)
        sums[0] += correction->of_nodes[i] * correction->force[i];
    for (size_t i = 0; i < rows; i++)
        sums[1] += correction->step[i] * search->residual[i];
    OST_TRY(ost_sum(problem->ctx, 2, sums));
    *taken = sums[0] > 0.0 && isfinite(sums[1]);
    if (!*taken)
        return OST_SUCCESS;
    const double length = sums[1] / sums[0];
    OST_TRY(ost_lanczos_add(&correction->lanczos, length, beta));
    for (size_t i = 0; i < rows; i++)
        search->solved->unknowns[i] += length * correction->step[i];
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->node_count; i++)
        search->solved->displacement[i] += length * correction->of_nodes[i];
    return OST_SUCCESS;
}

/* Until the error is small, or the last steps gain nothing. */
static OstStatus iterate(Search *search, Correction *correction, OstErrors *errors)
{
    OstErrors best = *errors;
    int idle_steps = 0;
    double beta;
    for (int k = 0, taken = 1; largest(errors) > ost_small_error && k < MOST_CORRECTIONS && idle_steps < FEW; k++) {
        OST_TRY(turn(search, correction, k == 0, &beta));
        OST_TRY(take_step(search, correction, beta, &taken));
        if (!taken)
            break;
        OST_TRY(find_residual(search));
        OST_TRY(measure(search, 0.1, errors));
        const int gains =
            halves(errors->displacement, best.displacement) || halves(of_forces(errors), of_forces(&best));
        idle_steps = gains ? 0 : idle_steps + 1;
        best = gains ? *errors : best;
    }
    return OST_SUCCESS;
}

/* What the solver finds for a residual is by the rounded stiffness, and to a tenth. If a mode is softer by the tets,
 * its error is larger by as much: the Lanczos coefficients show it. Where the steps ended before the error was small,
 * they may not have met the softest mode, or the residual is the rounding of the tets' forces, and what it is taken for
 * may be small by chance. */
static double find_caution(const OstLanczos *lanczos, const OstErrors *errors)
{
    static const double least = 3.0, chance = 10.0;
    double smallest, largest_value;
    ost_lanczos_extremes(lanczos, &smallest, &largest_value);
    return (largest(errors) > ost_small_error ? chance : least) / (smallest > 0.0 ? fmin(smallest, 1.0) : 1.0);
}

static OstStatus correct(Search *search, OstErrors *errors)
{
    OstContext *ctx = search->problem->ctx;
    const size_t rows = 3 * (size_t)search->problem->system->matrix->rows;
    const size_t owned = 3 * (size_t)search->problem->mesh->owned_nodes;
    Correction correction = {.step = NULL};
    OstStatus status = OST_NEW(ctx, &correction.step, 2 * rows + owned);
    OST_THEN(OST_NEW(ctx, &correction.of_nodes, 3 * (size_t)search->problem->mesh->node_count));
    OST_THEN(ost_lanczos_create(ctx, MOST_CORRECTIONS, &correction.lanczos));
    OST_TRY_DONE(ost_agree(ctx, status));
    correction.before = correction.step + rows;
    correction.force = correction.before + rows;
    OST_TRY_DONE(iterate(search, &correction, errors));
    search->caution = find_caution(&correction.lanczos, errors);
    state(search, errors);
done:
    ost_lanczos_destroy(&correction.lanczos);
    OST_FREE(correction.step);
    OST_FREE(correction.of_nodes);
    return status;
}

/* Stiff parts may have most of an error's forces and little of its energy, so they are found late: looks more closely
 * until no error grows any more. */
static OstStatus look_closer(const Search *search, OstErrors *errors)
{
    OstErrors before = {0};
    for (double missing = 1e-2; missing > 1e-9 && largest(errors) > ost_small_error; missing *= 1e-2) {
        const int grows =
            errors->displacement > 2.0 * before.displacement || of_forces(errors) > 2.0 * of_forces(&before);
        if (!grows && (search->turned || !seem_lost(errors)))
            break;
        before = *errors;
        OST_TRY(measure(search, missing, errors));
    }
    return OST_SUCCESS;
}

/* Of an error that the residual asked for explains. */
static OstStatus measure_asked(Search *search, OstErrors *errors)
{
    const double condition = search->solved->report->condition_estimate;
    OST_TRY(measure(search, 1.0, errors));
    if (errors->known && largest(errors) > ost_small_error && condition > good_condition)
        OST_TRY(measure(search, 0.1, errors));
    return OST_SUCCESS;
}

/* Of an error that is part of a watched quantity's: where it is not small, to a tenth, as one application may miss the
 * soft motion that is watched. */
static OstStatus measure_once(Search *search, double enough, OstErrors *errors)
{
    OST_TRY(measure(search, 1.0, errors));
    return errors->known && search->solved->error && errors->displacement > enough ? measure(search, 0.1, errors)
                                                                                   : OST_SUCCESS;
}

/* Of one that rounding may have a part in. */
static OstStatus measure_all(Search *search, int is_rounding, OstErrors *errors)
{
    OST_TRY(measure(search, 1.0, errors));
    if (largest(errors) > ost_small_error || search->solved->report->condition_estimate > worst_condition)
        OST_TRY(measure(search, 0.1, errors));
    if (is_rounding && largest(errors) > ost_worth_correcting && errors->displacement < ost_past_correcting)
        OST_TRY(correct(search, errors));
    OST_TRY(look_closer(search, errors));
    if (errors->known &&
        seem_lost(errors)) /* so rounding of the stiffness counts, which this displacement does not see */
        errors->displacement *= lost_caution;
    return OST_SUCCESS;
}

OstStatus ost_find_errors(const OstProblem *problem, OstSolver *solver, const OstSolved *solved, double enough,
                          OstErrors *errors)
{
    OstContext *ctx = problem->ctx;
    const size_t rows = 3 * (size_t)problem->system->matrix->rows;
    Search search = {.problem = problem, .solver = solver, .solved = solved, .caution = 1.0};
    const int once = enough > 0.0;
    int is_rounding = 0;
    *errors = (OstErrors){0};
    OstStatus status = OST_NEW(ctx, &search.residual, 2 * rows);
    OST_THEN(OST_NEW(ctx, &search.error, 3 * (size_t)problem->mesh->node_count));
    OST_THEN(OST_NEW_UNCLEARED(ctx, &search.internal, 3 * (size_t)problem->mesh->owned_nodes));
    OST_TRY_DONE(ost_agree(ctx, status));
    search.of_rows = search.residual + rows;
    OST_TRY_DONE(find_residual(&search));
    OST_TRY_DONE(blame_rounding(&search, &is_rounding));
    const int is_asked = !is_rounding && solved->report->relative_residual > ost_large_residual;
    OST_TRY_DONE(once       ? measure_once(&search, enough, errors)
                 : is_asked ? measure_asked(&search, errors)
                            : measure_all(&search, is_rounding, errors));
    if (solved->error)
        memcpy(solved->error, search.error, 3 * (size_t)problem->mesh->node_count * sizeof *solved->error);
    if (once)
        goto done;
    errors->asked = is_asked;
    if (!errors->corrected) {
        errors->reaction *= ost_forces_caution;
        errors->stress *= ost_forces_caution;
    }
done:
    if (status == OST_SUCCESS && !problem->supports->spring) { /* whose forces are no tet's */
        *solved->internal = search.internal;
        search.internal = NULL;
    }
    OST_FREE(search.internal);
    OST_FREE(search.residual);
    OST_FREE(search.error);
    return status;
}

OstStatus ost_find_turned_errors(const OstProblem *problem, OstSolver *solver, const OstTurned *turned,
                                 OstErrors *errors)
{
    OstContext *ctx = problem->ctx;
    const size_t rows = 3 * (size_t)problem->system->matrix->rows;
    Search search = {.problem = problem, .solver = solver, .caution = 1.0, .turned = turned};
    *errors = (OstErrors){0};
    OstStatus status = OST_NEW(ctx, &search.residual, 2 * rows);
    OST_THEN(OST_NEW(ctx, &search.error, 3 * (size_t)problem->mesh->node_count));
    OST_TRY_DONE(ost_agree(ctx, status));
    search.of_rows = search.residual + rows;
    memcpy(search.residual, turned->residual, rows * sizeof *search.residual);
    OST_TRY_DONE(measure(&search, 1.0, errors));
    if (largest(errors) > ost_small_error)
        OST_TRY_DONE(measure(&search, 0.1, errors));
    OST_TRY_DONE(look_closer(&search, errors));
    errors->reaction *= ost_forces_caution;
    errors->stress *= ost_forces_caution;
done:
    OST_FREE(search.residual);
    OST_FREE(search.error);
    return status;
}
