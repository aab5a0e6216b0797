/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SADDLE_RUN_H
#define ORTHOSTAT_ALGEBRA_SADDLE_RUN_H

#include "algebra/krylov/goal.h"
#include "algebra/krylov/lanczos.h"
#include "algebra/saddle/local_schur.h"
#include "algebra/saddle/means.h"
#include "algebra/saddle/norm.h"

/* A vector of the system: of displacements, and of pressures with room for ghosts. */
typedef struct OstSaddlePair {
    double *u, *p;
} OstSaddlePair;

typedef struct OstSaddleRun {
    OstContext *ctx;
    const OstCgSystem *system;
    const OstPreconditioner *preconditioner;
    const OstSaddle *saddle;
    const double *f;
    double *u;
    OstGoal *goal;
    size_t n, m, mg; /* unknowns, pressures, and these with ghosts */
    double *memory;
    OstSaddlePair r, z, d, k;  /* residual, preconditioned; direction, and the system times it */
    double *az, *ad, *bz, *bd; /* A and B times z and d */
    double *w;                 /* N^-1 k, and other displacements */
    double *wide, *scaled;     /* z with ghosts; work of the preconditioner */
    double *q;                 /* pressures: work, with ghosts */
    double *work;              /* of ost_coupling_schur_solve */
    double *weights;           /* likewise (ost_pressure_weights), or NULL */
    OstSoftMeans *means;       /* beside it, or NULL */
    OstLocalSchur *local;      /* likewise */
    double tau;
    double size; /* of r.u when z.u was last computed */
    int carried; /* has it been since? */
    double weight;
    double energy; /* of the right-hand sides, about */
    int passes, restarts;
    double begun;        /* the weight that the pass began with, over tau squared */
    int lost;            /* has rounding ended it? */
    double beyond;       /* a step whose curvature over its weight and tau is larger tells that */
    OstSaddlePair start; /* u and p where the pass began */
    double start_norm;   /* their true residual */
    OstLanczos lanczos;
} OstSaddleRun;

/* Local but for the create. `preconditioner`: NULL for none. */
OstSaddleRun ost_saddle_run_of(const OstCgSystem *system, const OstPreconditioner *preconditioner,
                               const OstSaddle *saddle, const double *f, double *u, OstGoal *goal);
OstStatus ost_saddle_run_create(OstSaddleRun *run);
void ost_saddle_run_destroy(OstSaddleRun *run);

/* Collective. z = S^-1 r, by all that is known of S. */
OstStatus ost_saddle_schur_solve(const OstSaddleRun *run, const double *r, double *z);

/* Collective. z = N^-1 r. */
OstStatus ost_saddle_precondition(OstSaddleRun *run, const double *r, double *z);

/* Collective. The norm of the residual at hand; and r = b - K x for the u and p reached, with its norm in the goal. */
OstStatus ost_saddle_find_norm(OstSaddleRun *run, double *norm);
OstStatus ost_saddle_find_residual(OstSaddleRun *run);

/* Collective. The size of u and p in the norm of the energy: u·A u + p·C p, of the solution. */
OstStatus ost_saddle_find_size(OstSaddleRun *run, double *size);

#endif
