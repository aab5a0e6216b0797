/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_COMPONENTS_COMPONENT_RANKS_H
#define ORTHOSTAT_MESH_COMPONENTS_COMPONENT_RANKS_H

#include "mesh/mesh_data.h"

/* Collective. Merges each rank's sets of tets into those of the whole body, by the tets that several ranks hold:
 * set[t] comes as one of this rank's `set_count` numbers and leaves as one of *count numbers that all ranks share. */
OstStatus ost_component_ranks_merge(const OstMesh *mesh, OstLocal set_count, OstLocal *set, OstLocal *count);

#endif
