/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_BOUNDARY_CONDITIONS_H
#define ORTHOSTAT_PROBLEM_BOUNDARY_CONDITIONS_H

#include "assembly/supports.h"
#include "problem/scene_data.h"

/* Collective. The supports that the case's constraints make; displacements that do not follow the function of time
 * `table` (0: t itself, 1 + k: table k of the case) are prescribed as zero. Raises OST_INVALID_INPUT with the case's
 * line where constraints contradict each other, or if nothing is constrained. */
OstStatus ost_scene_supports(const OstScene *scene, int table, OstSupports **supports);

/* Collective. Adds the case's loads that follow this function of time to `force` (3 × node_count, complete on owned
 * nodes). Warns of a load that these supports take up whole, so that it strains nothing; they may be NULL. */
OstStatus ost_scene_loads(const OstScene *scene, int table, const OstSupports *supports, double *force);

#endif
