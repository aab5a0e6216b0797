/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_H
#define ORTHOSTAT_PROBLEM_H

#include "orthostat/field.h"
#include "orthostat/formulation.h"
#include "orthostat/mesh.h"
#include "orthostat/time_table.h"

OST_API_BEGIN

/* The discrete problem: mesh, materials, supports and loads as functions of the pseudo-time t and the displacement u.
 * At rest, force(t, u) = load(t, u) in every direction that the supports leave free, and u is the displacement
 * prescribed at t in the others. Loads, prescribed displacements and eigenstrains grow with t, unless they follow a
 * time table; the load depends on u where a pressure follows the surface. How that is solved is no concern of the
 * problem (orthostat/analysis.h).
 *
 * Displacements have 3 numbers for each local node, ghosts included; forces 3 for each owned node. */
typedef struct OstProblem OstProblem;

/* An owned node's displacement along a direction (of any length but 0), at t = 1. */
typedef struct OstNodeConstraint {
    OstLocal node;
    double direction[3];
    double displacement;
} OstNodeConstraint;

/* A spring between an owned node and the ground, along a direction (of any length; 0: in every direction). */
typedef struct OstNodeSpring {
    OstLocal node;
    double direction[3];
    double stiffness; /* force per length, not negative */
} OstNodeSpring;
/* What follows a time table, at factor 1. */
typedef struct OstTimedParts {
    OstTimeTable table;
    const double *force;        /* 3 × owned_nodes, or NULL for none */
    const double *displacement; /* one along each of the constraints, or NULL for none */
} OstTimedParts;

/* A problem from the caller's own parts. Mesh and field outlive the problem; the arrays are copied. */
typedef struct OstProblemParts {
    const OstMesh *mesh;
    const OstMaterialField *field;
    const OstNodeConstraint *constraints;
    OstLocal constraint_count; /* on this rank; directions of one node may repeat, but not contradict each other */
    int free_body;             /* nothing holds the body, its loads balance, and there are no constraints */
    const double *force;       /* 3 × owned_nodes: the load at t = 1, or NULL for none */
    const OstNodeSpring *springs;
    OstLocal spring_count; /* on this rank */
    /* Faces of the surface under a pressure that follows them: outward, 3 vertices and on quadratic tets 3 mid-edge
     * nodes each, local numbers; every one that touches an owned node. Positive pushes inwards. */
    const OstLocal *pressed_faces;
    OstLocal pressed_count;
    double pressure;
    OstFormulation formulation; /* of the answer; 0: linear */
    int timed_count;            /* the same on all ranks, as are the tables */
    const OstTimedParts *timed;
    int eigenstrain_follows; /* 0: the field's eigenstrain grows with t; k: it follows timed[k - 1] */
} OstProblemParts;

/* Collective. Raises OST_INVALID_INPUT for contradicting constraints, or none at all, or eigenstrain_follows beyond
 * timed_count. */
OstStatus ost_problem_create(const OstProblemParts *parts, OstProblem **problem);
void ost_problem_destroy(OstProblem **problem);

/* Collective. Materials and axes on a mesh: one material for each region of it, and one way of giving axes (NULL:
 * none). Axes given tet by tet (9 × tet_count, or NULL) serve the regions of kind OST_AXES_CELLS and OST_AXES_GRADIENT.
 * The caller frees the field (ost_field_destroy). ost_field_mean_dilatation is the caller's choice. */
OstStatus ost_field_create_on(const OstMesh *mesh, const OstMaterial *materials, const OstAxesSpec *axes,
                              const double *tet_axes, OstMaterialField **field);

/* Local. Is the internal force linear in the displacement? Then the stiffness is the same at every u, and the energy is
 * half the work of the internal force. */
int ost_problem_is_linear(const OstProblem *problem);

/* Local. How strain follows from displacements. A new formulation may be set at any time, on all ranks alike: energy,
 * force and stiffness are of the one set last. */
void ost_problem_set_formulation(OstProblem *problem, OstFormulation formulation);
OstFormulation ost_problem_formulation(const OstProblem *problem);

/* Local. */
const OstMesh *ost_problem_mesh(const OstProblem *problem);
const OstMaterialField *ost_problem_field(const OstProblem *problem);
OstGlobal ost_problem_unknowns(const OstProblem *problem); /* 0 until the stiffness has been asked for */

/* Local. Puts another load (3 × owned_nodes, at t = 1; copied) in place of the problem's that grows with t. */
void ost_problem_set_load(OstProblem *problem, const double *force);

/* Local. load(t, u): t times the load that grows with t, and what follows time tables; and the pressures that follow
 * the surface as u moves it (NULL, or by linear theory: as it is undeformed). */
void ost_problem_load(const OstProblem *problem, double t, const double *u, double *force);

/* Collective. A work function of the load: its gradient by u is load(t, u), and it is 0 at u = 0. Where a pressure
 * follows a surface with a rim that is free to move there is none, and the result is no more than a measure. */
OstStatus ost_problem_load_work(const OstProblem *problem, double t, const double *u, double *work);

/* Collective. The strain energy of the body under u, with its eigenstrain at t, and the energy of the springs. (The
 * classical formulation's force is not its gradient.) */
OstStatus ost_problem_energy(const OstProblem *problem, double t, const double *u, double *energy);

/* Local. The internal force, of tets and springs: the gradient of the energy by u, summed without the stiffness matrix.
 */
OstStatus ost_problem_force(const OstProblem *problem, double t, const double *u, double *force);

/* This rank's rows of the stiffness, by 3×3 blocks: P K P + s(I - P), P the projector on what the supports leave free
 * and s of the node's own stiffness. Nodes constrained in all directions have no row. The arrays are the problem's. */
typedef struct OstStiffness {
    OstLocal rows, columns; /* columns: the rows, then those of ghosts */
    OstGlobal global_rows;
    const OstLocal *row_start; /* rows + 1 */
    const OstLocal *column;    /* row_start[rows], ascending in each row */
    const double *value;       /* 9 for each of them, row-major */
    const OstLocal *node;      /* columns: the local node of each row and ghost column */
} OstStiffness;

/* Collective. Fills the values of the stiffness at t and u (NULL: at t = 0 and u = 0; a linear problem looks at
 * neither): the derivative of force - load by u, but that of a pressure that follows the surface by its symmetric part
 * alone, on a pattern that is made the first time and kept. Raises OST_LIMIT_EXCEEDED before anything large is made
 * where a library below could not number the unknowns. `stiffness` may be NULL. */
OstStatus ost_problem_stiffness(OstProblem *problem, double t, const double *u, OstStiffness *stiffness);

/* Collective. The same, made positive semidefinite tet by tet: where the energy of a point of a tet has negative
 * curvature, that is set to 0; elsewhere the stiffness stays as it is. A linear problem's is definite already. The part
 * of a pressure that follows the surface is left out. */
OstStatus ost_problem_definite_stiffness(OstProblem *problem, double t, const double *u, OstStiffness *stiffness);

/* The most compressed tet at a displacement: at one of its points, of all tets, a line of the undeformed body is
 * shortened the most, to `stretch` times its length; the stretch is negative where the tet is inverted. */
typedef struct OstWorstTet {
    double stretch;
    OstGlobal tet;      /* its label */
    int region;         /* index into the mesh's regions */
    double place[3];    /* its centroid before the deformation */
    OstGlobal inverted; /* how many tets are inverted at a point */
} OstWorstTet;

/* Collective. The same on all ranks. */
OstStatus ost_problem_worst_tet(const OstProblem *problem, const double *u, OstWorstTet *worst);

/* Local. Drops the map by which tets are added to the matrix, about a fifth as large as the values on linear tets. The
 * stiffness of a linear problem then stays as it is; that of a nonlinear one makes the map anew when asked for.
 */
void ost_problem_release_scatter(OstProblem *problem);

/* Local. Drops matrix, pattern and map. Solvers made of the matrix must be gone. */
void ost_problem_release_stiffness(OstProblem *problem);

OST_API_END

#endif
