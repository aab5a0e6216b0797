/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/metric_solver.h"

#include "algebra/cg.h"
#include "algebra/metric_cycle.h"
#include "core/error.h"
#include "core/memory.h"

struct OstMetric {
    OstContext *ctx;
    OstSolverOptions options;
    const OstBlockMatrix *matrix;
    OstScaling *scaling;
    OstBlockMatrix *scaled;
    OstCycle *cycle;
    int levels;
    OstGlobal level_unknowns[OST_MAX_LEVELS];
    double operator_complexity;
};

void ost_metric_destroy(OstMetric **metric)
{
    if (!*metric)
        return;
    ost_cycle_destroy(&(*metric)->cycle); /* before the matrix whose halo it borrows */
    ost_block_matrix_destroy(&(*metric)->scaled);
    ost_scaling_destroy(&(*metric)->scaling);
    OST_FREE(*metric);
}

/* The modes in scaled unknowns. */
static OstStatus scale_modes(const OstScaling *scaling, const double *modes, double **scaled)
{
    const size_t n = 3 * (size_t)scaling->rows;
    OST_TRY(OST_NEW(scaling->ctx, scaled, 6 * n));
    for (size_t k = 0; k < 6; k++)
        ost_scaling_to_scaled_mode(scaling, modes + k * n, *scaled + k * n);
    return OST_SUCCESS;
}

/* Sizes of the levels over all ranks, for the report. */
static OstStatus measure_levels(OstMetric *metric, const OstMetricLevels *levels)
{
    OstGlobal size[2 * OST_MAX_LEVELS] = {0};
    for (int l = 0; l < levels->count; l++) {
        const OstMetricOperator *matrix = levels->matrix[l];
        size[2 * l] = (OstGlobal)matrix->height * matrix->rows;
        size[2 * l + 1] = (OstGlobal)matrix->height * matrix->width * matrix->row_start[matrix->rows];
    }
    OST_TRY(OST_MPI(metric->ctx, MPI_Allreduce(MPI_IN_PLACE, size, 2 * OST_MAX_LEVELS, MPI_INT64_T, MPI_SUM,
                                               ost_comm(metric->ctx))));
    OstGlobal nonzeros = 0;
    metric->levels = levels->count;
    for (int l = 0; l < levels->count; l++) {
        metric->level_unknowns[l] = size[2 * l];
        nonzeros += size[2 * l + 1];
    }
    metric->operator_complexity = (double)nonzeros / (double)size[1];
    return OST_SUCCESS;
}

static OstStatus build_cycle(OstMetric *metric, const OstSolverGeometry *geometry)
{
    OstContext *ctx = metric->ctx;
    OstMetricGraph *graph = NULL;
    OstMetricLevels levels = {0};
    double *modes = NULL;
    OstStatus status = ost_metric_graph_create(metric->matrix, geometry, &graph);
    if (status != OST_SUCCESS)
        goto done;
    OST_TRY_DONE(ost_agree(ctx, scale_modes(metric->scaling, geometry->modes, &modes)));
    OST_TRY_DONE(ost_metric_levels_create(metric->scaled, modes, &graph, &metric->options, &levels));
    OST_TRY_DONE(measure_levels(metric, &levels));
    OST_TRY_DONE(ost_cycle_create(ctx, &levels, &metric->options, &metric->cycle));
done:
    OST_FREE(modes);
    ost_metric_graph_destroy(&graph);
    ost_metric_levels_clear(&levels);
    return status;
}

OstStatus ost_metric_create(OstContext *ctx, const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                            const OstSolverOptions *options, OstMetric **metric)
{
    OstMetric *made = NULL;
    *metric = NULL;
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, &made, 1));
    if (status != OST_SUCCESS)
        goto done;
    made->ctx = ctx;
    made->options = *options;
    made->matrix = matrix;
    OST_TRY_DONE(ost_scaling_create(matrix, &made->scaling));
    OST_TRY_DONE(ost_scaling_apply_matrix(made->scaling, matrix, &made->scaled));
    OST_TRY_DONE(build_cycle(made, geometry));
done:
    if (status != OST_SUCCESS)
        ost_metric_destroy(&made);
    *metric = made;
    return status;
}

static OstStatus apply_cycle(void *data, const double *r, double *z)
{
    return ost_cycle_apply(data, r, z);
}

OstStatus ost_metric_solve(OstMetric *metric, const double *f, double *u, OstSolveReport *report)
{
    const OstPreconditioner preconditioner = {.data = metric->cycle, .apply = apply_cycle, .flexible = 1};
    const OstCgSystem system = {.matrix = metric->matrix, .scaled_matrix = metric->scaled, .scaling = metric->scaling};
    report->levels = metric->levels;
    for (int l = 0; l < metric->levels; l++)
        report->level_unknowns[l] = metric->level_unknowns[l];
    report->operator_complexity = metric->operator_complexity;
    return ost_cg_solve(&system, &preconditioner, f, u, &metric->options, report);
}
