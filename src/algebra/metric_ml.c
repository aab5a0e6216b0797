/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/metric_ml.h"

#include "algebra/metric_aggregate.h"
#include "algebra/metric_ml_copy.h"
#include "algebra/ml_matrix.h"
#include "core/error.h"

#include <ml_agg_user.h>

#include <string.h>

enum { MODES = 6, FINEST = OST_MAX_LEVELS - 1 }; /* ML counts levels down, as its user aggregates ask for */

/* ML asks for the aggregates of one level after another through a function that gets no data of ours and no level, so
 * where that function finds its work has to be a variable of this file. It is set only while ML runs, below. */
typedef struct Aggregation {
    OstMetricLevels *levels;
    const OstSolverOptions *options;
    int level; /* whose aggregates ML asks for next */
    OstStatus status;
} Aggregation;
static Aggregation *running;

static char *label(void)
{
    static char text[] = "orthostat";
    return text;
}

static OstStatus aggregate_level(Aggregation *work, int *of_node, int *count)
{
    const OstMetricGraph *graph = work->levels->graph[work->level];
    const int finest = work->level == 0;
    const OstSolverOptions *options = work->options;
    /* Two nodes or fewer cannot show the six modes; a coarse node carries all six. */
    const OstAggregateShape shape = {.target = finest ? options->aggregate_nodes : options->coarse_aggregate_nodes,
                                     .minimum = finest ? 3 : 1,
                                     .recentrings = 2};
    OstAggregates *aggregates = NULL;
    if (work->level + 1 >= OST_MAX_LEVELS)
        return OST_RAISE(graph->ctx, OST_LIBRARY_FAILED, "ML asked for more than %d levels", OST_MAX_LEVELS);
    OST_TRY(ost_aggregates_create(graph, &shape, &aggregates));
    const OstStatus status = ost_metric_graph_coarsen(graph, aggregates, &work->levels->graph[work->level + 1]);
    if (status == OST_SUCCESS) {
        for (OstLocal i = 0; i < graph->nodes; i++)
            of_node[i] = aggregates->of_node[i];
        *count = aggregates->count;
    }
    ost_aggregates_destroy(&aggregates);
    return status;
}

/* ML's callback: the aggregate of each node of this rank. `boundary` comes uninitialised, and ML takes the near-null
 * space away from nodes where it is 'T'. */
static int aggregate(ML_Operator *matrix, char *boundary, double threshold, double *x, double *y, double *z,
                     int *of_node, int *nonzeros)
{
    Aggregation *work = running;
    (void)matrix, (void)threshold, (void)x, (void)y, (void)z;
    int count = 0;
    const OstMetricGraph *graph = work->level < OST_MAX_LEVELS ? work->levels->graph[work->level] : NULL;
    const OstLocal nodes = graph ? graph->nodes : 0;
    memset(boundary, 'F', (size_t)nodes);
    *nonzeros = graph ? graph->edge_start[nodes] + nodes : 0;
    for (OstLocal i = 0; i < nodes; i++)
        of_node[i] = -1;
    if (work->status == OST_SUCCESS)
        work->status = aggregate_level(work, of_node, &count);
    work->level++;
    return count;
}

/* Runs ML; *count is the number of levels it made. */
static OstStatus run_ml(ML *ml, const OstBlockMatrix *matrix, const double *modes, Aggregation *work, int *count)
{
    OstContext *ctx = matrix->ctx;
    ML_Aggregate *settings = NULL;
    if (ML_Aggregate_Create(&settings) != 0 || !settings)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML_Aggregate_Create failed");
    ML_Aggregate_Set_MaxLevels(settings, OST_MAX_LEVELS);
    ML_Aggregate_Set_MaxCoarseSize(settings, work->options->coarsest_unknowns);
    ML_Aggregate_Set_Threshold(settings, 0.0);
    ML_Aggregate_Set_DampingFactor(settings, 4.0 / 3.0);
    ML_Set_SpectralNormScheme_Calc(ml);
    ML_Aggregate_Set_NullSpace(settings, 3, MODES, (double *)modes, 3 * matrix->rows); /* copied, not written */
    ML_Aggregate_Set_CoarsenScheme_User(settings);
    ML_SetUserLabel(label);
    ML_SetUserPartitions(aggregate);
    ML_Aggregate_VizAndStats_Setup(ml);
    running = work;
    *count = ML_Gen_MultiLevelHierarchy_UsingAggregation(ml, FINEST, ML_DECREASING, settings);
    running = NULL;
    ML_Aggregate_VizAndStats_Clean(ml);
    ML_Aggregate_Destroy(&settings);
    return work->status;
}

static OstStatus copy_levels(ML *ml, OstContext *ctx, OstMetricLevels *levels)
{
    for (int l = 1; l < levels->count; l++) {
        const int exact = l == levels->count - 1;
        OST_TRY(ost_metric_operator_from_ml(ctx, &ml->Amat[FINEST - l], MODES, MODES, exact, &levels->matrix[l]));
        ost_metric_operator_mend_diagonal(levels->matrix[l]);
        OST_TRY(ost_metric_operator_from_ml(ctx, &ml->Pmat[FINEST - l], l == 1 ? 3 : MODES, MODES, 0,
                                            &levels->prolongator[l - 1]));
    }
    return OST_SUCCESS;
}

static OstStatus coarsen(const OstBlockMatrix *matrix, const double *modes, const OstSolverOptions *options,
                         OstMetricLevels *levels)
{
    OstContext *ctx = matrix->ctx;
    Aggregation work = {.levels = levels, .options = options};
    ML *ml = NULL;
    OstMlMatrix *link = NULL;
    int count = 0;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_agree(ctx, ost_ml_create(ctx, OST_MAX_LEVELS, &ml)));
    OST_TRY_DONE(ost_ml_set_matrix(ml, FINEST, matrix, &link));
    OST_TRY_DONE(ost_agree(ctx, run_ml(ml, matrix, modes, &work, &count)));
    OST_TRY_DONE(ost_ml_check(link));
    if (count < 1 || count > OST_MAX_LEVELS)
        OST_TRY_DONE(OST_RAISE(ctx, OST_LIBRARY_FAILED, "ML made %d levels; expected 1 to %d", count, OST_MAX_LEVELS));
    levels->count = count;
    OST_TRY_DONE(copy_levels(ml, ctx, levels));
done:
    if (ml)
        ML_Destroy(&ml);
    ost_ml_matrix_destroy(&link);
    return status;
}

OstStatus ost_metric_levels_create(const OstBlockMatrix *matrix, const double *modes, OstMetricGraph **finest_graph,
                                   const OstSolverOptions *options, OstMetricLevels *levels)
{
    memset(levels, 0, sizeof *levels);
    levels->count = 1;
    levels->graph[0] = *finest_graph;
    *finest_graph = NULL;
    OstStatus status = OST_SUCCESS;
    if (3 * matrix->global_rows > options->coarsest_unknowns)
        OST_TRY_DONE(coarsen(matrix, modes, options, levels));
    OST_TRY_DONE(ost_metric_operator_from_matrix(matrix, levels->count == 1, &levels->matrix[0]));
done:
    if (status != OST_SUCCESS)
        ost_metric_levels_clear(levels);
    return status;
}

void ost_metric_levels_clear(OstMetricLevels *levels)
{
    for (int l = 0; l < OST_MAX_LEVELS; l++) {
        ost_metric_operator_destroy(&levels->matrix[l]);
        ost_metric_operator_destroy(&levels->prolongator[l]);
        ost_metric_graph_destroy(&levels->graph[l]);
    }
    levels->count = 0;
}
