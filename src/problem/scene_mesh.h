/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_SCENE_MESH_H
#define ORTHOSTAT_PROBLEM_SCENE_MESH_H

#include "case/case_data.h"
#include "problem/scene_materials.h"

/* Collective. This rank's piece of the case's mesh: read or made, with the axes that the case has in tables,
 * partitioned and distributed, refined as often as the case says, and in tets of the case's order (new nodes of shapes
 * lie on the true surface). `from_file`: the materials that came with the file, or NULL; `materials`: one for each
 * region. The partition runs along their stiff directions where it can. Both are the caller's to free. */
OstStatus ost_scene_make_mesh(const OstCase *c, OstMesh **mesh, OstFileMaterials **from_file,
                              OstSceneMaterials *materials);

/* Collective. The second half of that: partitions, distributes and refines a chunk, which is consumed, and changes it
 * to the case's order. */
OstStatus ost_scene_distribute(const OstCase *c, const OstFileMaterials *from_file, OstMeshChunk **chunk,
                               OstMesh **mesh, OstSceneMaterials *materials);

#endif
