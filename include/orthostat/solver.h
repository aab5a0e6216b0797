/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVER_H
#define ORTHOSTAT_SOLVER_H

#include "orthostat/context.h"

/* How the linear system is solved. */
typedef enum {
    OST_RECIPE_AUTO,   /* METRIC, or DIRECT below 3000 unknowns */
    OST_RECIPE_PLAIN,  /* AztecOO's CG, ML's smoothed aggregation with its own aggregates */
    OST_RECIPE_METRIC, /* flexible CG, smoothed aggregation on aggregates round in the material's metric, block
                          smoother, K-cycle */
    OST_RECIPE_DIRECT  /* MUMPS, refined by CG to the requested residual */
} OstRecipe;

typedef struct OstSolverOptions {
    OstRecipe recipe;
    double relative_residual; /* of the true, unscaled residual */
    int max_iterations;
    double aggregate_nodes;        /* METRIC: nodes per aggregate on the finest level; fewer, down to 10, where Young's
                                      moduli differ by more than 1000 (metric_levels.c) */
    double coarse_aggregate_nodes; /* METRIC: on the levels below */
    double smoother_block_nodes;   /* METRIC: nodes per smoother block; more, up to 10, there */
    int smoother_degree;           /* Chebyshev degree */
    double smoother_ratio;         /* Chebyshev covers [lambda / ratio, 1.1 lambda] */
    int coarsest_unknowns;         /* stop coarsening below this many */
} OstSolverOptions;

enum { OST_MAX_LEVELS = 12 };

typedef struct OstSolveReport {
    OstRecipe recipe; /* the one used */
    int iterations;
    double relative_residual; /* true, recomputed */
    double setup_seconds, solve_seconds;
    int levels;
    OstGlobal level_unknowns[OST_MAX_LEVELS];
    double operator_complexity; /* nonzeros of all levels over those of the finest */
    double condition_estimate; /* of the preconditioned matrix, from the Lanczos coefficients; 0 if not known (PLAIN) */
} OstSolveReport;

/* Local. The defaults: AUTO, 1e-8 in at most 1000 iterations, recipe R's 40 / 8 / 7 nodes, degree 3, ratio 20, coarsest
 * 1000. */
OstSolverOptions ost_solver_default_options(void);
const char *ost_recipe_name(OstRecipe recipe);

#endif
