/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/strategy.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "problem/scene_data.h"
#include "solve/distributing/distributing.h"

#include <string.h>

OstStatus ost_result_create(const OstProblem *problem, OstResult **result)
{
    const OstMesh *mesh = ost_problem_mesh(problem);
    OstContext *ctx = mesh->ctx;
    OstResult *made = NULL;
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS) {
        made->ctx = ctx;
        made->mesh = mesh;
        made->field = ost_problem_field(problem);
        made->t = 1.0;
        made->linear_alone = problem->effects && problem->effects->why_linear;
        status = OST_NEW(ctx, &made->displacement, 3 * (size_t)mesh->node_count);
        if (problem->pressures) {
            ost_ledger_enter(ctx, OST_EFFECT_MIXED);
            OST_THEN(OST_NEW(ctx, &made->pressure, 4 * (size_t)mesh->tet_count));
            ost_ledger_leave(ctx);
        }
    }
    status = ost_agree(ctx, status);
    if (status != OST_SUCCESS)
        ost_result_destroy(&made);
    else if (made->pressure) {
        OstProblem state;
        ost_problem_at_pressure(problem, made->pressure, &made->at_pressure, &state);
        made->field = &made->at_pressure;
    }
    *result = made;
    return status;
}

void ost_result_destroy(OstResult **result)
{
    if (!*result)
        return;
    OST_FREE((*result)->displacement);
    OST_FREE((*result)->pressure);
    OST_FREE((*result)->internal);
    OST_FREE((*result)->force);
    OST_FREE((*result)->reaction);
    OST_FREE((*result)->passed, (*result)->moved);
    OST_FREE((*result)->strain);
    OST_FREE((*result)->stress);
    OST_FREE((*result)->strain_energy_density);
    OST_FREE((*result)->node_stress);
    OST_FREE((*result)->rotation);
    OST_FREE((*result)->tet_error);
    OST_FREE((*result)->surplus);
    OST_FREE((*result)->left_out);
    OST_FREE((*result)->left_out_reaction);
    for (int m = 0; m < OST_MOST_BUCKLING_MODES; m++)
        OST_FREE((*result)->buckling_mode[m]);
    OST_FREE((*result)->node_stress_surplus);
    OST_FREE((*result)->reactions);
    OST_FREE((*result)->stress_surplus);
    OST_FREE((*result)->along_axes_surplus);
    OST_FREE((*result)->interest.share);
    OST_FREE(*result);
}

void ost_result_take_outcome(OstResult *result, OstStatus solved)
{
    result->unfinished = solved == OST_NOT_CONVERGED;
    if (result->unfinished)
        ost_object(&result->verdict, solved, "%s", ost_error_text(result->ctx));
}

static int watches_reaction(const OstProblem *problem)
{
    int any = 0;
    for (int w = 0; problem->scene && w < problem->scene->c->watch_count; w++)
        any |= problem->scene->c->watches[w].kind == OST_WATCH_REACTION;
    return any;
}

OstStatus ost_result_take_load(OstResult *result, const OstProblem *problem, double t)
{
    OstContext *ctx = result->ctx;
    const OstLocal nodes = result->mesh->node_count;
    OstStatus status = OST_NEW(ctx, &result->force, 3 * (size_t)result->mesh->owned_nodes);
    OST_THEN(OST_NEW(ctx, &result->reaction, 3 * (size_t)nodes));
    if (watches_reaction(problem) && (problem->supports->links || ost_distributing_any(problem)))
        OST_THEN(OST_NEW(ctx, &result->passed, 3 * (size_t)result->mesh->owned_nodes));
    if (result->passed && ost_distributing_any(problem))
        OST_THEN(OST_NEW(ctx, &result->moved, 3 * (size_t)result->mesh->owned_nodes));
    if (status == OST_SUCCESS)
        ost_problem_load(problem, t, result->displacement, result->force);
    result->t = ost_problem_eigen_share(problem, t);
    return ost_agree(ctx, status);
}

OstStatus ost_result_find_largest(OstResult *result)
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
        if (!(size > largest.value)) /* NaN neither */
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

const OstBuckling *ost_result_buckling(const OstResult *result)
{
    return &result->buckling;
}

const double *ost_result_displacement(const OstResult *result)
{
    return result->displacement;
}

const double *ost_result_reaction(const OstResult *result)
{
    return result->reaction;
}

const double *ost_result_load(const OstResult *result)
{
    return result->force;
}

const double *ost_result_stress(const OstResult *result)
{
    return result->stress;
}

const double *ost_result_strain(const OstResult *result)
{
    return result->strain;
}

const double *ost_result_strain_energy_density(const OstResult *result)
{
    return result->strain_energy_density;
}

const double *ost_result_node_stress(const OstResult *result)
{
    return result->node_stress;
}

const double *ost_result_tet_error(const OstResult *result)
{
    return result->tet_error;
}

const OstAnswerError *ost_result_answer_error(const OstResult *result)
{
    return &result->answer;
}

const OstFailure *ost_result_failure(const OstResult *result)
{
    return &result->failure;
}

const OstSolveReport *ost_result_solve_report(const OstResult *result)
{
    return &result->solve;
}

const OstChecks *ost_result_checks(const OstResult *result)
{
    return &result->checks;
}

const OstNewtonReport *ost_result_newton_report(const OstResult *result)
{
    return &result->newton;
}

OstGlobal ost_result_unknowns(const OstResult *result)
{
    return result->unknowns;
}

double ost_result_largest_displacement(const OstResult *result, double at[3])
{
    if (at)
        memcpy(at, result->largest_at, sizeof result->largest_at);
    return result->largest_displacement;
}

int ost_result_objection_count(const OstResult *result)
{
    return result->verdict.count;
}

const char *ost_result_objection(const OstResult *result, int number)
{
    return result->verdict.text[number];
}
