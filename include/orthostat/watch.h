/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_WATCH_H
#define ORTHOSTAT_WATCH_H

#include "orthostat/scene.h"

OST_API_BEGIN

/* The quantities of interest that a case states (`watch`). */

/* Collective. Checks them, those of its verify section too: raises OST_INVALID_INPUT for a selection that does not
 * exist or is empty; warns where a displacement is taken at a vertex that is not near the point stated. */
OstStatus ost_watch_check(const OstScene *scene);

/* Collective. The values of all of them (ost_case_watch_count) in a result of the scene, in the case's order. The array
 * is the caller's, to be freed by ost_free_memory; names are the case's. */
OstStatus ost_watch_evaluate_all(const OstScene *scene, const OstResult *result, OstWatchedValue **values);

OST_API_END

#endif
