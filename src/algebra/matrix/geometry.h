/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_GEOMETRY_H
#define ORTHOSTAT_ALGEBRA_MATRIX_GEOMETRY_H

#include "algebra/matrix/block_matrix.h"
#include "orthostat/solver.h"

/* What multigrid needs beyond the matrix. Arrays belong to the caller and outlive the solver, unless there is an
 * `owner`: then they are released once a hierarchy has taken what it needs, and made again for the next one. */
typedef struct OstSolverGeometry {
    const double *coordinates; /* rows × 3 */
    const double *moved;  /* rows × 3: where the rows are now, which the modes are of; NULL: at their coordinates */
    const double *metric; /* rows × 6 (11 22 33 12 23 31): the material metric, mean over a node's tets of
                             R^T diag(sqrt(E_min/E_k)) R; or NULL for the Euclidean metric */
    const double *modes;  /* near-null space: 6 columns of 3 × rows numbers, column-major (rigid body modes, projected
                             on the unconstrained directions). The plain method takes NULL for three translations, the
                             direct method uses nothing of this */
    const struct OstCoarseSpace *coarse; /* METRIC to TWO_LEVEL: a coarser discretisation for corrections, or NULL */
    const OstSolverFacts *facts;         /* for the plan, or NULL */
    void *owner;                         /* of the arrays; NULL: they stay */
    OstStatus (*renew)(void *owner, struct OstSolverGeometry *geometry); /* collective; does nothing if all are there */
    void (*release)(void *owner);                                        /* local */
} OstSolverGeometry;

/* Collective. Makes the arrays if they have been released. */
static inline OstStatus ost_geometry_renew(OstSolverGeometry *geometry)
{
    return geometry->owner ? geometry->renew(geometry->owner, geometry) : OST_SUCCESS;
}

/* Local. They are not needed any more. */
static inline void ost_geometry_release(const OstSolverGeometry *geometry)
{
    if (geometry->owner)
        geometry->release(geometry->owner);
}

/* A coarser discretisation of the same body on the same ranks: linear tets for quadratic ones (p-multigrid). A fine
 * node interpolates its four parents by weights, projected on the directions in which the fine node is unconstrained.
 */
typedef struct OstCoarseSpace {
    const OstBlockMatrix *matrix;      /* assembled on its own; unscaled */
    const OstSolverGeometry *geometry; /* of its rows */
    const OstLocal
        *parents;          /* fine rows × 4: columns of the coarse matrix (owned or ghost); -1: none, or constrained */
    const double *weights; /* fine rows × 4 */
} OstCoarseSpace;

#endif
