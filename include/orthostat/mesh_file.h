/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MESH_FILE_H
#define ORTHOSTAT_MESH_FILE_H

#include "orthostat/mesh.h"

OST_API_BEGIN

/* Collective. Reads a mesh by its file's ending: .msh and .msh.gz (Gmsh 1 to 4.1, ASCII and
 * binary), .veg (Vega FEM), .vtkhdf. Serial formats are read by rank 0, .vtkhdf by all ranks in parallel. Raises
 * OST_FILE_FAILED or OST_INVALID_INPUT with file:line where there is one, what was found and what was expected.
 * Cubic .veg elements are refused by name. Nodes and tets have the file's numbers as labels; the tets that a
 * hexahedron, wedge or pyramid of number 17 is split into have 171, 172, ..., and a tet beside such has 171. Tets come
 * in the file's order; those of a .msh file in the order of their numbers, turned if all are inverted, and without the
 * nodes that no tet uses. The chunk is the caller's, for ost_mesh_distribute or ost_scene_create_on. Materials that a
 * .veg file brings are left out; a case takes them. */
OstStatus ost_chunk_read(OstContext *ctx, const char *path, OstMeshChunk **chunk);

OST_API_END

#endif
