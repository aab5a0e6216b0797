/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/trilinos/smoothed_aggregation.h"

#include "algebra/matrix/scaling.h"
#include "algebra/trilinos/ml.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"

#include <limits.h>
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
    double *vector;   /* 3 × columns: with room for ghosts */
    OstStatus status; /* the first failure inside a callback, as ML cannot pass it on */
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
    OST_FREE((*hierarchy)->vector);
    OST_FREE(*hierarchy);
}

static void note(OstSmoothedAggregation *hierarchy, OstStatus status)
{
    if (hierarchy->status == OST_SUCCESS)
        hierarchy->status = status;
}

/* ML's row callback: scalar rows `rows[0..count)`; returns 0 when `space` is too small, and is called again. */
static int get_rows(ML_Operator *operator, int count, int *rows, int space, int *columns, double *values, int *lengths)
{
    const OstBlockMatrix *a = ((const OstSmoothedAggregation *)ML_Get_MyGetrowData(operator))->matrix;
    int n = 0;
    for (int i = 0; i < count; i++) {
        const OstLocal row = rows[i] / 3;
        const size_t line = 3 * (size_t)(rows[i] % 3);
        const OstLocal start = a->row_start[row];
        const OstLocal end = a->row_start[row + 1];
        lengths[i] = 3 * (end - start);
        if (n + lengths[i] > space)
            return 0;
        for (OstLocal k = start; k < end; k++) {
            double room[9];
            const double *block = ost_block_matrix_block(a, row, k, room);
            for (int c = 0; c < 3; c++) {
                columns[n] = 3 * a->column[k] + c;
                values[n++] = block[line + (size_t)c];
            }
        }
    }
    return 1;
}

static int multiply(ML_Operator *operator, int in_length, double *x, int out_length, double *y)
{
    OstSmoothedAggregation *hierarchy = ML_Get_MyMatvecData(operator);
    (void)out_length;
    if (in_length > 0) /* ML passes NULL on a rank that has no rows */
        memcpy(hierarchy->vector, x, (size_t)in_length * sizeof *x);
    note(hierarchy, ost_block_matrix_apply(hierarchy->matrix, hierarchy->vector, y));
    return 0;
}

/* ML finds its neighbours by calling this exchange. */
static int exchange(double *x, void *data)
{
    OstSmoothedAggregation *hierarchy = data;
    note(hierarchy, ost_halo_import(hierarchy->matrix->halo, 3 * sizeof *x, x));
    return 1;
}

static OstStatus check_limits(const OstBlockMatrix *a)
{
    const OstGlobal blocks = a->row_start[a->rows];
    if (a->global_rows > INT_MAX / 3)
        return OST_RAISE(a->ctx, OST_LIMIT_EXCEEDED,
                         "%lld unknowns are more than ML can number (2^31 - 1); use a smaller mesh",
                         3LL * (long long)a->global_rows);
    if (blocks > INT_MAX / 9)
        return OST_RAISE(a->ctx, OST_LIMIT_EXCEEDED,
                         "%lld nonzeros on rank %d are more than ML can count (2^31 - 1); use more ranks",
                         9LL * (long long)blocks, ost_rank(a->ctx));
    return OST_SUCCESS;
}

/* Passes the matrix to ML, by callbacks for rows, product and halo exchange; ML copies only the diagonal. */
static OstStatus set_matrix(OstSmoothedAggregation *hierarchy)
{
    const OstBlockMatrix *a = hierarchy->matrix;
    ML *ml = hierarchy->ml;
    const int unknowns = 3 * a->rows;
    OstStatus status = check_limits(a);
    OST_THEN(OST_NEW(a->ctx, &hierarchy->vector, 3 * (size_t)a->columns));
    OST_TRY(ost_agree(a->ctx, status));
    ML_Init_Amatrix(ml, FINEST, unknowns, unknowns, hierarchy);
    ML_Set_Amatrix_Getrow(ml, FINEST, get_rows, exchange, 3 * a->columns);
    ML_Set_Amatrix_Matvec(ml, FINEST, multiply);
    for (OstLocal i = 0; i < a->rows; i++)
        for (int c = 0; c < 3; c++)
            hierarchy->vector[3 * i + c] = ost_block_matrix_diagonal(a, i)[4 * c];
    ML_Set_Amatrix_Diag(ml, FINEST, unknowns, hierarchy->vector);
    ml->Amat[FINEST].N_nonzeros = 9 * a->row_start[a->rows];
    ml->Amat[FINEST].num_PDEs = 3;
    return ost_agree(a->ctx, hierarchy->status);
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

/* Also counts the levels' unknowns and nonzeros over all ranks. */
static OstStatus coarsen(OstSmoothedAggregation *hierarchy)
{
    OstContext *ctx = hierarchy->matrix->ctx;
    OstGlobal counts[2 * OST_MAX_LEVELS] = {0}, nonzeros = 0;
    ML *ml = hierarchy->ml;
    hierarchy->levels = ML_Gen_MultiLevelHierarchy_UsingAggregation(ml, FINEST, ML_INCREASING, hierarchy->aggregates);
    OST_TRY(ost_agree(ctx, hierarchy->status));
    if (hierarchy->levels < 1)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML made no hierarchy (%d levels)", hierarchy->levels);
    for (int level = 0; level < hierarchy->levels; level++) {
        counts[2 * level] = ml->Amat[level].outvec_leng;
        counts[2 * level + 1] = ml->Amat[level].N_nonzeros;
    }
    OST_TRY(ost_sum_numbers(ctx, 2 * OST_MAX_LEVELS, counts));
    for (int level = 0; level < hierarchy->levels; level++) {
        hierarchy->level_unknowns[level] = counts[2 * level];
        nonzeros += counts[2 * level + 1];
    }
    hierarchy->operator_complexity = (double)nonzeros / (double)counts[1];
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
    return hierarchy->status;
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
    OST_TRY_DONE(set_matrix(made));
    OST_TRY_DONE(ost_agree(ctx, set_aggregation(made, geometry->modes, options)));
    OST_TRY_DONE(coarsen(made));
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
    return hierarchy->status;
}

void ost_smoothed_aggregation_report(const OstSmoothedAggregation *hierarchy, OstSolveReport *report)
{
    report->levels = hierarchy->levels;
    memcpy(report->level_unknowns, hierarchy->level_unknowns, sizeof hierarchy->level_unknowns);
    report->operator_complexity = hierarchy->operator_complexity;
}
