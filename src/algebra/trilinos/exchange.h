/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_TRILINOS_EXCHANGE_H
#define ORTHOSTAT_ALGEBRA_TRILINOS_EXCHANGE_H

#include "core/parallel/halo.h"

/* ML's exchange of ghost values (ML_exchange_bdry) between the neighbours of a halo, for entries of `width` numbers.
 * (Epetra's importer would do the same, but with a barrier over all ranks in each exchange.) */
typedef struct OstExchange OstExchange;

/* Collective. The halo is not kept. Raises OST_LIMIT_EXCEEDED if ML's 32-bit numbers are too small. */
OstStatus ost_exchange_create(const OstHalo *halo, int width, OstExchange **exchange);
void ost_exchange_destroy(OstExchange **exchange);

/* Local. Has this rank a neighbour? */
int ost_exchange_any(const OstExchange *exchange);

/* Collective over neighbours. Copies owners' values into the ghosts of x. */
void ost_exchange_import(const OstExchange *exchange, double *x);

/* Collective over neighbours. Adds the ghosts' values to those of their owners; the ghosts' stay as they are. */
void ost_exchange_add_to_owners(const OstExchange *exchange, double *x);

#endif
