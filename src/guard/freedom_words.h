/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_FREEDOM_WORDS_H
#define ORTHOSTAT_GUARD_FREEDOM_WORDS_H

#include "guard/freedom_rows.h"

/* Local. Describes the motions of a body: "can move along (0, 0, 1) and turn about the line through (0, 2, 1) along (1,
 * 0, 0)". `motions` are count × 6 numbers in `frame`, independent (1 to 6 of them). */
OstStatus ost_motion_words(OstContext *ctx, const OstRigidFrame *frame, int count, const double *motions, char *text,
                           size_t size);

/* Local. "(0.5, 2, 1)", the same for points that differ by rounding; `scale` is the size of numbers near it. */
void ost_point_words(const double point[3], double scale, char text[96]);

#endif
