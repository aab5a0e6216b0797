/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/search.h"

#include "accuracy/blocks.h"
#include "assembly/springs.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <math.h>
#include <string.h>

OstStatus ost_search_open(const OstOperator *stiffness, const float *factor, OstSolver *solver, OstSearch *search)
{
    const OstProblem *problem = stiffness->problem;
    OstContext *ctx = problem->ctx;
    OstEnriched *const vectors[4] = {&search->p, &search->q, &search->r, &search->e};
    *search = (OstSearch){.stiffness = stiffness, .factor = factor, .solver = solver, .size = 1.0};
    search->rows = 3 * (size_t)problem->system->matrix->rows;
    search->functions = (size_t)stiffness->complement->count;
    const size_t numbers = OST_PER_FUNCTION * search->functions;
    OstStatus status = OST_NEW(ctx, &search->p.rows, 4 * search->rows);
    OST_THEN(OST_NEW(ctx, &search->p.functions, 4 * numbers));
    OST_THEN(OST_NEW(ctx, &search->z, search->rows));
    OST_THEN(OST_NEW(ctx, &search->u, 3 * (size_t)problem->mesh->node_count));
    OST_THEN(OST_NEW(ctx, &search->force, 3 * (size_t)problem->mesh->owned_nodes));
    OST_TRY(ost_agree(ctx, status));
    for (size_t k = 1; k < 4; k++) {
        vectors[k]->rows = search->p.rows + k * search->rows;
        vectors[k]->functions = search->p.functions + k * numbers;
    }
    return OST_SUCCESS;
}

void ost_search_close(OstSearch *search)
{
    OST_FREE(search->p.rows);
    OST_FREE(search->p.functions);
    OST_FREE(search->z);
    OST_FREE(search->u);
    OST_FREE(search->force);
}

double *ost_search_spare(OstSearch *search)
{
    return (double *)(void *)search->p.functions;
}

void ost_search_take_residual(OstSearch *search, const double *forces, double divisor)
{
    const double factor = 1.0 / divisor;
    for (size_t k = 0; k < search->functions; k++)
        for (size_t i = 0; i < 3; i++)
            search->r.functions[OST_PER_FUNCTION * k + i] = (float)(factor * forces[3 * k + i]);
    ost_complement_project(search->stiffness->complement, search->r.functions);
}

void ost_search_start(OstSearch *search)
{
    memset(search->p.rows, 0, 2 * search->rows * sizeof *search->p.rows); /* and q */
    memset(search->p.functions, 0, 2 * OST_PER_FUNCTION * search->functions * sizeof *search->p.functions);
    ost_blocks_step(search->functions, search->factor, 0.0, search->p.functions, search->q.functions,
                    search->e.functions, search->r.functions, search->products);
    search->turns = 0;
}

OstStatus ost_search_take_rows(const OstSearch *search, double *rows)
{
    return ost_system_take_rows(search->stiffness->problem->system, search->force, rows);
}

OstStatus ost_search_dot(const OstSearch *search, const OstEnriched *a, const OstEnriched *b, double *product)
{
    *product = ost_functions_dot(search->functions, a->functions, b->functions);
    for (size_t i = 0; i < search->rows; i++)
        *product += a->rows[i] * b->rows[i];
    return ost_sum(search->stiffness->problem->ctx, 1, product);
}

/* q = A p */
static OstStatus multiply(OstSearch *search)
{
    const OstOperator *stiffness = search->stiffness;
    const OstProblem *problem = stiffness->problem;
    OST_TRY(ost_system_displacement(problem->system, 0.0, search->p.rows, search->u));
    OST_TRY(ost_complement_import(stiffness->complement, search->p.functions));
    ost_operator_apply(stiffness, search->u, search->p.functions, search->force, search->q.functions);
    if (problem->supports->spring)
        ost_spring_force(problem->supports, -1.0 / stiffness->unit, search->u, search->force);
    ost_complement_project(stiffness->complement, search->q.functions);
    return ost_search_take_rows(search, search->q.rows);
}

/* z = B r on the rows. */
static OstStatus take_cycle(OstSearch *search, int *found)
{
    OST_TRY(ost_solver_precondition(search->solver, search->r.rows, search->z, found));
    for (size_t i = 0; i < search->rows; i++)
        search->z[i] *= search->stiffness->unit;
    return OST_SUCCESS;
}

/* The elements' own unknowns take part in every other step: hardly more steps are needed so, and a multigrid cycle takes
 * as long as several products with A. On quadratic tets, where that is most of the time, the first pair of steps is
 * without. */
static OstStatus precondition(OstSearch *search)
{
    int found = 1;
    const int first = search->stiffness->complement->mesh->nodes_per_tet == 10 ? 2 : 1, turn = search->turns++;
    if (turn >= first && (turn - first) % 2 == 0)
        OST_TRY(take_cycle(search, &found));
    else
        memset(search->z, 0, search->rows * sizeof *search->z);
    search->failed = !found;
    return OST_SUCCESS;
}

/* Goes along p: `gain` is what that adds to |e|², `weight` r'B r before. */
static OstStatus go_on(OstSearch *search, double weight, double *gain)
{
    double curvature = 0.0;
    OST_TRY(multiply(search));
    OST_TRY(ost_search_dot(search, &search->p, &search->q, &curvature));
    search->failed = !(curvature > 0.0);
    const double length = search->failed ? 0.0 : weight / curvature;
    for (size_t i = 0; i < search->rows; i++) {
        search->e.rows[i] += length * search->p.rows[i];
        search->r.rows[i] -= length * search->q.rows[i];
    }
    ost_blocks_step(search->functions, search->factor, length, search->p.functions, search->q.functions,
                    search->e.functions, search->r.functions, search->products);
    *gain = length * weight;
    return OST_SUCCESS;
}

/* The next direction, as if the preconditioner varied (Polak and Ribiere). */
static OstStatus turn(OstSearch *search, double gain, double *weight)
{
    const double before = *weight;
    double sums[2] = {search->products[0], search->products[1]};
    OST_TRY(precondition(search));
    for (size_t i = 0; i < search->rows; i++) {
        sums[0] += search->r.rows[i] * search->z[i];
        sums[1] += search->q.rows[i] * search->z[i];
    }
    OST_TRY(ost_sum(search->stiffness->problem->ctx, 2, sums));
    const double share = before > 0.0 ? -gain * sums[1] / (before * before) : 0.0;
    *weight = sums[0];
    for (size_t i = 0; i < search->rows; i++)
        search->p.rows[i] = search->z[i] + share * search->p.rows[i];
    ost_blocks_turn(search->functions, search->factor, search->r.functions, share, search->p.functions);
    search->failed |= !(*weight >= 0.0) || !isfinite(*weight);
    return OST_SUCCESS;
}

OstStatus ost_search_pair(OstSearch *search, double *weight, double *of_step, double *gain)
{
    *gain = 0.0;
    for (int k = 0; k < 2 && !search->failed; k++) {
        OST_TRY(turn(search, *of_step, weight));
        if (search->failed || !(*weight > 0.0))
            break;
        OST_TRY(go_on(search, *weight, of_step));
        *gain += *of_step;
    }
    return OST_SUCCESS;
}

OstStatus ost_search_settle(OstSearch *search)
{
    int found = 0;
    OST_TRY(take_cycle(search, &found));
    for (size_t i = 0; i < search->rows && found; i++)
        search->e.rows[i] += search->z[i];
    return OST_SUCCESS;
}
