/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/steps.h"

#include "accuracy/complement/blocks.h"
#include "assembly/springs.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <math.h>
#include <string.h>

/* The elements' own unknowns are at rest where a step moves them by no more than this share of e. Most bodies take two
 * to five such steps; thin and slender ones, whose bending multigrid finds slowly, more. */
static const double settled = 0.15;
enum {
    LEAST_TO_SETTLE = 2,
    LEAST_AFTER_U = 1,
    MOST_TO_SETTLE = 20
}; /* a thin plate's first step was shorter than its next seven */

OstStatus ost_steps_open(const OstOperator *stiffness, const float *factor, const OstStacks *stacks, OstSolver *solver,
                         OstSteps *steps)
{
    const OstProblem *problem = stiffness->problem;
    OstContext *ctx = problem->ctx;
    OstEnriched *const vectors[4] = {&steps->p, &steps->q, &steps->r, &steps->e};
    *steps = (OstSteps){.stiffness = stiffness, .factor = factor, .stacks = stacks, .solver = solver, .size = 1.0};
    steps->rows = 3 * (size_t)problem->system->matrix->rows;
    steps->functions = (size_t)stiffness->complement->count;
    const size_t numbers = OST_PER_FUNCTION * steps->functions;
    const OstLocal columns = problem->system->matrix->columns, nodes = problem->mesh->node_count;
    OstStatus status = OST_NEW(ctx, &steps->p.rows, 4 * steps->rows);
    OST_THEN(OST_NEW_UNCLEARED(ctx, &steps->p.functions, 2 * numbers)); /* those of p and q are written at once */
    OST_THEN(OST_NEW(ctx, &steps->r.functions, 2 * numbers));
    OST_THEN(OST_NEW(ctx, &steps->z, steps->rows));
    if (stacks)
        OST_THEN(OST_NEW(ctx, &steps->stacked, numbers));
    OST_THEN(OST_NEW(ctx, &steps->u, 3 * (size_t)(columns > nodes ? columns : nodes))); /* rigid faces add rows */
    OST_THEN(OST_NEW_UNCLEARED(ctx, &steps->force, 3 * (size_t)problem->mesh->owned_nodes));
    OST_TRY(ost_agree(ctx, status));
    for (size_t k = 1; k < 4; k++)
        vectors[k]->rows = steps->p.rows + k * steps->rows;
    steps->q.functions = steps->p.functions + numbers;
    steps->e.functions = steps->r.functions + numbers;
    return OST_SUCCESS;
}

void ost_steps_close(OstSteps *steps)
{
    OST_FREE(steps->p.rows);
    OST_FREE(steps->p.functions, steps->r.functions);
    OST_FREE(steps->z);
    OST_FREE(steps->stacked);
    OST_FREE(steps->u);
    OST_FREE(steps->force);
}

double *ost_steps_spare(OstSteps *steps)
{
    return (double *)(void *)steps->p.functions;
}

void ost_steps_take_residual(OstSteps *steps, const double *forces, double divisor)
{
    const double factor = 1.0 / divisor;
    for (size_t k = 0; k < steps->functions; k++)
        for (size_t i = 0; i < 3; i++)
            steps->r.functions[OST_PER_FUNCTION * k + i] = (float)(factor * forces[3 * k + i]);
    ost_complement_project(steps->stiffness->complement, steps->r.functions);
}

void ost_steps_start(OstSteps *steps)
{
    memset(steps->p.rows, 0, 2 * steps->rows * sizeof *steps->p.rows); /* and q */
    steps->products[0] = steps->stacks ? ost_stacks_apply(steps->stacks, steps->r.functions, steps->stacked)
                                       : ost_blocks_square(steps->functions, steps->factor, steps->r.functions);
    steps->products[1] = 0.0;
    steps->weight = steps->gain = 0.0;
    steps->turns = 0;
    steps->at_rest = 1;
}

OstStatus ost_steps_take_rows(const OstSteps *steps, double *rows)
{
    return ost_system_take_rows(steps->stiffness->problem->system, steps->force, rows);
}

OstStatus ost_steps_dot(const OstSteps *steps, const OstEnriched *a, const OstEnriched *b, double *product)
{
    *product = ost_functions_dot(steps->functions, a->functions, b->functions);
    for (size_t i = 0; i < steps->rows; i++)
        *product += a->rows[i] * b->rows[i];
    return ost_sum(steps->stiffness->problem->ctx, 1, product);
}

/* q = A p */
static OstStatus multiply(OstSteps *steps)
{
    const OstOperator *stiffness = steps->stiffness;
    const OstProblem *problem = stiffness->problem;
    if (!steps->at_rest)
        OST_TRY(ost_system_displacement(problem->system, 0.0, steps->p.rows, steps->u));
    OST_TRY(ost_complement_import(stiffness->complement, steps->p.functions));
    ost_operator_apply(stiffness, steps->at_rest ? NULL : steps->u, steps->p.functions, steps->force,
                       steps->q.functions);
    if (problem->supports->spring && !steps->at_rest)
        ost_spring_force(problem->supports, -1.0 / stiffness->unit, steps->u, steps->force);
    ost_complement_add_bed(stiffness->complement, steps->p.functions, steps->q.functions);
    ost_complement_project(stiffness->complement, steps->q.functions);
    return ost_steps_take_rows(steps, steps->q.rows);
}

/* The same on the rows of a p that has no functions, by the stiffness that was solved with, where that is A (in curved
 * tets better than A): a third of the work of a visit to the tets, or less. */
static OstStatus multiply_rows(OstSteps *steps)
{
    const OstOperator *stiffness = steps->stiffness;
    const OstProblem *problem = stiffness->problem;
    if (stiffness->turned_by || !problem->filled) {
        memset(steps->p.functions, 0, OST_PER_FUNCTION * steps->functions * sizeof *steps->p.functions);
        return multiply(steps);
    }
    memcpy(steps->u, steps->p.rows, steps->rows * sizeof *steps->u);
    OST_TRY(ost_block_matrix_apply(problem->system->matrix, steps->u, steps->q.rows));
    for (size_t i = 0; i < steps->rows; i++)
        steps->q.rows[i] /= stiffness->unit;
    return OST_SUCCESS;
}

/* z = B r on the rows. */
static OstStatus take_cycle(OstSteps *steps, OstCyclePart part, int *found)
{
    OST_TRY(ost_solver_precondition(steps->solver, part, steps->r.rows, steps->z, found));
    steps->at_rest = 0;
    for (size_t i = 0; i < steps->rows; i++)
        steps->z[i] *= steps->stiffness->unit;
    return OST_SUCCESS;
}

/* The elements' own unknowns take part in every other step: hardly more steps are needed so, and half a multigrid cycle
 * takes as long as a product with A, or longer. On quadratic tets the first two steps are without: with one alone, the
 * error of a displacement in a coarse beam was found 1.57 times too large, not 1.17, and of a pressure at a point 8
 * times. With stacks the functions are found sooner, and one is. */
static OstStatus precondition(OstSteps *steps)
{
    int found = 1;
    const int is_quadratic = steps->stiffness->complement->mesh->nodes_per_tet == 10;
    const int first = is_quadratic && !steps->stacks ? 2 : 1, turn = steps->turns++;
    if (turn >= first && (turn - first) % 2 == 0)
        OST_TRY(take_cycle(steps, OST_CYCLE_HALF, &found));
    else
        memset(steps->z, 0, steps->rows * sizeof *steps->z);
    steps->failed = !found;
    return OST_SUCCESS;
}

static void go_on_functions(OstSteps *steps, double length)
{
    if (!steps->stacks) {
        ost_blocks_step(steps->functions, steps->factor, length, steps->p.functions, steps->q.functions,
                        steps->e.functions, steps->r.functions, steps->products);
        return;
    }
    ost_functions_add(steps->functions, length, steps->p.functions, steps->e.functions);
    ost_functions_add(steps->functions, -length, steps->q.functions, steps->r.functions);
    steps->products[0] = ost_stacks_apply(steps->stacks, steps->r.functions, steps->stacked);
    steps->products[1] = ost_functions_dot(steps->functions, steps->q.functions, steps->stacked);
}

/* Goes along p. */
static OstStatus go_on(OstSteps *steps)
{
    double curvature = 0.0;
    OST_TRY(multiply(steps));
    OST_TRY(ost_steps_dot(steps, &steps->p, &steps->q, &curvature));
    steps->failed = !(curvature > 0.0);
    const double length = steps->failed ? 0.0 : steps->weight / curvature;
    for (size_t i = 0; i < steps->rows; i++) {
        steps->e.rows[i] += length * steps->p.rows[i];
        steps->r.rows[i] -= length * steps->q.rows[i];
    }
    go_on_functions(steps, length);
    steps->gain = length * steps->weight;
    return OST_SUCCESS;
}

/* The next direction, as if the preconditioner varied (Polak and Ribiere). */
static OstStatus turn(OstSteps *steps)
{
    const double before = steps->weight;
    double sums[2] = {steps->products[0], steps->products[1]};
    OST_TRY(precondition(steps));
    for (size_t i = 0; i < steps->rows; i++) {
        sums[0] += steps->r.rows[i] * steps->z[i];
        sums[1] += steps->q.rows[i] * steps->z[i];
    }
    OST_TRY(ost_sum(steps->stiffness->problem->ctx, 2, sums));
    const double share = before > 0.0 ? -steps->gain * sums[1] / (before * before) : 0.0;
    steps->weight = sums[0];
    for (size_t i = 0; i < steps->rows; i++)
        steps->p.rows[i] = steps->z[i] + share * steps->p.rows[i];
    if (steps->stacks)
        ost_functions_turn(steps->functions, steps->stacked, share, steps->p.functions);
    else
        ost_blocks_turn(steps->functions, steps->factor, steps->r.functions, share, steps->p.functions);
    steps->failed |= !(steps->weight >= 0.0) || !isfinite(steps->weight);
    return OST_SUCCESS;
}

OstStatus ost_steps_next(OstSteps *steps)
{
    OST_TRY(turn(steps));
    steps->gain = 0.0;
    return steps->failed || !(steps->weight > 0.0) ? OST_SUCCESS : go_on(steps);
}

OstStatus ost_steps_left(const OstSteps *steps, double *left)
{
    *left = steps->products[0];
    return ost_sum(steps->stiffness->problem->ctx, 1, left);
}

/* The next direction on the rows alone, or none: sets `weight`, r'B r, to 0. `gone` is the length of the step before.
 */
static OstStatus turn_rows(OstSteps *steps, OstCyclePart part, double gone)
{
    double sums[2] = {0.0};
    int found = 0;
    OST_TRY(take_cycle(steps, part, &found));
    for (size_t i = 0; i < steps->rows && found; i++) {
        sums[0] += steps->r.rows[i] * steps->z[i];
        sums[1] += steps->q.rows[i] * steps->z[i];
    }
    OST_TRY(ost_sum(steps->stiffness->problem->ctx, 2, sums));
    const double share = gone > 0.0 ? -gone * sums[1] / steps->weight : 0.0;
    steps->weight = sums[0] > 0.0 && isfinite(sums[0]) ? sums[0] : 0.0;
    for (size_t i = 0; i < steps->rows; i++)
        steps->p.rows[i] = steps->z[i] + share * steps->p.rows[i];
    return OST_SUCCESS;
}

/* Goes along p on the rows. `share` is what the step is of e, in the 2-norm. */
static OstStatus go_on_rows(OstSteps *steps, double *length, double *share)
{
    OstContext *ctx = steps->stiffness->problem->ctx;
    double sums[3] = {0.0};
    OST_TRY(multiply_rows(steps));
    for (size_t i = 0; i < steps->rows; i++)
        sums[0] += steps->p.rows[i] * steps->q.rows[i];
    OST_TRY(ost_sum(ctx, 1, sums));
    *length = sums[0] > 0.0 ? steps->weight / sums[0] : 0.0;
    for (size_t i = 0; i < steps->rows; i++) {
        const double step = *length * steps->p.rows[i];
        steps->e.rows[i] += step;
        steps->r.rows[i] -= *length * steps->q.rows[i];
        sums[1] += step * step;
        sums[2] += steps->e.rows[i] * steps->e.rows[i];
    }
    OST_TRY(ost_sum(ctx, 2, sums + 1));
    *share = sums[2] > 0.0 ? sqrt(sums[1] / sums[2]) : 0.0;
    return OST_SUCCESS;
}

/* The displacement u for the next direction. */
static OstStatus turn_along(OstSteps *steps, const double *u)
{
    const OstSystem *system = steps->stiffness->problem->system;
    double work = 0.0;
    for (OstLocal row = 0; row < system->matrix->rows; row++) {
        const OstLocal node = system->node_of_row[row];
        double projector[9], *p = steps->p.rows + 3 * (size_t)row;
        ost_supports_get(system->supports, node, projector, NULL);
        ost_apply3(projector, u + 3 * (size_t)node, p);
        work += ost_dot3(p, steps->r.rows + 3 * (size_t)row);
    }
    OST_TRY(ost_sum(steps->stiffness->problem->ctx, 1, &work));
    for (size_t i = 0; i < steps->rows && work < 0.0; i++)
        steps->p.rows[i] *= -1.0;
    steps->weight = fabs(work);
    steps->at_rest = 0;
    return OST_SUCCESS;
}

/* A displacement is smooth, and on linear tets mostly found as well where the finest level is hardly smoothed. That of
 * quadratic tets is found slowly so: with brief cycles alone steps were short while half of a bar's twist was missing.
 */
OstStatus ost_steps_settle(OstSteps *steps, const double *u)
{
    const int is_quadratic = steps->stiffness->complement->mesh->nodes_per_tet == 10;
    const int least = u ? LEAST_AFTER_U : LEAST_TO_SETTLE;
    double length = 0.0, share = 1.0;
    if (u) {
        OST_TRY(turn_along(steps, u));
        if (steps->weight > 0.0)
            OST_TRY(go_on_rows(steps, &length, &share));
    }
    for (int step = 0; step < MOST_TO_SETTLE && (step < least || share > settled); step++) {
        const int is_whole = u ? step % 2 == 1 : step % 2 == 0 && (is_quadratic || step > 0);
        OST_TRY(turn_rows(steps, is_whole ? OST_CYCLE_WHOLE : OST_CYCLE_BRIEF, length));
        if (!(steps->weight > 0.0))
            break;
        OST_TRY(go_on_rows(steps, &length, &share));
    }
    return OST_SUCCESS;
}
