/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/trilinos/plain.h"

#include "algebra/matrix/scaling.h"
#include "algebra/trilinos/ml_matrix.h"
#include "algebra/trilinos/plain_cg.h"
#include "core/error.h"
#include "core/memory.h"

#include <string.h>

enum {
    FINEST = 0,
    EIGENVALUE_STEPS = 30, /* of ML's conjugate gradients for the largest eigenvalue of a level */
    LARGEST_FOR_KLU = 2000 /* unknowns of the coarsest level; above, MUMPS is faster */
};

/* The eigenvalue comes from below, and a Chebyshev polynomial that ends short of the spectrum is not definite. */
static const double eigenvalue_margin = 1.2;

struct OstPlain {
    const OstBlockMatrix *matrix;
    ML *ml;
    ML_Aggregate *aggregates;
    OstMlMatrix *link;
    int levels;
    OstGlobal level_unknowns[OST_MAX_LEVELS];
    double operator_complexity;
};

void ost_plain_destroy(OstPlain **plain)
{
    if (!*plain)
        return;
    if ((*plain)->aggregates)
        ML_Aggregate_Destroy(&(*plain)->aggregates);
    if ((*plain)->ml)
        ML_Destroy(&(*plain)->ml);
    ost_ml_matrix_destroy(&(*plain)->link);
    OST_FREE(*plain);
}

static OstStatus set_aggregation(OstPlain *plain, const double *modes, const OstSolverOptions *options)
{
    OstContext *ctx = plain->matrix->ctx;
    if (ML_Aggregate_Create(&plain->aggregates) != 0)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML_Aggregate_Create failed");
    ML_Aggregate *aggregates = plain->aggregates;
    ML_Aggregate_Set_MaxLevels(aggregates, OST_MAX_LEVELS);
    ML_Aggregate_Set_MaxCoarseSize(aggregates, options->coarsest_unknowns);
    ML_Aggregate_Set_CoarsenScheme_Uncoupled(aggregates);
    ML_Aggregate_Set_Threshold(aggregates, 0.0);
    ML_Aggregate_Set_DampingFactor(aggregates, 4.0 / 3.0);
    ML_Set_SpectralNormScheme_Calc(plain->ml);
    if (ML_Aggregate_Set_NullSpace(aggregates, 3, modes ? 6 : 3, (double *)modes, 3 * plain->matrix->rows) != 0)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML would not take the near-null space");
    return OST_SUCCESS;
}

static OstStatus coarsen(OstPlain *plain)
{
    OstContext *ctx = plain->matrix->ctx;
    plain->levels = ML_Gen_MultiLevelHierarchy_UsingAggregation(plain->ml, FINEST, ML_INCREASING, plain->aggregates);
    OST_TRY(ost_ml_check(plain->link));
    if (plain->levels < 1)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML made no hierarchy (%d levels)", plain->levels);
    return OST_SUCCESS;
}

/* Unknowns and nonzeros of the levels over all ranks. */
static OstStatus measure(OstPlain *plain)
{
    OstContext *ctx = plain->matrix->ctx;
    OstGlobal counts[2][OST_MAX_LEVELS] = {{0}};
    OstGlobal nonzeros = 0;
    for (int level = 0; level < plain->levels; level++) {
        counts[0][level] = plain->ml->Amat[level].outvec_leng;
        counts[1][level] = plain->ml->Amat[level].N_nonzeros;
    }
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, counts, 2 * OST_MAX_LEVELS, MPI_INT64_T, MPI_SUM, ost_comm(ctx))));
    for (int level = 0; level < plain->levels; level++) {
        plain->level_unknowns[level] = counts[0][level];
        nonzeros += counts[1][level];
    }
    plain->operator_complexity = (double)nonzeros / (double)counts[1][FINEST];
    return OST_SUCCESS;
}

static OstStatus set_smoothers(OstPlain *plain, const OstSolverOptions *options)
{
    OstContext *ctx = plain->matrix->ctx;
    ML *ml = plain->ml;
    const int coarsest = plain->levels - 1;
    ml->Cheby_eig_boost = eigenvalue_margin;
    for (int level = FINEST; level < coarsest; level++) {
        ML_Operator *matrix = &ml->Amat[level];
        ML_Operator_Set_SpectralNormScheme_Calc(matrix);
        ML_Operator_Set_SpectralNorm_Iterations(matrix, EIGENVALUE_STEPS);
        matrix->lambda_max = -666.666; /* ML's mark for "not known yet": the prolongator's estimate took few steps */
        if (ML_Gen_Smoother_Cheby(ml, level, ML_BOTH, options->smoother_ratio, options->smoother_degree) != 0)
            return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML has no Chebyshev smoother for level %d", level);
    }
    const int solver = plain->level_unknowns[coarsest] > LARGEST_FOR_KLU ? ML_AMESOS_MUMPS : ML_AMESOS_KLU;
    if (ML_Gen_Smoother_Amesos(ml, coarsest, solver, -1, 0.0, 1) != 0)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "Amesos could not factor the coarsest level (%lld unknowns)",
                         (long long)plain->level_unknowns[coarsest]);
    if (coarsest > FINEST && ML_Gen_Solver(ml, ML_MGV, FINEST, coarsest) != 0)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML_Gen_Solver failed");
    return ost_ml_check(plain->link);
}

/* What ML and Amesos would take badly (a failed factorisation prints, and dumps the matrix to files) is refused first.
 */
static OstStatus check_diagonal(const OstBlockMatrix *matrix)
{
    OstScaling *scaling = NULL;
    const OstStatus status = ost_scaling_create(matrix, &scaling);
    ost_scaling_destroy(&scaling);
    return status;
}

OstStatus ost_plain_create(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                           const OstSolverOptions *options, OstPlain **plain)
{
    OstContext *ctx = matrix->ctx;
    OstPlain *made = NULL;
    *plain = NULL;
    OstStatus status;
    OST_TRY_DONE(check_diagonal(matrix));
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &made, 1)));
    made->matrix = matrix;
    OST_TRY_DONE(ost_agree(ctx, ost_ml_create(ctx, OST_MAX_LEVELS, &made->ml)));
    OST_TRY_DONE(ost_ml_set_matrix(made->ml, FINEST, matrix, &made->link));
    OST_TRY_DONE(ost_agree(ctx, set_aggregation(made, geometry->modes, options)));
    OST_TRY_DONE(coarsen(made));
    OST_TRY_DONE(measure(made));
    OST_TRY_DONE(ost_agree(ctx, set_smoothers(made, options)));
done:
    if (status != OST_SUCCESS)
        ost_plain_destroy(&made);
    *plain = made;
    return status;
}

static OstStatus cycle(void *data, const double *r, double *z)
{
    OstPlain *plain = data;
    const int n = 3 * plain->matrix->rows;
    memset(z, 0, (size_t)n * sizeof *z);
    if (plain->levels > 1)
        ML_Solve_MGV(plain->ml, (double *)r, z);
    else /* ML has no cycle of one level (it would print a warning), but the direct solve is there */
        ML_Smoother_Apply(&plain->ml->post_smoother[FINEST], n, z, n, (double *)r, ML_ZERO);
    return plain->link->status;
}

OstStatus ost_plain_solve(OstPlain *plain, const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    const OstPreconditioner v_cycle = {.data = plain, .apply = cycle, .flexible = 0};
    report->levels = plain->levels;
    memcpy(report->level_unknowns, plain->level_unknowns, sizeof plain->level_unknowns);
    report->operator_complexity = plain->operator_complexity;
    report->condition_estimate = report->error_estimate = report->energy_error = report->rounding_error =
        report->rounding_spread = 0.0;
    return ost_aztec_solve(plain->matrix, &v_cycle, f, u, goal);
}
