/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_PARALLEL_ROUTE_H
#define ORTHOSTAT_CORE_PARALLEL_ROUTE_H

#include "orthostat/context.h"

/* Sends each of this rank's items to any number of ranks. Items arrive in the order of the sending rank, then in their
 * order there. One route carries any number of arrays over the same items. */
typedef struct OstRoute {
    OstContext *ctx;
    OstLocal sends;
    OstLocal receives;
    OstLocal *item;                                               /* sends: the items, grouped by the rank they go to */
    int *send_count, *send_start, *receive_count, *receive_start; /* per rank */
} OstRoute;

/* Collective. Item i goes to the ranks to[i × width ..], once to each; -1 is no rank. */
OstStatus ost_route_create(OstContext *ctx, OstLocal count, int width, const int *to, OstRoute **route);
void ost_route_destroy(OstRoute **route);

/* Collective. Carries `size` bytes per item. *arrived has receives × size bytes; the caller frees it. */
OstStatus ost_route_carry(const OstRoute *route, size_t size, const void *values, void **arrived);

/* Collective. Sends answers back along a route on which each item goes to one rank. `answers` has `size` bytes for each
 * item that arrived; `mine` gets them in the order of the items sent. */
OstStatus ost_route_answer(const OstRoute *route, size_t size, const void *answers, void *mine);

#endif
