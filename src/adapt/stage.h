/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ADAPT_STAGE_H
#define ORTHOSTAT_ADAPT_STAGE_H

#include "adapt/mark.h"
#include "orthostat/analysis.h"
#include "orthostat/refine.h"
#include "problem/result_data.h"
#include "problem/scene_data.h"

/* One level: the case on a mesh, its answer, and the error of that. */
typedef struct Stage {
    OstContext *ctx;
    OstCase c; /* the user's, with this level's order; all else is borrowed */
    OstScene *scene;
    OstBisection *bisection; /* of the scene's mesh; the finest level has it */
    double *start;           /* the answer of the level before, on this mesh; or NULL */
    int starts_turned;       /* is it one of large rotations? */
    OstProblem *problem;     /* with the analysis, until the next level is made: the last one finds reactions' errors */
    OstAnalysis *analysis;
    OstResult *result;
    double potential, volume; /* strain energy less the loads' work, NAN where it is not least; of the body */
    double missed;            /* what the estimate is to be multiplied by; found by the levels, 1 if not known */
    double *fall;             /* of each own tet's share of the squared error, expected of its next cuts */
    double *before;           /* share and fall of the tet that each own tet is made of, two numbers each; or NULL */
    int *cuts;                /* and how often that was cut */
} OstStage;

/* Collective, as all that follows. An empty stage. */
OstStatus ost_stage_create(OstContext *ctx, OstStage **stage);
void ost_stage_destroy(OstStage **stage);

/* The first level: the case's mesh as it is given. */
OstStatus ost_stage_open(OstStage *stage, const OstCase *c);

/* The next level: the stage's mesh, cut as the marking finds, of the marking's order. Takes over the bisection. */
OstStatus ost_stage_refine(OstStage *stage, OstMarking *marking, OstStage *next);

/* Solves, and estimates the error. */
OstStatus ost_stage_solve(OstStage *stage);

/* Completes the result of the last level: errors of watched reactions, which the others do without, what the estimate
 * missed, and the fields that the case asks for. */
OstStatus ost_stage_finish(OstStage *stage);

#endif
