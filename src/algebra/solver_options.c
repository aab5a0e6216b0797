/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver_options.h"

#include "core/error.h"

#include <limits.h>

/* Strong smoothing: 334 instead of 471 iterations on the tube at ratio 1e6 (stiff around), 221 instead of 288 at nu
 * 0.4999. */
enum { STRONG_DEGREE = 6 };
static const double strong_ratio = 60.0;

/* Smaller aggregates if the coarse matrix is factored, which represents more of the fine one then. */
static const double two_level_aggregate = 20.0;

OstSolverOptions ost_solver_default_options(void)
{
    return (OstSolverOptions){.method = OST_METHOD_AUTO,
                              .relative_residual = 1e-8,
                              .max_iterations = 20000,
                              .patience = 150,
                              .aggregate_nodes = 40.0,
                              .coarse_aggregate_nodes = 8.0,
                              .smoother_block_nodes = 7.0,
                              .smoother_degree = 3,
                              .smoother_ratio = 20.0,
                              .coarsest_unknowns = 1000,
                              .most_levels = OST_MAX_LEVELS};
}

const char *ost_method_name(OstMethod method)
{
    static const char *const names[] = {
        [OST_METHOD_AUTO] = "auto",     [OST_METHOD_PLAIN] = "plain",         [OST_METHOD_METRIC] = "metric",
        [OST_METHOD_STRONG] = "strong", [OST_METHOD_TWO_LEVEL] = "two_level", [OST_METHOD_DIRECT] = "direct"};
    return method >= OST_METHOD_AUTO && method <= OST_METHOD_DIRECT ? names[method] : "unknown";
}

const char *ost_method_engine(OstMethod method)
{
    switch (method) {
    case OST_METHOD_DIRECT:
        return "MUMPS factors, refined by CG";
    case OST_METHOD_PLAIN:
        return "AztecOO CG, ML V-cycle on levels of its own";
    default:
        return "AztecOO CG, ML cycle";
    }
}

static OstStatus check_number(OstContext *ctx, const char *name, double value, double above, double most)
{
    if (value > above && value <= most)
        return OST_SUCCESS;
    return OST_RAISE(ctx, OST_INVALID_INPUT, "solver option %s is %g; expected more than %g and at most %g", name,
                     value, above, most);
}

OstStatus ost_solver_check_options(OstContext *ctx, const OstSolverOptions *options)
{
    OST_TRY(check_number(ctx, "relative_residual", options->relative_residual, 0.0, 0.5));
    OST_TRY(check_number(ctx, "max_iterations", options->max_iterations, 0.0, INT_MAX));
    OST_TRY(check_number(ctx, "patience", options->patience, 0.0, INT_MAX));
    OST_TRY(check_number(ctx, "aggregate_nodes", options->aggregate_nodes, 1.0, 1e6));
    OST_TRY(check_number(ctx, "coarse_aggregate_nodes", options->coarse_aggregate_nodes, 1.0, 1e6));
    OST_TRY(check_number(ctx, "smoother_block_nodes", options->smoother_block_nodes, 0.0, 1e3));
    OST_TRY(check_number(ctx, "smoother_degree", options->smoother_degree, 0.0, 20.0));
    OST_TRY(check_number(ctx, "smoother_ratio", options->smoother_ratio, 1.0, 1e6));
    OST_TRY(check_number(ctx, "coarsest_unknowns", options->coarsest_unknowns, 0.0, INT_MAX));
    OST_TRY(check_number(ctx, "load_steps", options->load_steps, -1.0, 1000.0));
    OST_TRY(check_number(ctx, "most_levels", options->most_levels, 0.0, OST_MAX_LEVELS));
    if (!(options->algebraic_fraction >= 0.0 && options->algebraic_fraction <= 0.5))
        return OST_RAISE(ctx, OST_INVALID_INPUT, "solver option algebraic_fraction is %g; expected 0 (off) to 0.5",
                         options->algebraic_fraction);
    if (options->factor_memory >= 0.0 && options->factor_memory <= 1e300)
        return OST_SUCCESS;
    return OST_RAISE(ctx, OST_INVALID_INPUT,
                     "solver option factor_memory is %g bytes; expected 0 (all that is free) to 1e300",
                     options->factor_memory);
}

void ost_solver_strategy_options(const OstSolverOptions *planned, OstMethod method, OstSolverOptions *options)
{
    *options = *planned;
    options->method = method;
    if (method != OST_METHOD_STRONG && method != OST_METHOD_TWO_LEVEL)
        return;
    if (!(planned->given & OST_GIVEN_DEGREE) && planned->smoother_degree < STRONG_DEGREE)
        options->smoother_degree = STRONG_DEGREE;
    if (!(planned->given & OST_GIVEN_RATIO) && planned->smoother_ratio < strong_ratio)
        options->smoother_ratio = strong_ratio;
    if (method == OST_METHOD_STRONG && !planned->fine)
        return;
    if (!(planned->given & OST_GIVEN_AGGREGATE))
        options->aggregate_nodes = two_level_aggregate;
    if (method == OST_METHOD_TWO_LEVEL && options->most_levels > 2)
        options->most_levels = 2;
}
