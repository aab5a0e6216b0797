/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef HARD_GRID_DIRECT_H
#define HARD_GRID_DIRECT_H

#include "algebra/direct/mumps.h"
#include "algebra/matrix/scaling.h"
#include "assembly/system.h"
#include "hard_grid/twofold.h"
#include "problem/scene_data.h"

/* A scene's equations, assembled again, and their factors. Vectors have 3 × rows numbers, with ghosts 3 × columns. */
typedef struct HardDirect {
    OstContext *ctx;
    size_t n; /* 3 × rows */
    OstSupports *supports;
    OstSystem *system;
    OstScaling *scaling;
    OstMumps *factors;
    double *force, *f;
    Twofold *u, *p;    /* with ghosts: solution; direction of search, its lower halves 0 */
    double *r, *q, *d; /* residual; K p; correction, with ghosts */
    int indefinite;    /* was p·K p <= 0 for some p? Then the rounded K has no minimum of energy */
} HardDirect;

/* Collective. The equations without factors. */
OstStatus hard_direct_assemble(const OstScene *scene, HardDirect *direct);

/* Collective. If rounding makes the factorisation fail, a little is added to the diagonal that is factored. Fails if
 * that does not help; must be cleared also then. */
OstStatus hard_direct_create(const OstScene *scene, HardDirect *direct);
void hard_direct_clear(HardDirect *direct);

/* Collective. u = K^-1 f by conjugate gradients preconditioned by the factors, with compensated residuals and products,
 * until a correction is at most `enough` of u (then `known`) or K is found to be indefinite. `first`, or NULL: receives
 * the factors' own solution. */
OstStatus hard_direct_solve(HardDirect *direct, const double *f, double enough, double *first, int *known);

/* Collective. d = K^-1 r by the factors. */
OstStatus hard_direct_apply(HardDirect *direct);

/* Local. sum - (K v)_ic, of component c of row i; v with its ghosts. */
Twofold hard_direct_row(const HardDirect *direct, OstLocal i, int c, Twofold sum, const Twofold *v);

/* Collective. ||v||, and the norm of u. */
OstStatus hard_direct_norm(const HardDirect *direct, const double *v, double *norm);
OstStatus hard_direct_size(HardDirect *direct, double *norm);

#endif
