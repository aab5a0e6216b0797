/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver.h"

#include "algebra/direct.h"
#include "algebra/epetra.h"
#include "algebra/metric_solver.h"
#include "algebra/plain.h"
#include "core/error.h"
#include "core/memory.h"

#include <limits.h>
#include <math.h>
#include <string.h>

enum { DIRECT_BELOW = 3000 }; /* unknowns: factoring so few takes less than building a hierarchy */

struct OstSolver {
    OstContext *ctx;
    const OstBlockMatrix *matrix;
    OstSolverOptions options; /* with the recipe that was picked */
    OstEpetraMap *map;
    OstPlain *plain; /* one of these three, or none if there are no unknowns */
    OstMetric *metric;
    OstDirect *direct;
    double setup_seconds;
};

OstSolverOptions ost_solver_default_options(void)
{
    return (OstSolverOptions){.recipe = OST_RECIPE_AUTO,
                              .relative_residual = 1e-8,
                              .max_iterations = 1000,
                              .aggregate_nodes = 40.0,
                              .coarse_aggregate_nodes = 8.0,
                              .smoother_block_nodes = 7.0,
                              .smoother_degree = 3,
                              .smoother_ratio = 20.0,
                              .coarsest_unknowns = 1000};
}

const char *ost_recipe_name(OstRecipe recipe)
{
    switch (recipe) {
    case OST_RECIPE_AUTO:
        return "auto";
    case OST_RECIPE_PLAIN:
        return "plain";
    case OST_RECIPE_METRIC:
        return "metric";
    case OST_RECIPE_DIRECT:
        return "direct";
    }
    return "unknown";
}

static OstStatus check_number(OstContext *ctx, const char *name, double value, double above, double most)
{
    if (value > above && value <= most)
        return OST_SUCCESS;
    return OST_RAISE(ctx, OST_INVALID_INPUT, "solver option %s is %g; expected more than %g and at most %g", name,
                     value, above, most);
}

static OstStatus check_options(OstContext *ctx, const OstSolverOptions *options)
{
    OST_TRY(check_number(ctx, "relative_residual", options->relative_residual, 0.0, 0.5));
    OST_TRY(check_number(ctx, "max_iterations", options->max_iterations, 0.0, INT_MAX));
    OST_TRY(check_number(ctx, "aggregate_nodes", options->aggregate_nodes, 1.0, 1e6));
    OST_TRY(check_number(ctx, "coarse_aggregate_nodes", options->coarse_aggregate_nodes, 1.0, 1e6));
    OST_TRY(check_number(ctx, "smoother_block_nodes", options->smoother_block_nodes, 0.0, 1e3));
    OST_TRY(check_number(ctx, "smoother_degree", options->smoother_degree, 0.0, 20.0));
    OST_TRY(check_number(ctx, "smoother_ratio", options->smoother_ratio, 1.0, 1e6));
    return check_number(ctx, "coarsest_unknowns", options->coarsest_unknowns, 0.0, INT_MAX);
}

static OstRecipe pick_recipe(OstRecipe asked, const OstBlockMatrix *matrix)
{
    if (asked != OST_RECIPE_AUTO)
        return asked;
    return 3 * matrix->global_rows < DIRECT_BELOW ? OST_RECIPE_DIRECT : OST_RECIPE_METRIC;
}

static OstStatus build(OstSolver *solver, const OstSolverGeometry *geometry)
{
    OstContext *ctx = solver->ctx;
    const OstBlockMatrix *matrix = solver->matrix;
    OST_TRY(ost_epetra_map_create(ctx, 3 * matrix->rows, &solver->map));
    if (matrix->global_rows == 0)
        return OST_SUCCESS;
    switch (solver->options.recipe) {
    case OST_RECIPE_PLAIN:
        return ost_plain_create(matrix, geometry, &solver->options, &solver->plain);
    case OST_RECIPE_METRIC:
        return ost_metric_create(ctx, matrix, geometry, &solver->options, &solver->metric);
    default:
        return ost_direct_create(matrix, &solver->direct);
    }
}

OstStatus ost_solver_create(OstContext *ctx, const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                            const OstSolverOptions *options, OstSolver **solver)
{
    OstSolver *made = NULL;
    *solver = NULL;
    ost_ledger_enter(ctx, OST_LEDGER_HIERARCHY);
    const double start = ost_seconds();
    OstStatus status = check_options(ctx, options);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &made, 1);
    OST_TRY_DONE(ost_agree(ctx, status));
    made->ctx = ctx;
    made->matrix = matrix;
    made->options = *options;
    made->options.recipe = pick_recipe(options->recipe, matrix);
    OST_TRY_DONE(build(made, geometry));
    made->setup_seconds = ost_seconds() - start;
done:
    ost_ledger_leave(ctx);
    if (status != OST_SUCCESS)
        ost_solver_destroy(&made);
    *solver = made;
    return status;
}

void ost_solver_destroy(OstSolver **solver)
{
    if (!*solver)
        return;
    ost_plain_destroy(&(*solver)->plain);
    ost_metric_destroy(&(*solver)->metric);
    ost_direct_destroy(&(*solver)->direct);
    ost_epetra_map_destroy(&(*solver)->map);
    OST_FREE(*solver);
}

static OstStatus run(OstSolver *solver, const double *f, double *u, OstSolveReport *report)
{
    if (solver->plain)
        return ost_plain_solve(solver->plain, f, u, &solver->options, report);
    if (solver->metric)
        return ost_metric_solve(solver->metric, f, u, report);
    if (solver->direct)
        return ost_direct_solve(solver->direct, f, u, &solver->options, report);
    return OST_SUCCESS;
}

/* ||f - A u|| / ||f||, by Epetra's norms: no code in common with what the recipes stop by but the product. */
static OstStatus measure_residual(const OstSolver *solver, const double *f, const double *u, double *relative)
{
    OstContext *ctx = solver->ctx;
    const size_t n = 3 * (size_t)solver->matrix->rows;
    double *vector = NULL;
    double *residual = NULL;
    double norm = 0.0;
    double f_norm = 0.0;
    OstStatus status = OST_NEW(ctx, &vector, 3 * (size_t)solver->matrix->columns);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &residual, n);
    OST_TRY_DONE(ost_agree(ctx, status));
    memcpy(vector, u, n * sizeof *u);
    OST_TRY_DONE(ost_block_matrix_apply(solver->matrix, vector, residual));
    for (size_t i = 0; i < n; i++)
        residual[i] = f[i] - residual[i];
    OST_TRY_DONE(ost_epetra_norm(solver->map, residual, &norm));
    OST_TRY_DONE(ost_epetra_norm(solver->map, f, &f_norm));
    *relative = f_norm > 0.0 ? norm / f_norm : norm;
done:
    OST_FREE(vector);
    OST_FREE(residual);
    return status;
}

OstStatus ost_solver_solve(OstSolver *solver, const double *f, double *u, OstSolveReport *report)
{
    memset(report, 0, sizeof *report);
    report->recipe = solver->options.recipe;
    report->setup_seconds = solver->setup_seconds;
    ost_ledger_enter(solver->ctx, OST_LEDGER_SOLVE);
    const double start = ost_seconds();
    OstStatus status = run(solver, f, u, report);
    if (status == OST_SUCCESS)
        status = measure_residual(solver, f, u, &report->relative_residual);
    report->solve_seconds = ost_seconds() - start;
    ost_ledger_leave(solver->ctx);
    return status;
}
