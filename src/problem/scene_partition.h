/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_SCENE_PARTITION_H
#define ORTHOSTAT_PROBLEM_SCENE_PARTITION_H

#include "problem/scene_materials.h"

/* Collective. Distributes the mesh (ost_mesh_distribute) so that borders of ranks run along the stiff directions of
 * orthotropic materials rather than across them: aggregates and blocks of multigrid end at a border, and a strong
 * coupling lost there costs iterations. Axes that are not known yet (of gradients) count as isotropic; a body of
 * isotropic materials is partitioned without weights. */
OstStatus ost_scene_partition(const OstSceneMaterials *materials, OstMeshChunk **chunk, OstMesh **mesh);

#endif
