/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_PROBLEM_H
#define ORTHOSTAT_PROBLEM_PROBLEM_H

#include "assembly/follower.h"
#include "assembly/pressure/pressure_space.h"
#include "assembly/system.h"
#include "orthostat/problem.h"
#include "problem/scene_data.h"

/* What follows a time table, at factor 1. */
typedef struct OstTimed {
    OstTimeTable table;
    double *force;         /* 3 × node_count, complete on owned nodes */
    OstSupports *supports; /* those of the problem, with the displacements that follow this table */
} OstTimed;

struct OstProblem {
    OstContext *ctx;
    const OstMesh *mesh;
    const OstMaterialField *field;
    const OstScene *scene;     /* of which the problem is made, and which outlives it; NULL if there is none */
    const OstCase *c;          /* where supports and loads come from, for messages; may be NULL */
    const OstEffects *effects; /* the scene's; NULL if there is no scene */
    OstSupports *supports;     /* with the displacements prescribed at t = 1 */
    double *force;             /* 3 × owned_nodes: the load at t = 1 */
    double *driven;  /* as many for each function: what moves distributing couplings; NULL before it is known */
    int timed_count; /* time tables of further loads and displacements (timed.c) */
    OstTimed *timed;
    OstFollower *follower; /* pressures that follow the surface, of all functions; NULL: there are none */
    double *lever;         /* 9 for each function and rigid face: of forces at a point of it (turning.c), or NULL */
    int eigen_function;    /* the function of time that eigenstrains follow */
    int conservative;      /* is the load the gradient of a work function? */
    OstPressureSpace *pressures;  /* of the mixed form; NULL without one */
    OstCoupling *coupling;        /* theirs with the system's unknowns, as long as there is one */
    OstMaterialField own;         /* the field, where the problem has changed it (problem/mixed.c) */
    OstSystem *system;            /* NULL before ost_problem_stiffness, and after its release */
    int filled;                   /* does the matrix have values? */
    int lent;                     /* has a caller been given its arrays, which then stay as they are? */
    int linear;                   /* is the internal force linear in the displacement? */
    OstFormulation formulation;   /* of energy, force and stiffness now */
    OstFormulation beyond_linear; /* of the answer; LINEAR: linear theory whatever the rotations */
    int automatic;                /* the latter only where linear theory is off by more than `accuracy`, relative? */
    double accuracy;
    int buckling_modes; /* of the linear answer: as many as are asked for */
    int free_body;
    int with_metric;      /* is the body orthotropic, so that multigrid needs the material metric? */
    OstSolverFacts facts; /* of the materials */
};

/* Local. What messages begin with: the case's file, or "the problem". */
const char *ost_problem_name(const OstProblem *problem);

/* Local. Goes on with another formulation on the way to the answer, whose formulation stays. */
void ost_problem_take_formulation(OstProblem *problem, OstFormulation formulation);

/* Collective. The right-hand side P (load(t) - K g(t)) of a linear problem, g the prescribed displacements, after
 * ost_problem_stiffness. `rhs` has 3 × rows numbers. */
OstStatus ost_problem_right_hand_side(const OstProblem *problem, double t, double *rhs);

/* Collective. The displacement u = P v + g(t) of every local node, from v of the rows. */
OstStatus ost_problem_displacement(const OstProblem *problem, double t, const double *v, double *u);

/* Collective. Halves the memory of a linear problem's stiffness (algebra/matrix/fold.h). Whoever asks for its arrays
 * or for other values gets it whole again; not while a solver uses it. */
OstStatus ost_problem_fold_stiffness(OstProblem *problem);
OstStatus ost_problem_unfold_stiffness(OstProblem *problem);

/* Collective. What the plan of the solver depends on: facts of the materials, the mesh, the unknowns and the machines.
 */
OstStatus ost_problem_facts(const OstProblem *problem, OstSolverFacts *facts);

/* Collective. As ost_problem_stiffness, or ost_problem_definite_stiffness, with the stress linear between `from` (3 ×
 * node_count, or NULL) and u (element/large_rotation.h). */
OstStatus ost_problem_stiffness_from(OstProblem *problem, double t, const double *u, const double *from, int definite);

/* Local. Adds what the stiffness of a load that is not conservative has beside its symmetric part, which the matrix
 * holds, times v (3 × node_count), to the owned nodes' `product`. */
OstStatus ost_problem_add_skew(const OstProblem *problem, double t, const double *u, const double *v, double *product);

/* What acts on a body is a sum over functions of time, each a factor times a load and prescribed displacements.
 * Function 0 is t itself: the problem's force and supports. The others follow the problem's time tables (timed.c). */

/* Local. How many functions there are, and the factor of one at t. */
int ost_problem_functions(const OstProblem *problem);
double ost_problem_factor(const OstProblem *problem, int function, double t);

/* Local. What of the eigenstrain acts at t. */
double ost_problem_eigen_share(const OstProblem *problem, double t);

/* Collective. ost_problem_force less the load (3 × owned_nodes, memory from the context): at free nodes what a solve
 * has left, at others the reactions. */
OstStatus ost_problem_out_of_balance(const OstProblem *problem, double t, const double *u, double **force);

/* Local. ost_problem_force by linear theory, and the sum of the squared mean stresses of this rank's own tets. */
OstStatus ost_problem_force_and_stress(const OstProblem *problem, double t, const double *u, double *force,
                                       double *stress);

/* Local. Adds factor × the load of one function to `force` (3 × owned_nodes), with pressures on the surface as u has
 * moved it (NULL: undeformed). */
void ost_problem_add_load(const OstProblem *problem, int function, double factor, const double *u, double *force);

/* Local. factor × this rank's part of the work function of that load (ost_problem_load_work). */
double ost_problem_work(const OstProblem *problem, int function, double factor, const double *u);

/* Collective. Its right-hand side P (f - K g), with the eigenstrain's if it follows this function, of a linear problem,
 * after ost_problem_stiffness; 3 × rows numbers. */
OstStatus ost_problem_function_right_hand_side(const OstProblem *problem, int function, double *rhs);

/* Collective. Its displacement P v + g of every local node. */
OstStatus ost_problem_function_displacement(const OstProblem *problem, int function, const double *v, double *u);

/* Rigid faces that turn (turning.c, assembly/links/rigid_faces.h). A force at a point of such a face follows it: its
 * work is (R - I):N beside that of the dead forces that it is spread as, N = force arm' less the same of these. */

/* Collective, once the loads are there: finds N. */
OstStatus ost_problem_find_levers(OstProblem *problem);

/* Collective. Takes the rigid faces, and the weights of nodes that follow these or levers, to a displacement (NULL:
 * none), at which loads, rows of forces and displacements of rows are then meant. */
OstStatus ost_problem_turn(const OstProblem *problem, const double *u);

/* Local. Adds the forces at owned nodes, as the faces are turned; and returns their work on all ranks. */
void ost_problem_add_levers(const OstProblem *problem, double t, double *force);
double ost_problem_lever_work(const OstProblem *problem, double t);

/* Collective. Is there a rigid face whose rotation is an unknown? */
int ost_problem_has_turning(const OstProblem *problem);

/* Collective. What forces at the arms of such faces, and of levers, add to the stiffness at tangent->u, where links are
 * turned to, made positive semidefinite if tangent->definite. The arrays of `turning` are the caller's to free, NULL
 * where there is none. */
OstStatus ost_problem_find_turning(const OstProblem *problem, double t, const OstTangent *tangent, OstTurning *turning);

/* Collective. Puts what is prescribed at t into a displacement, the rest of which is kept; v has room for 3 × rows. */
OstStatus ost_problem_prescribe(const OstProblem *problem, double t, double *v, double *u);

/* The mixed form (problem/mixed.c): what acts on its pressures, and their state. */

/* Collective. The right-hand side of the pressures at t, or of one function at factor 1: the integral of each one's
 * share of m'(e0 - strain of the prescribed displacements). `g` has pressures->owned numbers. */
OstStatus ost_problem_volume(const OstProblem *problem, double t, double *g);
OstStatus ost_problem_function_volume(const OstProblem *problem, int function, double *g);

/* Local. The problem whose forces, energies and stresses are those of a state with these pressures of its tets (4 ×
 * tet_count; NULL: 0). `field` is filled, and lives as long as `state` is used. */
void ost_problem_at_pressure(const OstProblem *problem, const double *of_tets, OstMaterialField *field,
                             OstProblem *state);

/* Local. The owned pressures of one stress m p, of the size 1, in all incompressible material; 0 in other. */
void ost_problem_uniform_pressure(const OstProblem *problem, double *pressure);

/* Collective. Is no surface of incompressible material free to move, nor a compressible body beside it? That stress
 * then has no force at any free node: nothing determines how large it is, and the sum of all changes of volume is 0.
 * Linear theory. */
OstStatus ost_problem_is_enclosed(const OstProblem *problem, int *enclosed);

/* Collective. Of an enclosed body: takes the mean off the stress that the pressures are; and takes off a right-hand
 * side g of the pressures what changes the volume of the whole, evenly spread: `swelling` × |m| at each point. */
OstStatus ost_problem_centre_pressure(const OstProblem *problem, double *pressure);
OstStatus ost_problem_keep_volume(const OstProblem *problem, double *g, double *swelling);

/* Local. The room for pressures that are solved for, once there is a stiffness: pressures->count or, where nodes follow
 * others, what the coupling has more of other ranks. The owned come first in both; ost_pressure_complete sets the
 * ghosts that tets ask for. */
size_t ost_problem_pressure_room(const OstProblem *problem);

/* Local. From now on the problem's own forces, energies and stiffness are those with these pressures of its tets (NULL:
 * 0), which the caller keeps. */
void ost_problem_take_pressure(OstProblem *problem, const double *of_tets);

/* Collective. Goes on with the mean dilatation in place of the mixed form; the stiffness must be filled again. Raises
 * OST_INVALID_INPUT where a material is incompressible. */
OstStatus ost_problem_leave_mixed(OstProblem *problem);

/* Local. Does some function prescribe a displacement other than zero for an owned node? */
int ost_problem_moves(const OstProblem *problem, OstLocal node);

/* Local. Is every factor 0 at t = 0, so that a path begins there, with a body at rest? Else it begins at t = -1. */
int ost_problem_begins_at_rest(const OstProblem *problem);

/* Collective. Adds a function that follows this table (which is copied), without load and supports as yet. */
OstStatus ost_problem_add_timed(OstProblem *problem, const OstTimeTable *table);
void ost_problem_release_timed(OstProblem *problem);

#endif
