/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_REFINEMENT_INHERIT_H
#define ORTHOSTAT_MESH_REFINEMENT_INHERIT_H

#include "mesh/mesh_data.h"

/* Local. A mesh with the parent's regions, and its boundaries without items; all else is empty. The caller destroys it,
 * also after a failure. */
OstStatus ost_mesh_inherit(const OstMesh *parent, int nodes_per_tet, OstMesh **mesh);

/* Local. Nodes of an item of a dimension (0-2) on a mesh of linear or quadratic tets. */
int ost_nodes_per_item(int nodes_per_tet, int dimension);

#endif
