/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_SYSTEM_H
#define ORTHOSTAT_ASSEMBLY_SYSTEM_H

#include "algebra/matrix/block_matrix.h"
#include "assembly/supports.h"
#include "material/field_data.h"
#include "mesh/mesh_data.h"

/* The linear system of the nodes that are free in at least one direction: P K P + s(I - P), by 3×3 blocks. Fully held
 * nodes have no row. Rows keep the order of the mesh's local nodes, owned first. */
typedef struct OstSystem {
    OstContext *ctx;
    const OstMesh *mesh;
    const OstSupports *supports;
    OstBlockMatrix *matrix;
    OstLocal *row_of_node;  /* node_count: local row or ghost column, -1 if fully held */
    OstLocal *node_of_row;  /* matrix->columns */
    OstLocal *block_of_tet; /* tet_count × n(n+1)/2: which block of matrix->value each pair of a tet's nodes adds to,
                               -1: none. Only the upper triangle is summed; the lower is its mirror image. May be NULL
                               once filled (ost_system_release_scatter) */
} OstSystem;

/* Collective. Numbers the rows and makes the pattern (account OST_LEDGER_PATTERN). Raises OST_LIMIT_EXCEEDED with the
 * limit that a library below would break (Epetra, ML: 2^31 unknowns in all ranks, nonzeros of a rank), before anything
 * large is made. */
OstStatus ost_system_create(const OstMesh *mesh, const OstSupports *supports, OstSystem **system);
void ost_system_destroy(OstSystem **system);

/* Local. With the rows numbered, makes the matrix's row_start, column, diagonal and (zero) values, and the system's
 * block_of_tet; a step of ost_system_create. Raises OST_LIMIT_EXCEEDED once the blocks are counted, before they are
 * made. */
OstStatus ost_system_make_pattern(OstSystem *system);

/* Local. Fills K (OST_LEDGER_STIFFNESS), then applies what partly held nodes may do (OST_LEDGER_SUPPORTS /
 * OST_EFFECT_SLIDING). */
OstStatus ost_system_fill(OstSystem *system, const OstMaterialField *field);

/* Local. Drops block_of_tet, once no further fill is wanted. */
void ost_system_release_scatter(OstSystem *system);

/* Local. Right-hand side of the rows, P (force - K g): `force` are the loads on local nodes (3 × node_count, complete
 * on owned). The term K g is evaluated on the tets that touch a node with g != 0 alone. `rhs` has 3 × matrix->rows
 * numbers. */
OstStatus ost_system_right_hand_side(const OstSystem *system, const OstMaterialField *field, const double *force,
                                     double *rhs);

/* Collective. Displacement of every local node, u = P v + t g, ghosts included, g what the supports prescribe; v has
 * 3 × matrix->rows numbers. */
OstStatus ost_system_displacement(const OstSystem *system, double t, const double *v, double *u);

/* Local. Internal forces K u at owned nodes, tet by tet without the matrix; u 3 × node_count, force 3 × owned_nodes.
 * `magnitude` (as force, or NULL) takes the sums of absolute values |B'| |C| |B| |u|, of which rounding leaves a few
 * 1e-16 in the forces. */
OstStatus ost_internal_force(const OstMesh *mesh, const OstMaterialField *field, const double *u, double *force,
                             double *magnitude);

/* Collective. What multigrid wants to know of the rows: coordinates (3 × rows), metric (6 × rows, method R of Li-Barbič
 * materials: mean over a node's tets of R^T diag(sqrt(E_min/E_k)) R) and the six rigid body modes about the
 * middle of all rows, projected on P (column-major, 6 × 3 × rows). `metric` may be NULL. */
OstStatus ost_system_geometry(const OstSystem *system, const OstMaterialField *field, double *coordinates,
                              double *metric, double *modes);

#endif
