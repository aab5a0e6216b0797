/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_WATCH_H
#define ORTHOSTAT_ALGEBRA_WATCH_H

enum { OST_WATCH_WINDOW = 20 };

/* A norm that goes up and down in conjugate gradients: the least one so far is what counts. */
typedef struct OstTrack {
    double first, least;
    double before[OST_WATCH_WINDOW]; /* the least ones of the last iterations */
} OstTrack;

/* Watches a residual fall, in the norm that is asked for and in that of the preconditioner, sqrt(r·z): while the first
 * still rises (thin bodies, uneven stiffness), the second, close to the norm of the energy, may long be falling. */
typedef struct OstWatch {
    int count; /* iterations so far */
    OstTrack residual, energy;
} OstWatch;

/* Local, all. `weight` is r·z. */
void ost_watch_start(OstWatch *watch, double norm);
void ost_watch_add(OstWatch *watch, double norm, double weight);

/* By what an iteration of the last window multiplied the faster of the two; and the residual since the start (geometric
 * means). */
double ost_watch_factor(const OstWatch *watch);
double ost_watch_whole_factor(const OstWatch *watch);

/* How many more iterations it takes to reach `target` at the pace of the last window: INFINITY if there is none, 0 if
 * it is too early to say (two windows). */
double ost_watch_remaining(const OstWatch *watch, double target);

#endif
