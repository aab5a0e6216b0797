/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/saddle/run.h"

#include "algebra/krylov/precondition.h"
#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <math.h>
#include <string.h>

OstStatus ost_saddle_run_create(OstSaddleRun *run)
{
    const size_t columns = 3 * (size_t)run->system->matrix->columns;
    const size_t n = run->n, m = run->m, mg = run->mg;
    OstStatus status = OST_NEW(run->ctx, &run->memory, 9 * n + columns + 5 * mg + 7 * m);
    OST_THEN(ost_lanczos_create(run->ctx, run->goal->most_iterations, &run->lanczos));
    OST_TRY(ost_agree(run->ctx, status));
    double *next = run->memory;
    double **of_unknowns[] = {&run->r.u, &run->z.u, &run->d.u,    &run->k.u,    &run->az,
                              &run->ad,  &run->w,   &run->scaled, &run->start.u};
    double **of_columns[] = {&run->r.p, &run->z.p, &run->d.p, &run->k.p, &run->q};
    double **of_pressures[] = {&run->start.p, &run->bz, &run->bd, &run->work};
    for (int i = 0; i < 9; i++, next += n)
        *of_unknowns[i] = next;
    for (int i = 0; i < 5; i++, next += mg)
        *of_columns[i] = next;
    for (int i = 0; i < 4; i++, next += m)
        *of_pressures[i] = next;
    run->wide = run->work + 3 * m;
    return OST_SUCCESS;
}

OstSaddleRun ost_saddle_run_of(const OstCgSystem *system, const OstPreconditioner *preconditioner,
                               const OstSaddle *saddle, const double *f, double *u, OstGoal *goal)
{
    const OstCoupling *coupling = saddle->coupling;
    return (OstSaddleRun){.ctx = coupling->ctx,
                          .system = system,
                          .preconditioner = preconditioner,
                          .saddle = saddle,
                          .f = f,
                          .u = u,
                          .goal = goal,
                          .n = 3 * (size_t)coupling->unknowns,
                          .m = (size_t)coupling->rows,
                          .mg = (size_t)coupling->columns,
                          .tau = 1.0};
}

void ost_saddle_run_destroy(OstSaddleRun *run)
{
    ost_soft_means_destroy(&run->means);
    ost_local_schur_destroy(&run->local);
    OST_FREE(run->weights);
    OST_FREE(run->memory);
    ost_lanczos_destroy(&run->lanczos);
}

/* z = S^-1 r by the mass matrix and the means of soft parts. */
static OstStatus mass_solve(const OstSaddleRun *run, const double *r, double *z)
{
    OST_TRY(ost_coupling_schur_solve(run->saddle->coupling, run->weights, r, z, run->work));
    return run->means ? ost_soft_means_add(run->means, r, z) : OST_SUCCESS;
}

OstStatus ost_saddle_schur_solve(const OstSaddleRun *run, const double *r, double *z)
{
    OST_TRY(mass_solve(run, r, z));
    return run->local ? ost_local_schur_add(run->local, r, z) : OST_SUCCESS;
}

OstStatus ost_saddle_find_norm(OstSaddleRun *run, double *norm)
{
    double squares[OST_SADDLE_SQUARES];
    OST_TRY(mass_solve(run, run->r.p, run->q));
    OST_TRY(ost_saddle_squares(run->saddle->coupling, run->r.u, run->r.p, run->q, run->w, squares));
    *norm = sqrt(squares[OST_SADDLE_FORCE] +
                 run->goal->start * run->goal->start / run->energy * squares[OST_SADDLE_VOLUME]);
    return OST_SUCCESS;
}

OstStatus ost_saddle_precondition(OstSaddleRun *run, const double *r, double *z)
{
    OST_TRY(ost_precondition(run->system, run->preconditioner, r, run->scaled, z));
    for (size_t i = 0; i < run->n; i++)
        z[i] *= run->tau;
    return OST_SUCCESS;
}

OstStatus ost_saddle_find_residual(OstSaddleRun *run)
{
    const OstCoupling *coupling = run->saddle->coupling;
    memcpy(run->wide, run->u, run->n * sizeof(double));
    OST_TRY(ost_residual(run->system->matrix, run->f, run->wide, run->goal->compensated, run->r.u));
    OST_TRY(ost_coupling_transpose(coupling, run->saddle->p, run->w));
    for (size_t i = 0; i < run->n; i++)
        run->r.u[i] -= run->w[i];
    ost_coupling_multiply(coupling, run->wide, run->r.p);
    OST_TRY(ost_coupling_give_way(coupling, run->saddle->p, run->work));
    for (size_t i = 0; i < run->m; i++)
        run->r.p[i] = run->saddle->g[i] - run->r.p[i] + run->work[i];
    return ost_saddle_find_norm(run, &run->goal->norm);
}

OstStatus ost_saddle_find_size(OstSaddleRun *run, double *size)
{
    double sums[2] = {ost_dot(run->n, run->f, run->u), ost_dot(run->m, run->saddle->g, run->saddle->p)};
    OST_TRY(ost_sum(run->ctx, 2, sums));
    *size = sqrt(fmax(sums[0] - sums[1], 0.0));
    return OST_SUCCESS;
}
