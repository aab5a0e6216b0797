/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_SCENE_LINKS_H
#define ORTHOSTAT_PROBLEM_SCENE_LINKS_H

#include "assembly/supports.h"
#include "problem/scene_data.h"

/* Collective. Gives the supports the links (assembly/links/links.h) that the case's rigid, tied and periodic faces
 * make, if it has such; before ost_supports_complete. What does not follow the function of time `table` is prescribed
 * as zero. Raises OST_INVALID_INPUT with the case's line. */
OstStatus ost_scene_links(const OstScene *scene, int table, OstSupports *supports);

#endif
