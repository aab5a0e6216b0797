/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_SCENE_DATA_H
#define ORTHOSTAT_PROBLEM_SCENE_DATA_H

#include "assembly/closed_form.h"
#include "case/case_data.h"
#include "case/plan.h"
#include "formats/serial/formats.h"
#include "material/field_data.h"
#include "orthostat/scene.h"
#include "problem/result_data.h"

/* What moves a distributing coupling, found by the solve: by linear theory a force and a moment at its point; with
 * large rotations, forces of a traction on the undeformed selection, at its centroid, and its gradient (rows:
 * components). */
typedef struct OstDrive {
    double of_point[6], mean[3], gradient[9];
} OstDrive;

/* A case on this rank: its piece of the mesh, its materials, and the plan of the work. */
struct OstScene {
    OstContext *ctx;
    const OstCase *c;
    OstPlan plan;           /* its effects decide what is computed */
    OstEffect *load_effect; /* of each load of the case */
    OstDrive *drive;        /* of each function of time one for each load; NULL: no distributing coupling is moved */
    OstFileMaterials *from_file; /* that came with the mesh file, or NULL */
    OstMesh *mesh;
    OstMaterialField *field;
    int borrows;                /* mesh, materials and field are another scene's, of which this is a load case */
    const OstClosedForm *exact; /* what `exact` in the case stands for; set by `orthostat verify` */
};

static inline OstDrive *ost_scene_drive(const OstScene *scene, int function, int load)
{
    return &scene->drive[function * scene->c->load_count + load];
}

/* Collective. A scene of the same body on a finer mesh: the chunk, which is consumed, in tets of the case's order and
 * not refined further. `c` may differ from the earlier scene's case in its settings, not in what is modelled, and
 * outlives the scene. */
OstStatus ost_scene_create_finer(const OstScene *coarse, const OstCase *c, OstMeshChunk **chunk, OstScene **scene);

/* Collective. The scene of one of the load cases of the scene's case: on its mesh and materials, which outlive it. */
OstStatus ost_scene_load_case(const OstScene *scene, int number, OstScene **of_case);

/* Local. The case's output fields, without those of effects that are off. */
unsigned ost_scene_result_fields(const OstScene *scene);

#endif
