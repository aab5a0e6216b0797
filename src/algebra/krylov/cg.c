/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/krylov/cg.h"

#include "algebra/krylov/energy_error.h"
#include "algebra/krylov/lanczos.h"
#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Of p·Dp, D being A's diagonal: what rounding may leave of p·Ap, some tens of units in the last place. */
static const double rounding = 1e-13;

/* What each pass for a hidden displacement takes from the residual, and how many there are at most. */
static const double pass_gain = 1e-2;

enum { MOST_PASSES = 8 };

typedef struct Cg {
    OstContext *ctx;
    const OstCgSystem *system;
    const OstPreconditioner *preconditioner;
    size_t n;          /* unknowns this rank owns */
    double *direction; /* p */
    double *unscaled;  /* S^T p, with room for ghosts */
    double *product;   /* A' p */
    double *residual;  /* r' */
    double *corrected; /* z */
    double energy;     /* p·A'p of the last direction */
    double weight;     /* r·z of the last direction */
    int blind;         /* rounding hides that energy: p does not lead to a next direction */
    double size;       /* what r' was divided by, a power of two */
    int runs;
    OstLanczos lanczos;       /* of the first run, since it was cleared */
    double smallest, largest; /* eigenvalues of M^-1 A, by all of these */
    int hidden;               /* is the displacement where the energy, and so the residual, has little to say? */
} Cg;

static OstStatus sum(const Cg *cg, int count, double *values)
{
    return OST_MPI(cg->ctx, MPI_Allreduce(MPI_IN_PLACE, values, count, MPI_DOUBLE, MPI_SUM, ost_comm(cg->ctx)));
}

static double dot(size_t n, const double *restrict a, const double *restrict b)
{
    double total = 0.0;
#pragma omp simd reduction(+ : total)
    for (size_t i = 0; i < n; i++)
        total += a[i] * b[i];
    return total;
}

/* Norm of the unscaled residual that the recursion holds. */
static OstStatus recursive_norm(const Cg *cg, double *norm)
{
    double square = cg->system->scaling ? ost_scaling_residual_square(cg->system->scaling, cg->residual)
                                        : dot(cg->n, cg->residual, cg->residual);
    OST_TRY(sum(cg, 1, &square));
    *norm = cg->size * sqrt(square);
    return OST_SUCCESS;
}

/* z = M^-1 r, and the next direction p = z + beta p. */
static OstStatus next_direction(Cg *cg, OstGoal *goal, int first, double *beta)
{
    const int flexible = cg->preconditioner->flexible && !first;
    OST_TRY(cg->preconditioner->apply(cg->preconditioner->data, cg->residual, cg->corrected));
    double sums[2] = {dot(cg->n, cg->residual, cg->corrected), flexible ? dot(cg->n, cg->corrected, cg->product) : 0.0};
    OST_TRY(sum(cg, 2, sums));
    if (!ost_goal_accepts(goal, sums[0]))
        return OST_SUCCESS;
    *beta = first ? 0.0 : flexible ? -sums[1] / cg->energy : sums[0] / cg->weight;
    cg->weight = sums[0];
    for (size_t i = 0; i < cg->n; i++)
        cg->direction[i] = cg->corrected[i] + (first ? 0.0 : *beta * cg->direction[i]);
    return OST_SUCCESS;
}

/* A' p = S (A (S^T p)). */
static OstStatus find_product(Cg *cg)
{
    const OstScaling *scaling = cg->system->scaling;
    if (scaling)
        ost_scaling_from_scaled(scaling, cg->direction, cg->unscaled);
    else
        memcpy(cg->unscaled, cg->direction, cg->n * sizeof *cg->unscaled);
    OST_TRY(ost_block_matrix_apply(cg->system->matrix, cg->unscaled, cg->product));
    if (scaling)
        ost_scaling_to_scaled(scaling, cg->product, cg->product);
    return OST_SUCCESS;
}

/* p·Dp: beside that, rounding hides what is small of p·Ap and may turn its sign. */
static OstStatus size_energy(const Cg *cg, double *size)
{
    const OstBlockMatrix *matrix = cg->system->matrix;
    *size = 0.0;
    for (OstLocal i = 0; i < matrix->rows; i++) {
        const double *block = matrix->value + 9 * (size_t)matrix->diagonal[i], *p = cg->unscaled + 3 * (size_t)i;
        *size += fabs(block[0]) * p[0] * p[0] + fabs(block[4]) * p[1] * p[1] + fabs(block[8]) * p[2] * p[2];
    }
    return sum(cg, 1, size);
}

/* p·Ap is not positive. */
static OstStatus judge_energy(const Cg *cg, OstGoal *goal)
{
    double size;
    OST_TRY(size_energy(cg, &size));
    if (cg->energy < -rounding * size)
        return ost_goal_refuse_indefinite(goal, cg->energy);
    goal->end = OST_END_STALLED;
    snprintf(goal->words, sizeof goal->words,
             "in iteration %d p·Ap = %g beside p·Dp = %g: the stiffness is singular to rounding", goal->iterations + 1,
             cg->energy, size);
    return OST_SUCCESS;
}

/* Factors made p: is p·Ap no more than rounding, or rounding so near that who asked finds the step? */
static OstStatus look_for_rounding(Cg *cg, const OstGoal *goal)
{
    double size;
    cg->blind = cg->preconditioner->factors && goal->exact;
    if (!cg->preconditioner->factors || goal->exact)
        return OST_SUCCESS;
    OST_TRY(size_energy(cg, &size));
    cg->blind = fabs(cg->energy) <= rounding * size;
    return OST_SUCCESS;
}

/* The step along p that leaves the least energy; all of p, where the energy is not to be seen. */
static OstStatus step(Cg *cg, OstGoal *goal, double *u, double *alpha)
{
    OST_TRY(find_product(cg));
    double sums[2] = {dot(cg->n, cg->direction, cg->product), dot(cg->n, cg->direction, cg->residual)};
    OST_TRY(sum(cg, 2, sums));
    cg->energy = sums[0];
    OST_TRY(look_for_rounding(cg, goal));
    if (!cg->blind && !(cg->energy > 0.0 && isfinite(cg->energy)))
        return judge_energy(cg, goal);
    *alpha = cg->blind ? 1.0 : sums[1] / sums[0];
    for (size_t i = 0; i < cg->n; i++) {
        u[i] += *alpha * cg->direction[i];
        cg->residual[i] -= *alpha * cg->product[i];
    }
    return OST_SUCCESS;
}

static OstStatus iterate(Cg *cg, double *u, OstGoal *goal)
{
    double norm;
    OST_TRY(recursive_norm(cg, &norm));
    int on = (norm > goal->target || goal->settled > 0.0) && goal->iterations < goal->most_iterations;
    for (int first = 1; on; first = 0) {
        double alpha = 0.0;
        double beta = 0.0;
        OST_TRY(next_direction(cg, goal, first, &beta));
        if (goal->end == OST_END_REACHED)
            OST_TRY(step(cg, goal, u, &alpha));
        if (goal->end != OST_END_REACHED)
            return OST_SUCCESS;
        if (cg->runs == 0)
            ost_lanczos_add(&cg->lanczos, alpha, beta);
        OST_TRY(recursive_norm(cg, &norm));
        on = ost_goal_count(goal, norm, cg->size * cg->size * cg->weight) && !cg->blind;
    }
    return OST_SUCCESS;
}

/* Brings r' to order 1, whatever the units: preconditioners work in single precision too. */
static OstStatus normalise(Cg *cg)
{
    OST_TRY(ost_vector_size(cg->ctx, cg->n, cg->residual, &cg->size));
    for (size_t i = 0; i < cg->n; i++)
        cg->residual[i] /= cg->size;
    return OST_SUCCESS;
}

/* OstInnerSolve: A u = r by way of A' u' = S r, u = S^T u'. */
static OstStatus solve_scaled(void *data, const double *r, double *u, OstGoal *goal)
{
    Cg *cg = data;
    const OstScaling *scaling = cg->system->scaling;
    if (scaling)
        ost_scaling_to_scaled(scaling, r, cg->residual);
    else
        memcpy(cg->residual, r, cg->n * sizeof *r);
    OST_TRY(normalise(cg));
    const OstStatus status = iterate(cg, u, goal);
    for (size_t i = 0; i < cg->n; i++)
        u[i] *= cg->size;
    if (scaling)
        ost_scaling_from_scaled(scaling, u, u);
    cg->runs++;
    return status;
}

static OstStatus cg_allocate(Cg *cg, int steps)
{
    OST_TRY(OST_NEW(cg->ctx, &cg->direction, cg->n));
    OST_TRY(OST_NEW(cg->ctx, &cg->unscaled, 3 * (size_t)cg->system->matrix->columns));
    OST_TRY(OST_NEW(cg->ctx, &cg->product, cg->n));
    OST_TRY(OST_NEW(cg->ctx, &cg->residual, cg->n));
    OST_TRY(OST_NEW(cg->ctx, &cg->corrected, cg->n));
    return ost_lanczos_create(cg->ctx, steps, &cg->lanczos);
}

/* What the coefficients say of the spectrum. */
static void note_spectrum(Cg *cg)
{
    double smallest, largest;
    ost_lanczos_extremes(&cg->lanczos, &smallest, &largest);
    cg->smallest = cg->smallest > 0.0 && smallest > 0.0 ? fmin(cg->smallest, smallest) : fmax(cg->smallest, smallest);
    cg->largest = fmax(cg->largest, largest);
    cg->lanczos.count = 0;
    cg->runs = 0;
}

/* That, and so the error of u; nothing where M is not definite. */
static OstStatus report_error(Cg *cg, const double *f, const double *u, const OstGoal *goal, OstSolveReport *report)
{
    OstEnergyError error = {.whole = NAN};
    note_spectrum(cg);
    if (cg->smallest > 0.0 && goal->end != OST_END_PRECONDITIONER)
        OST_TRY(ost_energy_error(cg->system, cg->preconditioner, cg->smallest, f, u, goal->exact, &error));
    const int known = !isnan(error.whole) && !isnan(error.rounding);
    report->condition_estimate = cg->smallest > 0.0 ? cg->largest / cg->smallest : 0.0;
    /* Factors whose steps do not settle are what rounding made them. */
    report->error_estimate = known ? fmax(error.whole, goal->drift) : 0.0;
    report->energy_error = known ? fmax(error.energy, goal->drift) : 0.0;
    report->rounding_error = known ? fmax(error.rounding, goal->drift) : 0.0;
    report->rounding_spread = known && error.rounding >= goal->drift ? error.spread : 0.0;
    cg->hidden = known && error.hidden;
    return OST_SUCCESS;
}

/* Solves for what is left; u stays where the goal would then be missed. Returns whether more may be had in `on`. */
static OstStatus go_on(Cg *cg, const double *f, double *u, double *before, OstGoal *goal, int *on)
{
    OstGoal further = *goal;
    further.target = pass_gain * goal->norm;
    memcpy(before, u, cg->n * sizeof *u);
    OST_TRY(ost_refine(cg->system->matrix, solve_scaled, cg, f, u, &further));
    *on = further.end == OST_END_REACHED;
    goal->iterations = further.iterations;
    if (further.norm > goal->target) {
        memcpy(u, before, cg->n * sizeof *u);
        *on = 0;
        return OST_SUCCESS;
    }
    goal->norm = further.norm;
    goal->exact = further.exact;
    return OST_SUCCESS;
}

/* The residual asked for is reached, but by the part of the body that has the energy: the displacement of another is
 * hardly solved for, and nor was its part of the spectrum seen. So a smaller residual is asked for, until it is. */
static OstStatus solve_for_the_hidden(Cg *cg, const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    double *before = NULL;
    OST_TRY(ost_agree(cg->ctx, OST_NEW(cg->ctx, &before, cg->n)));
    OstStatus status = OST_SUCCESS;
    const double asked = goal->target / goal->start;
    for (int pass = 0, on = 1; pass < MOST_PASSES && on && cg->hidden && status == OST_SUCCESS; pass++) {
        if (report->error_estimate <= asked)
            break;
        status = go_on(cg, f, u, before, goal, &on);
        if (status == OST_SUCCESS)
            status = report_error(cg, f, u, goal, report);
    }
    OST_FREE(before);
    return status;
}

OstStatus ost_cg_solve(const OstCgSystem *system, const OstPreconditioner *preconditioner, const double *f, double *u,
                       OstGoal *goal, OstSolveReport *report)
{
    OstContext *ctx = system->matrix->ctx;
    Cg cg = {.ctx = ctx, .system = system, .preconditioner = preconditioner, .n = 3 * (size_t)system->matrix->rows};
    OstStatus status;
    OST_TRY_DONE(ost_agree(ctx, cg_allocate(&cg, goal->most_iterations)));
    OST_TRY_DONE(ost_refine(system->matrix, solve_scaled, &cg, f, u, goal));
    OST_TRY_DONE(report_error(&cg, f, u, goal, report));
    if (cg.hidden && goal->end == OST_END_REACHED)
        OST_TRY_DONE(solve_for_the_hidden(&cg, f, u, goal, report));
done:
    OST_FREE(cg.direction);
    OST_FREE(cg.unscaled);
    OST_FREE(cg.product);
    OST_FREE(cg.residual);
    OST_FREE(cg.corrected);
    ost_lanczos_destroy(&cg.lanczos);
    return status;
}
