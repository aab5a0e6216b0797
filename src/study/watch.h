/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_WATCH_H
#define ORTHOSTAT_STUDY_WATCH_H

#include "orthostat/scene.h"

/* A watched quantity of one answer, and the size of its kind: the largest displacement, the whole reaction. Beside
 * that a quantity may be zero, and then has no relative error of its own. */
typedef struct OstWatched {
    double value;
    double scale;
} OstWatched;

/* Collective. Moves the place of a watched displacement to the vertex of this mesh that is nearest (mid-edge nodes do
 * not count), where it stays when the mesh is refined; warns if that is further away than a tenth of the vertex's
 * shortest edge. Other quantities have no place and are left alone. */
OstStatus ost_watch_place(const OstMesh *mesh, OstWatch *watch);

/* Collective. The quantity in a result of the scene. */
OstStatus ost_watch_evaluate(const OstScene *scene, const OstResult *result, const OstWatch *watch,
                             OstWatched *watched);

/* Collective. Refuses a scene whose case watches, or verifies, on a selection that is not there or selects nothing;
 * warns of a displacement that is watched at another place than the one asked for, as ost_watch_place does. */
OstStatus ost_watch_check(const OstScene *scene);

/* Collective. All that the case watches, in its order: memory from the context, the caller's to free; names are the
 * case's. */
OstStatus ost_watch_evaluate_all(const OstScene *scene, const OstResult *result, OstWatchedValue **values);

/* Local. A line each: value, and the expected one where it is known. */
void ost_watch_print(const OstWatchedValue *values, int count);

#endif
