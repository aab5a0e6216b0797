/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "fields/stress_measure.h"
#include "solve/reactions/reactions.h"

#include <string.h>

/* A mean over a region, of a measure that is linear in the stress. */
static int is_mean(const OstWatch *watch)
{
    return watch->kind == OST_WATCH_STRESS && watch->region && watch->take == OST_TAKE_MEAN &&
           (watch->component <= OST_STRESS_MEASURE_31 || watch->component == OST_STRESS_MEASURE_PRESSURE);
}

static int have_adjoint(const OstProblem *problem)
{
    return problem->scene && problem->pressures && ost_problem_is_linear(problem);
}

int ost_reactions_are_watched(const OstProblem *problem)
{
    int any = 0;
    for (int w = 0; problem->scene && w < problem->scene->c->watch_count; w++) {
        const OstWatch *watch = &problem->scene->c->watches[w];
        any |= watch->kind == OST_WATCH_REACTION || (is_mean(watch) && have_adjoint(problem));
    }
    return any;
}

/* That of an earlier load. */
static OstAdjoint *look_up(const OstReactions *kept, const OstWatch *watch)
{
    for (int k = 0; kept && k < kept->mean_count; k++)
        if (kept->mean[k]->component == watch->component && strcmp(kept->mean[k]->region, watch->region) == 0)
            return kept->of_mean[k];
    return NULL;
}

/* One without an answer says nothing. */
static OstStatus create(const OstProblem *problem, OstEstimate *estimate, OstSolver *solver, double t, const double *u,
                        const OstWatch *watch, OstAdjoint **adjoint)
{
    OstInterest interest;
    OstStatus status = ost_interest_create(problem, watch, t, u, &interest);
    OST_THEN(ost_adjoint_create(estimate, solver, t, u, &interest, 0.0, adjoint));
    ost_interest_clear(&interest);
    return status == OST_NOT_CONVERGED ? OST_SUCCESS : status;
}

OstStatus ost_mean_stresses_find(const OstProblem *problem, OstEstimate *estimate, OstSolver *solver, double t,
                                 const double *u, OstReactions *kept, OstWatchedReaction *found)
{
    const OstCase *c = problem->scene->c;
    OstStatus status = OST_SUCCESS;
    for (int w = 0; w < c->watch_count && have_adjoint(problem) && status == OST_SUCCESS; w++) {
        if (!is_mean(&c->watches[w]))
            continue;
        OstAdjoint *adjoint = look_up(kept, &c->watches[w]), *own = NULL;
        if (!adjoint)
            status = create(problem, estimate, solver, t, u, &c->watches[w], &own);
        adjoint = adjoint ? adjoint : own;
        if (adjoint)
            OST_THEN(ost_adjoint_error(adjoint, estimate, t, u, NULL, &found[w].error));
        found[w].error = -found[w].error;
        found[w].known = adjoint && status == OST_SUCCESS;
        if (own && kept && kept->mean_count < OST_MOST_REACTIONS) {
            kept->mean[kept->mean_count] = &c->watches[w];
            kept->of_mean[kept->mean_count++] = own;
        } else
            ost_adjoint_destroy(&own);
    }
    return status;
}
