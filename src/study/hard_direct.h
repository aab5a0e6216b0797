/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_HARD_DIRECT_H
#define ORTHOSTAT_STUDY_HARD_DIRECT_H

#include "algebra/direct/mumps.h"
#include "algebra/matrix/scaling.h"
#include "assembly/system.h"
#include "orthostat/scene.h"

/* An unevaluated sum of two doubles: some 32 digits, of which ill-conditioned equations leave enough. */
typedef struct OstTwofold {
    double high, low;
} OstTwofold;

/* A scene's equations, assembled afresh, and their factors; vectors of 3 × rows, with ghosts 3 × columns. */
typedef struct OstHardDirect {
    OstContext *ctx;
    size_t n; /* 3 × rows */
    OstSupports *supports;
    OstSystem *system;
    OstScaling *scaling;
    OstMumps *factors;
    double *force, *f;
    OstTwofold *u, *p; /* with ghosts: solution; direction of search, its lower halves 0 */
    double *r, *q, *d; /* residual; K p; correction, with ghosts */
    int indefinite;    /* was a p met with p·K p <= 0? Then K, as it is rounded, has no solution of least energy */
} OstHardDirect;

/* Collective. Where rounding has made K indefinite, or its factors, those of K and a little on its diagonal serve.
 * Fails where the equations cannot be factored even so; to be cleared also then. */
OstStatus ost_hard_direct_create(const OstScene *scene, OstHardDirect *direct);
void ost_hard_direct_clear(OstHardDirect *direct);

/* Collective. u = K^-1 f by conjugate gradients on the factors, residuals and products summed in twofold precision,
 * from 0 until a correction is no more than `enough` of u: then `known`, or until K is found indefinite. `first` (or
 * NULL) takes what the factors by themselves made of f. */
OstStatus ost_hard_direct_solve(OstHardDirect *direct, const double *f, double enough, double *first, int *known);

/* Collective. d = K^-1 r by the factors, which may be of K and a little on its diagonal. */
OstStatus ost_hard_direct_apply(OstHardDirect *direct);

/* Collective. ||v||, and the norm of u. */
OstStatus ost_hard_direct_norm(const OstHardDirect *direct, const double *v, double *norm);
OstStatus ost_hard_direct_size(OstHardDirect *direct, double *norm);

#endif
