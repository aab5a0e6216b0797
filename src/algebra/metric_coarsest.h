/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_METRIC_COARSEST_H
#define ORTHOSTAT_ALGEBRA_METRIC_COARSEST_H

#include "algebra/metric_exact.h"

/* A small matrix that every rank holds whole and factors alone: on the coarsest level messages cost more than flops. */
typedef struct OstCoarsest {
    OstContext *ctx;
    int order;      /* unknowns over all ranks */
    int owned;      /* of them on this rank */
    int *count;     /* ranks: unknowns of each */
    int *start;     /* ranks: number of the first */
    double *factor; /* order × order: LAPACK's Cholesky factor */
    double *vector; /* order */
} OstCoarsest;

/* The largest order that is factored as a dense matrix: 128 MiB a rank. */
enum { OST_COARSEST_LIMIT = 4096 };

/* Collective. The matrix is not kept. Raises OST_LIMIT_EXCEEDED over the limit and OST_LIBRARY_FAILED if
 * the matrix cannot be factored even with a small shift, which a positive semidefinite one gets. */
OstStatus ost_coarsest_create(const OstExactMatrix *matrix, OstCoarsest **coarsest);
void ost_coarsest_destroy(OstCoarsest **coarsest);

/* Collective. Solves A x = b; this rank's parts. */
OstStatus ost_coarsest_solve(OstCoarsest *coarsest, const double *b, double *x);

#endif
