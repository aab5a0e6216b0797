/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_TOGETHER_TOGETHER_H
#define ORTHOSTAT_CORE_TOGETHER_TOGETHER_H

#include "orthostat/context.h"

/* Tasks that do the same for different data, such as load cases of one body. What costs most reads much that is common
 * to all (a matrix, the tets), and costs little more for several vectors than for one. So each task runs, on a stack
 * of its own, until it hands in a request; once all wait, requests of one kind are served together. One task runs at a
 * time, and the order depends on the requests alone: it is the same on all ranks. */

/* Serves requests of one kind. `common`: what they have in common, by which they are told from others. */
typedef OstStatus OstServe(void *common, int count, void *const *request);

enum { OST_MOST_TOGETHER = 16 };

/* Collective. Runs the tasks 0 to count - 1, OST_MOST_TOGETHER at the most. Raises OST_OUT_OF_MEMORY, before any has
 * begun, if there is no room for their stacks. A task cannot begin others. */
OstStatus ost_together_run(OstContext *ctx, int count, void (*task)(void *data, int number), void *data);

/* Inside a task: returns when the request has been served. Elsewhere it is served at once, alone. To be called by all
 * ranks alike, also where what is served is local. `most`: so many are served at once; more would be no cheaper. */
OstStatus ost_together(OstContext *ctx, OstServe *serve, int most, void *common, void *request);

/* Inside a task: returns when all others are over or have come to such a call too, so that what follows is done
 * together. To be called by all ranks alike. */
void ost_together_gather(OstContext *ctx);

/* Local. Is a task running? */
int ost_together_any(const OstContext *ctx);

/* Local. Seconds, as ost_seconds counts them, without those in which this task waited for others: of what is served
 * together each has an equal share. */
double ost_own_seconds(const OstContext *ctx);

#endif
