/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_FREEDOM_REPORT_H
#define ORTHOSTAT_GUARD_FREEDOM_REPORT_H

#include "guard/freedom_linkage.h"

enum { OST_FREEDOM_LINES = 10, OST_FREEDOM_TEXT = 3000 };

/* The free motions in words, a line for each set of components that moves as one. */
typedef struct OstFreedomReport {
    OstLocal found;    /* sets of components that can move; the first OST_FREEDOM_LINES have a line */
    OstLocal unsolved; /* components in clusters too large to be solved */
    char text[OST_FREEDOM_TEXT];
} OstFreedomReport;

/* Local. Looks at every cluster of the linkage. */
OstStatus ost_freedom_report(const OstLinkage *linkage, OstFreedomReport *report);

/* Local. The lines for one cluster's motions (freedom_sets.c). */
OstStatus ost_freedom_report_sets(const OstLinkage *linkage, const OstFreeMotions *free, OstFreedomReport *report);

/* Local. A line: these components move as one, by `count` motions (count × 6 numbers in `frame`). */
OstStatus ost_freedom_report_line(const OstLinkage *linkage, int members, const OstLocal *member,
                                  const OstRigidFrame *frame, int count, const double *motions,
                                  OstFreedomReport *report);

/* Local. A line: these components move against each other, in `count` ways that are not the motion of one set of them.
 */
void ost_freedom_report_rest(const OstLinkage *linkage, int members, const OstLocal *member, int count,
                             OstFreedomReport *report);

/* Local. Describes the motions of a body: "can move along (0, 0, 1) and turn about the line through (0, 2, 1) along (1,
 * 0, 0)". `motions` are count × 6 numbers in `frame`, independent (1 to 6 of them); what differs by less than `same`
 * of the body's size is told as the same. */
OstStatus ost_motion_words(OstContext *ctx, const OstRigidFrame *frame, int count, const double *motions, double same,
                           char *text, size_t size);

/* Local. "(0.5, 2, 1)", the same for points that differ by rounding; `scale` is the size of numbers near it. */
void ost_point_words(const double point[3], double scale, char text[96]);

#endif
