/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/vector.h"
#include "algebra/saddle/run.h"
#include "algebra/saddle/saddle.h"
#include "core/error.h"
#include "core/parallel/reduce.h"

#include <math.h>

/* Corrections by factors are taken while each is this share of the one before. After that they are the rounding of
 * residuals, each a random sample of the error: their root mean square, with some caution, is stated. */
static const double shrinks = 0.5, caution = 1.5, no_change = 1e-16;
enum { MOST_CORRECTIONS = 30, SAMPLES = 4 };

/* The sizes of the correction at hand, relative to u and to the energy. */
static OstStatus measure_correction(OstSaddleRun *run, double *of_u, double *of_p)
{
    const OstCoupling *coupling = run->saddle->coupling;
    double sums[3];
    OST_TRY(ost_coupling_mass(coupling, run->z.p, run->work));
    for (size_t i = 0; i < run->m; i++)
        run->work[i] *= coupling->schur[i];
    sums[0] = ost_dot(run->n, run->z.u, run->z.u);
    sums[1] = ost_dot(run->n, run->u, run->u);
    sums[2] = ost_dot(run->m, run->z.p, run->work);
    OST_TRY(ost_sum(run->ctx, 3, sums));
    *of_u = sums[1] > 0.0 ? sqrt(sums[0] / sums[1]) : 1.0;
    *of_p = sqrt(fmax(sums[2], 0.0) / run->energy);
    return OST_SUCCESS;
}

/* Where the squares are relative to in norms (find_norm): the energy, once u and p are about right. */
static OstStatus take_energy(OstSaddleRun *run)
{
    double size;
    OST_TRY(ost_saddle_find_size(run, &size));
    run->energy = size > 0.0 ? size * size : INFINITY;
    return OST_SUCCESS;
}

static void take_correction(OstSaddleRun *run)
{
    for (size_t i = 0; i < run->n; i++)
        run->u[i] += run->z.u[i];
    for (size_t i = 0; i < run->m; i++)
        run->saddle->p[i] += run->z.p[i];
}

/* Until corrections no longer shrink; the last one is not taken. */
static OstStatus correct(OstSaddleRun *run, const OstSaddleFactors *factors, double *of_u, double *of_p)
{
    double before = INFINITY, u, p, squares[2] = {0.0};
    int samples = 0;
    for (int k = 0; k < MOST_CORRECTIONS; k++) {
        OST_TRY(ost_saddle_find_residual(run));
        OST_TRY(ost_saddle_factors_solve(factors, run->r.u, run->r.p, run->z.u, run->z.p));
        OST_TRY(measure_correction(run, &u, &p));
        const double change = fmax(u, p);
        samples += samples > 0 || (k > 0 && !(change < shrinks * before)) || k + SAMPLES == MOST_CORRECTIONS;
        squares[0] += samples > 0 ? u * u : 0.0;
        squares[1] += samples > 0 ? p * p : 0.0;
        *of_u = samples > 0 ? sqrt(squares[0] / samples) : u;
        *of_p = samples > 0 ? sqrt(squares[1] / samples) : p;
        const int is_crude = run->goal->crude && k > 0 && run->goal->norm <= run->goal->target;
        if (samples == SAMPLES || change < no_change || is_crude)
            return OST_SUCCESS;
        take_correction(run);
        OST_TRY(take_energy(run));
        run->goal->iterations++;
        before = k > 0 ? change : INFINITY;
    }
    return OST_SUCCESS;
}

OstStatus ost_saddle_correct(const OstCgSystem *system, const OstSaddleFactors *factors, const OstSaddle *saddle,
                             const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    OstSaddleRun run = ost_saddle_run_of(system, NULL, saddle, f, u, goal);
    double of_u = 0.0, of_p = 0.0;
    goal->end = OST_END_REACHED;
    if (goal->start == 0.0)
        return OST_SUCCESS;
    OstStatus status;
    OST_TRY_DONE(ost_saddle_run_create(&run));
    run.energy = INFINITY;
    OST_TRY_DONE(correct(&run, factors, &of_u, &of_p));
    goal->limit = goal->norm; /* what the factors cannot correct is rounding */
    if (!(goal->norm <= goal->target))
        ost_goal_explain_end(goal, "");
    report->error_estimate = caution * of_u;
    report->energy_error = caution * fmax(of_u, of_p);
done:
    ost_saddle_run_destroy(&run);
    return status;
}
