/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_WATCH_H
#define ORTHOSTAT_STUDY_WATCH_H

#include "orthostat/watch.h"
#include "problem/scene_data.h"

/* A quantity of interest (the case's `watch`): its value in one answer, and the scale of its kind (the largest
 * displacement, the whole reaction). A value that is nearly zero has no relative error of its own; the scale serves. */
typedef struct OstWatched {
    double value;
    double scale;
    double terms; /* of a reaction: the sizes of what it is the sum of; else 0 */
    double error; /* by how much the exact value is larger, as estimated; NAN: not estimated */
    int placed;   /* has the value a place: that of a least or largest one? */
    double place[3];
    int in_doubt;      /* of a reaction: an OstBearingDoubt, of any of its nodes */
    const char *why;   /* is the error not known although the estimate was asked for; NULL else */
    const char *exact; /* why the value has no error of the mesh, in words; NULL else */
} OstWatched;

/* Collective. The quantity in a result of the scene. */
OstStatus ost_watch_evaluate(const OstScene *scene, const OstResult *result, const OstWatch *watch,
                             OstWatched *watched);

/* Local. A line each: value, and the expected one where it is known. */
void ost_watch_print(const OstWatchedValue *values, int count);

/* Collective. Those of stress (study/watch_stress.c): the value, and whether there is such a point, or region. */
OstStatus ost_watch_stress(const OstScene *scene, const OstResult *result, const OstWatch *watch, OstWatched *watched);
OstStatus ost_watch_check_stress(const OstScene *scene, const OstWatch *watch);

/* Collective. The size of energies in this answer: that of its strains if no eigenstrain relieved them. Where a body
 * swells freely, what is left of its energy is rounding. */
OstStatus ost_energy_scale(const OstResult *result, double *scale);

#endif
