/* SPDX-License-Identifier: BSD-3-Clause */
#include "solve/distributing/distributing.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "problem/boundary_conditions.h"

#include <string.h>

extern void dposv_(const char *uplo, const int *n, const int *columns, double *a, const int *leading, double *b,
                   const int *leading_b, int *info, size_t length);

/* One component of a motion that is given. */
typedef struct Motion {
    int load, component;
    double given;
    double *force; /* 3 × node_count: of a unit of its force or moment */
    double *v;     /* of the rows: K^-1 of that */
    double *p;     /* and its pressures, of a mixed form; else NULL */
} Motion;

typedef struct Search {
    const OstProblem *problem;
    OstSolver *solver;
    int function;               /* of time */
    const double *rhs, *volume; /* volume: of the pressures, or NULL */
    int count;
    Motion *motion;
    double *zero;    /* a right-hand side of the pressures */
    double *u;       /* 3 × node_count */
    double *of_rows; /* 3 × rows */
    double *matrix;  /* count × count */
    double *size;    /* of each force, and room for as many numbers */
} Search;

int ost_distributing_any(const OstProblem *problem)
{
    const OstScene *scene = problem->scene;
    return scene && scene->drive && ost_effect_on(problem->effects, OST_EFFECT_MOVED_COUPLING);
}

static void close_search(Search *search)
{
    for (int k = 0; search->motion && k < search->count; k++) {
        OST_FREE(search->motion[k].force);
        OST_FREE(search->motion[k].v);
        OST_FREE(search->motion[k].p);
    }
    OST_FREE(search->motion);
    OST_FREE(search->zero);
    OST_FREE(search->u);
    OST_FREE(search->of_rows);
    OST_FREE(search->matrix);
    OST_FREE(search->size);
}

static OstStatus open_search(Search *search)
{
    const OstProblem *problem = search->problem;
    const OstCase *c = problem->scene->c;
    OstContext *ctx = problem->ctx;
    const size_t nodes = 3 * (size_t)problem->mesh->node_count, rows = 3 * (size_t)problem->system->matrix->rows;
    OstStatus status = OST_NEW(ctx, &search->motion, 6 * (size_t)c->load_count);
    for (int i = 0; i < c->load_count && status == OST_SUCCESS; i++)
        for (int k = 0; k < 6 && c->loads[i].kind == OST_LOAD_DISTRIBUTING; k++)
            if (c->loads[i].moved[k])
                search->motion[search->count++] =
                    (Motion){.load = i,
                             .component = k,
                             .given = c->loads[i].table == search->function ? c->loads[i].motion[k] : 0.0};
    for (int k = 0; k < search->count && status == OST_SUCCESS; k++) {
        status = OST_NEW(ctx, &search->motion[k].force, nodes);
        OST_THEN(OST_NEW(ctx, &search->motion[k].v, rows));
        if (problem->pressures)
            OST_THEN(OST_NEW(ctx, &search->motion[k].p, ost_problem_pressure_room(problem)));
    }
    if (problem->pressures)
        OST_THEN(OST_NEW(ctx, &search->zero, problem->pressures->owned));
    OST_THEN(OST_NEW(ctx, &search->u, nodes));
    OST_THEN(OST_NEW(ctx, &search->of_rows, rows));
    OST_THEN(OST_NEW(ctx, &search->matrix, (size_t)search->count * (size_t)search->count));
    OST_THEN(OST_NEW(ctx, &search->size, 2 * (size_t)search->count));
    return ost_agree(ctx, status);
}

/* The motion that a unit force works on. */
static double mean_motion(const Search *search, const Motion *motion)
{
    double sum = 0.0;
    for (size_t i = 0; i < 3 * (size_t)search->problem->mesh->owned_nodes; i++)
        sum += motion->force[i] * search->u[i];
    return sum;
}

/* The response to a unit of one force: a column of B' K^-1 B. */
static OstStatus respond(Search *search, int k)
{
    const OstProblem *problem = search->problem;
    Motion *motion = &search->motion[k];
    OstDrive *drive = ost_scene_drive(problem->scene, 0, motion->load);
    const OstDrive before = *drive;
    OstSolveReport report;
    *drive = (OstDrive){.of_point = {0.0}};
    drive->of_point[motion->component] = 1.0;
    const OstStatus status = ost_scene_load(problem->scene, motion->load, motion->force);
    *drive = before;
    OST_TRY(status);
    OST_TRY(ost_system_take_rows(problem->system, motion->force, search->of_rows));
    const OstSaddle saddle = {problem->coupling, search->zero, motion->p};
    OST_TRY(ost_solver_solve_mixed(search->solver, problem->pressures ? &saddle : NULL, search->of_rows, motion->v,
                                   &report));
    OST_TRY(ost_system_displacement(problem->system, 0.0, motion->v, search->u));
    for (int j = 0; j <= k; j++)
        search->matrix[k * search->count + j] = mean_motion(search, &search->motion[j]);
    return OST_SUCCESS;
}

/* What the given motions lack under the other loads. K^-1 is symmetric, also with the pressures: their displacement
 * need not be solved for. */
static OstStatus find_lack(Search *search)
{
    const OstProblem *problem = search->problem;
    const size_t rows = 3 * (size_t)problem->system->matrix->rows;
    memset(search->of_rows, 0, rows * sizeof(double));
    OST_TRY(ost_problem_function_displacement(problem, search->function, search->of_rows, search->u));
    for (int k = 0; k < search->count; k++) {
        double sum = mean_motion(search, &search->motion[k]);
        for (size_t i = 0; i < rows; i++)
            sum += search->motion[k].v[i] * search->rhs[i];
        for (OstLocal i = 0; search->volume && i < problem->pressures->owned; i++)
            sum += search->motion[k].p[i] * search->volume[i];
        search->size[k] = -sum;
    }
    OST_TRY(ost_sum(problem->ctx, search->count, search->size));
    for (int k = 0; k < search->count; k++)
        search->size[k] += search->motion[k].given;
    return ost_sum(problem->ctx, search->count * search->count, search->matrix);
}

/* The first motion that those before leave no freedom, or -1; solves for the sizes. */
static int solve_dense(Search *search, double *diagonal)
{
    static const double nothing = 1e-6; /* of its own response: the solves are that exact */
    const int one = 1, n = search->count;
    int info = 0;
    for (int k = 0; k < n; k++)
        diagonal[k] = search->matrix[k * (n + 1)];
    dposv_("U", &n, &one, search->matrix, &n, search->size, &n, &info, 1);
    for (int k = 0; k < n && info == 0; k++)
        if (!(search->matrix[k * (n + 1)] * search->matrix[k * (n + 1)] > nothing * diagonal[k]))
            return k;
    return info > 0 ? info - 1 : -1;
}

static OstStatus find_sizes(Search *search)
{
    const OstCase *c = search->problem->scene->c;
    for (int k = 0; k < search->count; k++)
        OST_TRY(respond(search, k));
    OST_TRY(find_lack(search));
    const int lost = solve_dense(search, search->size + search->count);
    if (lost >= 0)
        return OST_RAISE(c->ctx, OST_INVALID_INPUT,
                         "%s:%d: the motion of this distributing coupling is given already, by a support or by another "
                         "coupling of the same face; leave one out",
                         c->path, c->loads[search->motion[lost].load].line);
    return OST_SUCCESS;
}

static OstStatus apply(const Search *search, OstProblem *problem)
{
    const size_t owned = 3 * (size_t)problem->mesh->owned_nodes;
    OST_TRY(ost_agree(problem->ctx, ost_distributing_make_room(problem)));
    OstDrive *drive = ost_scene_drive(problem->scene, search->function, 0);
    double *driven = problem->driven + (size_t)search->function * owned;
    memset(drive, 0, (size_t)problem->scene->c->load_count * sizeof *drive);
    for (int k = 0; k < search->count; k++) {
        const Motion *motion = &search->motion[k];
        drive[motion->load].of_point[motion->component] = search->size[k];
        for (size_t i = 0; i < owned; i++)
            driven[i] += search->size[k] * motion->force[i];
    }
    return OST_SUCCESS;
}

OstStatus ost_distributing_find(OstProblem *problem, OstSolver *solver, int function, const double *rhs,
                                const double *volume)
{
    Search search = {.problem = problem, .solver = solver, .function = function, .rhs = rhs, .volume = volume};
    ost_ledger_enter(problem->ctx, OST_EFFECT_MOVED_COUPLING);
    OstStatus status = open_search(&search);
    OST_THEN(find_sizes(&search));
    OST_THEN(apply(&search, problem));
    close_search(&search);
    ost_ledger_leave(problem->ctx);
    return status;
}

static OstStatus take_responses(const Search *search, OstResponses *responses)
{
    const OstProblem *problem = search->problem;
    const size_t count = (size_t)search->count, rows = 3 * (size_t)problem->system->matrix->rows;
    const size_t pressures = problem->pressures ? ost_problem_pressure_room(problem) : 0;
    *responses = (OstResponses){.count = search->count, .rows = rows, .pressures = pressures};
    OstStatus status = OST_NEW(problem->ctx, &responses->force, count * rows);
    OST_THEN(OST_NEW(problem->ctx, &responses->response, count * rows));
    OST_THEN(OST_NEW(problem->ctx, &responses->pressure, count * pressures));
    OST_THEN(OST_NEW(problem->ctx, &responses->products, count * count));
    status = ost_agree(problem->ctx, status);
    for (size_t k = 0; k < count && status == OST_SUCCESS; k++) {
        const Motion *motion = &search->motion[k];
        memcpy(responses->response + k * rows, motion->v, rows * sizeof(double));
        if (pressures > 0)
            memcpy(responses->pressure + k * pressures, motion->p, pressures * sizeof(double));
        status = ost_system_take_rows(problem->system, motion->force, responses->force + k * rows);
    }
    if (status == OST_SUCCESS)
        memcpy(responses->products, search->matrix, count * count * sizeof(double));
    return status;
}

OstStatus ost_distributing_respond(const OstProblem *problem, OstSolver *solver, OstResponses *responses)
{
    Search search = {.problem = problem, .solver = solver};
    ost_ledger_enter(problem->ctx, OST_EFFECT_MOVED_COUPLING);
    OstStatus status = open_search(&search);
    for (int k = 0; k < search.count && status == OST_SUCCESS; k++)
        status = respond(&search, k);
    OST_THEN(ost_sum(problem->ctx, search.count * search.count, search.matrix));
    OST_THEN(take_responses(&search, responses));
    close_search(&search);
    ost_ledger_leave(problem->ctx);
    return status;
}

void ost_responses_release(OstResponses *responses)
{
    OST_FREE(responses->force, responses->response, responses->pressure, responses->products);
}

OstStatus ost_distributing_make_room(OstProblem *problem)
{
    const size_t count = 3 * (size_t)problem->mesh->owned_nodes * (size_t)ost_problem_functions(problem);
    return problem->driven ? OST_SUCCESS : OST_NEW(problem->ctx, &problem->driven, count);
}

void ost_distributing_forget(OstProblem *problem)
{
    OST_FREE(problem->driven);
}

OstStatus ost_distributing_react(const OstProblem *problem, double t, OstResult *result)
{
    const size_t owned = 3 * (size_t)problem->mesh->owned_nodes;
    for (size_t i = 0; i < owned; i++) {
        double driven = 0.0;
        for (int k = 0; k < ost_problem_functions(problem); k++)
            driven += ost_problem_factor(problem, k, t) * problem->driven[(size_t)k * owned + i];
        result->force[i] -= driven;
        result->reaction[i] += driven;
        if (result->passed)
            result->passed[i] += driven;
        if (result->moved)
            result->moved[i] = driven;
    }
    return ost_halo_import(problem->mesh->halo, 3 * sizeof(double), result->reaction);
}
