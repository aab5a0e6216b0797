/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_WATCH_H
#define ORTHOSTAT_ALGEBRA_WATCH_H

enum { OST_WATCH_WINDOW = 20 };

/* Watches a residual fall. Its norm goes up and down in conjugate gradients, so the least one so far is what counts. */
typedef struct OstWatch {
    int count;                       /* iterations so far */
    double first;                    /* norm before the first */
    double least;                    /* norm so far */
    double before[OST_WATCH_WINDOW]; /* the least ones of the last iterations */
} OstWatch;

/* Local, all. */
void ost_watch_start(OstWatch *watch, double norm);
void ost_watch_add(OstWatch *watch, double norm);

/* By what an iteration multiplies the norm: over the last window, and since the start (geometric means). */
double ost_watch_factor(const OstWatch *watch);
double ost_watch_whole_factor(const OstWatch *watch);

/* How many more iterations it takes to reach `target` at the pace of the last window: INFINITY if there is none, 0 if
 * it is too early to say (two windows). */
double ost_watch_remaining(const OstWatch *watch, double target);

#endif
