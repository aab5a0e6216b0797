/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/rung.h"

#include "algebra/direct/direct.h"
#include "algebra/krylov/cg.h"
#include "algebra/multigrid/metric.h"
#include "algebra/trilinos/smoothed_aggregation.h"
#include "core/error.h"
#include "core/memory.h"

struct OstRung {
    OstRecipe recipe;
    const OstBlockMatrix *matrix;
    OstSmoothedAggregation *plain; /* one of these three */
    OstMetric *metric;
    OstDirect *direct;
};

void ost_rung_destroy(OstRung **rung)
{
    if (!*rung)
        return;
    ost_smoothed_aggregation_destroy(&(*rung)->plain);
    ost_metric_destroy(&(*rung)->metric);
    ost_direct_destroy(&(*rung)->direct);
    OST_FREE(*rung);
}

OstRecipe ost_rung_recipe(const OstRung *rung)
{
    return rung->recipe;
}

static OstStatus build(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry, const OstSolverOptions *options,
                       OstRung *rung)
{
    switch (options->recipe) {
    case OST_RECIPE_PLAIN:
        return ost_smoothed_aggregation_create(matrix, geometry, options, &rung->plain);
    case OST_RECIPE_DIRECT:
        return ost_direct_create(matrix, options->factor_memory, &rung->direct);
    default:
        return ost_metric_create(matrix->ctx, matrix, geometry, options, &rung->metric);
    }
}

OstStatus ost_rung_stand(const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                         const OstSolverOptions *options, OstRung **rung)
{
    OstContext *ctx = matrix->ctx;
    if (*rung && (*rung)->recipe == OST_RECIPE_METRIC && options->recipe == OST_RECIPE_STRONG) {
        ost_metric_strengthen((*rung)->metric, options);
        (*rung)->recipe = OST_RECIPE_STRONG;
        return OST_SUCCESS;
    }
    ost_rung_destroy(rung);
    OstStatus status = ost_agree(ctx, OST_NEW(ctx, rung, 1));
    if (status == OST_SUCCESS) {
        (*rung)->recipe = options->recipe;
        (*rung)->matrix = matrix;
        status = build(matrix, geometry, options, *rung);
    }
    if (status != OST_SUCCESS)
        ost_rung_destroy(rung);
    return status;
}

OstStatus ost_rung_work(OstRung *rung, const double *f, double *u, OstGoal *goal, OstSolveReport *report)
{
    if (rung->plain) {
        const OstPreconditioner cycle = {.data = rung->plain, .apply = ost_smoothed_aggregation_apply};
        const OstCgSystem system = {.matrix = rung->matrix};
        ost_smoothed_aggregation_report(rung->plain, report);
        return ost_cg_solve(&system, &cycle, f, u, goal, report);
    }
    if (rung->metric)
        return ost_metric_improve(rung->metric, f, u, goal, report);
    return ost_direct_solve(rung->direct, f, u, goal, report);
}
