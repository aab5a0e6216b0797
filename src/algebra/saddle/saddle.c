/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/saddle/saddle.h"

#include "algebra/krylov/energy_error.h"
#include "algebra/krylov/precondition.h"
#include "algebra/matrix/rounded_stiffness.h"
#include "algebra/matrix/vector.h"
#include "algebra/saddle/run.h"
#include "core/error.h"
#include "core/parallel/reduce.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* tau over 1 / the smallest eigenvalue of M^-1 A seen so far, from a little before it is needed; and what that is taken
 * for before any was seen. */
static const double margin = 1.2, near = 1.05, first_eigenvalue = 0.7;

/* Where the product proves not to be definite all the same, or the residual grows by so much, tau is multiplied and the
 * pass begins again from where it began; so often at most. */
static const double enlarge = 1.5, grown = 1e9;
enum { MOST_RESTARTS = 12 };

/* Iterations grow as the root of tau: with a larger one another strategy is quicker, and rounding raises it further. */
static const double most_tau = 1e4;

/* M works in single precision in part, so that z = N^-1 r, which is carried along, is off by that share of what it was
 * when it was last computed: it is computed anew where r has become so much smaller. */
static const double renew_below = 1e-3;

/* A step's curvature over its weight is at most twice tau times the largest eigenvalue of M^-1 A, which the cycle keeps
 * below 1.44. One far beyond is of a direction that rounding has made: what a pass gains after it is lost. */
static const double beyond = 10.0;

/* A pass whose weight has fallen so far may be broken by rounding; before, by a tau that is too small. */
static const double far = 1e-6;

/* A pass after which neither the true residual nor what the next one begins with is less by so much is a stall. Next to
 * the rounding limit, an estimate, there is one; below the second number of times it, residuals are compensated. */
static const double least_gain = 0.5, compensated_below = 10.0;
enum { MOST_STALLS = 3 };

/* About twice the energy of the solution: f·A^-1 f + g·S^-1 g. */
static OstStatus find_energy(OstSaddleRun *run)
{
    double sums[2];
    OST_TRY(ost_precondition(run->system, run->preconditioner, run->f, run->scaled, run->w));
    OST_TRY(ost_saddle_schur_solve(run, run->saddle->g, run->q));
    sums[0] = ost_dot(run->n, run->f, run->w);
    sums[1] = ost_dot(run->m, run->saddle->g, run->q);
    OST_TRY(ost_sum(run->ctx, 2, sums));
    run->energy = sums[0] + sums[1];
    return OST_SUCCESS;
}

/* --- one iteration --- */

/* z.u anew where that is due. */
static OstStatus renew(OstSaddleRun *run, int due)
{
    double square;
    OST_TRY(ost_vector_dot(run->ctx, run->n, run->r.u, run->r.u, &square));
    if (!due && sqrt(square) >= renew_below * run->size)
        return OST_SUCCESS;
    run->size = sqrt(square);
    run->carried = 0;
    return ost_saddle_precondition(run, run->r.u, run->z.u);
}

enum { SUM_AZ, SUM_RZ, SUM_P, SUMS };

/* A z and B z of z.u, and z.u·A z.u and z.u·r.u. */
static OstStatus multiply(OstSaddleRun *run, double sums[2])
{
    memcpy(run->wide, run->z.u, run->n * sizeof(double));
    OST_TRY(ost_block_matrix_apply(run->system->matrix, run->wide, run->az));
    ost_coupling_multiply(run->saddle->coupling, run->wide, run->bz);
    sums[SUM_AZ] = ost_dot(run->n, run->z.u, run->az);
    sums[SUM_RZ] = ost_dot(run->n, run->z.u, run->r.u);
    return ost_sum(run->ctx, 2, sums);
}

/* Is an eigenvalue of N^-1 A seen that is too small? */
static int asks_for_more(const double sums[2])
{
    return sums[SUM_RZ] > 0.0 && sums[SUM_AZ] < near * sums[SUM_RZ] && sums[SUM_AZ] > 0.0;
}

static void enlarge_by(OstSaddleRun *run, double larger)
{
    run->tau *= larger;
    for (size_t i = 0; i < run->n; i++) {
        run->z.u[i] *= larger;
        run->az[i] *= larger;
    }
    for (size_t i = 0; i < run->m; i++)
        run->bz[i] *= larger;
    ost_log(run->ctx, OST_LOG_VERBOSE, "solver: the preconditioner is scaled by %.3g", run->tau);
}

/* Fills A z, B z, z.p and the weight z·Hz from z.u. Enlarges tau where A - N is nearly indefinite: *again is 1 then,
 * and 2 where it was not positive definite. A z.u that was carried along differs from N^-1 r by rounding, so it is
 * computed anew before tau is enlarged. */
static OstStatus complete(OstSaddleRun *run, int *again)
{
    double sums[SUMS];
    *again = 0;
    OST_TRY(multiply(run, sums));
    if (run->carried && asks_for_more(sums)) {
        OST_TRY(renew(run, 1));
        OST_TRY(multiply(run, sums));
    }
    if (sums[SUM_RZ] > 0.0 && sums[SUM_AZ] < 0.0)
        return ost_goal_refuse_indefinite(run->goal, sums[SUM_AZ]);
    if (asks_for_more(sums)) {
        const double larger = margin * sums[SUM_RZ] / sums[SUM_AZ];
        enlarge_by(run, larger);
        sums[SUM_AZ] *= larger * larger;
        sums[SUM_RZ] *= larger;
        *again = larger > margin ? 2 : 1;
    }
    for (size_t i = 0; i < run->m; i++)
        run->q[i] = run->bz[i] - run->r.p[i];
    OST_TRY(ost_saddle_schur_solve(run, run->q, run->z.p));
    sums[SUM_P] = ost_dot(run->m, run->z.p, run->q);
    OST_TRY(ost_sum(run->ctx, 1, &sums[SUM_P]));
    run->weight = sums[SUM_AZ] - sums[SUM_RZ] + sums[SUM_P];
    return OST_SUCCESS;
}

static void add(size_t n, const double *z, double beta, double *d)
{
    for (size_t i = 0; i < n; i++)
        d[i] = z[i] + beta * d[i];
}

/* d = z + beta d and k = K d; then w = N^-1 k.u. `curvature`: d·H N^-1 K d. */
static OstStatus turn(OstSaddleRun *run, double beta, double *curvature)
{
    const OstCoupling *coupling = run->saddle->coupling;
    add(run->n, run->z.u, beta, run->d.u);
    add(run->m, run->z.p, beta, run->d.p);
    add(run->n, run->az, beta, run->ad);
    add(run->m, run->bz, beta, run->bd);
    OST_TRY(ost_coupling_transpose(coupling, run->d.p, run->k.u));
    OST_TRY(ost_coupling_give_way(coupling, run->d.p, run->k.p));
    for (size_t i = 0; i < run->n; i++)
        run->k.u[i] += run->ad[i];
    for (size_t i = 0; i < run->m; i++)
        run->k.p[i] = run->bd[i] - run->k.p[i];
    OST_TRY(ost_saddle_precondition(run, run->k.u, run->w));
    *curvature =
        ost_dot(run->n, run->k.u, run->w) - ost_dot(run->n, run->k.u, run->d.u) - ost_dot(run->m, run->k.p, run->d.p);
    return ost_sum(run->ctx, 1, curvature);
}

static void step(OstSaddleRun *run, double alpha)
{
    run->carried = 1;
    for (size_t i = 0; i < run->n; i++) {
        run->u[i] += alpha * run->d.u[i];
        run->r.u[i] -= alpha * run->k.u[i];
        run->z.u[i] -= alpha * run->w[i];
    }
    for (size_t i = 0; i < run->m; i++) {
        run->saddle->p[i] += alpha * run->d.p[i];
        run->r.p[i] -= alpha * run->k.p[i];
    }
}

/* The iteration lowers the squared error in its own norm, δ |e_u + A^-1 B'e_p|² + |e_p|² with S for p, where 1 + δ is
 * M^-1 A times tau: 1.1 and more. Of the energy of u and p, that is less by up to a factor of this. */
static const double of_energy = 3.0;

/* Estimates the error of u and p, in the norm of the energy, where the goal's stop wants it, and asks that. */
static OstStatus judge_error(OstSaddleRun *run)
{
    OstGoal *goal = run->goal;
    OstAlgebraicError *error = &goal->error;
    if (!goal->stop || run->passes > 0 || run->lanczos.count == 0)
        return OST_SUCCESS;
    ost_algebraic_error(&run->lanczos, error);
    goal->rate = ost_algebraic_error_rate(&run->lanczos, error);
    error->estimate *= of_energy;
    error->bound *= of_energy;
    if (!isfinite(error->estimate))
        return OST_SUCCESS;
    OST_TRY(ost_saddle_find_size(run, &error->size));
    if (!(error->estimate <= ost_goal_next(goal)))
        return OST_SUCCESS;
    OST_TRY(goal->stop->ask(goal->stop->data, run->u, error->estimate, &goal->next));
    goal->enough = error->estimate <= goal->next;
    if (!(goal->next > 0.0))
        goal->stop = NULL;
    return OST_SUCCESS;
}

/* Is the direction one that rounding has made? Not the first one of a preconditioner that has all digits it may have:
 * then the eigenvalues are as large as that. */
static int is_lost(OstSaddleRun *run, int first, double curvature)
{
    const double stiff = curvature / (run->tau * run->weight);
    if (first && run->passes == 0 && run->preconditioner->precise)
        run->beyond = fmax(run->beyond, beyond * stiff);
    run->lost = stiff > run->beyond;
    return run->lost;
}

/* Steps of a pass. *broken: A - N proves not to be positive definite. */
static OstStatus iterate(OstSaddleRun *run, int *broken)
{
    OstGoal *goal = run->goal;
    const double most = grown * goal->norm;
    double before = 0.0, curvature, norm;
    int again;
    *broken = run->lost = 0;
    ost_goal_begin_pass(goal);
    OST_TRY(renew(run, 1));
    for (int first = 1;; first = 0) {
        OST_TRY(complete(run, &again));
        *broken = !(run->weight > 0.0 && isfinite(run->weight));
        if (first)
            run->begun = run->weight / (run->tau * run->tau);
        if (*broken)
            return OST_SUCCESS;
        if (again < 2) /* else the iteration did not see all of the error */
            OST_TRY(judge_error(run));
        if (goal->enough)
            return OST_SUCCESS;
        if (again && run->passes == 0)
            run->lanczos.count = 0; /* of another operator */
        OST_TRY(turn(run, first || again ? 0.0 : run->weight / before, &curvature));
        *broken = !(curvature > 0.0 && isfinite(curvature));
        if (*broken)
            return OST_SUCCESS;
        if (is_lost(run, first, curvature))
            return OST_SUCCESS;
        before = run->weight;
        if (run->passes == 0) /* a run of conjugate gradients; the passes that follow are others */
            OST_TRY(ost_lanczos_add(&run->lanczos, run->weight / curvature, run->weight));
        step(run, run->weight / curvature);
        OST_TRY(ost_saddle_find_norm(run, &norm));
        *broken = !(norm <= most);
        if (!ost_goal_count(goal, norm, run->weight / (run->tau * run->tau)) || *broken)
            return OST_SUCCESS;
        if (run->tau > most_tau && goal->patience > 0) {
            goal->end = OST_END_SLOW;
            snprintf(goal->words, sizeof goal->words,
                     "after %d iterations the smallest eigenvalue is found to be below %.1g: too slow",
                     goal->convergence.count, 1.0 / run->tau);
            return OST_SUCCESS;
        }
        OST_TRY(renew(run, 0));
    }
}

/* What has come so far is not begun again: rounding has broken it. */
static void spare(OstSaddleRun *run, int *broken)
{
    if (!*broken || !(fabs(run->weight) < far * run->begun * run->tau * run->tau))
        return;
    *broken = 0;
    run->lost = 1;
}

/* A pass from the residual at hand. */
static OstStatus run_pass(OstSaddleRun *run)
{
    OstGoal *goal = run->goal;
    int broken;
    memcpy(run->start.u, run->u, run->n * sizeof(double));
    memcpy(run->start.p, run->saddle->p, run->m * sizeof(double));
    OST_TRY(iterate(run, &broken));
    spare(run, &broken);
    while (broken && run->restarts++ < MOST_RESTARTS && goal->end == OST_END_REACHED) {
        run->tau *= enlarge;
        run->lanczos.count = 0;
        ost_log(run->ctx, OST_LOG_VERBOSE, "solver: begun again, the preconditioner scaled by %.3g", run->tau);
        memcpy(run->u, run->start.u, run->n * sizeof(double));
        memcpy(run->saddle->p, run->start.p, run->m * sizeof(double));
        OST_TRY(ost_saddle_find_residual(run));
        ost_convergence_start(&goal->convergence, goal->norm); /* the rate so far is of another operator */
        OST_TRY(iterate(run, &broken));
        spare(run, &broken);
    }
    if (broken && goal->end == OST_END_REACHED)
        ost_goal_accepts(goal, -1.0);
    return OST_SUCCESS;
}

/* --- passes --- */

static OstStatus find_limit(OstSaddleRun *run)
{
    double square;
    memcpy(run->wide, run->u, run->n * sizeof(double));
    OST_TRY(ost_halo_import(run->system->matrix->halo, 3 * sizeof(double), run->wide));
    ost_term_rounding(run->system->matrix, run->wide, run->w);
    OST_TRY(ost_vector_dot(run->ctx, run->n, run->w, run->w, &square));
    run->goal->limit = sqrt(square);
    return OST_SUCCESS;
}

/* Is this the last strategy, and has it an answer? Then what rounding leaves of it is measured (solve/mixed_error.c).
 */
static int is_last_answer(const OstGoal *goal)
{
    return goal->patience == 0 && goal->norm < goal->start;
}

/* Passes from residuals in twice the precision gain nothing: what else rounds in them is the reason, and is no part of
 * the limit; a direction that is lost is, too, where the preconditioner has all digits it may have. Not while there is
 * another strategy, which may round less. */
static void blame_passes(const OstSaddleRun *run)
{
    OstGoal *goal = run->goal;
    const int stalls = goal->end == OST_END_REACHED && goal->iterations < goal->most_iterations;
    const int may_gain = run->lost && !run->preconditioner->precise;
    if (stalls && !may_gain && goal->compensated && is_last_answer(goal))
        goal->limit = fmax(goal->limit, goal->norm);
}

static OstStatus explain_end(OstSaddleRun *run)
{
    OstGoal *goal = run->goal;
    OST_TRY(find_limit(run));
    blame_passes(run);
    if (run->lost && goal->end == OST_END_REACHED && !ost_goal_at_limit(goal)) {
        goal->end = OST_END_PRECONDITIONER;
        snprintf(goal->words, sizeof goal->words,
                 "after %d iterations a direction is stiffer than the preconditioner allows: rounding spoils it",
                 goal->convergence.count);
    }
    ost_goal_explain_end(goal, "");
    return OST_SUCCESS;
}

/* The true residual after a pass, compensated once it is near what rounding allows. */
static OstStatus look_at_residual(OstSaddleRun *run)
{
    OstGoal *goal = run->goal;
    OST_TRY(ost_saddle_find_residual(run));
    if (goal->norm <= goal->target || goal->enough)
        return OST_SUCCESS;
    OST_TRY(find_limit(run));
    const int compensates = run->lost || goal->stagnates || goal->norm <= compensated_below * goal->limit;
    if (goal->compensated || !compensates)
        return OST_SUCCESS;
    goal->compensated = 1;
    return ost_saddle_find_residual(run);
}

/* Back to where the pass began, if that was next to rounding and the pass has spoilt it. */
static OstStatus keep_better(OstSaddleRun *run, int was_at_limit)
{
    OstGoal *goal = run->goal;
    if (!was_at_limit || goal->norm <= run->start_norm)
        return OST_SUCCESS;
    memcpy(run->u, run->start.u, run->n * sizeof(double));
    memcpy(run->saddle->p, run->start.p, run->m * sizeof(double));
    return look_at_residual(run);
}

/* A preconditioner that fails may leave what the next strategy could not begin with. */
static OstStatus leave(OstSaddleRun *run)
{
    OstGoal *goal = run->goal;
    OST_TRY(explain_end(run));
    if (goal->end != OST_END_PRECONDITIONER || goal->norm <= goal->start)
        return OST_SUCCESS;
    memset(run->u, 0, run->n * sizeof(double));
    memset(run->saddle->p, 0, run->m * sizeof(double));
    return ost_saddle_find_residual(run);
}

static OstStatus run_passes(OstSaddleRun *run)
{
    OstGoal *goal = run->goal;
    int stalls = 0, at_limit = 0;
    double begun = INFINITY;
    OST_TRY(find_energy(run));
    if (!ost_goal_accepts(goal, run->energy))
        return OST_SUCCESS;
    OST_TRY(ost_saddle_find_residual(run));
    ost_convergence_start(&goal->convergence, goal->norm);
    while (goal->end == OST_END_REACHED && goal->norm > goal->target && stalls < MOST_STALLS && !goal->enough) {
        run->start_norm = goal->norm;
        OST_TRY(run_pass(run));
        run->passes++;
        OST_TRY(look_at_residual(run));
        OST_TRY(keep_better(run, at_limit));
        const int gains = goal->norm < least_gain * run->start_norm || run->begun < least_gain * least_gain * begun;
        begun = run->begun;
        if (run->lost && !gains && run->preconditioner->precise)
            run->beyond *= beyond; /* its eigenvalues are as large as that */
        at_limit = ost_goal_at_limit(goal);
        stalls = gains ? 0 : at_limit ? MOST_STALLS : stalls + 1;
    }
    if (goal->norm > goal->target && !goal->enough)
        return leave(run);
    goal->end = OST_END_REACHED;
    return OST_SUCCESS;
}

/* The norm of the pressure that an error of volume r is worth, in that of the energy: r·S^-1 r. */
static OstStatus worth(OstSaddleRun *run, const double *r, double *norm)
{
    OST_TRY(ost_saddle_schur_solve(run, r, run->q));
    double square = ost_dot(run->m, run->q, r);
    OST_TRY(ost_sum(run->ctx, 1, &square));
    *norm = sqrt(square);
    return OST_SUCCESS;
}

/* The error of u and p is the solution for the residual: one application of the preconditioner over the smallest
 * eigenvalue is taken for it, as for A alone (energy_error.h). That of p has two parts, which may be of one sign: what
 * u's residual leaves of volume, and the second equation's own. */
static OstStatus report_error(OstSaddleRun *run, OstSolveReport *report)
{
    OstGoal *goal = run->goal;
    double smallest, largest, squares[2], of_u, of_p, size;
    int again;
    ost_lanczos_extremes(&run->lanczos, &smallest, &largest);
    goal->smallest = smallest;
    goal->scale = run->tau;
    report->error_estimate = report->energy_error = 0.0;
    report->condition_estimate = smallest > 0.0 ? largest / smallest : 0.0;
    if (goal->crude || goal->end == OST_END_PRECONDITIONER || !(smallest > 0.0))
        return OST_SUCCESS;
    OST_TRY(ost_saddle_precondition(run, run->r.u, run->z.u));
    OST_TRY(complete(run, &again));
    OST_TRY(worth(run, run->bz, &of_u));
    OST_TRY(worth(run, run->r.p, &of_p));
    OST_TRY(ost_saddle_find_size(run, &size));
    OST_TRY(ost_coupling_transpose(run->saddle->coupling, run->z.p, run->w));
    for (size_t i = 0; i < run->n; i++)
        run->k.u[i] = run->r.u[i] - run->w[i]; /* the displacement that the pressure's error brings with it */
    OST_TRY(ost_saddle_precondition(run, run->k.u, run->z.u));
    squares[0] = ost_dot(run->n, run->z.u, run->z.u);
    squares[1] = ost_dot(run->n, run->u, run->u);
    OST_TRY(ost_sum(run->ctx, 2, squares));
    if (squares[1] > 0.0)
        report->error_estimate = sqrt(squares[0] / squares[1]) / smallest;
    report->energy_error = fmax(report->error_estimate, size > 0.0 ? (of_u + of_p) / size / smallest : 0.0);
    return OST_SUCCESS;
}

static int is_digit_left(const OstSolveReport *report)
{
    return report->error_estimate > 0.0 && report->error_estimate < ost_least_digit;
}

/* The residual is as small as rounding allows, but so small an eigenvalue was met, or none, that one application of the
 * preconditioner tells nothing of u. Factors do not go by eigenvalues. */
static void leave_rounding(OstGoal *goal, OstSolveReport *report)
{
    static const double nothing_known = 1.0;
    if (goal->end != OST_END_ROUNDING || is_digit_left(report))
        return;
    if (is_last_answer(goal)) {
        report->error_estimate = fmax(report->error_estimate, nothing_known);
        return;
    }
    goal->end = OST_END_STALLED;
    snprintf(goal->words, sizeof goal->words, "after %d iterations the residual is rounding's, but u is not known",
             goal->convergence.count);
}

OstStatus ost_saddle_solve(const OstCgSystem *system, const OstPreconditioner *preconditioner, const OstSaddle *saddle,
                           const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    OstSaddleRun run = ost_saddle_run_of(system, preconditioner, saddle, f, u, goal);
    run.tau = fmax(margin / (preconditioner->factors ? 1.0 : first_eigenvalue), goal->scale);
    run.beyond = beyond;
    goal->end = OST_END_REACHED;
    if (goal->start == 0.0)
        return OST_SUCCESS;
    OstStatus status;
    OST_TRY_DONE(ost_saddle_run_create(&run));
    OST_TRY_DONE(ost_agree(run.ctx, ost_pressure_weights(system, saddle->coupling, &run.weights)));
    OST_TRY_DONE(ost_soft_means_create(system, preconditioner, saddle->coupling, &run.means));
    OST_TRY_DONE(ost_local_schur_create(system, saddle->coupling, &run.local));
    OST_TRY_DONE(run_passes(&run));
    OST_TRY_DONE(report_error(&run, report));
    if (!goal->crude)
        leave_rounding(goal, report);
done:
    ost_progress(run.ctx, "solve", -1.0);
    ost_saddle_run_destroy(&run);
    return status;
}
