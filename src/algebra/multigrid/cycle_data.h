/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_CYCLE_DATA_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_CYCLE_DATA_H

#include "algebra/multigrid/coarsest.h"
#include "algebra/multigrid/levels.h"
#include "algebra/multigrid/quadratic.h"
#include "algebra/trilinos/cycle.h"

enum { OST_COARSEST_SWEEPS = 10 }; /* where the coarsest level is smoothed; a fixed number keeps the cycle symmetric */

typedef struct OstCycle OstCycle;
typedef struct OstCycleColumns OstCycleColumns;

/* A level, or the whole cycle; only cycle.c and cycle_columns.c read them. */
typedef struct OstCycleLevel {
    int number; /* of the finest: 0 */
    const OstLevelMatrix *matrix;
    OstSmoother *smoother;             /* NULL where the level is solved by factors */
    const OstProlongator *prolongator; /* from the next level; or */
    OstQuadraticLevel *quadratic;      /* which interpolates from the linear tets; neither on the coarsest level */
    OstCoarsest *coarsest;             /* its factors; NULL if it is smoothed */
    double *own;                       /* a vector of this level with room for ghosts */
    double *coarse;                    /* a vector of the next level with room for the prolongator's ghosts */
} OstCycleLevel;

struct OstCycle {
    OstLevels levels;
    OstQuadraticLevel *quadratic;
    OstCoarsest *coarsest;
    int count; /* of levels, the quadratic one included */
    OstCycleLevel level[OST_MAX_LEVELS + 1];
    OstMlCycle *ml;           /* NULL if there is only one level */
    OstCycleColumns *columns; /* the same for several vectors; NULL before it is asked for */
};

#endif
