/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_SCENE_PARTS_H
#define ORTHOSTAT_PROBLEM_SCENE_PARTS_H

#include "orthostat/refine.h"
#include "problem/scene_data.h"

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

/* Collective. This rank's piece of the case's mesh: read or made, with the axes that the case has in tables,
 * partitioned and distributed, refined as often as the case says, and in tets of the case's order (new nodes of shapes
 * lie on the true surface). `from_file`: the materials that came with the file, or NULL; `materials`: one for each
 * region. The partition runs along their stiff directions where it can. Both are the caller's to free. */
OstStatus ost_scene_make_mesh(const OstCase *c, OstMesh **mesh, OstFileMaterials **from_file,
                              OstSceneMaterials *materials);

/* Local. Puts the place where the one material with axes states them, or else the case alone, before a failure. */
OstStatus ost_scene_locate_axes(const OstCase *c, OstStatus status);

/* Collective. The second half of that: partitions, distributes and refines a chunk, which is consumed, and changes it
 * to the case's order. */
OstStatus ost_scene_distribute(const OstCase *c, const OstFileMaterials *from_file, OstMeshChunk **chunk,
                               OstMesh **mesh, OstSceneMaterials *materials);

/* Collective. Warns of neighbours that do not fit (mesh/misfit.h), unless they are tied; shapes have none. */
OstStatus ost_scene_check_fit(const OstCase *c, const OstMesh *mesh);

/* Local. The curved surface on which new nodes of the case's shape are placed. */
OstShapeSurface ost_scene_surface(const OstCase *c);

/* Collective. Axes from one or two harmonic potentials. Each is 0 on its boundary `from`, 1 on its boundary `to`, 1/2
 * where these touch, and has no flux elsewhere. One axis is the gradient of the first; another is the part of the
 * second's orthogonal to it. Tets in which a potential does not vary (all their vertices lie on one boundary) take the
 * mean direction around them. Both are solved at once, as components of a displacement, by the solver of the elastic
 * problem. Fills `axes` (9 a tet) for the region's tets. Account OST_EFFECT_GRADIENT_AXES. */
OstStatus ost_scene_gradient_axes(const OstScene *scene, int region, const OstAxesSpec *spec, double *axes);

/* Collective. Do the boundaries exist that isotropic materials name for gradients? */
OstStatus ost_scene_check_gradients(const OstScene *scene);

/* Collective. Reads the fields of the mesh file that the case's materials name into the chunk. */
OstStatus ost_scene_read_tet_fields(const OstCase *c, OstMeshChunk *chunk);

/* Local. The factor that a field gives Young's modulus of a tet before the mesh is partitioned; it is not checked. */
double ost_scene_chunk_modulus(const OstCase *c, const OstMeshChunk *chunk, const OstModulusField *modulus,
                               OstLocal tet);

/* Local. Fills `axes` (9 a tet) of the regions whose axes are fields of the mesh file; gives the tets of regions whose
 * Young's modulus is one their factors. */
OstStatus ost_scene_field_axes(const OstScene *scene, const OstSceneMaterials *materials, double *axes);
OstStatus ost_scene_set_modulus(OstScene *scene);

/* Local. Gives the scene's field of materials the case's eigenstrains, of regions and of tets. */
OstStatus ost_scene_set_eigenstrain(OstScene *scene);

#endif
