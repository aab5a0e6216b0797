/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_PARALLEL_ROUTE_H
#define ORTHOSTAT_CORE_PARALLEL_ROUTE_H

#include "orthostat/context.h"

/* Where each of this rank's items goes: any number of ranks. What arrives is in the order of the sending rank, then of
 * the item on it. Made once, a route carries as many arrays over the items as there are. */
typedef struct OstRoute {
    OstContext *ctx;
    OstLocal sends;
    OstLocal receives;
    OstLocal *item;                                               /* sends: the items, grouped by the rank they go to */
    int *send_count, *send_start, *receive_count, *receive_start; /* per rank */
} OstRoute;

/* Collective. Item i goes to the ranks to[i × width ..], once to each that is named there; -1 names none. */
OstStatus ost_route_create(OstContext *ctx, OstLocal count, int width, const int *to, OstRoute **route);
void ost_route_destroy(OstRoute **route);

/* Collective. Carries `size` bytes per item; `arrived` is new memory for receives × size bytes. */
OstStatus ost_route_carry(const OstRoute *route, size_t size, const void *values, void **arrived);

/* Collective. The way back, of a route on which each item goes to one rank: `answers` has `size` bytes for each item
 * that arrived, and `mine` takes them in the order of the items that were sent. */
OstStatus ost_route_answer(const OstRoute *route, size_t size, const void *answers, void *mine);

#endif
