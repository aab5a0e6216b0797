/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_SCENE_MESH_H
#define ORTHOSTAT_SOLVE_SCENE_MESH_H

#include "orthostat/case.h"
#include "orthostat/mesh_file.h"

/* Collective. This rank's piece of the case's mesh: read or made, given the axes that the case has in tables, cut and
 * distributed, refined as often as the case says, and in tets of the case's order (new nodes of shapes lie on the true
 * surface). `materials` are those that came with the file, or NULL; the caller's to free. */
OstStatus ost_scene_mesh(const OstCase *c, OstMesh **mesh, OstFileMaterials **materials);

/* Collective. The second half of it: a chunk, which is consumed, cut, distributed, refined and in the case's order. */
OstStatus ost_scene_distribute(const OstCase *c, OstMeshChunk **chunk, OstMesh **mesh);

#endif
