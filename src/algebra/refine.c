/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/refine.h"

#include "core/error.h"
#include "core/memory.h"

#include <float.h>
#include <math.h>
#include <string.h>

/* Solving again for the recomputed residual must gain this much, or rounding rules. */
static const double least_gain = 0.5;

typedef struct Refinement {
    const OstBlockMatrix *matrix;
    const double *f;
    double *u;
    size_t n;           /* unknowns this rank owns */
    double *residual;   /* f - A u */
    double *correction; /* of u */
    double *ghosted;    /* 3 × columns */
    OstGoal goal;
} Refinement;

void ost_goal_progress(const OstGoal *goal, double norm)
{
    const double whole = log(goal->start / goal->target);
    ost_progress(goal->ctx, "solve", whole > 0.0 ? fmin(fmax(log(goal->start / norm) / whole, 0.0), 1.0) : 1.0);
}

OstStatus ost_goal_require_positive(const OstGoal *goal, double value, const char *form, const char *what)
{
    if (value > 0.0 && isfinite(value))
        return OST_SUCCESS;
    const char *sign = !isfinite(value) ? "is not finite" : value < 0.0 ? "is negative" : "is zero";
    return OST_RAISE(goal->ctx, OST_NOT_CONVERGED,
                     "iteration %d: %s = %g %s: %s is not positive definite; check supports and materials, or ask for "
                     "the direct solver",
                     goal->iterations + 1, form, value, sign, what);
}

static OstStatus root_of_sum(OstContext *ctx, double square, double *norm)
{
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, &square, 1, MPI_DOUBLE, MPI_SUM, ost_comm(ctx))));
    *norm = sqrt(square);
    return OST_SUCCESS;
}

static OstStatus norm_of(const Refinement *refinement, const double *values, double *norm)
{
    double square = 0.0;
    for (size_t i = 0; i < refinement->n; i++)
        square += values[i] * values[i];
    return root_of_sum(refinement->matrix->ctx, square, norm);
}

static OstStatus recompute_residual(Refinement *refinement, double *norm)
{
    memcpy(refinement->ghosted, refinement->u, refinement->n * sizeof(double));
    OST_TRY(ost_block_matrix_apply(refinement->matrix, refinement->ghosted, refinement->residual));
    for (size_t i = 0; i < refinement->n; i++)
        refinement->residual[i] = refinement->f[i] - refinement->residual[i];
    return norm_of(refinement, refinement->residual, norm);
}

/* Sum of the squares of the terms of (A u)_i, i being component c of a row. */
static double square_of_terms(const OstBlockMatrix *matrix, OstLocal row, int c, const double *u)
{
    double total = 0.0;
    for (OstLocal k = matrix->row_start[row]; k < matrix->row_start[row + 1]; k++)
        for (int d = 0; d < 3; d++) {
            const double term = matrix->value[9 * (size_t)k + (size_t)(3 * c + d)] * u[3 * matrix->column[k] + d];
            total += term * term;
        }
    return total;
}

/* About how small ||f - A u|| / ||f|| can be in double precision, each term of A u being rounded at random. */
static OstStatus attainable_residual(const Refinement *refinement, double *limit)
{
    const OstBlockMatrix *matrix = refinement->matrix;
    double square = 0.0;
    memcpy(refinement->ghosted, refinement->u, refinement->n * sizeof(double));
    OST_TRY(ost_halo_import(matrix->halo, 3 * sizeof(double), refinement->ghosted));
    for (OstLocal i = 0; i < matrix->rows; i++)
        for (int c = 0; c < 3; c++)
            square += square_of_terms(matrix, i, c, refinement->ghosted);
    OST_TRY(root_of_sum(matrix->ctx, square, limit));
    *limit *= DBL_EPSILON / refinement->goal.start;
    return OST_SUCCESS;
}

static OstStatus raise_not_converged(const Refinement *refinement, double reached, double requested)
{
    OstContext *ctx = refinement->matrix->ctx;
    const OstGoal *goal = &refinement->goal;
    if (goal->iterations >= goal->most_iterations)
        return OST_RAISE(ctx, OST_NOT_CONVERGED,
                         "after %d iterations, the most allowed, the relative residual is %.3g, not the requested "
                         "%.3g; allow more iterations or ask for another recipe",
                         goal->iterations, reached, requested);
    double limit = 0.0;
    OST_TRY(attainable_residual(refinement, &limit));
    return OST_RAISE(ctx, OST_NOT_CONVERGED,
                     "after %d iterations the relative residual stays at %.3g, not the requested %.3g; rounding in "
                     "double precision allows about %.1g here: ask for no less, or look for what makes the stiffness "
                     "so uneven",
                     goal->iterations, reached, requested, limit);
}

static OstStatus refine(Refinement *refinement, OstInnerSolve inner, void *data, const OstSolverOptions *options,
                        OstSolveReport *report)
{
    OstGoal *goal = &refinement->goal;
    double norm = goal->start;
    double before;
    memcpy(refinement->residual, refinement->f, refinement->n * sizeof(double));
    do {
        before = norm;
        memset(refinement->correction, 0, refinement->n * sizeof(double));
        const OstStatus status = inner(data, refinement->residual, refinement->correction, goal);
        for (size_t i = 0; i < refinement->n; i++)
            refinement->u[i] += refinement->correction[i];
        OST_TRY(recompute_residual(refinement, &norm));
        report->relative_residual = norm / goal->start;
        OST_TRY(status);
    } while (norm > goal->target && norm < least_gain * before && goal->iterations < goal->most_iterations);
    /* Not "norm > target": that would let a residual that is no number pass. */
    return norm <= goal->target
               ? OST_SUCCESS
               : raise_not_converged(refinement, report->relative_residual, options->relative_residual);
}

static OstStatus prepare(Refinement *refinement)
{
    OstContext *ctx = refinement->matrix->ctx;
    OST_TRY(OST_NEW(ctx, &refinement->residual, refinement->n));
    OST_TRY(OST_NEW(ctx, &refinement->correction, refinement->n));
    return OST_NEW(ctx, &refinement->ghosted, 3 * (size_t)refinement->matrix->columns);
}

OstStatus ost_refine(const OstBlockMatrix *matrix, OstInnerSolve inner, void *data, const double *f, double *u,
                     const OstSolverOptions *options, OstSolveReport *report)
{
    OstContext *ctx = matrix->ctx;
    Refinement refinement = {.matrix = matrix, .f = f, .u = u, .n = 3 * (size_t)matrix->rows};
    OstGoal *goal = &refinement.goal;
    report->iterations = 0;
    report->relative_residual = 0.0;
    memset(u, 0, refinement.n * sizeof *u);
    goal->ctx = ctx;
    goal->most_iterations = options->max_iterations;
    OstStatus status;
    OST_TRY_DONE(ost_agree(ctx, prepare(&refinement)));
    OST_TRY_DONE(norm_of(&refinement, f, &goal->start));
    goal->target = options->relative_residual * goal->start;
    if (!isfinite(goal->start))
        OST_TRY_DONE(OST_RAISE(ctx, OST_INVALID_INPUT, "the right-hand side holds a number that is not finite"));
    if (goal->start > 0.0)
        OST_TRY_DONE(refine(&refinement, inner, data, options, report));
done:
    ost_progress(ctx, "solve", -1.0);
    report->iterations = goal->iterations;
    OST_FREE(refinement.residual);
    OST_FREE(refinement.correction);
    OST_FREE(refinement.ghosted);
    return status;
}
