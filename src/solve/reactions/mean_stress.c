/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/plan.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/together/together.h"
#include "solve/reactions/reactions.h"

#include <math.h>
#include <string.h>

/* The adjoint problem's equations, in the norm of the energy: of an error two digits are enough. */
static const double share_of_adjoint = 1e-3;

/* Where moduli differ far, few steps find an error badly whose energy is small in the stiff part, or along the stiff
 * direction: of an inclusion 1000 times stiffer mean stresses were said to be off by ten times as much as they were, or
 * a tenth, and by other numbers on two ranks than on one. */
static int is_uneven(const OstProblem *problem)
{
    double most = 0.0, least = INFINITY;
    for (int r = 0; r < problem->field->region_count; r++)
        for (int k = 0; k < 3; k++) {
            const double modulus = problem->field->material[r].constants.youngs_modulus[k];
            most = fmax(most, modulus);
            least = fmin(least, modulus);
        }
    return most >= OST_UNEVEN_MODULI * least;
}

static int have_adjoint(const OstProblem *problem)
{
    return problem->scene && ost_problem_is_linear(problem) && (problem->pressures || is_uneven(problem));
}

int ost_reactions_are_watched(const OstProblem *problem)
{
    int any = 0;
    for (int w = 0; problem->scene && w < problem->scene->c->watch_count; w++) {
        const OstWatch *watch = &problem->scene->c->watches[w];
        any |= watch->kind == OST_WATCH_REACTION || (ost_watch_is_linear_mean(watch) && have_adjoint(problem));
    }
    return any;
}

/* A mean whose adjoint problem is wanted. */
typedef struct Wanted {
    const OstProblem *problem;
    OstEstimate *estimate;
    OstSolver *solver;
    double t;
    const double *u;
    const OstWatch *watch;
    OstAdjoint *adjoint; /* found; NULL: it has no answer */
    int is_kept;         /* by those of other loads; else it is the caller's */
    const double *tet_error;
} Wanted;

/* One without an answer says nothing. */
static OstStatus create(Wanted *wanted)
{
    OstInterest interest;
    const double share = wanted->problem->pressures ? 0.0 : share_of_adjoint;
    OstStatus status = ost_interest_create(wanted->problem, wanted->watch, wanted->t, wanted->u, &interest);
    OST_THEN(
        ost_adjoint_create(wanted->estimate, wanted->solver, wanted->t, wanted->u, &interest, share, &wanted->adjoint));
    ost_interest_clear(&interest);
    return ost_adjoint_has_no_answer(status) ? OST_SUCCESS : status;
}

/* OstServe: of one list of those that are kept. */
static OstStatus find_kept(void *common, int count, void *const *request)
{
    OstReactions *kept = common;
    for (int n = 0; n < count; n++) {
        Wanted *wanted = request[n];
        for (int k = 0; k < kept->mean_count && !wanted->is_kept; k++)
            if (kept->mean[k]->component == wanted->watch->component &&
                strcmp(kept->mean[k]->region, wanted->watch->region) == 0) {
                wanted->adjoint = kept->of_mean[k];
                wanted->is_kept = 1;
            }
        if (wanted->is_kept || kept->mean_count == OST_MOST_REACTIONS)
            continue;
        OST_TRY(create(wanted));
        kept->mean[kept->mean_count] = wanted->watch;
        kept->of_mean[kept->mean_count++] = wanted->adjoint;
        wanted->is_kept = 1;
    }
    return OST_SUCCESS;
}

/* What the solve left out of balance works on z as on the mean: of forces, and of a mixed form's `volume`, or NULL. */
static OstStatus find_missing(const Wanted *wanted, const double *imbalance, const double *volume, double *missing)
{
    const double *z = ost_adjoint_displacement(wanted->adjoint), *p = ost_adjoint_pressure(wanted->adjoint);
    *missing = 0.0;
    for (size_t i = 0; i < 3 * (size_t)wanted->problem->mesh->owned_nodes; i++)
        *missing -= z[i] * imbalance[i];
    for (OstLocal i = 0; volume && i < wanted->problem->pressures->owned; i++)
        *missing -= p[i] * volume[i];
    return ost_sum(wanted->problem->ctx, 1, missing);
}

static OstStatus find_mean(Wanted *wanted, const double *imbalance, const double *volume, OstReactions *kept,
                           OstWatchedReaction *found)
{
    OstContext *ctx = wanted->problem->ctx;
    OstStatus status = kept ? ost_together(ctx, find_kept, OST_MOST_TOGETHER, kept, wanted) : OST_SUCCESS;
    if (!wanted->is_kept)
        OST_THEN(create(wanted));
    if (wanted->adjoint) {
        OST_THEN(find_missing(wanted, imbalance, volume, &found->missing));
        OST_THEN(ost_adjoint_error(wanted->adjoint, wanted->estimate, wanted->t, wanted->u, wanted->tet_error,
                                   &found->error));
        found->error = -found->error;
        found->known = status == OST_SUCCESS;
    }
    if (!wanted->is_kept)
        ost_adjoint_destroy(&wanted->adjoint);
    return status;
}

/* What u leaves of the second equation of a mixed form; NULL without one. */
static OstStatus find_volume(const OstProblem *problem, double t, const double *u, double **volume)
{
    *volume = NULL;
    if (!problem->pressures)
        return OST_SUCCESS;
    OstStatus status = OST_NEW(problem->ctx, volume, problem->pressures->owned);
    OST_THEN(ost_pressure_volume(problem->pressures, problem->field, OST_FORMULATION_LINEAR,
                                 ost_problem_eigen_share(problem, t), u, *volume, NULL));
    return ost_agree(problem->ctx, status);
}

OstStatus ost_mean_stresses_find(const OstProblem *problem, OstEstimate *estimate, OstSolver *solver, double t,
                                 const double *u, const double *imbalance, const double *tet_error, OstReactions *kept,
                                 OstWatchedReaction *found)
{
    const OstCase *c = problem->scene->c;
    double *volume = NULL;
    if (!have_adjoint(problem))
        return OST_SUCCESS;
    OstStatus status = find_volume(problem, t, u, &volume);
    for (int w = 0; w < c->watch_count && status == OST_SUCCESS; w++) {
        Wanted wanted = {problem, estimate, solver, t, u, &c->watches[w], NULL, 0, tet_error};
        if (ost_watch_is_linear_mean(wanted.watch))
            status = find_mean(&wanted, imbalance, volume, kept, &found[w]);
    }
    OST_FREE(volume);
    return status;
}
