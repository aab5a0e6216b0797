/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_COMPONENTS_COMPONENT_RANKS_H
#define ORTHOSTAT_MESH_COMPONENTS_COMPONENT_RANKS_H

#include "mesh/mesh_data.h"

/* Collective. Joins the ranks' sets of tets into those of the whole body: two sets are one if they have a tet in
 * common, which is owned on one rank and a ghost on the other. On entry set[t] is one of this rank's `set_count`
 * numbers, on return one of *count numbers of all ranks. */
OstStatus ost_component_ranks_merge(const OstMesh *mesh, OstLocal set_count, OstLocal *set, OstLocal *count);

#endif
