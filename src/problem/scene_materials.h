/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_SCENE_MATERIALS_H
#define ORTHOSTAT_PROBLEM_SCENE_MATERIALS_H

#include "case/case_data.h"
#include "formats/serial/formats.h"

/* One material and one specification of axes for every region of the mesh. The specifications borrow their arrays from
 * the case. */
typedef struct OstSceneMaterials {
    OstMaterial *material;
    OstAxesSpec *axes;
} OstSceneMaterials;

/* Local, the same on all ranks. One for each of the mesh's regions: the mesh file's materials, overridden by those of
 * the case, later ones first. Raises OST_INVALID_INPUT if the case names a region that does not exist (listing those
 * that do), or leaves one without a material. */
OstStatus ost_scene_materials(const OstCase *c, const OstNames *regions, const OstFileMaterials *from_file,
                              OstSceneMaterials *materials);
void ost_scene_materials_release(OstSceneMaterials *materials);

/* Collective. Reads the tables of axes that the case's materials name into the chunk's tet_axes: one line a tet, in the
 * order of the mesh file. Done before the mesh is partitioned, while tets are in that order. */
OstStatus ost_scene_read_cell_axes(const OstCase *c, OstMeshChunk *chunk);

#endif
