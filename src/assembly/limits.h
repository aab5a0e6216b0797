/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_LIMITS_H
#define ORTHOSTAT_ASSEMBLY_LIMITS_H

#include "orthostat/context.h"

/* Local. Limits of the libraries, checked before memory of that size is allocated. Each raises OST_LIMIT_EXCEEDED with
 * the count, the limit and the library. */
OstStatus ost_limit_unknowns(OstContext *ctx, OstGlobal global_rows); /* Epetra, ML: scalar unknowns of all ranks */
OstStatus ost_limit_nonzeros(OstContext *ctx, OstGlobal blocks);      /* ML: scalar nonzeros of a rank */
OstStatus ost_limit_incidences(OstContext *ctx, OstGlobal tets, int nodes_per_tet); /* OstLocal: nodes of all tets */

#endif
