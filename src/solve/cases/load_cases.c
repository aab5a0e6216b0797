/* SPDX-License-Identifier: BSD-3-Clause */
#include "orthostat/load_cases.h"

#include "algebra/matrix/columns.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/progress.h"
#include "core/together/together.h"
#include "material/field_data.h"
#include "problem/cases/load_case.h"
#include "problem/scene_data.h"
#include "solve/cases/company.h"

struct OstLoadCases {
    OstContext *ctx;
    int count, left, next;
    OstScene **scene; /* of each */
    int *group;       /* the first case that has the same stiffness */
    int *is_done;
    int made_for; /* the group of problem and analysis; -1: there are none */
    OstProblem *problem;
    OstAnalysis *analysis;
    int alone;           /* has none of a company come through? */
    OstCompanion *ahead; /* of each: what it was solved for in the company of another, if it was */
};

/* Cases of one stiffness: their supports are the same on every rank. */
static OstStatus find_groups(OstLoadCases *cases)
{
    uint64_t *hash = NULL;
    OstStatus status = ost_agree(cases->ctx, OST_NEW(cases->ctx, &hash, cases->count));
    for (int k = 0; k < cases->count && status == OST_SUCCESS; k++) {
        status = ost_scene_support_hash(cases->scene[k], &hash[k]);
        cases->group[k] = k;
        for (int j = 0; j < k && cases->group[k] == k && status == OST_SUCCESS; j++) {
            int differs = hash[j] != hash[k];
            if (cases->group[j] != j)
                continue;
            status = ost_max_ints(cases->ctx, 1, &differs);
            cases->group[k] = differs ? k : j;
        }
    }
    OST_FREE(hash);
    return status;
}

static OstStatus fill(const OstScene *scene, OstLoadCases *cases)
{
    OstContext *ctx = cases->ctx;
    OstStatus status = OST_NEW(ctx, &cases->scene, cases->count);
    OST_THEN(OST_NEW(ctx, &cases->group, cases->count));
    OST_THEN(OST_NEW(ctx, &cases->is_done, cases->count));
    OST_THEN(OST_NEW(ctx, &cases->ahead, cases->count));
    OST_TRY(ost_agree(ctx, status));
    for (int k = 0; k < cases->count; k++)
        OST_TRY(ost_scene_load_case(scene, k, &cases->scene[k]));
    return find_groups(cases);
}

OstStatus ost_load_cases_create(const OstScene *scene, OstLoadCases **cases)
{
    OST_TRY(ost_agree(scene->ctx, OST_NEW(scene->ctx, cases, 1)));
    const int count = scene->c->load_case_count;
    **cases = (OstLoadCases){.ctx = scene->ctx, .count = count, .left = count, .made_for = -1};
    const OstStatus status = fill(scene, *cases);
    if (status != OST_SUCCESS)
        ost_load_cases_destroy(cases);
    return status;
}

static void release_analysis(OstLoadCases *cases)
{
    if (cases->analysis)
        ost_analysis_destroy(&cases->analysis);
    ost_problem_destroy(&cases->problem);
    cases->made_for = -1;
}

void ost_load_cases_destroy(OstLoadCases **cases)
{
    if (!*cases)
        return;
    release_analysis(*cases);
    for (int k = 0; (*cases)->ahead && k < (*cases)->count; k++)
        ost_result_destroy(&(*cases)->ahead[k].result);
    for (int k = 0; (*cases)->scene && k < (*cases)->count; k++)
        ost_scene_destroy(&(*cases)->scene[k]);
    OST_FREE((*cases)->ahead);
    OST_FREE((*cases)->scene);
    OST_FREE((*cases)->group);
    OST_FREE((*cases)->is_done);
    OST_FREE(*cases);
}

int ost_load_cases_count(const OstLoadCases *cases)
{
    return cases->count;
}

int ost_load_cases_left(const OstLoadCases *cases)
{
    return cases->left;
}

int ost_load_cases_stiffnesses(const OstLoadCases *cases)
{
    int groups = 0;
    for (int k = 0; k < cases->count; k++)
        groups += cases->group[k] == k;
    return groups;
}

int ost_load_cases_next(const OstLoadCases *cases)
{
    return cases->next;
}

const OstScene *ost_load_cases_scene(const OstLoadCases *cases, int number)
{
    return cases->scene[number];
}

/* Large rotations by the classical formulation have left the mixed form, which this case begins with. */
static int has_left_mixed(const OstLoadCases *cases)
{
    return cases->problem && ost_field_is_mixed(cases->scene[cases->next]->field) &&
           !ost_field_is_mixed(cases->problem->field);
}

/* The problem of the next case: that of the one before, with another loading, where the stiffness is the same. */
static OstStatus make_problem(OstLoadCases *cases)
{
    const OstScene *scene = cases->scene[cases->next];
    OstProblem *problem = NULL;
    if (cases->made_for != cases->group[cases->next] || has_left_mixed(cases))
        release_analysis(cases);
    OST_TRY(ost_scene_problem(scene, &problem));
    if (cases->analysis) {
        ost_problem_take_loading(cases->problem, problem);
        ost_problem_destroy(&problem);
        cases->analysis->options.algebraic_fraction = scene->c->solver.algebraic_fraction; /* each has its own watch */
        return ost_analysis_take_loading(cases->analysis);
    }
    cases->problem = problem;
    cases->made_for = cases->group[cases->next];
    OST_TRY(ost_analysis_create(problem, &scene->c->solver, &cases->analysis));
    cases->analysis->serves_several = 1;
    return OST_SUCCESS;
}

static void go_on(OstLoadCases *cases)
{
    const int done = cases->next;
    cases->is_done[done] = 1;
    cases->left--;
    for (int same_group = 1; same_group >= 0 && cases->next == done; same_group--)
        for (int k = 0; k < cases->count && cases->next == done; k++)
            if (!cases->is_done[k] && (!same_group || cases->group[k] == cases->group[done]))
                cases->next = k;
}

/* Could it be solved with the next one? */
static int is_alike(const OstLoadCases *cases, int k)
{
    return !cases->is_done[k] && cases->group[k] == cases->group[cases->next] && !cases->ahead[k].is_tried;
}

/* The next case and those that follow it with the same stiffness, each with the fields that are to be expected: its
 * own, unless the next one is asked for others than those. */
static int choose_company(const OstLoadCases *cases, int most, unsigned fields, OstCompanion *companion, int *number)
{
    const int own = fields == ost_scene_result_fields(cases->scene[cases->next]);
    int count = 0;
    for (int k = cases->next; k < cases->count && count < most; k++) {
        if (!is_alike(cases, k))
            continue;
        number[count] = k;
        companion[count++] = (OstCompanion){
            .scene = cases->scene[k], .fields = own ? ost_scene_result_fields(cases->scene[k]) : fields, .is_tried = 1};
    }
    return count;
}

/* Solves the next case with others, where that pays. Those that do not come through are solved alone in their turn: so
 * no failure here is the case's. */
static OstStatus solve_in_company(OstLoadCases *cases, int most, unsigned fields)
{
    OstCompanion companion[OST_MOST_TOGETHER];
    int number[OST_MOST_TOGETHER];
    const int count = choose_company(cases, most, fields, companion, number);
    if (count < OST_FEWEST_COLUMNS)
        return OST_SUCCESS;
    OST_TRY(ost_company_solve(cases->analysis, count, companion));
    cases->alone = 1;
    for (int k = 0; k < count; k++) {
        cases->ahead[number[k]] = companion[k];
        cases->alone &= !companion[k].result;
    }
    return OST_SUCCESS;
}

/* Solves the next case ahead, with others, where that pays. */
static OstStatus solve_ahead(OstLoadCases *cases, unsigned fields)
{
    int most, count = 0;
    OST_TRY(ost_company_most(cases->ctx, &most));
    for (int k = cases->next; k < cases->count && count < most; k++)
        count += is_alike(cases, k);
    ost_progress_batch(cases->ctx, count);
    OstStatus status = make_problem(cases);
    OST_THEN(ost_analysis_make_common(cases->analysis, fields));
    if (status == OST_SUCCESS && ost_company_suits(cases->analysis))
        status = solve_in_company(cases, most, fields);
    if (!cases->ahead[cases->next].result)
        ost_progress_batch(cases->ctx, 0);
    return status;
}

OstStatus ost_load_cases_solve(OstLoadCases *cases, unsigned fields, OstResult **result)
{
    OstCompanion *ahead = &cases->ahead[cases->next];
    OstStatus status = OST_SUCCESS;
    *result = NULL;
    if (!ahead->is_tried && !cases->alone && cases->left >= OST_FEWEST_COLUMNS)
        status = solve_ahead(cases, fields);
    if (ahead->result && ahead->fields == fields) {
        *result = ahead->result;
        ahead->result = NULL;
    } else {
        OST_THEN(make_problem(cases));
        OST_THEN(ost_analysis_solve(cases->analysis, fields, result));
    }
    if (status != OST_SUCCESS)
        release_analysis(cases); /* what a failed solve leaves is not built upon */
    go_on(cases);
    return status;
}
