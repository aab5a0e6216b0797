/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "problem/free_body.h"
#include "solve/error.h"

#include <math.h>
#include <string.h>

/* The part of an error that may be missing where it is iterated for. */
static const double part = 0.1;

/* One application makes up to 3000 times too much of reactions and stresses: errors of them above least_doubtful and
 * `doubtful` times that of the displacement are iterated for, and any above most_doubtful times that. */
static const double doubtful = 10.0, least_doubtful = 1e-7, most_doubtful = 1e2;

/* What is stated of forces over what was measured by one application, which finds a sixth of the stress in thin layers,
 * as they have little of the energy; and of all errors after corrections. */
static const double once_caution = 3.0, corrected_caution = 3.0;
enum { MOST_CORRECTIONS = 20 };

typedef struct Search {
    const OstProblem *problem; /* at the answer's pressure */
    OstSolver *solver;
    const OstSolved *solved;
    double *load, *internal;       /* forces, 3 × owned_nodes */
    double stress;                 /* the sum of its squares over this rank's tets */
    double *error;                 /* of nodes */
    double *r_u, *r_p, *e_u, *e_p; /* residuals and errors of the rows and pressures */
    double *of_tets;               /* the error of the pressures, of tets */
} Search;

static OstStatus make_room(Search *search)
{
    const OstProblem *problem = search->problem;
    OstContext *ctx = problem->ctx;
    const size_t rows = 3 * (size_t)problem->system->matrix->rows;
    OstStatus status = OST_NEW(ctx, &search->r_u, 2 * rows);
    OST_THEN(OST_NEW(ctx, &search->r_p, (size_t)problem->pressures->owned + ost_problem_pressure_room(problem)));
    OST_THEN(OST_NEW(ctx, &search->load, 3 * (size_t)problem->mesh->owned_nodes));
    OST_THEN(OST_NEW(ctx, &search->internal, 3 * (size_t)problem->mesh->owned_nodes));
    OST_THEN(OST_NEW(ctx, &search->error, 3 * (size_t)problem->mesh->node_count));
    OST_THEN(OST_NEW(ctx, &search->of_tets, 4 * (size_t)problem->mesh->tet_count));
    OST_TRY(ost_agree(ctx, status));
    search->e_u = search->r_u + rows;
    search->e_p = search->r_p + problem->pressures->owned;
    return OST_SUCCESS;
}

static void release(Search *search)
{
    OST_FREE(search->r_u);
    OST_FREE(search->r_p);
    OST_FREE(search->load);
    OST_FREE(search->internal);
    OST_FREE(search->error);
    OST_FREE(search->of_tets);
}

/* What displacement and pressure leave of both equations, tet by tet. */
static OstStatus find_residuals(Search *search)
{
    const OstProblem *problem = search->problem;
    const double *u = search->solved->displacement;
    OstStatus status = ost_problem_force_and_stress(problem, 1.0, u, search->internal, &search->stress);
    OST_THEN(ost_pressure_volume(problem->pressures, problem->field, OST_FORMULATION_LINEAR,
                                 ost_problem_eigen_share(problem, 1.0), u, search->r_p, NULL));
    OST_TRY(ost_agree(problem->ctx, status));
    for (OstLocal i = 0; i < problem->pressures->owned; i++)
        search->r_p[i] = -search->r_p[i];
    ost_problem_load(problem, 1.0, NULL, search->load);
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->owned_nodes; i++)
        search->load[i] -= search->internal[i];
    return ost_system_take_rows(problem->system, search->load, search->r_u);
}

/* `missing`: of the error, as in ost_solver_error. Where none is found `errors` stays as it is. */
static OstStatus measure(Search *search, double missing, OstErrors *errors, int *found)
{
    const OstProblem *problem = search->problem;
    const OstSaddle saddle = {problem->coupling, search->r_p, search->e_p};
    OstMaterialField field;
    OstProblem of_error;
    memset(search->e_u, 0, 3 * (size_t)problem->system->matrix->rows * sizeof *search->e_u);
    memset(search->e_p, 0, ost_problem_pressure_room(problem) * sizeof *search->e_p);
    OST_TRY(ost_solver_mixed_error(search->solver, missing, &saddle, search->r_u, search->e_u, found));
    if (!*found)
        return OST_SUCCESS;
    OST_TRY(ost_pressure_complete(problem->pressures, search->e_p));
    ost_pressure_of_tets(problem->pressures, search->e_p, search->of_tets);
    ost_problem_at_pressure(problem, search->of_tets, &field, &of_error);
    OST_TRY(ost_problem_displacement(problem, 0.0, search->e_u, search->error));
    if (problem->free_body)
        OST_TRY(ost_free_body_centre(problem->mesh, search->error));
    OST_TRY(ost_guard_errors(problem, &of_error, search->solved->displacement, search->internal, search->stress,
                             search->error, errors));
    ost_log(
        problem->ctx, OST_LOG_VERBOSE,
        "solver: to %g, the error of both equations is %.1e in the displacement, %.1e in reactions, %.1e in stresses",
        missing, errors->displacement, errors->reaction, errors->stress);
    return OST_SUCCESS;
}

static double largest(const OstErrors *errors)
{
    return errors->known ? fmax(errors->displacement, fmax(errors->reaction, errors->stress)) : 0.0;
}

static void take_correction(const Search *search)
{
    const OstProblem *problem = search->problem;
    const OstSolved *solved = search->solved;
    for (size_t i = 0; i < 3 * (size_t)problem->system->matrix->rows; i++)
        solved->unknowns[i] += search->e_u[i];
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->node_count; i++)
        solved->displacement[i] += search->error[i];
    for (size_t i = 0; i < (size_t)problem->pressures->count; i++)
        solved->pressure[i] += search->e_p[i];
    for (size_t i = 0; i < 4 * (size_t)problem->mesh->tet_count; i++)
        solved->of_tets[i] += search->of_tets[i];
}

/* What is measured is a correction too. The equations as they are assembled are not those of the tets: corrections find
 * what rounding their entries has cost, each to the share that it has cost. */
static OstStatus correct(Search *search, OstErrors *errors)
{
    double before = INFINITY;
    int found = 1;
    for (int k = 0;
         found && k < MOST_CORRECTIONS && largest(errors) > ost_small_error && largest(errors) < 0.5 * before; k++) {
        before = largest(errors);
        take_correction(search);
        OST_TRY(find_residuals(search));
        OST_TRY(measure(search, part, errors, &found));
    }
    errors->corrected = errors->known;
    return OST_SUCCESS;
}

/* Does one application of the preconditioner not tell enough, or nothing as no eigenvalue is known? After so many
 * iterations it has told 2000 times too much, and further ones add little. */
static int is_rough(const OstErrors *errors, const OstSolveReport *report)
{
    enum { SLOW = 150 };
    const double forces = fmax(errors->reaction, errors->stress);
    const int doubts =
        forces > fmax(doubtful * errors->displacement, least_doubtful) || forces > most_doubtful * errors->displacement;
    return !errors->known || largest(errors) > ost_small_error || doubts || report->iterations > SLOW;
}

/* After an early stop, which goes on where this is too large. */
static OstStatus measure_once(Search *search, OstErrors *errors)
{
    int found;
    OST_TRY(measure(search, ost_solver_mixed_is_poor(search->solver) ? part : 1.0, errors, &found));
    errors->reaction *= ost_forces_caution;
    errors->stress *= ost_forces_caution;
    return OST_SUCCESS;
}

static OstStatus measure_all(Search *search, OstErrors *errors)
{
    const OstSolveReport *report = search->solved->report;
    double caution = once_caution;
    int found;
    OST_TRY(measure(search, 1.0, errors, &found));
    const int is_to_iterate = is_rough(errors, report);
    if (is_to_iterate)
        OST_TRY(measure(search, part, errors, &found));
    if (is_to_iterate && found) {
        if (errors->known && largest(errors) > ost_worth_correcting && errors->displacement < ost_past_correcting &&
            (report->rounding_limited || report->relative_residual <= ost_large_residual))
            OST_TRY(correct(search, errors));
        caution = errors->corrected ? corrected_caution : ost_forces_caution;
        errors->displacement *= errors->corrected ? caution : 1.0;
    }
    errors->reaction *= caution;
    errors->stress *= caution;
    return OST_SUCCESS;
}

OstStatus ost_find_mixed_errors(const OstProblem *problem, OstSolver *solver, const OstSolved *solved, double enough,
                                OstErrors *errors)
{
    Search search = {.problem = problem, .solver = solver, .solved = solved};
    *errors = (OstErrors){0};
    OstStatus status = make_room(&search);
    OST_THEN(find_residuals(&search));
    OST_THEN(enough > 0.0 ? measure_once(&search, errors) : measure_all(&search, errors));
    if (status == OST_SUCCESS && solved->error)
        memcpy(solved->error, search.error, 3 * (size_t)problem->mesh->node_count * sizeof *solved->error);
    release(&search);
    return status;
}
