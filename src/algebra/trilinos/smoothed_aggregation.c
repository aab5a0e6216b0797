/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/trilinos/smoothed_aggregation.h"

#include "algebra/matrix/scaling.h"
#include "algebra/trilinos/ml.h"
#include "core/error.h"
#include "core/memory.h"

#include <string.h>

enum {
    FINEST = 0,
    EIGENVALUE_STEPS = 30, /* of ML's conjugate gradients for the largest eigenvalue of a level */
    LARGEST_FOR_KLU = 2000 /* unknowns of the coarsest level; above that MUMPS is faster */
};

/* The estimate approaches the eigenvalue from below; a Chebyshev polynomial is indefinite beyond its interval. */
static const double eigenvalue_margin = 1.2;

struct OstSmoothedAggregation {
    const OstBlockMatrix *matrix;
    ML *ml;
    ML_Aggregate *aggregates;
    OstMlMatrix *link;
    int levels;
    OstGlobal level_unknowns[OST_MAX_LEVELS];
    double operator_complexity;
};

void ost_smoothed_aggregation_destroy(OstSmoothedAggregation **hierarchy)
{
    if (!*hierarchy)
        return;
    if ((*hierarchy)->aggregates)
        ML_Aggregate_Destroy(&(*hierarchy)->aggregates);
    if ((*hierarchy)->ml)
        ML_Destroy(&(*hierarchy)->ml);
    ost_ml_matrix_destroy(&(*hierarchy)->link);
    OST_FREE(*hierarchy);
}

static OstStatus set_aggregation(OstSmoothedAggregation *hierarchy, const double *modes,
                                 const OstSolverOptions *options)
{
    OstContext *ctx = hierarchy->matrix->ctx;
    if (ML_Aggregate_Create(&hierarchy->aggregates) != 0)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML_Aggregate_Create failed");
    ML_Aggregate *aggregates = hierarchy->aggregates;
    ML_Aggregate_Set_MaxLevels(aggregates, OST_MAX_LEVELS);
    ML_Aggregate_Set_MaxCoarseSize(aggregates, options->coarsest_unknowns);
    ML_Aggregate_Set_CoarsenScheme_Uncoupled(aggregates);
    ML_Aggregate_Set_Threshold(aggregates, 0.0);
    ML_Aggregate_Set_DampingFactor(aggregates, 4.0 / 3.0);
    ML_Set_SpectralNormScheme_Calc(hierarchy->ml);
    if (ML_Aggregate_Set_NullSpace(aggregates, 3, modes ? 6 : 3, (double *)modes, 3 * hierarchy->matrix->rows) != 0)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML_Aggregate_Set_NullSpace failed");
    return OST_SUCCESS;
}

static OstStatus coarsen(OstSmoothedAggregation *hierarchy)
{
    OstContext *ctx = hierarchy->matrix->ctx;
    hierarchy->levels =
        ML_Gen_MultiLevelHierarchy_UsingAggregation(hierarchy->ml, FINEST, ML_INCREASING, hierarchy->aggregates);
    OST_TRY(ost_ml_check(hierarchy->link));
    if (hierarchy->levels < 1)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML made no hierarchy (%d levels)", hierarchy->levels);
    return OST_SUCCESS;
}

/* Unknowns and nonzeros of the levels over all ranks. */
static OstStatus measure(OstSmoothedAggregation *hierarchy)
{
    OstContext *ctx = hierarchy->matrix->ctx;
    OstGlobal counts[2][OST_MAX_LEVELS] = {{0}};
    OstGlobal nonzeros = 0;
    for (int level = 0; level < hierarchy->levels; level++) {
        counts[0][level] = hierarchy->ml->Amat[level].outvec_leng;
        counts[1][level] = hierarchy->ml->Amat[level].N_nonzeros;
    }
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, counts, 2 * OST_MAX_LEVELS, MPI_INT64_T, MPI_SUM, ost_comm(ctx))));
    for (int level = 0; level < hierarchy->levels; level++) {
        hierarchy->level_unknowns[level] = counts[0][level];
        nonzeros += counts[1][level];
    }
    hierarchy->operator_complexity = (double)nonzeros / (double)counts[1][FINEST];
    return OST_SUCCESS;
}

static OstStatus set_smoothers(OstSmoothedAggregation *hierarchy, const OstSolverOptions *options)
{
    OstContext *ctx = hierarchy->matrix->ctx;
    ML *ml = hierarchy->ml;
    const int coarsest = hierarchy->levels - 1;
    ml->Cheby_eig_boost = eigenvalue_margin;
    for (int level = FINEST; level < coarsest; level++) {
        ML_Operator *matrix = &ml->Amat[level];
        ML_Operator_Set_SpectralNormScheme_Calc(matrix);
        ML_Operator_Set_SpectralNorm_Iterations(matrix, EIGENVALUE_STEPS);
        matrix->lambda_max =
            -666.666; /* ML's mark for "unknown": discards the prolongator's estimate, which took few steps */
        if (ML_Gen_Smoother_Cheby(ml, level, ML_BOTH, options->smoother_ratio, options->smoother_degree) != 0)
            return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML has no Chebyshev smoother for level %d", level);
    }
    const int solver = hierarchy->level_unknowns[coarsest] > LARGEST_FOR_KLU ? ML_AMESOS_MUMPS : ML_AMESOS_KLU;
    if (ML_Gen_Smoother_Amesos(ml, coarsest, solver, -1, 0.0, 1) != 0)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "Amesos could not factor the coarsest level (%lld unknowns)",
                         (long long)hierarchy->level_unknowns[coarsest]);
    if (coarsest > FINEST && ML_Gen_Solver(ml, ML_MGV, FINEST, coarsest) != 0)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML_Gen_Solver failed");
    return ost_ml_check(hierarchy->link);
}

/* Refuses unusable diagonal blocks first, as a failed factorisation in Amesos prints and writes the matrix to files. */
static OstStatus check_diagonal(const OstBlockMatrix *matrix)
{
    OstScaling *scaling = NULL;
    const OstStatus status = ost_scaling_create(matrix, &scaling);
    ost_scaling_destroy(&scaling);
    return status;
}

OstStatus ost_smoothed_aggregation_create(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                                          const OstSolverOptions *options, OstSmoothedAggregation **hierarchy)
{
    OstContext *ctx = matrix->ctx;
    OstSmoothedAggregation *made = NULL;
    *hierarchy = NULL;
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
        ost_smoothed_aggregation_destroy(&made);
    *hierarchy = made;
    return status;
}

OstStatus ost_smoothed_aggregation_apply(void *data, const double *r, double *z)
{
    OstSmoothedAggregation *hierarchy = data;
    const int n = 3 * hierarchy->matrix->rows;
    memset(z, 0, (size_t)n * sizeof *z);
    if (hierarchy->levels > 1)
        ML_Solve_MGV(hierarchy->ml, (double *)r, z);
    else /* with one level ML's cycle would print a warning; the smoother is the direct solve */
        ML_Smoother_Apply(&hierarchy->ml->post_smoother[FINEST], n, z, n, (double *)r, ML_ZERO);
    return hierarchy->link->status;
}

void ost_smoothed_aggregation_report(const OstSmoothedAggregation *hierarchy, OstSolveReport *report)
{
    report->levels = hierarchy->levels;
    memcpy(report->level_unknowns, hierarchy->level_unknowns, sizeof hierarchy->level_unknowns);
    report->operator_complexity = hierarchy->operator_complexity;
}
