/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/saddle/error.h"

#include "algebra/krylov/precondition.h"
#include "algebra/saddle/local_schur.h"
#include "algebra/saddle/means.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>

enum { MOST_STEPS = 2000 };

/* Iterations go by the error; a residual that has fallen by as much and this ends them too. */
static const double residual_beside = 1e-2;

typedef struct Work {
    OstSoftMeans *means;
    OstLocalSchur *local;
    double *memory, *scaled, *wide, *force, *q, *schur, *weights;
} Work;

static OstStatus create(const OstCgSystem *system, const OstPreconditioner *preconditioner, const OstCoupling *coupling,
                        Work *work)
{
    const size_t n = 3 * (size_t)coupling->unknowns, columns = 3 * (size_t)system->matrix->columns;
    const size_t m = (size_t)coupling->rows;
    OST_TRY(ost_agree(coupling->ctx, OST_NEW(coupling->ctx, &work->memory, 2 * n + columns + 4 * m)));
    work->scaled = work->memory;
    work->force = work->scaled + n;
    work->wide = work->force + n;
    work->q = work->wide + columns;
    work->schur = work->q + m;
    OST_TRY(ost_agree(coupling->ctx, ost_pressure_weights(system, coupling, &work->weights)));
    OST_TRY(ost_local_schur_create(system, coupling, &work->local));
    return ost_soft_means_create(system, preconditioner, coupling, &work->means);
}

static OstStatus apply(const OstCgSystem *system, const OstPreconditioner *preconditioner, const OstSaddle *saddle,
                       double scale, const double *r_u, Work *work, double *e_u)
{
    const OstCoupling *coupling = saddle->coupling;
    const size_t n = 3 * (size_t)coupling->unknowns, m = (size_t)coupling->rows;
    OST_TRY(ost_precondition(system, preconditioner, r_u, work->scaled, work->wide));
    for (size_t i = 0; i < n; i++)
        work->wide[i] *= scale;
    OST_TRY(ost_halo_import(system->matrix->halo, 3 * sizeof(double), work->wide));
    ost_coupling_multiply(coupling, work->wide, work->q);
    for (size_t i = 0; i < m; i++)
        work->q[i] -= saddle->g[i];
    OST_TRY(ost_coupling_schur_solve(coupling, work->weights, work->q, saddle->p, work->schur));
    if (work->means)
        OST_TRY(ost_soft_means_add(work->means, work->q, saddle->p));
    if (work->local)
        OST_TRY(ost_local_schur_add(work->local, work->q, saddle->p));
    OST_TRY(ost_coupling_transpose(coupling, saddle->p, work->force));
    for (size_t i = 0; i < n; i++)
        work->force[i] = r_u[i] - work->force[i];
    OST_TRY(ost_precondition(system, preconditioner, work->force, work->scaled, e_u));
    for (size_t i = 0; i < n; i++)
        e_u[i] *= scale;
    return OST_SUCCESS;
}

/* The estimate may be small before the softest motions have shown: then its bound is not, and it is looked at again
 * when it has halved. */
static OstStatus accept(void *data, const double *u, double error, double *next)
{
    const OstGoal *goal = data;
    (void)u;
    *next = goal->error.bound <= goal->stop->first * goal->error.size ? error : 0.5 * error;
    return OST_SUCCESS;
}

OstStatus ost_saddle_iterated_error(const OstCgSystem *system, const OstPreconditioner *preconditioner,
                                    const OstSaddle *saddle, double scale, double missing, const double *r_u,
                                    double *e_u, int *found)
{
    OstGoal goal = {.ctx = system->matrix->ctx, .most_iterations = MOST_STEPS, .crude = 1, .scale = scale};
    const OstErrorStop stop = {.ask = accept, .data = &goal, .first = missing, .relative = 1};
    OstSolveReport report = {0};
    goal.stop = &stop;
    OST_TRY(ost_saddle_goal(system->matrix, saddle, r_u, missing * residual_beside, &goal));
    const OstStatus status = ost_saddle_solve(system, preconditioner, saddle, r_u, e_u, &goal, &report);
    *found = status == OST_SUCCESS && goal.end != OST_END_PRECONDITIONER && isfinite(goal.error.estimate);
    if (status != OST_SUCCESS && status != OST_NOT_CONVERGED)
        return status;
    const double rest = goal.enough ? goal.error.estimate : goal.error.bound;
    const double left = *found && goal.error.size > 0.0 ? rest / goal.error.size : 0.0;
    const double longer = sqrt(1.0 + left * left);
    for (size_t i = 0; i < 3 * (size_t)saddle->coupling->unknowns; i++)
        e_u[i] *= longer;
    for (size_t i = 0; i < (size_t)saddle->coupling->rows; i++)
        saddle->p[i] *= longer;
    return OST_SUCCESS;
}

OstStatus ost_saddle_error(const OstCgSystem *system, const OstPreconditioner *preconditioner, const OstSaddle *saddle,
                           double scale, const double *r_u, double *e_u)
{
    Work work = {NULL};
    OstStatus status = create(system, preconditioner, saddle->coupling, &work);
    OST_THEN(apply(system, preconditioner, saddle, scale, r_u, &work, e_u));
    ost_soft_means_destroy(&work.means);
    ost_local_schur_destroy(&work.local);
    OST_FREE(work.weights);
    OST_FREE(work.memory);
    return status;
}
