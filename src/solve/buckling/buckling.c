/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/buckling/buckling.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "guard/guard.h"
#include "solve/buckling/modes.h"

#include <float.h>
#include <math.h>

double ost_near_buckling(const OstMesh *mesh)
{
    return mesh->nodes_per_tet == 4 ? 2.5 : 1.25;
}

/* Below this load factor linear theory is not taken for the answer. */
static const double near_enough = 1.25;

/* Of modes that are asked for, and of whether there is one: largest residual, relative to the mode. */
static const double fine = 5e-3, crude = 0.03;

enum { MOST_ITERATIONS = 60, MOST_TO_JUDGE = 30 };

static void take(const OstModes *modes, OstResult *result)
{
    OstBuckling *buckling = &result->buckling;
    buckling->known = 1;
    buckling->count = modes->count;
    buckling->iterations = modes->iterations;
    buckling->converged = modes->converged;
    for (int m = 0; m < modes->count; m++)
        buckling->factor[m] = modes->softening[m] > 0.0 ? 1.0 / modes->softening[m] : INFINITY;
}

static OstStatus find(const OstProblem *problem, OstSolver *solver, OstResult *result)
{
    OstModesAim aim = {.modes = problem->buckling_modes,
                       .tolerance = fine,
                       .most_iterations = MOST_ITERATIONS,
                       .mixed = problem->pressures != NULL};
    OstModes modes;
    OstHeldMotions *held = NULL;
    int known = 0;
    OstStatus status = OST_SUCCESS;
    for (int m = 0; m < aim.modes; m++)
        OST_THEN(OST_NEW(problem->ctx, &result->buckling_mode[m], 3 * (size_t)problem->mesh->node_count));
    status = ost_agree(problem->ctx, status);
    OST_THEN(ost_held_motions_create(problem, solver, result->t, &known, &held));
    aim.held = held;
    if (status == OST_SUCCESS && !known)
        ost_warn(problem->ctx, "no buckling modes are looked for: of what a distributing coupling moves no rotation is "
                               "known, as it lies on a line");
    else
        OST_THEN(ost_modes_find(problem, solver, result, &aim, result->buckling_mode, &modes));
    if (status == OST_SUCCESS && known)
        take(&modes, result);
    ost_held_motions_destroy(&held);
    return status;
}

OstStatus ost_buckling_find(const OstProblem *problem, OstSolver *solver, OstResult *result)
{
    ost_ledger_enter(problem->ctx, OST_EFFECT_BUCKLING);
    const double before = ost_seconds();
    const OstStatus status = find(problem, solver, result);
    result->buckling.seconds = ost_seconds() - before;
    ost_ledger_leave(problem->ctx);
    return status;
}

int ost_buckling_ends(const OstResult *result)
{
    const OstBuckling *buckling = &result->buckling;
    return buckling->known && buckling->factor[0] < 1.0 && result->newton.linear_error == 1.0 / buckling->factor[0];
}

void ost_buckling_object(OstResult *result)
{
    ost_object(&result->verdict, OST_CHECK_FAILED,
               "by linear theory the body buckles at %.4g times this load: the state at rest that is found is not "
               "stable; take less load, or follow the body past its buckling by large_rotation: on, with a small force "
               "to the side or a path, or take the linear answer as it is by large_rotation: off",
               result->buckling.factor[0]);
}

/* The least height of a tet over one of its faces: six times the volume over twice the largest area. */
static double height(const OstMesh *mesh, OstLocal tet)
{
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    double edge[3][3], normal[4][3], most = 0.0;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++)
            edge[k][i] = mesh->coordinates[3 * (size_t)nodes[k + 1] + (size_t)i] -
                         mesh->coordinates[3 * (size_t)nodes[0] + (size_t)i];
    for (int k = 0; k < 3; k++)
        ost_cross3(edge[(k + 1) % 3], edge[(k + 2) % 3], normal[k]);
    for (int i = 0; i < 3; i++)
        normal[3][i] = normal[0][i] + normal[1][i] + normal[2][i];
    for (int k = 0; k < 4; k++)
        most = fmax(most, ost_norm3(normal[k]));
    return fabs(ost_dot3(edge[0], normal[0])) / most;
}

/* Could the body buckle under such strains? A column of one cell through its thickness buckles at a compression of
 * about (thickness / length)² / 5, whatever holds it; no part of a body is thinner than the lowest of its tets, nor
 * longer than the body. Moduli that differ make it softer by as much, and nearly incompressible material is stressed
 * more than it strains. On springs a body may tip over that does not strain at all. */
static OstStatus may_buckle(const OstProblem *problem, const OstResult *result, int *yes)
{
    const OstMesh *mesh = problem->mesh;
    double low[3], high[3], least = INFINITY, square = 0.0;
    OST_TRY(ost_mesh_bounds(mesh, low, high));
    for (int i = 0; i < 3; i++)
        square += (high[i] - low[i]) * (high[i] - low[i]);
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++)
        least = fmin(least, height(mesh, tet));
    int sprung = problem->supports->spring != NULL;
    OST_TRY(ost_min(problem->ctx, 1, &least));
    OST_TRY(ost_max_ints(problem->ctx, 1, &sprung));
    const OstSolverFacts *facts = &problem->facts;
    const double uneven = fmax(fmax(facts->contrast, facts->anisotropy), 1.0) / fmax(1.0 - 2.0 * facts->poisson, 1e-6);
    const double softening = 5.0 * square / (least * least) * result->newton.linear_strain * uneven;
    ost_log(problem->ctx, OST_LOG_VERBOSE, "buckling: softened by no more than %.3g", softening);
    *yes = softening >= 1.0 / ost_near_buckling(mesh) || sprung;
    return OST_SUCCESS;
}

/* One mode, if there is one so soft that it matters. */
static OstStatus look_for_mode(const OstProblem *problem, OstSolver *solver, const OstHeldMotions *held,
                               OstResult *result)
{
    OstModesAim aim = {.modes = 1,
                       .tolerance = crude,
                       .least = 1.0 / ost_near_buckling(problem->mesh),
                       .most_iterations = MOST_TO_JUDGE,
                       .held = held};
    OstModes modes;
    OST_TRY(ost_modes_find(problem, solver, result, &aim, NULL, &modes));
    if (problem->pressures && modes.softening[0] >= aim.least) { /* but they may hold the body */
        const double most = modes.softening[0];
        aim.mixed = 1;
        const OstStatus status = ost_modes_find(problem, solver, result, &aim, NULL, &modes);
        if (status == OST_NOT_CONVERGED) /* Newton's method tells */
            result->newton.linear_error = fmax(result->newton.linear_error, most);
        if (status != OST_SUCCESS)
            return status == OST_NOT_CONVERGED ? OST_SUCCESS : status;
    }
    if (modes.softening[0] >= aim.least)
        take(&modes, result);
    return OST_SUCCESS;
}

OstStatus ost_buckling_judge(const OstProblem *problem, OstSolver *solver, OstResult *result)
{
    OstHeldMotions *held = NULL;
    int may = 0, known = 0;
    if (!problem->conservative) /* no energy tells: it may begin to move long before */
        return OST_SUCCESS;
    if (!result->buckling.known) {
        OST_TRY(may_buckle(problem, result, &may));
        if (!may)
            return OST_SUCCESS;
        OstStatus status = ost_held_motions_create(problem, solver, result->t, &known, &held);
        if (known)
            OST_THEN(look_for_mode(problem, solver, held, result));
        ost_held_motions_destroy(&held);
        OST_TRY(status);
        if (!result->buckling.known)
            return OST_SUCCESS;
    }
    if (result->buckling.factor[0] < near_enough)
        result->newton.linear_error = fmax(result->newton.linear_error, 1.0 / result->buckling.factor[0]);
    return OST_SUCCESS;
}
