/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_SYSTEM_H
#define ORTHOSTAT_ASSEMBLY_SYSTEM_H

#include "algebra/matrix/block_matrix.h"
#include "assembly/supports.h"
#include "material/field_data.h"
#include "mesh/mesh_data.h"
#include "orthostat/formulation.h"

/* The linear system of the nodes that are free in at least one direction: P K P + s(I - P), in 3×3 blocks. Where nodes
 * follow others (assembly/links/links.h), it is that of T' K T: followers have no row. Fully constrained nodes have no
 * row. Rows keep the order of the mesh's local nodes, owned first. */
typedef struct OstSystem {
    OstContext *ctx;
    const OstMesh *mesh;
    const OstSupports *supports;
    OstBlockMatrix *matrix;
    OstSupports unlinked;    /* the supports without links, where there are links: */
    struct OstSystem *whole; /* that of all nodes, from which the matrix is made (condense.c); else NULL */
    OstLocal *row_of_node;   /* node_count: local row or ghost column, -1 if fully constrained */
    OstLocal *node_of_row;   /* matrix->columns */
    OstLocal *block_of_tet; /* tet_count × n(n+1)/2, the scatter map: which block of matrix->value each pair of a tet's
                               nodes adds to, -1: none. Only the upper triangle is summed, and then mirrored. NULL after
                               ost_system_release_scatter */
} OstSystem;

/* Collective. Numbers the rows and makes the pattern (account OST_LEDGER_PATTERN). Raises OST_LIMIT_EXCEEDED if a
 * library's limit would be exceeded (Epetra, ML: 2^31 unknowns of all ranks, nonzeros of a rank), before it allocates
 * anything large. */
OstStatus ost_system_create(const OstMesh *mesh, const OstSupports *supports, OstSystem **system);
void ost_system_destroy(OstSystem **system);

/* Local. A step of ost_system_create, after the rows are numbered: makes the matrix's row_start, column, diagonal and
 * (zero) values, and the system's block_of_tet. Raises OST_LIMIT_EXCEEDED before it allocates too many blocks. */
OstStatus ost_system_make_pattern(OstSystem *system);

/* Local. Fills K (OST_LEDGER_STIFFNESS), then applies the constraints of partly constrained nodes (OST_LEDGER_SUPPORTS
 * or OST_EFFECT_SLIDING). */
OstStatus ost_system_fill(OstSystem *system, const OstMaterialField *field);

struct OstFollower;

/* Where and how the stiffness of large rotations is taken. */
typedef struct OstTangent {
    OstFormulation formulation;         /* consistent or classical */
    double t;                           /* the share of the eigenstrain */
    const double *u;                    /* 3 × node_count */
    const double *from, *to;            /* 3 × node_count or NULL: OstLastStep (element/large_rotation.h) */
    int definite;                       /* made positive semidefinite, tet by tet, where it is not? */
    const struct OstFollower *follower; /* whose load stiffness is added (assembly/follower.h), or NULL */
    const double *factor;               /* of its loads, one for each function of time */
    const OstTurning *turning;          /* of links that turn, or NULL */
} OstTangent;

/* Local. As ost_system_fill, with the stiffness at a displacement (NULL: the linear one). */
OstStatus ost_system_fill_tangent(OstSystem *system, const OstMaterialField *field, const OstTangent *tangent);

/* Local. Frees block_of_tet; the system cannot be filled again until it is restored. */
void ost_system_release_scatter(OstSystem *system);
OstStatus ost_system_restore_scatter(OstSystem *system);

/* Local; collective where nodes follow others. P T' force, the rows' part of forces on owned nodes (3 × owned_nodes).
 */
OstStatus ost_system_take_rows(const OstSystem *system, const double *force, double *of_rows);

/* Collective, a step of ost_system_fill. Makes the matrix T' K T from K of all nodes, where nodes follow others;
 * `turning` as of OstTangent. */
OstStatus ost_system_condense(OstSystem *system, const OstTurning *turning);

/* Collective. Right-hand side of the rows, P (force - K g + share × B'C e0): `force`
 * are the loads on local nodes (3 × node_count, complete on owned nodes); K g is computed only on tets that touch a
 * node with g != 0, and the last term only for an eigenstrain e0. `rhs` has 3 × matrix->rows numbers. */
OstStatus ost_system_right_hand_side(const OstSystem *system, const OstMaterialField *field, double share,
                                     const double *force, double *rhs);

/* Collective. Displacement of every local node, u = P v + t g, ghosts included, g what the supports prescribe; v has
 * 3 × matrix->rows numbers. */
OstStatus ost_system_displacement(const OstSystem *system, double t, const double *v, double *u);

/* Local. Internal forces of the tets at owned nodes, K u less the forces of t times the eigenstrain, tet by tet without
 * the matrix; u is 3 × node_count, force 3 × owned_nodes. `magnitude` (as force, or NULL) gets the sums of absolute
 * values |B'| |C| (|B| |u| + |e0|): rounding errors of the forces are a few 1e-16 of these. */
OstStatus ost_internal_force(const OstMesh *mesh, const OstMaterialField *field, double t, const double *u,
                             double *force, double *magnitude);

/* Local. The forces, and the sum of the squared mean stresses of this rank's own tets. */
OstStatus ost_internal_force_and_stress(const OstMesh *mesh, const OstMaterialField *field, double t, const double *u,
                                        double *force, double *stress);

/* Local. Adds the nodal forces of t times the eigenstrain, B'C e0, to `force` (3 × owned_nodes). They add up to zero.
 */
OstStatus ost_eigenstrain_force(const OstMesh *mesh, const OstMaterialField *field, double t, double *force);

/* Local. The same of any formulation. Its rounding errors are a few 1e-16 of the same magnitudes as the linear one's.
 */
OstStatus ost_internal_force_of(const OstMesh *mesh, const OstMaterialField *field, OstFormulation formulation,
                                double t, const double *u, double *force, double *magnitude);

/* Local. The same of the consistent form, with the stress along a step (OstLastStep). */
OstStatus ost_internal_force_along(const OstMesh *mesh, const OstMaterialField *field, double t, const double *u,
                                   const double *from, const double *to, double *force);

/* Local. Strain energy of this rank's own tets under t and u, with large rotations. */
double ost_large_rotation_energy_of(const OstMesh *mesh, const OstMaterialField *field, OstFormulation formulation,
                                    double t, const double *u);

/* Local. The volumes of this rank's own tets, before and after u (the integral of det F). */
void ost_deformed_volume(const OstMesh *mesh, const OstMaterialField *field, const double *u, double volumes[2]);

/* Local. Of this rank's own tets at u: how many are inverted at one of their points, and the one whose principal
 * stretch is the least at any point (-1 without tets; then the stretch is DBL_MAX). */
typedef struct OstLeastStretch {
    OstGlobal inverted;
    OstLocal tet;
    double stretch;
} OstLeastStretch;
void ost_least_stretch(const OstMesh *mesh, const OstMaterialField *field, const double *u, OstLeastStretch *least);

/* Collective. What multigrid needs of the rows: coordinates (3 × rows), material metric (6 × rows: mean over a node's
 * tets of R' diag(sqrt(E_min/E_k)) R, with R the axes) and the six rigid body modes about the middle of all rows, times
 * P (column-major, 6 × 3 × rows). `metric` may be NULL. */
OstStatus ost_system_geometry(const OstSystem *system, const OstMaterialField *field, double *coordinates,
                              double *metric, double *modes);

/* Collective. The rows' places (3 × rows) in the shape that `displacement` (3 × node_count; NULL: none) gives the body,
 * and the modes there. */
OstStatus ost_system_modes(const OstSystem *system, const double *displacement, double *places, double *modes);

/* Local. Adds the springs to the filled K, and turns it into P K P + s(I - P) at nodes that are constrained in one or
 * two directions. s is the mean
 * stiffness of the node's diagonal block along its free directions, so that the added entries have the node's own
 * scale. Without such nodes it enters no account. Booked to OST_EFFECT_SLIDING if that effect is on
 * and a constrained direction is not a coordinate axis, otherwise to OST_LEDGER_SUPPORTS. */
void ost_system_apply_supports(OstSystem *system);

/* A symmetric matrix is summed in its upper triangle only: in each row from the diagonal to the end, ghost columns
 * included (columns of ghosts come last). */

/* Local. Zeroes the upper triangle. */
void ost_triangle_clear(OstBlockMatrix *matrix);

/* Local. Copies the upper triangle's owned columns, transposed, into the lower. */
OstStatus ost_triangle_mirror(OstBlockMatrix *matrix);

/* Local. Limits of the libraries, checked before memory of that size is allocated. Each raises OST_LIMIT_EXCEEDED with
 * the count, the limit and the library. */
OstStatus ost_limit_unknowns(OstContext *ctx, OstGlobal global_rows); /* Epetra, ML: scalar unknowns of all ranks */
OstStatus ost_limit_nonzeros(OstContext *ctx, OstGlobal blocks);      /* ML: scalar nonzeros of a rank */
OstStatus ost_limit_incidences(OstContext *ctx, OstGlobal tets, int nodes_per_tet); /* OstLocal: nodes of all tets */

#endif
