/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_BOUNDARY_CONDITIONS_H
#define ORTHOSTAT_PROBLEM_BOUNDARY_CONDITIONS_H

#include "assembly/follower.h"
#include "assembly/loads.h"
#include "assembly/spread.h"
#include "assembly/supports.h"
#include "problem/scene_data.h"

/* Collective. The supports that the case's constraints and springs make; displacements that do not follow the function
 * of time `table` (0: t itself, 1 + k: table k of the case) are prescribed as zero. Raises OST_INVALID_INPUT with the
 * case's line where constraints contradict each other, or if nothing is constrained. */
OstStatus ost_scene_supports(const OstScene *scene, int table, OstSupports **supports);

/* Collective. Adds the case's loads that follow this function of time to `force` (3 × node_count, complete on owned
 * nodes), and pressures that follow the surface to *follower, which stays NULL if there are none. Warns of a load that
 * these supports take up whole, so that it strains nothing; they may be NULL. Distributing couplings
 * whose motion is given have no force yet. */
OstStatus ost_scene_loads(const OstScene *scene, int table, const OstSupports *supports, double *force,
                          OstFollower **follower);

/* Collective. Adds one load likewise; of a distributing coupling, the force and moment that the scene has for it in
 * function 0. */
OstStatus ost_scene_load(const OstScene *scene, int number, double *force);

/* Local. How the body turns, of a centrifugal load. */
OstSpin ost_load_spin(const OstLoad *load);

/* Collective. Of a load with a moment: the faces on which it acts, the caller's to free, and the traction there; of a
 * distributing coupling, that of one function of time. Where it acts on vertices (*on_faces is 0), neither. */
OstStatus ost_scene_spread(const OstScene *scene, const OstLoad *load, int function, int *on_faces, OstLocal *count,
                           int *nodes_per_face, OstLocal **faces, OstSpread *spread);

#endif
