/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/strategy.h"

#include "algebra/direct/direct.h"
#include "algebra/krylov/cg.h"
#include "algebra/multigrid/metric.h"
#include "algebra/trilinos/smoothed_aggregation.h"
#include "core/error.h"
#include "core/memory.h"

#include <stdio.h>

struct OstStrategy {
    OstMethod method;
    const OstBlockMatrix *matrix;
    OstSmoothedAggregation *plain; /* one of these three */
    OstMetric *metric;
    OstDirect *direct;
};

void ost_strategy_destroy(OstStrategy **strategy)
{
    if (!*strategy)
        return;
    ost_smoothed_aggregation_destroy(&(*strategy)->plain);
    ost_metric_destroy(&(*strategy)->metric);
    ost_direct_destroy(&(*strategy)->direct);
    OST_FREE(*strategy);
}

OstMethod ost_strategy_method(const OstStrategy *strategy)
{
    return strategy->method;
}

static OstStatus build(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry, const OstSolverOptions *options,
                       OstStrategy *strategy)
{
    switch (options->method) {
    case OST_METHOD_PLAIN:
        return ost_smoothed_aggregation_create(matrix, geometry, options, &strategy->plain);
    case OST_METHOD_DIRECT:
        return ost_direct_create(matrix, options->factor_memory, &strategy->direct);
    default:
        return ost_metric_create(matrix, geometry, options, &strategy->metric);
    }
}

OstStatus ost_strategy_prepare(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                               const OstSolverOptions *options, OstStrategy **strategy)
{
    OstContext *ctx = matrix->ctx;
    if (*strategy && (*strategy)->method == OST_METHOD_METRIC && options->method == OST_METHOD_STRONG) {
        ost_metric_strengthen((*strategy)->metric, options);
        (*strategy)->method = OST_METHOD_STRONG;
        return OST_SUCCESS;
    }
    ost_strategy_destroy(strategy);
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, strategy, 1));
    if (status == OST_SUCCESS) {
        (*strategy)->method = options->method;
        (*strategy)->matrix = matrix;
        status = build(matrix, geometry, options, *strategy);
    }
    if (status != OST_SUCCESS)
        ost_strategy_destroy(strategy);
    return status;
}

static OstStatus improve_plain(OstStrategy *strategy, const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    const OstPreconditioner cycle = {.data = strategy->plain, .apply = ost_smoothed_aggregation_apply};
    const OstCgSystem system = {.matrix = strategy->matrix};
    ost_smoothed_aggregation_report(strategy->plain, report);
    snprintf(report->engine, sizeof report->engine, "AztecOO CG, ML V-cycle of %d levels of its own", report->levels);
    return ost_cg_solve(&system, &cycle, f, u, goal, report);
}

OstStatus ost_strategy_improve(OstStrategy *strategy, const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    if (strategy->plain)
        return improve_plain(strategy, f, u, goal, report);
    if (strategy->metric)
        return ost_metric_improve(strategy->metric, f, u, goal, report);
    return ost_direct_solve(strategy->direct, f, u, goal, report);
}
