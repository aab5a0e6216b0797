/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "problem/free_body.h"
#include "solve/error.h"

#include <math.h>
#include <string.h>
#include <stdio.h>
#include <stdlib.h>

/* Below this an error need not be known better than one application of the preconditioner tells. */
static const double small_error = 1e-6;

typedef struct Search {
    const OstProblem *problem; /* at the answer's pressure */
    OstSolver *solver;
    const OstSolved *solved;
    double *load;                  /* 3 × owned_nodes */
    double *force;                 /* of nodes: internal forces, then the error */
    double *r_u, *r_p, *e_u, *e_p; /* residuals and errors of the rows and pressures */
    double *of_tets;               /* the error of the pressures, of tets */
} Search;

static OstStatus make_room(Search *search)
{
    const OstProblem *problem = search->problem;
    OstContext *ctx = problem->ctx;
    const size_t rows = 3 * (size_t)problem->system->matrix->rows;
    OstStatus status = OST_NEW(ctx, &search->r_u, 2 * rows);
    OST_THEN(OST_NEW(ctx, &search->r_p, 2 * (size_t)problem->pressures->count));
    OST_THEN(OST_NEW(ctx, &search->load, 3 * (size_t)problem->mesh->owned_nodes));
    OST_THEN(OST_NEW(ctx, &search->force, 3 * (size_t)problem->mesh->node_count));
    OST_THEN(OST_NEW(ctx, &search->of_tets, 4 * (size_t)problem->mesh->tet_count));
    OST_TRY(ost_agree(ctx, status));
    search->e_u = search->r_u + rows;
    search->e_p = search->r_p + problem->pressures->count;
    return OST_SUCCESS;
}

static void release(Search *search)
{
    OST_FREE(search->r_u);
    OST_FREE(search->r_p);
    OST_FREE(search->load);
    OST_FREE(search->force);
    OST_FREE(search->of_tets);
}

/* What displacement and pressure leave of both equations, tet by tet. */
static OstStatus find_residuals(Search *search)
{
    const OstProblem *problem = search->problem;
    const double *u = search->solved->displacement;
    OstStatus status = ost_problem_force(problem, 1.0, u, search->force);
    OST_THEN(ost_pressure_volume(problem->pressures, problem->field, OST_FORMULATION_LINEAR,
                                 ost_problem_eigen_share(problem, 1.0), u, search->r_p, NULL));
    OST_TRY(ost_agree(problem->ctx, status));
    for (OstLocal i = 0; i < problem->pressures->owned; i++)
        search->r_p[i] = -search->r_p[i];
    ost_problem_load(problem, 1.0, NULL, search->load);
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->owned_nodes; i++)
        search->load[i] -= search->force[i];
    return ost_system_take_rows(problem->system, search->load, search->r_u);
}

/* `missing`: of the error, as in ost_solver_error. */
static OstStatus measure(Search *search, double missing, OstErrors *errors)
{
    const OstProblem *problem = search->problem;
    const OstSaddle saddle = {problem->coupling, search->r_p, search->e_p};
    OstMaterialField field;
    OstProblem of_error;
    int found;
    memset(search->e_u, 0, 3 * (size_t)problem->system->matrix->rows * sizeof *search->e_u);
    memset(search->e_p, 0, (size_t)problem->pressures->count * sizeof *search->e_p);
    OST_TRY(ost_solver_mixed_error(search->solver, missing, &saddle, search->r_u, search->e_u, &found));
    if (!found)
        return OST_SUCCESS;
    OST_TRY(ost_pressure_complete(problem->pressures, search->e_p));
    ost_pressure_of_tets(problem->pressures, search->e_p, search->of_tets);
    ost_problem_at_pressure(problem, search->of_tets, &field, &of_error);
    OST_TRY(ost_problem_displacement(problem, 0.0, search->e_u, search->force));
    if (problem->free_body)
        OST_TRY(ost_free_body_centre(problem->mesh, search->force));
    OST_TRY(ost_guard_errors(problem, &of_error, search->solved->displacement, search->force, errors));
        if (getenv("MX"))
            printf("MX %g %s meas %.2e  stress %.2e reaction %.2e\n", missing, ost_method_name(search->solved->report->method), errors->displacement,  errors->stress, errors->reaction);
    return OST_SUCCESS;
}

static OstStatus measure_all(Search *search, OstErrors *errors)
{
    OST_TRY(measure(search, 1.0, errors));
    if (errors->known && fmax(errors->displacement, fmax(errors->reaction, errors->stress)) > small_error)
        OST_TRY(measure(search, 0.1, errors));
    return OST_SUCCESS;
}

OstStatus ost_find_mixed_errors(const OstProblem *problem, OstSolver *solver, const OstSolved *solved, int once,
                                OstErrors *errors)
{
    Search search = {.problem = problem, .solver = solver, .solved = solved};
    *errors = (OstErrors){0};
    OstStatus status = make_room(&search);
    OST_THEN(find_residuals(&search));
    OST_THEN(once ? measure(&search, 1.0, errors) : measure_all(&search, errors));
    release(&search);
    return status;
}
