/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SCENE_H
#define ORTHOSTAT_SCENE_H

#include "orthostat/case.h"
#include "orthostat/problem.h"
#include "orthostat/result.h"

OST_API_BEGIN

/* A case made concrete on this rank: its piece of the mesh, its materials, and the plan of the work. */
typedef struct OstScene OstScene;

/* Collective. Reads or makes the mesh, distributes it, and sets up materials and axes. The case outlives the scene. */
OstStatus ost_scene_create(const OstCase *c, OstScene **scene);

/* Collective. The same on a mesh of the caller's in place of the case's, which still says (by its shape) on which
 * surface new nodes belong; no table of axes is read. The chunk is consumed: destroyed, and the pointer nulled. */
OstStatus ost_scene_create_on(const OstCase *c, OstMeshChunk **chunk, OstScene **scene);

void ost_scene_destroy(OstScene **scene);

/* Local. The scene's own; they live as long as it does. */
const OstMesh *ost_scene_mesh(const OstScene *scene);
const OstMaterialField *ost_scene_field(const OstScene *scene);

/* Collective. The scene's problem: its mesh and field (which outlive it) with the supports and loads of the case.
 * Raises OST_INVALID_INPUT with the case's line where constraints contradict each other, or if nothing is constrained.
 */
OstStatus ost_scene_problem(const OstScene *scene, OstProblem **problem);

/* Local. That of the case's answer; LINEAR where `large_rotation: auto` decides in the solve. The scene's problem is of
 * linear theory until it is solved, or told (ost_problem_set_formulation). */
OstFormulation ost_scene_formulation(const OstScene *scene);

/* Collective. ost_problem_dry_run and ost_problem_solve of the scene's problem, with the solver's options and the
 * fields that the case asks for; where the case has a path (orthostat/path.h), the result is that at its end. The scene
 * outlives the result. */
OstStatus ost_scene_dry_run(const OstScene *scene);
OstStatus ost_scene_solve(const OstScene *scene, OstResult **result);

OST_API_END

#endif
