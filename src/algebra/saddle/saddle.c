/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/saddle/saddle.h"

#include "algebra/krylov/energy_error.h"
#include "algebra/krylov/precondition.h"
#include "algebra/matrix/rounded_stiffness.h"
#include "algebra/matrix/vector.h"
#include "algebra/saddle/means.h"
#include "core/error.h"
#include "core/memory.h"
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

/* A pass that does not reduce the true residual so far is a stall. The rounding limit is an estimate. */
static const double least_gain = 0.5;
enum { MOST_STALLS = 3 };

/* A vector of the system: of displacements, and of pressures with room for ghosts. */
typedef struct Pair {
    double *u, *p;
} Pair;

enum { SUM_AZ, SUM_RZ, SUM_P, SUMS };

typedef struct Run {
    OstContext *ctx;
    const OstCgSystem *system;
    const OstPreconditioner *preconditioner;
    const OstSaddle *saddle;
    const double *f;
    double *u;
    OstGoal *goal;
    size_t n, m, mg; /* unknowns, pressures, and these with ghosts */
    double *memory;
    Pair r, z, d, k;           /* residual, preconditioned; direction, and the system times it */
    double *az, *ad, *bz, *bd; /* A and B times z and d */
    double *w;                 /* N^-1 k, and other displacements */
    double *wide, *scaled;     /* z with ghosts; work of the preconditioner */
    double *q;                 /* pressures: work, with ghosts */
    double *work;              /* of ost_coupling_schur_solve */
    OstSoftMeans *means;       /* beside it, or NULL */
    double tau;
    double size; /* of r.u when z.u was last computed */
    double weight;
    double energy; /* of the right-hand sides, about */
    int passes, restarts;
    Pair start; /* u and p where the pass began */
    OstLanczos lanczos;
} Run;

static OstStatus create(Run *run)
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

static Run run_of(const OstCgSystem *system, const OstPreconditioner *preconditioner, const OstSaddle *saddle,
                  const double *f, double *u, OstGoal *goal)
{
    const OstCoupling *coupling = saddle->coupling;
    return (Run){.ctx = coupling->ctx,
                 .system = system,
                 .preconditioner = preconditioner,
                 .saddle = saddle,
                 .f = f,
                 .u = u,
                 .goal = goal,
                 .n = 3 * (size_t)coupling->unknowns,
                 .m = (size_t)coupling->rows,
                 .mg = (size_t)coupling->columns,
                 .tau = margin / (preconditioner && preconditioner->factors ? 1.0 : first_eigenvalue)};
}

static void destroy(Run *run)
{
    ost_soft_means_destroy(&run->means);
    OST_FREE(run->memory);
    ost_lanczos_destroy(&run->lanczos);
}

static OstStatus schur_solve(const Run *run, const double *r, double *z)
{
    OST_TRY(ost_coupling_schur_solve(run->saddle->coupling, r, z, run->work));
    return run->means ? ost_soft_means_add(run->means, r, z) : OST_SUCCESS;
}

/* --- norms --- */

/* The norm of the residual at hand. */
static OstStatus find_norm(Run *run, double *norm)
{
    double squares[OST_SADDLE_SQUARES];
    OST_TRY(schur_solve(run, run->r.p, run->q));
    OST_TRY(ost_saddle_squares(run->saddle->coupling, run->r.u, run->r.p, run->q, run->w, squares));
    *norm = sqrt(squares[OST_SADDLE_FORCE] +
                 run->goal->start * run->goal->start / run->energy * squares[OST_SADDLE_VOLUME]);
    return OST_SUCCESS;
}

/* About twice the energy of the solution: f·A^-1 f + g·S^-1 g. */
static OstStatus find_energy(Run *run)
{
    double sums[2];
    OST_TRY(ost_precondition(run->system, run->preconditioner, run->f, run->scaled, run->w));
    OST_TRY(schur_solve(run, run->saddle->g, run->q));
    sums[0] = ost_dot(run->n, run->f, run->w);
    sums[1] = ost_dot(run->m, run->saddle->g, run->q);
    OST_TRY(ost_sum(run->ctx, 2, sums));
    run->energy = sums[0] + sums[1];
    return OST_SUCCESS;
}

/* --- one iteration --- */

/* z.u = N^-1 r */
static OstStatus precondition(Run *run, const double *r, double *z)
{
    OST_TRY(ost_precondition(run->system, run->preconditioner, r, run->scaled, z));
    for (size_t i = 0; i < run->n; i++)
        z[i] *= run->tau;
    return OST_SUCCESS;
}

/* r = b - K x for the u and p reached, and its norm. */
static OstStatus find_residual(Run *run)
{
    const OstCoupling *coupling = run->saddle->coupling;
    memcpy(run->wide, run->u, run->n * sizeof(double));
    OST_TRY(ost_block_matrix_apply(run->system->matrix, run->wide, run->r.u));
    OST_TRY(ost_coupling_transpose(coupling, run->saddle->p, run->w));
    for (size_t i = 0; i < run->n; i++)
        run->r.u[i] = run->f[i] - run->r.u[i] - run->w[i];
    ost_coupling_multiply(coupling, run->wide, run->r.p);
    OST_TRY(ost_coupling_give_way(coupling, run->saddle->p, run->work));
    for (size_t i = 0; i < run->m; i++)
        run->r.p[i] = run->saddle->g[i] - run->r.p[i] + run->work[i];
    return find_norm(run, &run->goal->norm);
}

/* From z.u: A z and B z, z.p, and the weight z·Hz. Takes a larger tau where A - N proves not to be positive definite
 * (*again). */
static OstStatus complete(Run *run, int *again)
{
    const OstCoupling *coupling = run->saddle->coupling;
    double sums[SUMS];
    *again = 0;
    memcpy(run->wide, run->z.u, run->n * sizeof(double));
    OST_TRY(ost_block_matrix_apply(run->system->matrix, run->wide, run->az));
    ost_coupling_multiply(coupling, run->wide, run->bz);
    sums[SUM_AZ] = ost_dot(run->n, run->z.u, run->az);
    sums[SUM_RZ] = ost_dot(run->n, run->z.u, run->r.u);
    OST_TRY(ost_sum(run->ctx, 2, sums));
    if (sums[SUM_RZ] > 0.0 && sums[SUM_AZ] < 0.0)
        return ost_goal_refuse_indefinite(run->goal, sums[SUM_AZ]);
    if (sums[SUM_RZ] > 0.0 && sums[SUM_AZ] < near * sums[SUM_RZ] && sums[SUM_AZ] > 0.0) {
        const double larger = margin * sums[SUM_RZ] / sums[SUM_AZ];
        run->tau *= larger;
        for (size_t i = 0; i < run->n; i++) {
            run->z.u[i] *= larger;
            run->az[i] *= larger;
        }
        for (size_t i = 0; i < run->m; i++)
            run->bz[i] *= larger;
        sums[SUM_AZ] *= larger * larger;
        sums[SUM_RZ] *= larger;
        *again = 1;
        ost_log(run->ctx, OST_LOG_VERBOSE, "solver: the preconditioner is scaled by %.3g", run->tau);
    }
    for (size_t i = 0; i < run->m; i++)
        run->q[i] = run->bz[i] - run->r.p[i];
    OST_TRY(schur_solve(run, run->q, run->z.p));
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
static OstStatus turn(Run *run, double beta, double *curvature)
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
    OST_TRY(precondition(run, run->k.u, run->w));
    *curvature =
        ost_dot(run->n, run->k.u, run->w) - ost_dot(run->n, run->k.u, run->d.u) - ost_dot(run->m, run->k.p, run->d.p);
    return ost_sum(run->ctx, 1, curvature);
}

static void step(Run *run, double alpha)
{
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

/* z.u anew where that is due. */
static OstStatus renew(Run *run, int due)
{
    double square;
    OST_TRY(ost_vector_dot(run->ctx, run->n, run->r.u, run->r.u, &square));
    if (!due && sqrt(square) >= renew_below * run->size)
        return OST_SUCCESS;
    run->size = sqrt(square);
    return precondition(run, run->r.u, run->z.u);
}

/* The iteration lowers the squared error in its own norm, δ |e_u + A^-1 B'e_p|² + |e_p|² with S for p, where 1 + δ is
 * M^-1 A times tau: 1.1 and more. Of the energy of u and p, that is less by up to a factor of this. */
static const double of_energy = 3.0;

/* The size of u and p in the norm of the energy: u·A u + p·C p, of the solution. */
static OstStatus find_size(Run *run, double *size)
{
    double sums[2] = {ost_dot(run->n, run->f, run->u), ost_dot(run->m, run->saddle->g, run->saddle->p)};
    OST_TRY(ost_sum(run->ctx, 2, sums));
    *size = sqrt(fmax(sums[0] - sums[1], 0.0));
    return OST_SUCCESS;
}

/* Estimates the error of u and p, in the norm of the energy, where the goal's stop wants it, and asks that. */
static OstStatus judge_error(Run *run)
{
    OstGoal *goal = run->goal;
    OstAlgebraicError *error = &goal->error;
    if (!goal->stop || run->passes > 0)
        return OST_SUCCESS;
    ost_algebraic_error(&run->lanczos, error);
    goal->rate = ost_algebraic_error_rate(&run->lanczos, error);
    error->estimate *= of_energy;
    error->bound *= of_energy;
    if (!isfinite(error->estimate))
        return OST_SUCCESS;
    OST_TRY(find_size(run, &error->size));
    if (!(error->estimate <= ost_goal_next(goal)))
        return OST_SUCCESS;
    OST_TRY(goal->stop->ask(goal->stop->data, run->u, error->estimate, &goal->next));
    goal->enough = error->estimate <= goal->next;
    if (!(goal->next > 0.0))
        goal->stop = NULL;
    return OST_SUCCESS;
}

/* Steps of a pass. *broken: A - N proves not to be positive definite. */
static OstStatus iterate(Run *run, int *broken)
{
    OstGoal *goal = run->goal;
    const double most = grown * goal->norm;
    double before = 0.0, curvature, norm;
    int again;
    *broken = 0;
    OST_TRY(renew(run, 1));
    for (int first = 1;; first = 0) {
        OST_TRY(complete(run, &again));
        *broken = !(run->weight > 0.0 && isfinite(run->weight));
        if (*broken)
            return OST_SUCCESS;
        if (again && run->passes == 0)
            run->lanczos.count = 0; /* of another operator */
        OST_TRY(turn(run, first || again ? 0.0 : run->weight / before, &curvature));
        *broken = !(curvature > 0.0 && isfinite(curvature));
        if (*broken)
            return OST_SUCCESS;
        before = run->weight;
        if (run->passes == 0) /* a run of conjugate gradients; the passes that follow are others */
            ost_lanczos_add(&run->lanczos, run->weight / curvature, run->weight);
        step(run, run->weight / curvature);
        OST_TRY(find_norm(run, &norm));
        *broken = !(norm <= most);
        if (!ost_goal_count(goal, norm, run->weight) || *broken)
            return OST_SUCCESS;
        if (run->tau > most_tau && goal->patience > 0) {
            goal->end = OST_END_SLOW;
            snprintf(goal->words, sizeof goal->words,
                     "after %d iterations the smallest eigenvalue is found to be below %.1g: too slow",
                     goal->convergence.count, 1.0 / run->tau);
            return OST_SUCCESS;
        }
        OST_TRY(judge_error(run));
        if (goal->enough)
            return OST_SUCCESS;
        OST_TRY(renew(run, 0));
    }
}

/* A pass from the residual at hand. */
static OstStatus run_pass(Run *run)
{
    OstGoal *goal = run->goal;
    int broken;
    memcpy(run->start.u, run->u, run->n * sizeof(double));
    memcpy(run->start.p, run->saddle->p, run->m * sizeof(double));
    OST_TRY(iterate(run, &broken));
    while (broken && run->restarts++ < MOST_RESTARTS && goal->end == OST_END_REACHED) {
        run->tau *= enlarge;
        run->lanczos.count = 0;
        ost_log(run->ctx, OST_LOG_VERBOSE, "solver: begun again, the preconditioner scaled by %.3g", run->tau);
        memcpy(run->u, run->start.u, run->n * sizeof(double));
        memcpy(run->saddle->p, run->start.p, run->m * sizeof(double));
        OST_TRY(find_residual(run));
        OST_TRY(iterate(run, &broken));
    }
    if (broken && goal->end == OST_END_REACHED)
        ost_goal_accepts(goal, -1.0);
    return OST_SUCCESS;
}

/* --- passes --- */

static OstStatus find_limit(Run *run)
{
    double square;
    OST_TRY(ost_halo_import(run->system->matrix->halo, 3 * sizeof(double), run->wide));
    ost_term_rounding(run->system->matrix, run->wide, run->w);
    OST_TRY(ost_vector_dot(run->ctx, run->n, run->w, run->w, &square));
    run->goal->limit = sqrt(square);
    return OST_SUCCESS;
}

static OstStatus explain_end(Run *run)
{
    memcpy(run->wide, run->u, run->n * sizeof(double));
    OST_TRY(find_limit(run));
    ost_goal_explain_end(run->goal, "");
    return OST_SUCCESS;
}

static OstStatus run_passes(Run *run)
{
    OstGoal *goal = run->goal;
    int stalls = 0;
    OST_TRY(find_energy(run));
    if (!ost_goal_accepts(goal, run->energy))
        return OST_SUCCESS;
    OST_TRY(find_residual(run));
    ost_convergence_start(&goal->convergence, goal->norm);
    while (goal->end == OST_END_REACHED && goal->norm > goal->target && stalls < MOST_STALLS && !goal->enough) {
        const double before = goal->norm;
        OST_TRY(run_pass(run));
        run->passes++;
        OST_TRY(find_residual(run));
        stalls = goal->norm < least_gain * before ? 0 : stalls + 1;
    }
    if (goal->norm > goal->target && !goal->enough)
        return explain_end(run);
    goal->end = OST_END_REACHED;
    return OST_SUCCESS;
}

/* The norm of the pressure that an error of volume r is worth, in that of the energy: r·S^-1 r. */
static OstStatus worth(Run *run, const double *r, double *norm)
{
    OST_TRY(schur_solve(run, r, run->q));
    double square = ost_dot(run->m, run->q, r);
    OST_TRY(ost_sum(run->ctx, 1, &square));
    *norm = sqrt(square);
    return OST_SUCCESS;
}

/* The error of u and p is the solution for the residual: one application of the preconditioner over the smallest
 * eigenvalue is taken for it, as for A alone (energy_error.h). That of p has two parts, which may be of one sign: what
 * u's residual leaves of volume, and the second equation's own. */
static OstStatus report_error(Run *run, OstSolveReport *report)
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
    OST_TRY(precondition(run, run->r.u, run->z.u));
    OST_TRY(complete(run, &again));
    OST_TRY(worth(run, run->bz, &of_u));
    OST_TRY(worth(run, run->r.p, &of_p));
    OST_TRY(find_size(run, &size));
    OST_TRY(ost_coupling_transpose(run->saddle->coupling, run->z.p, run->w));
    for (size_t i = 0; i < run->n; i++)
        run->k.u[i] = run->r.u[i] - run->w[i]; /* the displacement that the pressure's error brings with it */
    OST_TRY(precondition(run, run->k.u, run->z.u));
    squares[0] = ost_dot(run->n, run->z.u, run->z.u);
    squares[1] = ost_dot(run->n, run->u, run->u);
    OST_TRY(ost_sum(run->ctx, 2, squares));
    if (squares[1] > 0.0)
        report->error_estimate = sqrt(squares[0] / squares[1]) / smallest;
    report->energy_error = fmax(report->error_estimate, size > 0.0 ? (of_u + of_p) / size / smallest : 0.0);
    return OST_SUCCESS;
}

/* --- by factors of both equations --- */

/* Corrections by factors are taken while each is this share of the one before. After that they are the rounding of
 * residuals, each a random sample of the error: their root mean square, with some caution, is stated. */
static const double shrinks = 0.5, caution = 1.5, no_change = 1e-16;
enum { MOST_CORRECTIONS = 30, SAMPLES = 4 };

/* The sizes of the correction at hand, relative to u and to the energy. */
static OstStatus measure_correction(Run *run, double *of_u, double *of_p)
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
static OstStatus take_energy(Run *run)
{
    double size;
    OST_TRY(find_size(run, &size));
    run->energy = size > 0.0 ? size * size : INFINITY;
    return OST_SUCCESS;
}

static void take_correction(Run *run)
{
    for (size_t i = 0; i < run->n; i++)
        run->u[i] += run->z.u[i];
    for (size_t i = 0; i < run->m; i++)
        run->saddle->p[i] += run->z.p[i];
}

/* Until corrections no longer shrink; the last one is not taken. */
static OstStatus correct(Run *run, const OstSaddleFactors *factors, double *of_u, double *of_p)
{
    double before = INFINITY, u, p, squares[2] = {0.0};
    int samples = 0;
    for (int k = 0; k < MOST_CORRECTIONS; k++) {
        OST_TRY(find_residual(run));
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
    Run run = run_of(system, NULL, saddle, f, u, goal);
    double of_u = 0.0, of_p = 0.0;
    goal->end = OST_END_REACHED;
    if (goal->start == 0.0)
        return OST_SUCCESS;
    OstStatus status;
    OST_TRY_DONE(create(&run));
    run.energy = INFINITY;
    OST_TRY_DONE(correct(&run, factors, &of_u, &of_p));
    goal->limit = goal->norm; /* what the factors cannot correct is rounding */
    if (!(goal->norm <= goal->target))
        ost_goal_explain_end(goal, "");
    report->error_estimate = caution * of_u;
    report->energy_error = caution * fmax(of_u, of_p);
done:
    destroy(&run);
    return status;
}

static int is_digit_left(const OstSolveReport *report)
{
    return report->error_estimate > 0.0 && report->error_estimate < ost_least_digit;
}

/* The residual is as small as rounding allows, but so small an eigenvalue was met that nothing is known of u. Factors
 * do not go by eigenvalues. */
static void leave_rounding(OstGoal *goal)
{
    if (goal->end != OST_END_ROUNDING)
        return;
    goal->end = OST_END_STALLED;
    snprintf(goal->words, sizeof goal->words, "after %d iterations the residual is rounding's, but u is not known",
             goal->convergence.count);
}

OstStatus ost_saddle_solve(const OstCgSystem *system, const OstPreconditioner *preconditioner, const OstSaddle *saddle,
                           const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    Run run = run_of(system, preconditioner, saddle, f, u, goal);
    goal->end = OST_END_REACHED;
    if (goal->start == 0.0)
        return OST_SUCCESS;
    OstStatus status;
    OST_TRY_DONE(create(&run));
    OST_TRY_DONE(ost_soft_means_create(system, preconditioner, saddle->coupling, &run.means));
    OST_TRY_DONE(run_passes(&run));
    OST_TRY_DONE(report_error(&run, report));
    if (!goal->crude && !is_digit_left(report))
        leave_rounding(goal);
done:
    ost_progress(run.ctx, "solve", -1.0);
    destroy(&run);
    return status;
}
