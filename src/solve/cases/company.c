/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/cases/company.h"

#include "algebra/matrix/vector.h"
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
    struct Member *part[OST_MOST_TOGETHER]; /* solved for before: the load is their sum */
    int parts;                              /* 0: it is none */
    OstLoadSum sum;
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

/* --- loads that are sums of others --- */

/* What is left of a right-hand side, over it, where it is taken for a sum: by the products of all, and itself. */
static const double small_square = 1e-10, small_left = 1e-8;

/* Parts are solved to this share of the error that would do alone, as they add up. */
static const double of_part = 0.2;

/* Could its answer be stopped as those are whose sum it is? */
static int may_be_sum(const Member *member)
{
    return member->analysis.estimate && member->analysis.options.algebraic_fraction > 0.0;
}

/* The products of all right-hand sides, which are made. */
static OstStatus find_products(OstContext *ctx, int count, Member *const *member, double *product)
{
    const size_t unknowns = 3 * (size_t)member[0]->system.matrix->rows;
    for (int k = 0; k < count; k++) {
        OST_TRY(ost_problem_right_hand_side(member[k]->problem, 1.0, member[k]->linear.rhs));
        member[k]->linear.has_rhs = 1;
        for (int j = 0; j <= k; j++)
            product[count * k + j] = ost_dot(unknowns, member[k]->linear.rhs, member[j]->linear.rhs);
    }
    return ost_sum(ctx, count * count, product);
}

/* What is left of a right-hand side without the sum. */
static OstStatus find_left(OstContext *ctx, const Member *member, double *square)
{
    const double *rhs = member->linear.rhs;
    *square = 0.0;
    for (size_t i = 0; i < 3 * (size_t)member->system.matrix->rows; i++) {
        double left = rhs[i];
        for (int k = 0; k < member->parts; k++)
            left -= member->sum.factor[k] * member->part[k]->linear.rhs[i];
        *square += left * left;
    }
    return ost_sum(ctx, 1, square);
}

/* The loads of which no one is a sum of those before, with the Cholesky factor of their products. */
typedef struct Basis {
    int size, number[OST_MOST_TOGETHER];
    Member *member[OST_MOST_TOGETHER];
    double factor[OST_MOST_TOGETHER][OST_MOST_TOGETHER];
} Basis;

/* y = L^-1 times the products of a load with the basis; returns the square of what is left of its own. */
static double reduce(const Basis *basis, const double *product, double own, double *y)
{
    for (int j = 0; j < basis->size; j++) {
        y[j] = product[basis->number[j]];
        for (int i = 0; i < j; i++)
            y[j] -= basis->factor[j][i] * y[i];
        y[j] /= basis->factor[j][j];
        own -= y[j] * y[j];
    }
    return own;
}

/* Is a load that seems to be a sum one to rounding? Then its parts keep what it takes from them. */
static OstStatus take_parts(OstContext *ctx, const Basis *basis, const double *y, double own, Member *member)
{
    double *factor = member->sum.factor, square;
    for (int j = basis->size - 1; j >= 0; j--) { /* L^-T y */
        factor[j] = y[j];
        for (int i = j + 1; i < basis->size; i++)
            factor[j] -= basis->factor[i][j] * factor[i];
        factor[j] /= basis->factor[j][j];
    }
    memcpy(member->part, basis->member, sizeof member->part);
    member->parts = basis->size;
    OST_TRY(find_left(ctx, member, &square));
    if (!(square <= small_left * small_left * own))
        member->parts = 0;
    for (int j = 0; j < member->parts; j++) {
        ost_estimate_keep(member->part[j]->analysis.estimate);
        member->part[j]->analysis.options.algebraic_fraction = of_part * member->analysis.options.algebraic_fraction;
    }
    return OST_SUCCESS;
}

static OstStatus find_sums(OstContext *ctx, int count, Member *const *member)
{
    double product[OST_MOST_TOGETHER * OST_MOST_TOGETHER] = {0.0}, y[OST_MOST_TOGETHER];
    Basis basis = {.size = 0};
    OST_TRY(find_products(ctx, count, member, product));
    for (int k = 0; k < count; k++) {
        const double own = product[count * k + k];
        if (!(own > 0.0) || !may_be_sum(member[k]))
            continue;
        const double left = reduce(&basis, product + (size_t)count * (size_t)k, own, y);
        if (left > small_square * own) {
            memcpy(basis.factor[basis.size], y, (size_t)basis.size * sizeof *y);
            basis.factor[basis.size][basis.size] = sqrt(left);
            basis.number[basis.size] = k;
            basis.member[basis.size++] = member[k];
        } else
            OST_TRY(take_parts(ctx, &basis, y, own, member[k]));
    }
    return OST_SUCCESS;
}

/* The parts must have come through, and have stopped at a known error. */
static void take_sum(Member *member)
{
    OstEstimate *estimate[OST_MOST_TOGETHER];
    int known = 1;
    member->sum.count = member->parts;
    for (int k = 0; k < member->parts; k++) {
        const OstResult *result = member->part[k]->companion->result;
        member->sum.of[k] = &member->part[k]->analysis;
        member->sum.result[k] = result;
        estimate[k] = member->part[k]->analysis.estimate;
        known &= result && result->solve.stopped && result->solve.algebraic_error > 0.0;
    }
    if (!known)
        return;
    for (int k = 0; k < member->parts; k++)
        ost_solver_learn(member->linear.stiffness.solver, member->part[k]->linear.stiffness.solver);
    ost_estimate_add_up(member->analysis.estimate, member->parts, estimate, member->sum.factor);
    member->analysis.sum = &member->sum;
}

static void solve(void *data, int number)
{
    Member *member = ((Member **)data)[number];
    OstCompanion *companion = member->companion;
    if (ost_analysis_solve(&member->analysis, companion->fields, &companion->result) != OST_SUCCESS)
        ost_result_destroy(&companion->result);
}

/* First those whose loads are no sums of others. */
static OstStatus solve_all(OstContext *ctx, int count, Member *const *member)
{
    Member *turn[OST_MOST_TOGETHER];
    OstStatus status = find_sums(ctx, count, member);
    for (int sums = 0; sums < 2 && status == OST_SUCCESS; sums++) {
        int in_turn = 0;
        for (int k = 0; k < count; k++)
            if ((member[k]->parts > 0) == sums)
                turn[in_turn++] = member[k];
        for (int k = 0; k < in_turn && sums; k++)
            take_sum(turn[k]);
        if (in_turn > 0)
            status = ost_together_run(ctx, in_turn, solve, turn);
    }
    return status;
}

OstStatus ost_company_solve(OstAnalysis *analysis, int count, OstCompanion *companion)
{
    Member *member = NULL, *joined[OST_MOST_TOGETHER];
    int joining = 0;
    OstStatus status = ost_agree(analysis->ctx, OST_NEW(analysis->ctx, &member, count));
    for (int k = 0; k < count && status == OST_SUCCESS; k++) {
        member[joining].companion = &companion[k];
        if (join(analysis, &member[joining]) == OST_SUCCESS) {
            joined[joining] = &member[joining];
            joining++;
        } else { /* its own turn will tell why */
            release(&member[joining]);
            memset(&member[joining], 0, sizeof *member);
        }
    }
    if (joining > 0)
        OST_THEN(solve_all(analysis->ctx, joining, joined));
    for (int k = 0; k < joining; k++)
        release(&member[k]);
    OST_FREE(member);
    return status;
}
