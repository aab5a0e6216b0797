/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_SCENE_PARTITION_H
#define ORTHOSTAT_PROBLEM_SCENE_PARTITION_H

#include "problem/scene_materials.h"

/* Collective. Distributes the mesh (ost_mesh_distribute) so that ranks' borders run along the stiff directions of
 * orthotropic materials rather than across: multigrid's aggregates and blocks end at a border, and what they cut there
 * costs iterations. Axes that are not known yet (of gradients) count as isotropic; isotropic bodies are asked nothing.
 */
OstStatus ost_scene_partition(const OstSceneMaterials *materials, OstMeshChunk **chunk, OstMesh **mesh);

#endif
