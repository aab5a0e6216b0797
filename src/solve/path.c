/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "problem/timed.h"
#include "solve/path_data.h"

#include <math.h>
#include <string.h>

static OstStatus check_times(OstContext *ctx, int count, const double *times)
{
    for (int i = 0; i < count; i++)
        if (!(times[i] >= 0.0) || !isfinite(times[i]) || (i > 0 && times[i] <= times[i - 1]))
            return OST_RAISE(ctx, OST_INVALID_INPUT,
                             "time %d of a path is %g; expected times that ascend, the first not negative", i + 1,
                             times[i]);
    return count > 0 ? OST_SUCCESS : OST_RAISE(ctx, OST_INVALID_INPUT, "a path has one step at least; found none");
}

OstStatus ost_path_create(OstProblem *problem, const OstSolverOptions *options, int count, const double *times,
                          OstPath **path)
{
    OstContext *ctx = problem->ctx;
    OstPath *made = NULL;
    *path = NULL;
    OST_TRY(check_times(ctx, count, times));
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS) {
        *made = (OstPath){.ctx = ctx, .problem = problem, .count = count};
        status = OST_NEW(ctx, &made->times, count);
        OST_THEN(OST_NEW(ctx, &made->steps, count));
    }
    status = ost_agree(ctx, status);
    if (status == OST_SUCCESS)
        memcpy(made->times, times, (size_t)count * sizeof *times);
    OST_THEN(ost_analysis_create(problem, options, &made->analysis));
    if (status != OST_SUCCESS)
        ost_path_destroy(&made);
    *path = made;
    return status;
}

OstStatus ost_scene_path(const OstScene *scene, OstPath **path)
{
    const OstCase *c = scene->c;
    OstProblem *problem = NULL;
    *path = NULL;
    if (c->path_steps == 0)
        return OST_RAISE(c->ctx, OST_INVALID_INPUT, "%s: the case has no path; add one, as in path: {steps: 10}",
                         c->path);
    OstStatus status = ost_scene_problem(scene, &problem);
    OST_THEN(ost_path_create(problem, &c->solver, c->path_steps, c->path_times, path));
    if (status == OST_SUCCESS)
        (*path)->owned = problem;
    else
        ost_problem_destroy(&problem);
    return status;
}

void ost_path_destroy(OstPath **path)
{
    if (!*path)
        return;
    ost_superposition_release(&(*path)->linear);
    if ((*path)->analysis)
        ost_analysis_destroy(&(*path)->analysis);
    ost_problem_destroy(&(*path)->owned);
    OST_FREE((*path)->times);
    OST_FREE((*path)->steps);
    OST_FREE(*path);
}

static OstStatus solve_linearly(OstPath *path)
{
    if (path->linear.count > 0)
        return OST_SUCCESS;
    OST_TRY(ost_analysis_prepare(path->analysis));
    path->solved_linearly = ost_superposition_create(path->analysis, &path->linear);
    return path->linear.count > 0 ? OST_SUCCESS : path->solved_linearly;
}

static void record(const OstResult *result, double t, OstPathStep *step)
{
    *step = (OstPathStep){.t = t,
                          .largest_displacement = result->largest_displacement,
                          .strain_energy = result->checks.strain_energy,
                          .largest_strain = result->checks.largest_strain,
                          .largest_rotation = result->checks.largest_rotation,
                          .iterations = result->solve.iterations,
                          .linear = result->checks.linear};
}

OstStatus ost_path_advance(OstPath *path, unsigned fields, OstResult **result)
{
    OstSolvedFor solved_for;
    *result = NULL;
    if (path->done == path->count)
        return OST_RAISE(path->ctx, OST_INVALID_USAGE, "all %d steps of the path are done", path->count);
    const double t = path->times[path->done];
    OST_TRY(ost_result_create(path->problem, result));
    OST_TRY(solve_linearly(path));
    (*result)->unknowns = ost_problem_unknowns(path->problem);
    OST_TRY(ost_superposition_at(&path->linear, path->analysis, t, *result, &solved_for));
    ost_result_take_outcome(*result, path->solved_linearly);
    OST_TRY(ost_analysis_conclude(path->analysis, t, path->solved_linearly, &solved_for, fields, *result));
    record(*result, t, &path->steps[path->done++]);
    return OST_SUCCESS;
}

int ost_path_count(const OstPath *path)
{
    return path->count;
}

int ost_path_done(const OstPath *path)
{
    return path->done;
}

OstPathStep *ost_path_step(OstPath *path, int number)
{
    return &path->steps[number];
}
