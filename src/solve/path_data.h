/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_PATH_DATA_H
#define ORTHOSTAT_SOLVE_PATH_DATA_H

#include "orthostat/path.h"
#include "solve/newton.h"
#include "solve/superposition.h"

struct OstPath {
    OstContext *ctx;
    OstProblem *problem, *owned; /* `owned` is destroyed with the path */
    OstAnalysis *analysis;
    int count, done;
    double *times;
    OstPathStep *steps;      /* count */
    OstSuperposition linear; /* solved by the first step that needs it, or read from a checkpoint */
    int decided;             /* is it known which of the two the steps are? */
    int nonlinear;           /* Newton's method takes them, from `state` */
    OstNewtonState state;
    OstNewtonReport judged;    /* how far linear theory is off at most, and with what that was compared */
    OstStatus solved_linearly; /* how that ended */
};

#endif
