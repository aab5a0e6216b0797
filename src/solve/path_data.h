/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_PATH_DATA_H
#define ORTHOSTAT_SOLVE_PATH_DATA_H

#include "orthostat/path.h"
#include "solve/superposition.h"

struct OstPath {
    OstContext *ctx;
    OstProblem *problem, *owned; /* `owned` is destroyed with the path */
    OstAnalysis *analysis;
    int count, done;
    double *times;
    OstPathStep *steps;        /* count */
    OstSuperposition linear;   /* solved by the first step, or read from a checkpoint */
    OstStatus solved_linearly; /* how that ended */
};

#endif
