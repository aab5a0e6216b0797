/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/reactions/reactions.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "core/together/together.h"

#include <math.h>
#include <string.h>

/* The adjoint problem is solved to this share of the error of u, within bounds: both errors count as a product. */
static const double share_of_error = 0.1, least_share = 1e-4, most_share = 2e-3;

double ost_share_of_adjoint(double relative)
{
    return fmin(fmax(share_of_error * relative, least_share), most_share);
}

void ost_reactions_clear(OstReactions *kept)
{
    for (int k = 0; k < kept->count; k++) {
        OST_FREE(kept->moved[k]);
        ost_adjoint_destroy(&kept->adjoint[k]);
    }
    for (int k = 0; k < kept->mean_count; k++)
        ost_adjoint_destroy(&kept->of_mean[k]);
    kept->count = kept->mean_count = 0;
}

static int any(const OstCase *c)
{
    int some = 0;
    for (int w = 0; w < c->watch_count; w++)
        some |= c->watches[w].kind == OST_WATCH_REACTION;
    return some;
}

/* Is a reaction the work of what is out of balance on some motion? Not the force of a coupling that is moved. */
static int is_work(const OstProblem *problem)
{
    return !problem->free_body && !problem->scene->drive;
}

int ost_reactions_allow_stop(const OstProblem *problem)
{
    return !problem->scene || !any(problem->scene->c) ||
           (is_work(problem) && !problem->supports->links && ost_problem_is_linear(problem) && !problem->pressures);
}

int ost_adjoint_has_no_answer(OstStatus status)
{
    return status == OST_NOT_CONVERGED || status == OST_INVALID_INPUT;
}

int ost_reactions_have_adjoint(const OstProblem *problem)
{
    return problem->scene && any(problem->scene->c) && is_work(problem) &&
           (ost_problem_is_linear(problem) || problem->conservative);
}

/* One watched reaction of an answer. */
typedef struct Search {
    const OstProblem *problem;
    const OstWatch *watch;
    OstInterest interest;
    double *rigid;           /* 3 × owned_nodes: the body's motion that the reaction works on, less the given one */
    const double *imbalance; /* 3 × owned_nodes: internal force less load */
} Search;

/* The rigid motion along the reaction's direction, or about its axis. */
static void find_rigid(const Search *search)
{
    const OstMesh *mesh = search->problem->mesh;
    for (size_t n = 0; n < (size_t)mesh->owned_nodes; n++) {
        double arm[3], motion[3];
        for (size_t i = 0; i < 3; i++)
            arm[i] = mesh->coordinates[3 * n + i] - search->watch->about[i];
        memcpy(motion, search->interest.direction, sizeof motion);
        if (search->watch->of_moment)
            ost_cross3(search->interest.direction, arm, motion);
        for (size_t i = 0; i < 3; i++)
            search->rigid[3 * n + i] = motion[i] - search->interest.moved[3 * n + i];
    }
}

/* What a rigid face's point does by the rigid motion, and its rotation, in its carriers' unknowns; 0 where the face has
 * the given motion. */
static void move_carriers(const Search *search, double *of_leaders)
{
    const OstMesh *mesh = search->problem->mesh;
    const OstLinks *links = search->problem->supports->links;
    const double *direction = search->interest.direction;
    for (int f = 0; f < links->face_count; f++)
        for (int k = 0; k < 2; k++) {
            const OstRigidFace *face = &links->face[f];
            const OstGlobal n = face->carrier[k] - mesh->first_node;
            double motion[3] = {0.0}, arm[3];
            if (face->carrier[k] < 0 || n < 0 || n >= mesh->owned_nodes)
                continue;
            for (int i = 0; i < 3; i++)
                arm[i] = face->point[i] - search->watch->about[i];
            if (search->watch->of_moment && k == 0)
                ost_cross3(direction, arm, motion);
            for (int i = 0; i < 3 && search->watch->of_moment == (k == 1); i++)
                motion[i] = direction[i] * (k == 1 ? face->length : 1.0);
            if (ost_norm3(search->interest.moved + 3 * (size_t)n) > 0.0)
                memset(motion, 0, sizeof motion);
            memcpy(of_leaders + 3 * (size_t)n, motion, sizeof motion);
        }
}

/* How far the motion is from what followers do by their leaders', at the most. */
static OstStatus leave_leaders(const Search *search, double *distance)
{
    const OstMesh *mesh = search->problem->mesh;
    const OstLinks *links = search->problem->supports->links;
    double *of_leaders = NULL, *followed = NULL;
    OstStatus status = OST_NEW(mesh->ctx, &of_leaders, 3 * (size_t)links->slots);
    OST_THEN(OST_NEW(mesh->ctx, &followed, 3 * (size_t)mesh->node_count));
    OST_TRY_DONE(ost_agree(mesh->ctx, status));
    memcpy(of_leaders, search->rigid, 3 * (size_t)mesh->owned_nodes * sizeof *of_leaders);
    move_carriers(search, of_leaders);
    OST_TRY_DONE(ost_links_follow(links, of_leaders, followed));
    for (size_t n = 0; n < (size_t)mesh->owned_nodes; n++) {
        double left[3];
        if (links->of_node[n] < 0)
            continue;
        for (size_t i = 0; i < 3; i++)
            left[i] = search->rigid[3 * n + i] - followed[3 * n + i];
        *distance = fmax(*distance, ost_norm3(left));
    }
done:
    OST_FREE(of_leaders, followed);
    return status;
}

/* Do supports and links allow what the rigid motion is beside the given one? Weights of links are found to rounding. */
static OstStatus is_static(const Search *search, int *yes)
{
    static const double nothing = 1e-12, rounding = 1e-9;
    const OstProblem *problem = search->problem;
    double sizes[3] = {0.0}; /* of what supports forbid, of all, and of what links forbid */
    for (OstLocal node = 0; node < problem->mesh->owned_nodes; node++) {
        const double *motion = search->rigid + 3 * (size_t)node;
        double projector[9], allowed[3];
        ost_supports_get(problem->supports, node, projector, NULL);
        ost_apply3(projector, motion, allowed);
        for (int i = 0; i < 3; i++)
            sizes[0] = fmax(sizes[0], fabs(motion[i] - allowed[i]));
        sizes[1] = fmax(sizes[1], ost_norm3(motion));
    }
    if (problem->supports->links)
        OST_TRY(leave_leaders(search, &sizes[2]));
    OST_TRY(ost_max(problem->ctx, 3, sizes));
    *yes = !problem->supports->spring && sizes[0] <= nothing * sizes[1] && sizes[2] <= rounding * sizes[1];
    return OST_SUCCESS;
}

/* The work of the imbalance on the given motion where no support takes it: the field has no reaction there. */
static double work_beside_supports(const Search *search)
{
    const OstProblem *problem = search->problem;
    const OstLinks *links = problem->supports->links;
    double work = 0.0;
    for (OstLocal node = 0; node < problem->mesh->owned_nodes; node++) {
        double projector[9], free_motion[3];
        if (links && (links->leads[node] || links->of_node[node] >= 0)) /* with what is passed on it has all */
            continue;
        ost_supports_get(problem->supports, node, projector, NULL);
        ost_apply3(projector, search->interest.moved + 3 * (size_t)node, free_motion);
        work += ost_dot3(free_motion, search->imbalance + 3 * (size_t)node);
    }
    return work;
}

/* The work of the imbalance on what is added to the given motion, and on that beside supports. */
static OstStatus work_of(const Search *search, const double *added, double beside, double *work)
{
    *work = beside;
    for (size_t i = 0; i < 3 * (size_t)search->problem->mesh->owned_nodes; i++)
        *work += added[i] * search->imbalance[i];
    return ost_sum(search->problem->ctx, 1, work);
}

/* Do loads act on nodes? */
static OstStatus is_loaded(const OstProblem *problem, double t, const double *u, int *yes)
{
    const size_t count = 3 * (size_t)problem->mesh->owned_nodes;
    double *load = NULL;
    *yes = 0;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &load, count)));
    ost_problem_load(problem, t, u, load);
    for (size_t i = 0; i < count && !*yes; i++)
        *yes = load[i] != 0.0;
    OST_FREE(load);
    return ost_max_ints(problem->ctx, 1, yes);
}

/* Statics alone gives the reaction where the supports allow what the rigid motion is beside the given one: the length
 * of a vector from its three parts. Where rotations are large, the displacement is in the arms of loads' moments, and
 * in pressure that follows. */
static OstStatus find_by_statics(const Search *whole, double t, const double *u, OstWatchedReaction *found)
{
    const int is_length = whole->watch->component == OST_WATCH_LENGTH;
    double before[3] = {0.0}, exact[3] = {0.0};
    const int turns = !ost_problem_is_linear(whole->problem);
    int depends_on_u = turns && whole->problem->follower;
    if (turns && whole->watch->of_moment && !depends_on_u)
        OST_TRY(is_loaded(whole->problem, t, u, &depends_on_u));
    int yes = !depends_on_u;
    for (int axis = 0; axis < 3 && yes; axis++) {
        OstWatch part = *whole->watch;
        Search search = {whole->problem, &part, {0}, whole->rigid, whole->imbalance};
        if (!is_length && axis != part.component)
            continue;
        part.component = axis;
        OstStatus status = ost_interest_create(search.problem, &part, t, u, &search.interest);
        if (status == OST_SUCCESS)
            find_rigid(&search);
        OST_THEN(is_static(&search, &yes));
        OST_THEN(work_of(&search, search.rigid, work_beside_supports(&search), &exact[axis]));
        before[axis] = search.interest.value;
        exact[axis] += before[axis];
        ost_interest_clear(&search.interest);
        OST_TRY(status);
    }
    found->known = yes;
    if (yes)
        found->missing = is_length ? ost_norm3(exact) - ost_norm3(before)
                                   : exact[whole->watch->component] - before[whole->watch->component];
    return OST_SUCCESS;
}

OstStatus ost_reactions_by_statics(const OstProblem *problem, const OstWatch *watch, double t, const double *u,
                                   OstWatchedReaction *found)
{
    Search search = {problem, watch, {0}, NULL, NULL};
    double *imbalance = NULL;
    if (watch->kind != OST_WATCH_REACTION || !is_work(problem))
        return OST_SUCCESS;
    OstStatus status =
        ost_agree(problem->ctx, OST_NEW(problem->ctx, &search.rigid, 3 * (size_t)problem->mesh->owned_nodes));
    OST_THEN(ost_problem_out_of_balance(problem, t, u, &imbalance));
    search.imbalance = imbalance;
    OST_THEN(find_by_statics(&search, t, u, found));
    OST_FREE(search.rigid);
    OST_FREE(imbalance);
    return status;
}

/* A reaction whose adjoint problem is wanted. */
typedef struct Wanted {
    Search *search;
    OstEstimate *estimate;
    OstSolver *solver;
    double t;
    const double *u;
    const double *tet_error;
    double share;        /* its equations' error, of z in the norm of the energy */
    OstAdjoint *adjoint; /* found; NULL: it has no answer */
    int is_kept;         /* by those of other loads; else it is the caller's */
} Wanted;

/* That of an earlier load, if there is one. */
static OstStatus look_up(const OstReactions *kept, Wanted *wanted)
{
    const OstProblem *problem = wanted->search->problem;
    const double *moved = wanted->search->interest.moved;
    for (int k = 0; kept && k < kept->count && !wanted->is_kept; k++) {
        int differs = memcmp(kept->moved[k], moved, 3 * (size_t)problem->mesh->node_count * sizeof *moved) != 0;
        OST_TRY(ost_max_ints(problem->ctx, 1, &differs));
        wanted->is_kept = !differs;
        wanted->adjoint = differs ? NULL : kept->adjoint[k];
    }
    return OST_SUCCESS;
}

/* One without an answer says nothing. */
static OstStatus create(Wanted *wanted)
{
    const OstStatus status = ost_adjoint_create(wanted->estimate, wanted->solver, wanted->t, wanted->u,
                                                &wanted->search->interest, wanted->share, &wanted->adjoint);
    return ost_adjoint_has_no_answer(status) ? OST_SUCCESS : status;
}

/* OstServe: of one list of those that are kept. What the first solves for serves the others, so it is found to what
 * suffices them all. */
static OstStatus find_kept(void *common, int count, void *const *request)
{
    OstReactions *kept = common;
    double share = most_share;
    for (int k = 0; k < count; k++)
        share = fmin(share, ((const Wanted *)request[k])->share);
    for (int k = 0; k < count; k++) {
        Wanted *wanted = request[k];
        wanted->share = share;
        OST_TRY(look_up(kept, wanted));
        if (wanted->is_kept || kept->count == OST_MOST_REACTIONS)
            continue;
        OST_TRY(create(wanted));
        kept->adjoint[kept->count] = wanted->adjoint;
        kept->moved[kept->count++] = wanted->search->interest.moved;
        wanted->search->interest.moved = NULL;
        wanted->is_kept = 1;
    }
    return OST_SUCCESS;
}

static OstStatus find_by_adjoint(Wanted *wanted, OstReactions *kept, OstWatchedReaction *found)
{
    const OstProblem *problem = wanted->search->problem;
    const double beside = work_beside_supports(wanted->search);  /* the given motion may go to `kept` */
    const int may_keep = kept && !wanted->search->interest.load; /* by its motion alone */
    OstStatus status = may_keep ? ost_together(problem->ctx, find_kept, OST_MOST_TOGETHER, kept, wanted) : OST_SUCCESS;
    if (!wanted->is_kept)
        OST_THEN(create(wanted));
    if (wanted->adjoint) {
        if (!problem->pressures) /* a mixed form is solved to its residual */
            OST_THEN(work_of(wanted->search, ost_adjoint_displacement(wanted->adjoint), beside, &found->missing));
        OST_THEN(ost_adjoint_error(wanted->adjoint, wanted->estimate, wanted->t, wanted->u, wanted->tet_error,
                                   &found->error));
        found->error += copysign(wanted->search->interest.doubt, found->error);
        found->known = status == OST_SUCCESS;
    }
    if (!wanted->is_kept)
        ost_adjoint_destroy(&wanted->adjoint);
    return status;
}

OstStatus ost_reactions_find(const OstProblem *problem, OstEstimate *estimate, OstSolver *solver, double t,
                             const double *u, double relative, const double *tet_error, OstReactions *kept,
                             OstWatchedReaction *found)
{
    const OstCase *c = problem->scene->c;
    const double share = ost_share_of_adjoint(relative);
    double *imbalance = NULL, *rigid = NULL;
    if (!ost_reactions_are_watched(problem))
        return OST_SUCCESS;
    OstStatus status = ost_agree(problem->ctx, OST_NEW(problem->ctx, &rigid, 3 * (size_t)problem->mesh->owned_nodes));
    OST_THEN(ost_problem_out_of_balance(problem, t, u, &imbalance));
    OST_THEN(ost_mean_stresses_find(problem, estimate, solver, t, u, imbalance, tet_error, kept, found));
    for (int w = 0; w < c->watch_count && status == OST_SUCCESS && is_work(problem); w++) {
        Search search = {problem, &c->watches[w], {0}, rigid, imbalance};
        if (search.watch->kind != OST_WATCH_REACTION || found[w].known)
            continue;
        status = find_by_statics(&search, t, u, &found[w]);
        if (status != OST_SUCCESS || found[w].known || !ost_reactions_have_adjoint(problem))
            continue;
        status = ost_interest_create(problem, search.watch, t, u, &search.interest);
        Wanted wanted = {&search, estimate, solver, t, u, tet_error, share, NULL, 0};
        OST_THEN(find_by_adjoint(&wanted, kept, &found[w]));
        ost_interest_clear(&search.interest);
    }
    OST_FREE(rigid);
    OST_FREE(imbalance);
    return status;
}
