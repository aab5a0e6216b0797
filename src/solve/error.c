/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/error.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "problem/free_body.h"

/* Below this an error need not be known better than one application of the preconditioner tells. */
static const double small_error = 1e-6;

/* An error of the forces above this is looked at more closely where the displacement's is smaller. */
static const double large_error = 1e-2;

typedef struct Search {
    const OstProblem *problem;
    OstSolver *solver;
    const double *displacement; /* of all local nodes */
    double *residual;           /* of the rows */
    double *of_rows;            /* the error, of the rows */
    double *error;              /* of all local nodes; first, the internal forces */
} Search;

/* P (f - K u) */
static OstStatus find_residual(const Search *search)
{
    const OstProblem *problem = search->problem;
    const OstSystem *system = problem->system;
    double *load = NULL;
    OstStatus status = OST_NEW(problem->ctx, &load, 3 * (size_t)problem->mesh->owned_nodes);
    OST_THEN(ost_problem_force(problem, 1.0, search->displacement, search->error));
    OST_TRY_DONE(ost_agree(problem->ctx, status));
    ost_problem_load(problem, 1.0, NULL, load);
    for (OstLocal row = 0; row < system->matrix->rows; row++) {
        const size_t node = (size_t)system->node_of_row[row];
        double projector[9], left[3];
        for (size_t i = 0; i < 3; i++)
            left[i] = load[3 * node + i] - search->error[3 * node + i];
        ost_supports_get(system->supports, (OstLocal)node, projector, NULL);
        ost_apply3(projector, left, search->residual + 3 * (size_t)row);
    }
done:
    OST_FREE(load);
    return status;
}

static OstStatus measure(const Search *search, double missing, OstErrors *errors)
{
    const OstProblem *problem = search->problem;
    int found;
    errors->known = 0;
    OST_TRY(ost_solver_error(search->solver, missing, search->residual, search->of_rows, &found));
    if (!found)
        return OST_SUCCESS;
    OST_TRY(ost_problem_displacement(problem, 0.0, search->of_rows, search->error));
    if (problem->free_body)
        OST_TRY(ost_free_body_centre(problem->mesh, search->error));
    return ost_guard_errors(problem, search->displacement, search->error, errors);
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

OstStatus ost_find_errors(const OstProblem *problem, OstSolver *solver, const double *displacement, int once,
                          OstErrors *errors)
{
    OstContext *ctx = problem->ctx;
    const size_t rows = 3 * (size_t)problem->system->matrix->rows;
    Search search = {.problem = problem, .solver = solver, .displacement = displacement};
    *errors = (OstErrors){0};
    OstStatus status = OST_NEW(ctx, &search.residual, 2 * rows);
    OST_THEN(OST_NEW(ctx, &search.error, 3 * (size_t)problem->mesh->node_count));
    OST_TRY_DONE(ost_agree(ctx, status));
    search.of_rows = search.residual + rows;
    OST_TRY_DONE(find_residual(&search));
    OST_TRY_DONE(measure(&search, 1.0, errors));
    if (once)
        goto done;
    if (errors->known && fmax(errors->displacement, of_forces(errors)) > small_error)
        OST_TRY_DONE(measure(&search, 0.1, errors));
    for (double missing = 1e-3; missing > 1e-8 && errors->known && seem_lost(errors); missing *= 1e-2)
        OST_TRY_DONE(measure(&search, missing, errors));
done:
    OST_FREE(search.residual);
    OST_FREE(search.error);
    return status;
}
