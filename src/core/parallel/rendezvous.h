/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_PARALLEL_RENDEZVOUS_H
#define ORTHOSTAT_CORE_PARALLEL_RENDEZVOUS_H

#include "orthostat/context.h"

/* A key of two numbers: a vertex by its label, twice; an edge by its ends' labels, the lower first; and the like. */
typedef struct OstKey {
    OstGlobal low, high;
} OstKey;

static inline OstKey ost_key(OstGlobal a, OstGlobal b)
{
    return a < b ? (OstKey){a, b} : (OstKey){b, a};
}

/* Keys with a value each. Where several ranks have one key, the value of the lowest `order` counts, so that the answer
 * does not depend on which rank is asked (NULL: all values of a key are the same). */
typedef struct OstKeyed {
    OstLocal count;
    const OstKey *key;
    const OstGlobal *order;
    const void *value; /* count × size bytes */
} OstKeyed;

/* Collective. The values of `count` keys, from the ranks that have them, whichever those are. A rank found by a hash of
 * the key brings the two together. Raises OST_INVALID_INPUT if no rank has a key, with `what` it is a key of. */
OstStatus ost_rendezvous(OstContext *ctx, const char *what, size_t size, const OstKeyed *known, OstLocal count,
                         const OstKey *key, void *value);

#endif
