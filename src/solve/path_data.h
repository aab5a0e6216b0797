/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_PATH_DATA_H
#define ORTHOSTAT_SOLVE_PATH_DATA_H

#include "orthostat/path.h"
#include "solve/superposition.h"

/* Where Newton's method stands; without arrays where linear theory serves. */
typedef struct OstPathState {
    double t, step;
    double *displacement, *slope; /* 3 × node_count */
} OstPathState;

struct OstPath {
    OstContext *ctx;
    OstProblem *problem, *owned; /* `owned` is destroyed with the path */
    OstAnalysis *analysis;
    int count, done;
    double *times;
    OstPathStep *steps;      /* count */
    OstSuperposition linear; /* solved by the first step that needs it */
    OstPathState state;
    OstStatus solved_linearly; /* how that ended */
};

#endif
