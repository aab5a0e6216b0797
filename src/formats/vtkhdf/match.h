/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_VTKHDF_MATCH_H
#define ORTHOSTAT_FORMATS_VTKHDF_MATCH_H

#include "orthostat/context.h"

/* Finds equal keys on different ranks. All equal keys are sent to the rank that their hash names, so no rank holds all
 * keys. */

/* Four words that are compared bit by bit: a label, a point's coordinates, ... */
enum { OST_KEY_WORDS = 4 };

typedef struct OstKey {
    OstGlobal word[OST_KEY_WORDS];
} OstKey;

/* Collective. Every rank contributes `pool_count` keys, each with a value of 0 or more, and asks for `query_count`
 * keys. Each answer is the smallest value that any rank contributed for an equal key, or -1 if none did. */
OstStatus ost_match_keys(OstContext *ctx, OstLocal pool_count, const OstKey *pool_key, const OstGlobal *pool_value,
                         OstLocal query_count, const OstKey *query_key, OstGlobal *answer);

#endif
