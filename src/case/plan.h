/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_PLAN_H
#define ORTHOSTAT_CASE_PLAN_H

#include "case/case_data.h"
#include "effect/effect.h"
#include "formats/serial/formats.h"

/* The plan of a case's work: every effect, on or off with the reason, and the size of the job, predicted before
 * anything large is allocated. */

/* Larger than any count in use; sums and small multiples of it still fit 64 bits. */
#define OST_PLAN_MOST (INT64_MAX / 64)

/* How large a mesh is, and the stiffness on it: what memory and seconds are foretold from. Whole numbers where they are
 * known, else estimates. */
typedef struct OstMeshCounts {
    double nodes, tets;
    double vertices, edges, surface; /* of the tets; faces on the surface */
    double blocks, linear_blocks;    /* of the stiffness, and of that of linear tets on the same vertices */
} OstMeshCounts;

/* Multigrid's levels, as they are foretold (src/case/plan_memory.c). */
typedef struct OstPlanLevels {
    double aggregate_nodes; /* of an aggregate of linear tets' nodes, as they turn out */
    double columns;         /* of a row of their prolongator */
    double coarsest;        /* unknowns of the last level */
    int count;              /* those of linear tets */
    double kept;            /* bytes of the hierarchy, over all ranks, and those needed on top while it is made */
    double transient;
} OstPlanLevels;

/* What multigrid coarsens. Where cells of quadratic tets are far longer than a wall is thick, or their edges cross
 * stiff directions, it takes aggregates of their nodes in place of the linear tets (algebra/multigrid/metric.c), and
 * where cells are longer still the columns of nodes through the wall, which are not coarsened further
 * (algebra/aggregation/columns.h). In between it factors the matrix of the vertices, if that is quicker. */
typedef enum {
    OST_COARSEN_TETS,
    OST_COARSEN_NODES,
    OST_COARSEN_COLUMNS,
    OST_COARSEN_VERTICES,
    OST_COARSEN_FACTORS
} OstCoarsening;

typedef struct OstPlan {
    OstEffects effects;
    OstSolverFacts facts; /* as far as they are known */
    OstSolverPlan solver;
    OstGlobal nodes, tets; /* of the mesh as given */
    int quadratic;
    OstMeshCounts counts;
    double slenderness;  /* of a shape's cells: length over the body's thickness; 0: not known */
    double cells_across; /* and cells through that */
    int bends; /* would a thin wall bend? Not a curved one under pressure: it is a membrane, as a closed one is anyway
                */
    int adjoints;            /* of watched quantities */
    int solves_to_residual;  /* on a path; for a watched reaction of a mixed form, or of faces that are linked */
    int corrects_by_factors; /* is Newton's method to factor each stiffness? */
    OstCoarsening coarsening;
    OstPlanLevels levels; /* zeros where multigrid is not planned */
    OstGlobal unknowns;   /* upper bound: 3 × nodes, before supports are taken off */
    int least_ranks;      /* predicted: on fewer ranks, one would hold more than it can number */
    /* Predicted, over all ranks (by src/case/plan_memory.c and the effects' rules): pieces of the mesh with their
     * halos; K by blocks, its pattern and its scatter map; the solver's copies and vectors; arrays of the effects; the
     * output files. */
    double bytes_mesh, bytes_matrix, bytes_solver, bytes_effects, bytes_output;
    double bytes_company; /* on top, of load cases that are solved beside the first, as far as there is room */
    double bytes_in_all;  /* at the peak: the solve, the estimate of the error after it, or strains and stresses when
                             the solver is gone */
} OstPlan;

/* What is known of the mesh when a plan is made: from the shape or the file, or the mesh itself. */
typedef struct OstPlanMesh {
    OstGlobal nodes, tets;
    int quadratic;
    double surface;                    /* faces on the surface; 0: not known, or of a shape, which tells */
    const OstNames *regions;           /* NULL: one region of any name, as shapes have */
    const OstFileMaterials *materials; /* those that came with the file, or NULL */
    const OstEffect *load;             /* the effect of each load (ost_load_effects); NULL: by the case alone */
    unsigned welded;                   /* what the partition kept on one rank each (mesh/mesh_data.h) */
} OstPlanMesh;

/* Local. The plan for a case on `ranks` ranks. */
void ost_plan_make(const OstCase *c, const OstPlanMesh *mesh, int ranks, OstPlan *plan);

/* Local. Does some load's effect depend on the mesh? So it is for a total force, which acts on faces if its selection
 * has any, and else on vertices. */
int ost_loads_need_mesh(const OstCase *c);

/* Collective. The effect of each load: OST_EFFECT_POINT_FORCE, OST_EFFECT_SURFACE_LOAD,
 * OST_EFFECT_FOLLOWER_PRESSURE or OST_EFFECT_BODY_FORCE; `effect` has load_count items. `mesh` may be NULL if
 * ost_loads_need_mesh is 0. Raises as ost_select_faces does. */
OstStatus ost_load_effects(const OstCase *c, const OstMesh *mesh, OstEffect *effect);

/* Local; rank 0 warns where nothing acts on the body: no load, no prescribed displacement and no eigenstrain.
 * `load_case`: its name, or NULL. */
void ost_plan_warn_idle(const OstCase *c, const OstPlan *plan, const char *load_case);

/* Local. Nodes and tets of a shape, from its divisions; 0 and 0 for a mesh file. Counts are limited to OST_PLAN_MOST.
 */
void ost_plan_shape_size(const OstCase *c, OstGlobal *nodes, OstGlobal *tets);

/* Local. Raises OST_LIMIT_EXCEEDED with the limit if Epetra and ML cannot number the unknowns of so many nodes on any
 * number of ranks; OST_INVALID_INPUT if the case expects its mesh from a program. */
OstStatus ost_plan_check_size(const OstCase *c, OstGlobal nodes);

/* From this slenderness on nodes form columns through a wall. */
extern const double ost_plan_longest_of_columns;

/* Local. How long the cells of a shape are over its thickness, across the direction in which it is thinnest, and cells
 * through that; zeros for a mesh file. */
void ost_plan_shape_slenderness(const OstCase *c, double *slenderness, double *across);

/* Local. Faces on the surface of a shape; 0 for a mesh file. */
double ost_plan_shape_surface(const OstCase *c);

/* Local. Converts the counts of a mesh file to those of the case's mesh, refined and in its order. */
void ost_plan_file_size(const OstCase *c, int nodes_per_tet, OstGlobal *nodes, OstGlobal *tets, double *surface);

/* Local. What follows from nodes, tets and faces on the surface (0: not known; a compact body is assumed). */
OstMeshCounts ost_mesh_counts(double nodes, double tets, int quadratic, double surface);

/* Local. Fills the facts of the materials in use that effects and solver depend on. */
void ost_plan_materials(const OstCase *c, const OstPlanMesh *mesh, OstEffectFacts *facts, OstSolverFacts *solver);

/* Local. The effect of a load, or OST_EFFECT_END if it depends on the mesh. */
OstEffect ost_load_effect(const OstCase *c, const OstLoad *load);

/* Of all materials: the smallest Young's modulus, the largest smallest one of a material, and the largest; 0 to begin
 * with. */
typedef struct OstModuli {
    double softest, most_rigid, stiffest;
} OstModuli;

/* Local. Adds a material to the facts that the solver's plan needs: ratios of moduli, and Poisson's ratio. */
void ost_plan_add_facts(OstContext *ctx, const OstOrthotropic *k, OstModuli *moduli, OstSolverFacts *facts);

/* Local. Warns of fields that the output lists by name and will not hold. */
void ost_warn_absent_fields(const OstCase *c, const OstEffects *effects);

/* Local. Do nodes of faces follow others, or a point? */
int ost_plan_links(const OstPlan *plan);

/* Local. Is a field among those to be written? */
int ost_plan_writes(const OstCase *c, OstOutputFieldBit field);

/* Local. Is it a mean over a region, of a measure that is linear in the stress? Its error takes an adjoint problem
 * where Young's moduli differ by this factor. */
int ost_watch_is_linear_mean(const OstWatch *watch);
#define OST_UNEVEN_MODULI 30.0

/* Of so many load cases share adjoint problems (solve/reactions/reactions.h). */
enum { OST_PLAN_MOST_SHARED = 12 };

/* Local. Predicts the plan's bytes from its counts, method and effects. */
void ost_plan_memory(const OstCase *c, int ranks, OstPlan *plan);

/* Local. Leaves the error estimate out, with the reason, where all else fits into `room` bytes and that does not; one
 * that an accuracy is asked for by stays. */
void ost_plan_fit(const OstCase *c, int ranks, double room, OstPlan *plan);

#endif
