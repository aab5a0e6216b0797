/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/cases/company.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"
#include "core/parallel/reduce.h"
#include "core/together/together.h"
#include "problem/scene_data.h"
#include "solve/distributing/distributing.h"
#include "solve/linear.h"

#include <math.h>
#include <string.h>

/* One more takes so much of what the body takes by itself, at the most; so much of the free memory may be used. */
static const double share_of_each = 0.6, share_of_free = 0.5;

typedef struct Member {
    OstCompanion *companion;
    OstProblem *problem; /* with the common stiffness */
    OstSystem system;    /* the common one, with this problem's supports */
    OstAnalysis analysis;
    OstLinear linear;
} Member;

/* Does the loading need no solve of its own? */
static int suits(const OstProblem *problem)
{
    return !problem->pressures && !problem->supports->links && !problem->follower && !ost_distributing_any(problem);
}

int ost_company_suits(const OstAnalysis *analysis)
{
    const OstLinear *linear = analysis->work;
    return linear->stiffness.solver && ost_solver_shares(linear->stiffness.solver) && suits(analysis->problem);
}

OstStatus ost_company_most(OstContext *ctx, int *most)
{
    double bytes = (double)ost_ledger_bytes(ctx), free_bytes;
    OST_TRY(ost_sum(ctx, 1, &bytes));
    OST_TRY(ost_memory_free(ctx, &free_bytes));
    *most = (int)fmin(OST_MOST_TOGETHER, share_of_free * free_bytes / (share_of_each * fmax(bytes, 1.0)));
    return OST_SUCCESS;
}

static void release(Member *member)
{
    ost_solver_destroy(&member->linear.stiffness.solver);
    ost_estimate_destroy(&member->analysis.estimate);
    OST_FREE(member->linear.rhs);
    OST_FREE(member->linear.v);
    if (member->problem)
        member->problem->system = NULL;
    ost_problem_destroy(&member->problem);
}

static OstStatus share_estimate(const OstAnalysis *analysis, Member *member)
{
    member->analysis.estimate = NULL;
    if (!analysis->estimate || !(member->companion->fields >> OST_FIELD_ERROR & 1U))
        return OST_SUCCESS;
    ost_ledger_enter(analysis->ctx, OST_EFFECT_ERROR_ESTIMATE);
    const OstStatus status = ost_estimate_share(analysis->estimate, member->problem, &member->analysis.estimate);
    ost_ledger_leave(analysis->ctx);
    return status;
}

static OstStatus join(OstAnalysis *analysis, Member *member)
{
    OstContext *ctx = analysis->ctx;
    const OstProblem *common = analysis->problem;
    const OstLinear *linear = analysis->work;
    const size_t unknowns = 3 * (size_t)common->system->matrix->rows;
    OST_TRY(ost_scene_problem(member->companion->scene, &member->problem));
    if (!suits(member->problem))
        return OST_INVALID_INPUT;
    member->system = *common->system;
    member->system.supports = member->problem->supports;
    member->problem->system = &member->system;
    member->problem->filled = 1;
    member->linear = *linear;
    member->linear.rhs = member->linear.v = NULL;
    member->linear.stiffness.problem = member->problem;
    member->linear.stiffness.solver = NULL;
    member->analysis = *analysis;
    member->analysis.problem = member->problem;
    member->analysis.reactions = (OstReactions){0};
    member->analysis.work = &member->linear;
    member->analysis.options.algebraic_fraction = member->companion->scene->c->solver.algebraic_fraction;
    member->analysis.company = analysis;
    OST_TRY(share_estimate(analysis, member));
    OstStatus status = ost_solver_share(linear->stiffness.solver, &member->linear.stiffness.solver);
    OST_THEN(OST_NEW(ctx, &member->linear.rhs, unknowns));
    OST_THEN(OST_NEW(ctx, &member->linear.v, unknowns));
    return ost_agree(ctx, status);
}

static void solve(void *data, int number)
{
    Member *member = (Member *)data + number;
    OstCompanion *companion = member->companion;
    if (ost_analysis_solve(&member->analysis, companion->fields, &companion->result) != OST_SUCCESS)
        ost_result_destroy(&companion->result);
}

OstStatus ost_company_solve(OstAnalysis *analysis, int count, OstCompanion *companion)
{
    Member *member = NULL;
    int joined = 0;
    OstStatus status = ost_agree(analysis->ctx, OST_NEW(analysis->ctx, &member, count));
    for (int k = 0; k < count && status == OST_SUCCESS; k++) {
        member[joined].companion = &companion[k];
        if (join(analysis, &member[joined]) == OST_SUCCESS)
            joined++;
        else { /* its own turn will tell why */
            release(&member[joined]);
            memset(&member[joined], 0, sizeof *member);
        }
    }
    if (joined > 0)
        OST_THEN(ost_together_run(analysis->ctx, joined, solve, member));
    for (int k = 0; k < joined; k++)
        release(&member[k]);
    OST_FREE(member);
    return status;
}
