/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_COARSEST_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_COARSEST_H

#include "algebra/direct/mumps.h"

/* The factors of the coarsest level. A small matrix every rank holds whole and factors alone, as messages would cost
 * more than flops; a large one is MUMPS's. */
typedef struct OstCoarsest {
    OstContext *ctx;
    int dense;
    OstMumps *sparse; /* the rest is of the dense one */
    int order;        /* unknowns over all ranks */
    int owned;        /* of them on this rank */
    int *count;       /* ranks: unknowns of each */
    int *start;       /* ranks: number of the first */
    double *factor;   /* order × order: LAPACK's Cholesky factor */
    double *vector;   /* order */
} OstCoarsest;

/* The largest order that is factored as a dense matrix: beyond it MUMPS is faster. */
enum { OST_COARSEST_LIMIT = 2000 };

/* Collective. The matrix is not kept; up to OST_COARSEST_LIMIT unknowns the factor is dense. Raises OST_NOT_CONVERGED
 * if it cannot be factored (the dense one: even with a small shift, which a positive semidefinite one gets), and what
 * ost_mumps_create does, `memory` included. */
OstStatus ost_coarsest_create(const OstDoubleMatrix *matrix, double memory, OstCoarsest **coarsest);
void ost_coarsest_destroy(OstCoarsest **coarsest);

/* Collective. Solves A x = b; this rank's parts. */
OstStatus ost_coarsest_solve(OstCoarsest *coarsest, const double *b, double *x);

#endif
