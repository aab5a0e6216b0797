/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SOLVER_H
#define ORTHOSTAT_ALGEBRA_SOLVER_H

#include "algebra/block_matrix.h"
#include "orthostat/solver.h"

/* What multigrid knows of the unknowns beyond the matrix; arrays belong to the caller and outlive the solver. */
typedef struct OstSolverGeometry {
    const double *coordinates; /* rows × 3 */
    const double *metric; /* rows × 6 (11 22 33 12 23 31): mean over a node's tets of R^T diag(sqrt(E_min/E_k)) R, or
                             NULL for the Euclidean metric */
    const double *modes;  /* near-null space: 6 columns of 3 × rows numbers, column-major (rigid body modes, projected
                             on what the supports leave free). The plain recipe takes NULL for three translations, the
                             direct one looks at nothing of this */
    const struct OstCoarseSpace *coarse; /* METRIC: a coarser discretisation to correct by, or NULL */
} OstSolverGeometry;

/* A coarser discretisation of the same body on the same ranks: linear tets under quadratic ones (p-multigrid). A fine
 * row takes the mean of its two parents, projected on what the fine row's supports leave free. */
typedef struct OstCoarseSpace {
    const OstBlockMatrix *matrix;      /* assembled on its own; unscaled */
    const OstSolverGeometry *geometry; /* of its rows */
    const OstLocal *parents; /* fine rows × 2: columns of the coarse matrix (owned or ghost), -1: held, so zero */
} OstCoarseSpace;

typedef struct OstSolver OstSolver;

/* Local. Rigid body modes of nodes about their centre `about`: 6 columns of 3 × count, three translations and three
 * rotations. */
void ost_rigid_body_modes(OstLocal count, const double *coordinates, const double about[3], double *modes);

/* Collective. Builds the preconditioner of the recipe in `options` (account OST_LEDGER_HIERARCHY); AUTO is DIRECT below
 * 3000 unknowns and METRIC above. The matrix stays the caller's, unchanged, and is used until the solver is destroyed.
 * Raises OST_INVALID_INPUT naming an option out of range or a row whose diagonal block is not positive definite,
 * OST_NOT_CONVERGED if a factorisation finds the matrix singular or indefinite, OST_LIMIT_EXCEEDED if it is more than
 * the libraries below can number. */
OstStatus ost_solver_create(OstContext *ctx, const OstBlockMatrix *matrix, const OstSolverGeometry *geometry,
                            const OstSolverOptions *options, OstSolver **solver);
void ost_solver_destroy(OstSolver **solver);

/* Collective. Solves A u = f from u = 0 until ||f - A u|| <= options.relative_residual ||f|| in the unscaled 2-norm,
 * recomputed from A, u, f at the end (and iterated on if the recursive residual had drifted). f and u have 3 × rows
 * numbers (account OST_LEDGER_SOLVE). Returns OST_NOT_CONVERGED with the residual reached, or with the sign that
 * betrayed an indefinite matrix or preconditioner; the report is filled either way. */
OstStatus ost_solver_solve(OstSolver *solver, const double *f, double *u, OstSolveReport *report);

#endif
