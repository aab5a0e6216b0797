/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_PLAN_H
#define ORTHOSTAT_CASE_PLAN_H

#include "case/case_data.h"
#include "effect/effect.h"
#include "formats/serial/formats.h"

/* The work a case calls for: every effect, on or off with the reason, and the size of the job, foreseen before anything
 * large is allocated. */

/* More than anything can hold; sums and multiples of it by a few still fit 64 bits. */
#define OST_PLAN_MOST (INT64_MAX / 64)

typedef struct OstPlan {
    OstEffects effects;
    OstSolverFacts facts; /* as far as they are known */
    OstSolverPlan solver;
    OstGlobal nodes, tets; /* of the mesh as given */
    OstGlobal unknowns;    /* upper bound: 3 × nodes, before supports are taken off */
    int least_ranks;       /* on fewer, one would hold more than can be numbered there, as far as is foreseen */
    /* Over all ranks, foreseen (the formulas are in src/case/plan_memory.c and the effects' rules): pieces of the mesh
     * with their halos; K by blocks, its pattern and where each tet's blocks go; the solver's copies and vectors; what
     * the effects hold; the output file. */
    double bytes_mesh, bytes_matrix, bytes_solver, bytes_effects, bytes_output;
} OstPlan;

/* What is known of the mesh when a plan is made: from the shape or the file, or the mesh itself. */
typedef struct OstPlanMesh {
    OstGlobal nodes, tets;
    int quadratic;
    const OstNames *regions;           /* NULL: one, whatever its name, as shapes have */
    const OstFileMaterials *materials; /* those that came with the file, or NULL */
    const OstEffect *load;             /* what each load is (ost_load_effects); NULL: as far as the case tells */
} OstPlanMesh;

/* Local. The plan for a case on `ranks` ranks. */
void ost_plan_make(const OstCase *c, const OstPlanMesh *mesh, int ranks, OstPlan *plan);

/* Local. Can only the mesh tell what some load is? So it is with a total force that goes over faces if its selection
 * has any, and else over vertices. */
int ost_loads_need_mesh(const OstCase *c);

/* Collective. The effect that each load is, OST_EFFECT_POINT_FORCE, OST_EFFECT_SURFACE_LOAD or OST_EFFECT_BODY_FORCE;
 * `effect` has load_count items. `mesh` may be NULL where the loads do not need it. Raises as ost_select_faces does. */
OstStatus ost_load_effects(const OstCase *c, const OstMesh *mesh, OstEffect *effect);

/* Local. Does anything act on the body: a load, or a prescribed displacement that is not zero? */
int ost_plan_acts(const OstCase *c, const OstPlan *plan);

/* Local. Nodes and tets of a shape, from its divisions; 0 and 0 where the mesh is a file. Counts that are out of reach
 * anyway end at OST_PLAN_MOST. */
void ost_plan_shape_size(const OstCase *c, OstGlobal *nodes, OstGlobal *tets);

/* Local. Raises OST_LIMIT_EXCEEDED with the limit where the libraries below cannot number the unknowns of a mesh of so
 * many nodes, on however many ranks; OST_INVALID_INPUT where the case leaves its mesh to a program. */
OstStatus ost_plan_check_size(const OstCase *c, OstGlobal nodes);

/* Local. Turns the counts of a mesh file into those of the mesh that the case makes of it, refined and in its order:
 * the tets exactly, the nodes about. */
void ost_plan_file_size(const OstCase *c, int nodes_per_tet, OstGlobal *nodes, OstGlobal *tets);

#endif
