/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/estimate.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "solve/linear.h"

#include <math.h>
#include <string.h>

/* Where the error is: the region with the largest share of its square, and the tet. `share` has a number for each
 * region; tet_error still has squares. */
static OstStatus find_worst(const OstResult *result, double *share, OstAnswerError *answer)
{
    OstContext *ctx = result->ctx;
    const OstMesh *mesh = result->mesh;
    const int regions = mesh->regions.count;
    struct {
        double value;
        int rank;
    } most = {-1.0, ost_rank(ctx)};
    OstLocal worst = -1;
    for (OstLocal tet = 0; tet < mesh->owned_tets; tet++) {
        share[mesh->tet_region[tet]] += result->tet_error[tet];
        if (!(result->tet_error[tet] > most.value))
            continue;
        most.value = result->tet_error[tet];
        worst = tet;
    }
    OST_TRY(ost_sum(ctx, regions, share));
    for (int r = 1; r < regions; r++)
        if (share[r] > share[answer->region])
            answer->region = r;
    const double square = answer->energy_norm * answer->energy_norm;
    answer->region_share = square > 0.0 ? share[answer->region] / square : 0.0;
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE_INT, MPI_MAXLOC, ost_comm(ctx))));
    for (int a = 0; a < 4 && worst >= 0; a++)
        for (int i = 0; i < 3; i++)
            answer->place[i] += 0.25 * mesh->coordinates[3 * (size_t)ost_mesh_nodes_of(mesh, worst)[a] + (size_t)i];
    return OST_MPI(ctx, MPI_Bcast(answer->place, 3, MPI_DOUBLE, most.rank, ost_comm(ctx)));
}

OstStatus ost_result_allow_error(const OstProblem *problem, OstResult *result)
{
    const OstMesh *mesh = result->mesh;
    const int is_watched = problem->scene && problem->scene->c->watch_count > 0;
    OstStatus status = OST_SUCCESS;
    if (!result->tet_error)
        status = OST_NEW(result->ctx, &result->tet_error, mesh->owned_tets);
    if (is_watched && !result->surplus)
        OST_THEN(OST_NEW(result->ctx, &result->surplus, 3 * (size_t)mesh->owned_nodes));
    return ost_agree(result->ctx, status);
}

static OstStatus estimate_tets(const OstAnalysis *analysis, OstEstimate *estimate, double t, OstResult *result)
{
    OstContext *ctx = result->ctx;
    const OstLinear *linear = analysis->work;
    double *share = NULL;
    OstStatus status = ost_result_allow_error(analysis->problem, result);
    OST_THEN(OST_NEW(ctx, &share, result->mesh->regions.count));
    OST_TRY_DONE(ost_agree(ctx, status));
    if (!result->answer.known) /* the solve may have been stopped by it */
        OST_TRY_DONE(ost_estimate_find(estimate, linear->stiffness.solver, t, result->displacement, &result->answer,
                                       result->tet_error, result->surplus));
    if (result->answer.known)
        OST_TRY_DONE(find_worst(result, share, &result->answer));
    if (!result->answer.known) {
        OST_FREE(result->tet_error);
        OST_FREE(result->surplus);
    }
    for (OstLocal tet = 0; tet < result->mesh->owned_tets && result->answer.known; tet++)
        result->tet_error[tet] = sqrt(fmax(result->tet_error[tet], 0.0));
done:
    OST_FREE(share);
    return status;
}

OstStatus ost_analysis_estimate(const OstAnalysis *analysis, double t, OstResult *result)
{
    OstEstimate *estimate = NULL;
    OstProblem state = *analysis->problem; /* with the answer's pressure, if it has one */
    state.field = result->field;
    ost_ledger_enter(analysis->ctx, OST_EFFECT_ERROR_ESTIMATE);
    OstStatus status = result->answer.known ? OST_SUCCESS : ost_estimate_create(&state, &estimate);
    OST_THEN(estimate_tets(analysis, estimate, t, result));
    ost_estimate_destroy(&estimate);
    ost_ledger_leave(analysis->ctx);
    return status;
}
