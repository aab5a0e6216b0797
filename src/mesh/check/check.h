/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_CHECK_CHECK_H
#define ORTHOSTAT_MESH_CHECK_CHECK_H

#include "mesh/mesh_data.h"

/* Collective. Checks what a rank can see before the mesh is distributed: counts and ranges fit together, coordinates
 * are finite, node and region numbers in range, and no tet uses a node twice. Sets first_node and first_tet of empty
 * shares.
 */
OstStatus ost_check_chunk(OstMeshChunk *chunk);

/* Collective. Checks the rest on the distributed mesh: no tet is inverted, flat or (`curved`) folded, every vertex is
 * used, and every boundary item is a face, an edge or a vertex of a tet. */
OstStatus ost_check_mesh(OstMesh *mesh, int curved);

/* Collective. Raises OST_INVALID_INPUT, with the label, if a quadratic tet folds over at one of its vertices; or, where
 * the mesh says `straighten`, straightens the edges of such tets and warns. */
OstStatus ost_check_folds(OstMesh *quadratic);

#endif
