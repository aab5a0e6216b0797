/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MULTIGRID_COARSEST_H
#define ORTHOSTAT_ALGEBRA_MULTIGRID_COARSEST_H

#include "algebra/direct/mumps.h"
#include "algebra/matrix/columns.h"

/* The factors of the coarsest level. A small matrix is factored whole by the rank that has all of it, or, where several
 * have it, on every rank, as messages would cost more than the arithmetic; a large one is factored by MUMPS. */
typedef struct OstCoarsest {
    OstContext *ctx;
    int dense;
    int alone;        /* has one rank all unknowns? It alone factors and solves them */
    OstMumps *sparse; /* if not dense; what follows is for a dense matrix */
    int order;        /* unknowns over all ranks */
    int owned;        /* of them on this rank */
    int *count;       /* ranks: unknowns of each */
    int *start;       /* ranks: global number of the first */
    double *factor;   /* order × order: LAPACK's Cholesky factor */
    double *vector;   /* OST_COLUMNS of order */
} OstCoarsest;

/* The largest order that is factored as a dense matrix; above it MUMPS is faster. */
enum { OST_COARSEST_LIMIT = 2000 };

/* Collective. The matrix is not kept. `memory` as in ost_mumps_create. Raises OST_NOT_CONVERGED if the matrix cannot be
 * factored (a dense one gets a small diagonal shift if it is positive semidefinite), and what ost_mumps_create raises.
 */
OstStatus ost_coarsest_create(const OstDoubleMatrix *matrix, double memory, OstCoarsest **coarsest);
void ost_coarsest_destroy(OstCoarsest **coarsest);

/* Collective. Solves A x = b for up to OST_COLUMNS vectors, one after another in b and x, of this rank's unknowns. */
OstStatus ost_coarsest_solve(OstCoarsest *coarsest, int columns, const double *b, double *x);

#endif
