/* SPDX-License-Identifier: BSD-3-Clause */
#include "guard/volume.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"

#include <math.h>

typedef struct Work {
    double *left, *mass; /* owned pressures: what is left of the equation, and the share of the mass, lumped */
    double *worth;       /* count */
    double *of_tets;     /* 4 × tet_count */
    double *zero, *force;
    double *at_leaders; /* 3 × slots of the links, or NULL */
} Work;

static void release(Work *work)
{
    OST_FREE(work->left);
    OST_FREE(work->mass);
    OST_FREE(work->worth);
    OST_FREE(work->of_tets);
    OST_FREE(work->zero);
    OST_FREE(work->force);
    OST_FREE(work->at_leaders);
}

static OstStatus make_room(const OstProblem *problem, Work *work)
{
    OstContext *ctx = problem->ctx;
    const OstPressureSpace *space = problem->pressures;
    OstStatus status = OST_NEW(ctx, &work->left, space->owned);
    OST_THEN(OST_NEW(ctx, &work->mass, space->owned));
    OST_THEN(OST_NEW(ctx, &work->worth, space->count));
    OST_THEN(OST_NEW(ctx, &work->of_tets, 4 * (size_t)space->mesh->tet_count));
    OST_THEN(OST_NEW(ctx, &work->zero, 3 * (size_t)space->mesh->node_count));
    OST_THEN(OST_NEW(ctx, &work->force, 3 * (size_t)space->mesh->owned_nodes));
    return ost_agree(ctx, status);
}

/* The absolute work on the answer's pressures. */
static double find_work(const OstProblem *problem, const Work *work)
{
    const OstPressureSpace *space = problem->pressures;
    double sum = 0.0;
    for (size_t i = 0; i < 4 * (size_t)space->mesh->tet_count; i++) {
        const OstLocal k = space->of_tet[i];
        if (k >= 0 && k < space->owned)
            work->worth[k] = problem->field->pressure[i];
    }
    for (OstLocal k = 0; k < space->owned; k++)
        sum += fabs(work->worth[k] * work->left[k]);
    return sum;
}

/* Of a node's force what no support takes, with that of its followers, squared. */
static double free_square(const OstSupports *supports, const Work *work, OstLocal node)
{
    double projector[9], left[3] = {0.0};
    if (!ost_link_of(supports->links, node)) {
        ost_supports_get(supports, node, projector, NULL);
        ost_apply3(projector, work->force + 3 * (size_t)node, left);
    }
    for (int i = 0; i < 3 && work->at_leaders; i++)
        left[i] += work->at_leaders[3 * (size_t)node + (size_t)i];
    return ost_dot3(left, left);
}

/* The forces of the pressure that would close the gap. */
static OstStatus find_force(const OstProblem *problem, Work *work, double *square)
{
    const OstPressureSpace *space = problem->pressures;
    OstMaterialField field;
    OstProblem state;
    for (OstLocal k = 0; k < space->owned; k++)
        work->worth[k] = work->left[k] / (work->mass[k] * ost_field_giving_way(problem->field, space->region[k]));
    OST_TRY(ost_pressure_complete(space, work->worth));
    ost_pressure_of_tets(space, work->worth, work->of_tets);
    ost_problem_at_pressure(problem, work->of_tets, &field, &state);
    OST_TRY(ost_agree(problem->ctx, ost_internal_force(space->mesh, &field, 0.0, work->zero, work->force, NULL)));
    if (problem->supports->links) {
        OST_TRY(ost_agree(problem->ctx,
                          OST_NEW(problem->ctx, &work->at_leaders, 3 * (size_t)problem->supports->links->slots)));
        OST_TRY(ost_links_gather(problem->supports->links, work->force, work->at_leaders));
    }
    for (OstLocal node = 0; node < space->mesh->owned_nodes; node++)
        *square += free_square(problem->supports, work, node);
    return OST_SUCCESS;
}

OstStatus ost_guard_volume_error(const OstProblem *problem, const OstResult *result, OstVolumeError *error)
{
    Work work = {NULL};
    double sums[2] = {0.0};
    OstStatus status;
    *error = (OstVolumeError){0};
    if (!problem->pressures || !problem->field->pressure)
        return OST_SUCCESS;
    OST_TRY_DONE(make_room(problem, &work));
    OST_TRY_DONE(ost_agree(problem->ctx, ost_pressure_volume(problem->pressures, problem->field, result->formulation,
                                                             result->t, result->displacement, work.left, work.mass)));
    sums[1] = find_work(problem, &work);
    OST_TRY_DONE(find_force(problem, &work, &sums[0]));
    OST_TRY_DONE(ost_sum(problem->ctx, 2, sums));
    *error = (OstVolumeError){.force = sums[0], .work = sums[1]};
done:
    release(&work);
    return status;
}
