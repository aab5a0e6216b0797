/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_BENCH_PETSC_SYSTEM_H
#define ORTHOSTAT_BENCH_PETSC_SYSTEM_H

#include "system_file.h"

#include <petscksp.h>

/* Which near-null space a peer is told: none, the three rotations (BoomerAMG adds them to the translations it knows by
 * itself), or all six rigid body modes. */
typedef enum { MODES_NONE, MODES_ROTATIONS, MODES_ALL } SystemModes;

/* A system of bench_write_system as PETSc's objects, on the same ranks with the same rows. Scaled, it is
 * (S A S^T) u' = S f with u = S^T u' and S the inverse Cholesky factor of each node's 3×3 block. */
typedef struct PetscSystem {
    Mat matrix; /* AIJ, block size 3 */
    Vec right_side;
    PetscReal right_side_norm; /* of f, unscaled */
    PetscInt rows;             /* block rows of this rank */
    PetscScalar *scale;        /* S, rows × 9; NULL: not scaled */
    PetscScalar *unscale;      /* S^-1 */
    PetscLogDouble scaling_seconds, scaling_processor;
} PetscSystem;

PetscErrorCode PetscSystemRead(const char *folder, PetscBool scaled, SystemModes modes, PetscSystem *system);
PetscErrorCode PetscSystemDestroy(PetscSystem *system);

/* ||S^-1 r'||, the norm of the unscaled residual that belongs to a residual of this system. */
PetscErrorCode PetscSystemResidualNorm(const PetscSystem *system, Vec residual, PetscReal *norm);

/* ||f - A u|| / ||f||, recomputed; `u` is in this system's unknowns. */
PetscErrorCode PetscSystemTrueResidual(const PetscSystem *system, Vec u, PetscReal *relative);

/* Writes S^T u' as FOLDER/solution.NAME.RANK. */
PetscErrorCode PetscSystemWriteSolution(const PetscSystem *system, const char *folder, const char *name, Vec u);

#endif
