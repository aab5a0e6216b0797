/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver.h"
#include "assembly/system.h"
#include "core/error.h"
#include "core/free_memory.h"
#include "core/memory.h"
#include "core/small.h"
#include "orthostat/scene.h"
#include "solve/boundary_conditions.h"
#include "solve/checks.h"
#include "solve/coarse_space.h"
#include "solve/free_body.h"
#include "solve/freedom.h"
#include "solve/number_range.h"
#include "solve/recovery.h"
#include "solve/rigid_motion.h"

#include <string.h>

/* What lives from the assembly to the end of the solve, and no longer. */
typedef struct Work {
    OstSupports *supports;
    OstSystem *system;
    OstLinearSpace *linear; /* under quadratic tets */
    OstSolver *solver;
    double *rhs, *v;                      /* 3 × rows */
    double *coordinates, *metric, *modes; /* what multigrid sees */
} Work;

static void release_system(Work *work)
{
    ost_solver_destroy(&work->solver);
    ost_linear_space_destroy(&work->linear);
    ost_system_destroy(&work->system);
    OST_FREE(work->rhs);
    OST_FREE(work->v);
    OST_FREE(work->coordinates);
    OST_FREE(work->metric);
    OST_FREE(work->modes);
}

static OstStatus create_result(const OstScene *scene, OstResult **result)
{
    OstContext *ctx = scene->ctx;
    const size_t nodes = (size_t)scene->mesh->node_count;
    OST_TRY(OST_NEW(ctx, result, 1));
    (*result)->ctx = ctx;
    (*result)->mesh = scene->mesh;
    (*result)->field = scene->field;
    OST_TRY(OST_NEW(ctx, &(*result)->displacement, 3 * nodes));
    OST_TRY(OST_NEW(ctx, &(*result)->force, 3 * nodes));
    return OST_NEW(ctx, &(*result)->reaction, 3 * nodes);
}

void ost_result_destroy(OstResult **result)
{
    if (!*result)
        return;
    OST_FREE((*result)->displacement);
    OST_FREE((*result)->force);
    OST_FREE((*result)->reaction);
    OST_FREE((*result)->strain);
    OST_FREE((*result)->stress);
    OST_FREE((*result)->strain_energy_density);
    OST_FREE((*result)->node_stress);
    OST_FREE(*result);
}

/* An isotropic body's metric is the Euclidean one, which needs no array. */
static OstStatus fill_geometry(const OstScene *scene, Work *work)
{
    OstContext *ctx = scene->ctx;
    const size_t rows = (size_t)work->system->matrix->rows;
    OstStatus status = OST_NEW(ctx, &work->coordinates, 3 * rows);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &work->modes, 18 * rows);
    if (status == OST_SUCCESS && scene->plan.effect[OST_PLAN_ORTHOTROPY].on)
        status = OST_NEW(ctx, &work->metric, 6 * rows);
    OST_TRY(ost_agree(ctx, status));
    return ost_system_geometry(work->system, scene->field, work->coordinates, work->metric, work->modes);
}

/* What is wrong with the supports is told with the place of the first. */
static OstStatus create_system(const OstScene *scene, Work *work)
{
    const OstCase *c = scene->c;
    const OstStatus status = ost_system_create(scene->mesh, work->supports, &work->system);
    if (status != OST_INVALID_INPUT || c->constraint_count == 0)
        return status;
    return ost_case_located(c, c->constraints[0].on.place, status);
}

static OstStatus assemble(const OstScene *scene, const OstResult *result, Work *work)
{
    OstContext *ctx = scene->ctx;
    OST_TRY(create_system(scene, work));
    const size_t rows = (size_t)work->system->matrix->rows;
    OstStatus status = ost_system_fill(work->system, scene->field);
    ost_system_release_scatter(work->system);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &work->rhs, 3 * rows);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &work->v, 3 * rows);
    if (status == OST_SUCCESS)
        status = ost_system_right_hand_side(work->system, scene->field, result->force, work->rhs);
    OST_TRY(ost_agree(ctx, status));
    return ost_number_range_check(work->system, work->rhs, scene->c->path);
}

/* Before anything is built on it: is rigid motion free of force, tet by tet and in the matrix? */
static OstStatus test_rigid_motion(const OstScene *scene, OstResult *result, const Work *work)
{
    double of_tets, of_rows;
    OST_TRY(ost_rigid_motion_of_tets(scene->mesh, scene->field, &of_tets));
    OST_TRY(ost_rigid_motion_of_rows(work->system, work->modes, &of_rows));
    result->checks.rigid_motion = fmax(of_tets, of_rows);
    return OST_SUCCESS;
}

/* What the plan knows, and what the mesh and the machines add to it. */
static OstStatus find_facts(const OstScene *scene, const Work *work, OstSolverFacts *facts)
{
    OstContext *ctx = scene->ctx;
    const OstMesh *mesh = scene->mesh;
    double worst = 1.0;
    *facts = scene->plan.facts;
    facts->unknowns = 3 * work->system->matrix->global_rows;
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        worst =
            fmin(worst, ost_tet_quality(mesh->coordinates, mesh->tet_nodes + (size_t)mesh->nodes_per_tet * (size_t)t));
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(&worst, &facts->quality, 1, MPI_DOUBLE, MPI_MIN, ost_comm(ctx))));
    return ost_memory_free(ctx, &facts->free_memory);
}

static int is_multigrid(OstRecipe recipe)
{
    return recipe != OST_RECIPE_PLAIN && recipe != OST_RECIPE_DIRECT;
}

/* A factorisation that is bounded may turn out not to fit, and then multigrid takes its place. */
static int may_be_multigrid(const OstSolverPlan *plan)
{
    return is_multigrid(plan->first) || (plan->options.recipe == OST_RECIPE_AUTO && plan->options.factor_memory > 0.0);
}

static OstStatus solve_system(const OstScene *scene, OstResult *result, Work *work)
{
    OstContext *ctx = scene->ctx;
    const OstSolverOptions *options = &scene->c->solver;
    OstSolverFacts facts;
    OstSolverPlan plan;
    ost_ledger_enter(ctx, OST_LEDGER_HIERARCHY);
    OstStatus status = fill_geometry(scene, work);
    if (status == OST_SUCCESS)
        status = find_facts(scene, work, &facts);
    ost_ledger_leave(ctx);
    OST_TRY(status);
    OST_TRY(test_rigid_motion(scene, result, work));
    ost_solver_plan(options, &facts, &plan);
    if (may_be_multigrid(&plan))
        OST_TRY(ost_linear_space_create(work->system, scene->field, work->metric != NULL, &work->linear));
    const OstSolverGeometry geometry = {.coordinates = work->coordinates,
                                        .metric = work->metric,
                                        .modes = work->modes,
                                        .coarse = work->linear ? &work->linear->space : NULL,
                                        .facts = &facts};
    OST_TRY(ost_solver_create(ctx, work->system->matrix, &geometry, options, &work->solver));
    const OstStatus solved = ost_solver_solve(work->solver, work->rhs, work->v, &result->solve);
    OST_TRY(ost_system_displacement(work->system, work->v, result->displacement));
    result->reached = solved == OST_SUCCESS || solved == OST_NOT_CONVERGED;
    return solved;
}

/* What the checks hold the residual to: what was asked for, or, where the case takes it, what double precision held. */
static double residual_to_hold(const OstScene *scene, const OstResult *result)
{
    const OstSolveReport *report = &result->solve;
    const double asked = scene->c->solver.relative_residual;
    return report->rounding_limited ? fmax(asked, report->relative_residual) : asked;
}

static OstStatus describe_rhs(const Work *work, OstSolvedFor *rhs)
{
    const size_t n = 3 * (size_t)work->system->matrix->rows;
    double sums[2] = {0.0};
    for (size_t i = 0; i < n; i++) {
        sums[0] += work->rhs[i] * work->rhs[i];
        sums[1] += work->rhs[i] * work->v[i];
    }
    OstContext *ctx = work->system->ctx;
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, ost_comm(ctx))));
    *rhs = (OstSolvedFor){sqrt(sums[0]), sums[1]};
    return OST_SUCCESS;
}

static OstStatus find_largest_displacement(OstResult *result)
{
    OstContext *ctx = result->ctx;
    const OstMesh *mesh = result->mesh;
    struct {
        double value;
        int rank;
    } largest = {0.0, ost_rank(ctx)};
    double at[3] = {0.0};
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        const double size = ost_norm3(result->displacement + 3 * (size_t)n);
        if (!(size > largest.value)) /* nor what is no number */
            continue;
        largest.value = size;
        memcpy(at, mesh->coordinates + 3 * (size_t)n, sizeof at);
    }
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE_INT, MPI_MAXLOC, ost_comm(ctx))));
    OST_TRY(OST_MPI(ctx, MPI_Bcast(at, 3, MPI_DOUBLE, largest.rank, ost_comm(ctx))));
    result->largest_displacement = largest.value;
    memcpy(result->largest_at, at, sizeof at);
    return OST_SUCCESS;
}

/* Checks what the solver reached, finished or not, and adds the fields asked for. */
static OstStatus examine(const OstScene *scene, OstResult *result, const OstSupports *supports, const OstSolvedFor *rhs)
{
    if (scene->c->free_body)
        OST_TRY(ost_free_body_centre(scene->mesh, result->displacement));
    OST_TRY(ost_result_check(result, supports, residual_to_hold(scene, result), rhs));
    OST_TRY(find_largest_displacement(result));
    return ost_agree(result->ctx, ost_result_recover(result, scene->c->output_fields));
}

/* What is held against the result, as a failure. */
static OstStatus raise_objections(const OstResult *result, OstStatus solved)
{
    const OstObjections *objections = &result->objections;
    char text[OST_MOST_OBJECTIONS * (OST_LONGEST_OBJECTION + 2)] = "";
    if (objections->count == 0)
        return OST_SUCCESS;
    if (solved != OST_SUCCESS)
        return OST_RAISE(result->ctx, solved, "%s", objections->text[0]);
    for (int i = 0; i < objections->count; i++) {
        strcat(text, i > 0 ? "; " : "");
        strcat(text, objections->text[i]);
    }
    return OST_RAISE(result->ctx, OST_CHECK_FAILED, "%s", text);
}

/* All that is checked before a solver is made. */
static OstStatus prepare(const OstScene *scene, OstResult *result, Work *work)
{
    const OstCase *c = scene->c;
    OST_TRY(ost_scene_supports(scene, &work->supports));
    OST_TRY(ost_freedom_check(scene->mesh, work->supports, c->path, c->free_body));
    OST_TRY(ost_scene_loads(scene, result->force));
    if (c->free_body)
        OST_TRY(ost_free_body_check_loads(scene->mesh, result->force, c->path));
    return assemble(scene, result, work);
}

OstStatus ost_scene_rehearse(const OstScene *scene)
{
    Work work = {0};
    OstResult *result = NULL;
    OstStatus status = ost_agree(scene->ctx, create_result(scene, &result));
    if (status == OST_SUCCESS)
        status = prepare(scene, result, &work);
    release_system(&work);
    ost_supports_destroy(&work.supports);
    ost_result_destroy(&result);
    return status;
}

OstStatus ost_scene_solve(OstScene *scene, OstResult **out)
{
    OstContext *ctx = scene->ctx;
    Work work = {0};
    OstResult *result = NULL;
    OstSolvedFor rhs = {0.0, 0.0};
    OstStatus status = ost_agree(ctx, create_result(scene, &result));
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(prepare(scene, result, &work));
    result->unknowns = 3 * work.system->matrix->global_rows;
    status = solve_system(scene, result, &work);
    if (!result->reached)
        goto done;
    const OstStatus solved = status;
    result->unfinished = solved != OST_SUCCESS;
    if (result->unfinished)
        ost_object(result, "%s", ost_error_text(ctx));
    OST_TRY_DONE(describe_rhs(&work, &rhs));
    release_system(&work);
    OST_TRY_DONE(examine(scene, result, work.supports, &rhs));
    status = raise_objections(result, solved);
done:
    release_system(&work);
    ost_supports_destroy(&work.supports);
    *out = result;
    return status;
}
