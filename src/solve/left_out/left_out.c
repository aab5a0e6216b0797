/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/left_out/left_out.h"

#include "assembly/links/levers.h"
#include "assembly/links/rigid_faces.h"
#include "assembly/springs.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "mesh/nearest.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Of the correction little needs to be known: this share of it, in the norm of the energy. The residual ends a solve
 * that knows no such error. */
static const double enough = 0.25, least_residual = 1e-3;

/* A body that moves by less than this share of its size does not, but for rounding; nor does stress change that much.
 */
static const double nothing = 1e-10;

typedef struct Work {
    double *force, *load, *even; /* 3 × owned_nodes: of one direction; and what both have in common */
    double *residual, *taken;    /* 3 × rows, and the pressures, ghosts included */
    double *turned; /* 3 × node_count: the displacement, with rigid faces and levers in their shape; NULL: as it is */
} Work;

static void release(Work *work)
{
    OST_FREE(work->force);
    OST_FREE(work->load);
    OST_FREE(work->even);
    OST_FREE(work->residual);
    OST_FREE(work->taken);
    OST_FREE(work->turned);
}

static int has_shapes(const OstProblem *problem)
{
    const OstLinks *links = problem->supports->links;
    return links && (links->face_count > 0 || links->gaps);
}

static OstStatus allocate(const OstProblem *problem, Work *work)
{
    OstContext *ctx = problem->ctx;
    const size_t owned = 3 * (size_t)problem->mesh->owned_nodes;
    const size_t unknowns =
        3 * (size_t)problem->system->matrix->rows + (problem->pressures ? ost_problem_pressure_room(problem) : 0);
    OstStatus status = OST_NEW(ctx, &work->force, owned);
    OST_THEN(OST_NEW(ctx, &work->load, owned));
    OST_THEN(OST_NEW(ctx, &work->even, owned));
    OST_THEN(OST_NEW(ctx, &work->residual, unknowns));
    OST_THEN(OST_NEW(ctx, &work->taken, unknowns));
    if (has_shapes(problem))
        OST_THEN(OST_NEW(ctx, &work->turned, 3 * (size_t)problem->mesh->node_count));
    return ost_agree(ctx, status);
}

/* The body goes where its loads push it, if nodes that move by at least half as far as any, and within 60 degrees of
 * their load, do nearly all of the work. Then its energy is that of the motion that matters, and says how stress
 * changes it (guard/linearity.h). Of a column that leans under its load it is not, nor where supports or strains move
 * it. */
static const double far = 0.5, along = 0.5, nearly_all = 0.9;

/* The loads' work: of nodes that are pushed so, of all, and of the three components of all. */
typedef struct Push {
    double pushed, all, component[3];
    double most; /* the largest displacement */
} Push;

static OstStatus measure_push(const OstProblem *problem, const OstResult *result, const double *load, Push *push)
{
    double sum[5] = {0.0}, most = 0.0;
    const OstLocal owned = problem->mesh->owned_nodes;
    for (OstLocal node = 0; node < owned; node++)
        most = fmax(most, ost_norm3(result->displacement + 3 * (size_t)node));
    OST_TRY(ost_max(problem->ctx, 1, &most));
    for (OstLocal node = 0; node < owned; node++) {
        const double *f = load + 3 * (size_t)node, *u = result->displacement + 3 * (size_t)node;
        const double of_node = ost_dot3(f, u), moved = ost_norm3(u);
        sum[0] += moved >= far * most && of_node >= along * ost_norm3(f) * moved ? of_node : 0.0;
        sum[1] += fabs(of_node);
        for (int i = 0; i < 3; i++)
            sum[2 + i] += f[i] * u[i];
    }
    OST_TRY(ost_sum(problem->ctx, 5, sum));
    *push = (Push){sum[0], sum[1], {sum[2], sum[3], sum[4]}, most};
    return OST_SUCCESS;
}

/* A watched displacement of this share of the largest one, in the direction of the loads' work, is of that motion. */
static const double of_the_motion = 0.1;

/* Is something watched that the energy of that motion says nothing of: a reaction, or another displacement? */
static OstStatus watches_more(const OstProblem *problem, const OstResult *result, const Push *push, int *yes)
{
    *yes = 0;
    for (int w = 0; problem->c && w < problem->c->watch_count && !*yes; w++) {
        const OstWatch *watch = &problem->c->watches[w];
        const int is_length = watch->component == OST_WATCH_LENGTH;
        OstNearest vertex;
        double moved = 0.0;
        if (watch->kind != OST_WATCH_DISPLACEMENT || is_length) {
            *yes = is_length || watch->kind == OST_WATCH_REACTION;
            continue;
        }
        OST_TRY(ost_mesh_nearest(problem->mesh, watch->on.point, &vertex));
        if (vertex.node >= 0)
            moved = fabs(result->displacement[3 * vertex.node + watch->component]);
        OST_TRY(ost_max(problem->ctx, 1, &moved));
        *yes = moved < of_the_motion * push->most || push->component[watch->component] < nearly_all * push->all;
    }
    return OST_SUCCESS;
}

static OstStatus energy_tells(const OstProblem *problem, const OstResult *result, int *yes)
{
    double *load = NULL;
    Push push;
    int more = 0;
    *yes = 0;
    if (ost_effect_on(problem->effects, OST_EFFECT_PRESCRIBED_DISPLACEMENT) ||
        ost_field_is_eigenstrained(problem->field))
        return OST_SUCCESS;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &load, 3 * (size_t)problem->mesh->owned_nodes)));
    ost_problem_load(problem, result->t, NULL, load);
    const OstStatus status = measure_push(problem, result, load, &push);
    OST_FREE(load);
    OST_TRY(status);
    if (push.pushed >= nearly_all * push.all)
        OST_TRY(watches_more(problem, result, &push, &more));
    *yes = push.pushed >= nearly_all * push.all && !more;
    return OST_SUCCESS;
}

static void reverse(OstResult *result)
{
    for (size_t i = 0; i < 3 * (size_t)result->mesh->node_count; i++)
        result->displacement[i] = -result->displacement[i];
    for (size_t i = 0; result->pressure && i < 4 * (size_t)result->mesh->tet_count; i++)
        result->pressure[i] = -result->pressure[i];
}

/* Subtracts half of what is out of balance in the answer, or in its reverse. */
static OstStatus subtract_half(const OstProblem *problem, const OstResult *result, double sign, Work *work)
{
    const OstSystem *system = problem->system;
    const double share = sign * ost_problem_eigen_share(problem, result->t), *u = result->displacement;
    if (work->turned) {
        const OstLinks *links = problem->supports->links;
        memcpy(work->turned, u, 3 * (size_t)problem->mesh->node_count * sizeof *work->turned);
        OST_TRY(ost_rigid_faces_move(links, NULL, u, 1.0, work->turned));
        OST_TRY(ost_levers_put(links, work->turned));
        OST_TRY(ost_problem_turn(problem, work->turned));
        u = work->turned;
    }
    OST_TRY(ost_agree(problem->ctx, ost_internal_force_of(problem->mesh, result->field, OST_FORMULATION_CONSISTENT,
                                                          share, u, work->force, NULL)));
    if (problem->follower || work->turned) {
        OstProblem turned = *problem;
        ost_problem_take_formulation(&turned, OST_FORMULATION_CONSISTENT);
        ost_problem_load(&turned, result->t, u, work->load);
        for (size_t i = 0; i < 3 * (size_t)problem->mesh->owned_nodes; i++)
            work->force[i] -= sign * work->load[i];
    }
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->owned_nodes; i++)
        work->even[i] += 0.5 * work->force[i];
    OST_TRY(ost_system_take_rows(system, work->force, work->taken));
    for (size_t i = 0; i < 3 * (size_t)system->matrix->rows; i++)
        work->residual[i] -= 0.5 * work->taken[i];
    if (!problem->pressures)
        return OST_SUCCESS;
    const size_t rows = 3 * (size_t)system->matrix->rows;
    OST_TRY(ost_pressure_volume(problem->pressures, result->field, OST_FORMULATION_CONSISTENT, share, u,
                                work->taken + rows, NULL));
    for (size_t i = rows; i < rows + (size_t)problem->pressures->owned; i++)
        work->residual[i] -= 0.5 * work->taken[i];
    return OST_SUCCESS;
}

/* What is out of balance to second order: the part that the reverse of all has too. Beyond that, a part that has turned
 * comes out longer, and its tension would be taken for one that stiffens the body. `taken` is not needed yet. */
static OstStatus find_residual(const OstProblem *problem, OstResult *result, Work *work)
{
    OstStatus status = subtract_half(problem, result, 1.0, work);
    reverse(result);
    OST_THEN(subtract_half(problem, result, -1.0, work));
    reverse(result);
    status = ost_agree(problem->ctx, status);
    OST_THEN(ost_problem_turn(problem, NULL));
    return status;
}

static OstStatus stop_there(void *data, const double *u, double error, double *next)
{
    (void)data;
    (void)u;
    *next = error;
    return OST_SUCCESS;
}

static OstStatus correct(const OstProblem *problem, OstSolver *solver, const Work *work)
{
    const size_t rows = 3 * (size_t)problem->system->matrix->rows;
    const OstErrorStop stop = {.ask = stop_there, .first = enough, .relative = 1};
    OstSolveReport report = {0};
    ost_solver_aim(solver, (OstSolverAim){.relative_residual = least_residual, .crude = 1, .stop = &stop});
    const OstSaddle saddle = {problem->coupling, work->residual + rows, work->taken + rows};
    const OstStatus status = problem->pressures
                                 ? ost_solver_solve_mixed(solver, &saddle, work->residual, work->taken, &report)
                                 : ost_solver_solve(solver, work->residual, work->taken, &report);
    ost_solver_aim(solver, (OstSolverAim){0});
    ost_log(problem->ctx, OST_LOG_VERBOSE, "large rotation: what linear theory leaves out took %d iterations",
            report.iterations);
    return status == OST_NOT_CONVERGED ? OST_SUCCESS : status; /* as far as it has come */
}

/* The largest change of a node's displacement along itself, relative to the largest displacement: across, what turns
 * moves too, but comes no further. */
static OstStatus compare(const OstProblem *problem, const OstResult *result, const double *moved, double *change)
{
    double most[3] = {0.0}; /* the last: how far from the origin of the coordinates */
    for (OstLocal node = 0; node < problem->mesh->owned_nodes; node++) {
        const double *u = result->displacement + 3 * (size_t)node, *x = problem->mesh->coordinates + 3 * (size_t)node;
        most[0] = fmax(most[0], ost_dot3(u, u));
        most[2] = fmax(most[2], ost_dot3(x, x));
        most[1] = fmax(most[1], fabs(ost_dot3(moved + 3 * (size_t)node, u)));
    }
    OST_TRY(ost_max(problem->ctx, 3, most));
    *change = most[0] > fmax(nothing * nothing * most[2], DBL_MIN) ? most[1] / most[0] : 0.0;
    return OST_SUCCESS;
}

/* What supports and springs take of the change of a node's forces: the rest is what the correction leaves. At linked
 * nodes it is passed on, too. */
static void take_supported(const OstSupports *supports, OstLocal node, const double *of_springs, double *force)
{
    double projector[9], rest[3], left[3];
    if (supports->links && (supports->links->leads[node] || supports->links->of_node[node] >= 0))
        return;
    for (int i = 0; i < 3; i++)
        rest[i] = force[i] - of_springs[i];
    ost_supports_get(supports, node, projector, NULL);
    ost_apply3(projector, rest, left);
    for (int i = 0; i < 3; i++)
        force[i] -= left[i];
}

/* What the corrected forces of the tets have beside the linear ones. Those of the correction's pressure would come to
 * it in a mixed form, which has none of this. */
static OstStatus find_reactions(const OstProblem *problem, OstResult *result, const Work *work)
{
    const size_t owned = 3 * (size_t)problem->mesh->owned_nodes;
    if (problem->pressures)
        return OST_SUCCESS;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &result->left_out_reaction, owned)));
    OST_TRY(ost_agree(problem->ctx, ost_internal_force_of(problem->mesh, problem->field, OST_FORMULATION_LINEAR, 0.0,
                                                          result->left_out, result->left_out_reaction, NULL)));
    for (size_t i = 0; i < owned; i++)
        result->left_out_reaction[i] += work->even[i];
    double *of_springs = work->load;
    memset(of_springs, 0, owned * sizeof *of_springs);
    if (problem->supports->spring)
        ost_spring_force(problem->supports, 1.0, result->left_out, of_springs);
    for (OstLocal node = 0; node < problem->mesh->owned_nodes; node++)
        take_supported(problem->supports, node, of_springs + 3 * (size_t)node,
                       result->left_out_reaction + 3 * (size_t)node);
    return OST_SUCCESS;
}

static OstStatus find(const OstProblem *problem, OstSolver *solver, int is_watched, OstResult *result, Work *work)
{
    double change = 0.0;
    OST_TRY(find_residual(problem, result, work));
    OST_TRY(correct(problem, solver, work));
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &result->left_out, 3 * (size_t)problem->mesh->node_count)));
    OST_TRY(ost_system_displacement(problem->system, 0.0, work->taken, result->left_out));
    OST_TRY(compare(problem, result, result->left_out, &change));
    ost_log(problem->ctx, OST_LOG_VERBOSE,
            "large rotation: what linear theory leaves out changes the displacement by "
            "%.3g",
            change);
    result->newton.linear_change = change;
    result->newton.linear_error = fmax(result->newton.linear_error, change);
    if (is_watched && result->newton.linear_error <= problem->accuracy)
        return find_reactions(problem, result, work);
    OST_FREE(result->left_out);
    return OST_SUCCESS;
}

OstStatus ost_left_out_find(const OstProblem *problem, OstSolver *solver, OstResult *result)
{
    const int is_watched = problem->c && problem->c->watch_count > 0;
    Work work = {0};
    int told = 0;
    OST_TRY(energy_tells(problem, result, &told));
    if (told)
        return OST_SUCCESS;
    OstStatus status = allocate(problem, &work);
    OST_THEN(find(problem, solver, is_watched, result, &work));
    release(&work);
    return status;
}
