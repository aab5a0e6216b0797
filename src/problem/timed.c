/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/problem.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

static OstStatus copy_table(OstContext *ctx, const OstTimeTable *table, OstTimeTable *copy)
{
    const size_t bytes = (size_t)table->count * sizeof(double);
    OST_TRY(OST_NEW(ctx, &copy->time, table->count));
    OST_TRY(OST_NEW(ctx, &copy->factor, table->count));
    memcpy(copy->time, table->time, bytes);
    memcpy(copy->factor, table->factor, bytes);
    copy->count = table->count;
    return OST_SUCCESS;
}

OstStatus ost_problem_add_timed(OstProblem *problem, const OstTimeTable *table)
{
    OstContext *ctx = problem->ctx;
    ost_ledger_enter(ctx, OST_EFFECT_PATH);
    OstStatus status = OST_RESIZE(ctx, &problem->timed, problem->timed_count + 1);
    if (status == OST_SUCCESS) {
        OstTimed *timed = &problem->timed[problem->timed_count++];
        status = copy_table(ctx, table, &timed->table);
        OST_THEN(OST_NEW(ctx, &timed->force, 3 * (size_t)problem->mesh->node_count));
    }
    ost_ledger_leave(ctx);
    return ost_agree(ctx, status);
}

void ost_problem_release_timed(OstProblem *problem)
{
    for (int k = 0; k < problem->timed_count; k++) {
        OST_FREE(problem->timed[k].table.time, problem->timed[k].table.factor, problem->timed[k].force);
        ost_supports_destroy(&problem->timed[k].supports);
    }
    OST_FREE(problem->timed);
}

int ost_problem_functions(const OstProblem *problem)
{
    return 1 + problem->timed_count;
}

double ost_problem_factor(const OstProblem *problem, int function, double t)
{
    static const OstTimeTable ramp = {0};
    return ost_time_factor(function == 0 ? &ramp : &problem->timed[function - 1].table, t);
}

double ost_problem_eigen_share(const OstProblem *problem, double t)
{
    return ost_problem_factor(problem, problem->eigen_function, t);
}

/* With what moves distributing couplings. */
static double dead_load(const OstProblem *problem, int function, size_t i)
{
    const double force = function == 0 ? problem->force[i] : problem->timed[function - 1].force[i];
    const size_t owned = 3 * (size_t)problem->mesh->owned_nodes;
    return problem->driven ? force + problem->driven[(size_t)function * owned + i] : force;
}

void ost_problem_add_load(const OstProblem *problem, int function, double factor, const double *u, double *force)
{
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->owned_nodes; i++)
        force[i] += factor * dead_load(problem, function, i);
    ost_follower_force(problem->follower, function, factor, u, force);
}

double ost_problem_work(const OstProblem *problem, int function, double factor, const double *u)
{
    double work = ost_follower_work(problem->follower, function, factor, u);
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->owned_nodes; i++)
        work += factor * dead_load(problem, function, i) * u[i];
    return work;
}

/* The system, with the displacements that this function prescribes. */
static OstSystem system_of(const OstProblem *problem, int function)
{
    OstSystem system = *problem->system;
    if (function > 0)
        system.supports = problem->timed[function - 1].supports;
    return system;
}

OstStatus ost_problem_function_right_hand_side(const OstProblem *problem, int function, double *rhs)
{
    const OstSystem system = system_of(problem, function);
    const double share = function == problem->eigen_function ? 1.0 : 0.0;
    double *force = NULL;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &force, 3 * (size_t)problem->mesh->owned_nodes)));
    ost_problem_add_load(problem, function, 1.0, NULL, force);
    const OstStatus status = ost_system_right_hand_side(&system, problem->field, share, force, rhs);
    OST_FREE(force);
    return status;
}

OstStatus ost_problem_function_displacement(const OstProblem *problem, int function, const double *v, double *u)
{
    const OstSystem system = system_of(problem, function);
    return ost_system_displacement(&system, 1.0, v, u);
}

static int is_moved(const OstSupports *supports, OstLocal node)
{
    double projector[9], prescribed[3];
    ost_supports_get(supports, node, projector, prescribed);
    return (prescribed[0] != 0.0 || prescribed[1] != 0.0 || prescribed[2] != 0.0);
}

int ost_problem_moves(const OstProblem *problem, OstLocal node)
{
    int moves = is_moved(problem->supports, node);
    for (int k = 0; k < problem->timed_count && !moves; k++)
        moves = is_moved(problem->timed[k].supports, node);
    return moves;
}

int ost_problem_begins_at_rest(const OstProblem *problem)
{
    for (int k = 0; k < problem->timed_count; k++)
        if (ost_time_factor(&problem->timed[k].table, 0.0) != 0.0)
            return 0;
    return 1;
}
