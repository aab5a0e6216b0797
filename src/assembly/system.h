/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_SYSTEM_H
#define ORTHOSTAT_ASSEMBLY_SYSTEM_H

#include "algebra/matrix/block_matrix.h"
#include "assembly/supports.h"
#include "material/field_data.h"
#include "mesh/mesh_data.h"

/* The linear system of the nodes that are free in at least one direction: P K P + s(I - P), in 3×3 blocks. Fully
 * constrained nodes have no row. Rows keep the order of the mesh's local nodes, owned first. */
typedef struct OstSystem {
    OstContext *ctx;
    const OstMesh *mesh;
    const OstSupports *supports;
    OstBlockMatrix *matrix;
    OstLocal *row_of_node;  /* node_count: local row or ghost column, -1 if fully constrained */
    OstLocal *node_of_row;  /* matrix->columns */
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

/* Local. Frees block_of_tet; the system cannot be filled again. */
void ost_system_release_scatter(OstSystem *system);

/* Local. Right-hand side of the rows, P (force - K g): `force` are the loads on local nodes (3 × node_count, complete
 * on owned nodes); K g is computed only on tets that touch a node with g != 0. `rhs` has 3 × matrix->rows numbers. */
OstStatus ost_system_right_hand_side(const OstSystem *system, const OstMaterialField *field, const double *force,
                                     double *rhs);

/* Collective. Displacement of every local node, u = P v + t g, ghosts included, g what the supports prescribe; v has
 * 3 × matrix->rows numbers. */
OstStatus ost_system_displacement(const OstSystem *system, double t, const double *v, double *u);

/* Local. Internal forces K u at owned nodes, tet by tet without the matrix; u is 3 × node_count, force 3 × owned_nodes.
 * `magnitude` (as force, or NULL) gets the sums of absolute values |B'| |C| |B| |u|: rounding errors of the forces are
 * a few 1e-16 of these. */
OstStatus ost_internal_force(const OstMesh *mesh, const OstMaterialField *field, const double *u, double *force,
                             double *magnitude);

/* Collective. What multigrid needs of the rows: coordinates (3 × rows), material metric (6 × rows: mean over a node's
 * tets of R' diag(sqrt(E_min/E_k)) R, with R the axes) and the six rigid body modes about the middle of all rows, times
 * P (column-major, 6 × 3 × rows). `metric` may be NULL. */
OstStatus ost_system_geometry(const OstSystem *system, const OstMaterialField *field, double *coordinates,
                              double *metric, double *modes);

#endif
