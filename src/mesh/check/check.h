/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_CHECK_CHECK_H
#define ORTHOSTAT_MESH_CHECK_CHECK_H

#include "mesh/mesh_data.h"

/* Collective. What can be told of a chunk before its tets meet their vertices: counts and ranges that fit together,
 * finite coordinates, node and region numbers in range, no tet that uses a node twice. Empty shares get the place in
 * the ranges that they have. */
OstStatus ost_check_chunk(OstMeshChunk *chunk);

/* Collective. The rest, on the finished pieces: no inverted or flat tet, every vertex used, every item of a boundary
 * part of a tet. */
OstStatus ost_check_mesh(const OstMesh *mesh);

/* Collective. Raises OST_INVALID_INPUT, with the label, if a quadratic tet folds over at one of its vertices. */
OstStatus ost_check_folds(const OstMesh *quadratic);

#endif
