/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PLAN_H
#define ORTHOSTAT_PLAN_H

#include "orthostat/case.h"
#include "orthostat/mesh_file.h"

OST_API_BEGIN

/* The work a case calls for: every effect the program knows, on or off with the reason, and the size of the job,
 * foreseen before anything large is allocated. */
typedef struct OstPlanEffect {
    const char *label;
    int on;
    char reason[160];
} OstPlanEffect;

/* Columns: name, label, the ledger's account (OST_LEDGER_COUNT: none of its own). */
#define OST_EFFECT_TABLE(X)                                                             \
    X(OST_PLAN_ORTHOTROPY, "orthotropy", OST_EFFECT_ORTHOTROPY)                         \
    X(OST_PLAN_VARYING_AXES, "varying axes", OST_EFFECT_VARYING_AXES)                   \
    X(OST_PLAN_GRADIENT_AXES, "gradient axes", OST_EFFECT_GRADIENT_AXES)                \
    X(OST_PLAN_REGIONS, "several materials", OST_EFFECT_REGIONS)                        \
    X(OST_PLAN_GIVEN_DISPLACEMENT, "given displacement", OST_EFFECT_GIVEN_DISPLACEMENT) \
    X(OST_PLAN_SLIDING, "sliding support", OST_EFFECT_SLIDING)                          \
    X(OST_PLAN_POINT_FORCE, "point force", OST_EFFECT_POINT_FORCE)                      \
    X(OST_PLAN_SURFACE_LOAD, "surface load", OST_EFFECT_SURFACE_LOAD)                   \
    X(OST_PLAN_BODY_FORCE, "body force", OST_EFFECT_BODY_FORCE)
#define OST_PLAN_ENUM(name, label, account) name,
typedef enum { OST_EFFECT_TABLE(OST_PLAN_ENUM) OST_PLAN_COUNT } OstPlanIndex;
#undef OST_PLAN_ENUM

/* More than anything can hold; sums and multiples of it by a few still fit 64 bits. */
#define OST_PLAN_MOST (INT64_MAX / 64)

typedef struct OstPlan {
    OstPlanEffect effect[OST_PLAN_COUNT];
    OstSolverFacts facts; /* as far as they are known */
    OstSolverPlan solver;
    OstGlobal nodes, tets; /* of the mesh as given */
    OstGlobal unknowns;    /* upper bound: 3 × nodes, before supports are taken off */
    int least_ranks;       /* on fewer, one would hold more than can be numbered there, as far as is foreseen */
    /* Over all ranks, foreseen (the formulas are in src/case/plan_memory.c): pieces of the mesh with their halos; K by
     * blocks, its pattern and where each tet's blocks go; the recipe's copies and vectors; the output file. */
    double bytes_mesh, bytes_matrix, bytes_solver, bytes_output;
} OstPlan;

/* Local. The plan for a case on `ranks` ranks; nodes and tets as known so far (from the shape, or the mesh once read).
 * `materials` are those that came with the mesh file, or NULL. */
void ost_plan_make(const OstCase *c, OstGlobal nodes, OstGlobal tets, const OstFileMaterials *materials, int ranks,
                   OstPlan *plan);

/* Local. Does anything act on the body: a load, or a displacement given that is not zero? */
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

OST_API_END

#endif
