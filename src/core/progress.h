/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_PROGRESS_H
#define ORTHOSTAT_CORE_PROGRESS_H

#include "orthostat/context.h"

/* Work that takes long shows itself, on rank 0: on a terminal in one line, which is redrawn; elsewhere by a line of the
 * log every half minute. Both say what is done now, how much of it, and how much time is left. */

/* Local; for programs. Shows progress from now on while `ctx` lives, at any time, by a timer's signal. */
void ost_progress_start(OstContext *ctx);
void ost_progress_end(void);

/* Local. The whole is foretold to take so many seconds, from the start of the program. */
void ost_progress_expect(OstContext *ctx, double seconds);

/* Local. The phase of the work has changed; of how much of it is done nothing is known yet. */
void ost_progress_phase(OstContext *ctx, const char *phase);

/* Local. Of parts of a task that are done at the same time (a batch), by what was foretold: seconds of what they share,
 * and of each of them. From now on the next `count` parts are such a batch; 0: they are not. */
void ost_progress_expect_batch(OstContext *ctx, double once, double each);
void ost_progress_batch(OstContext *ctx, int count);

#endif
