/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_TRILINOS_EPETRA_H
#define ORTHOSTAT_ALGEBRA_TRILINOS_EPETRA_H

#include "orthostat/context.h"

/* Epetra's map of the unknowns: which global numbers this rank owns (contiguous, in rank order). */
typedef struct OstEpetraMap OstEpetraMap;

/* Collective. The map of `count` unknowns on this rank. Raises OST_LIMIT_EXCEEDED if the total is more than
 * Epetra's C interface can number. */
OstStatus ost_epetra_map_create(OstContext *ctx, OstLocal count, OstEpetraMap **map);
void ost_epetra_map_destroy(OstEpetraMap **map);

/* Collective. The 2-norm of a distributed vector, which Epetra uses in place. */
OstStatus ost_epetra_norm(const OstEpetraMap *map, const double *values, double *norm);

#endif
