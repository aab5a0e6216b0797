/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_RESULT_H
#define ORTHOSTAT_RESULT_H

#include "orthostat/field.h"
#include "orthostat/mesh.h"
#include "orthostat/solver.h"

/* What the checks after the solve found; every number is over the whole body. */
typedef struct OstChecks {
    double relative_residual; /* ||P (f - K u)|| / ||f_rhs||, K u summed tet by tet without the matrix */
    double load[3], reaction[3];
    double force_imbalance;  /* |sum of loads + reactions| over the sum of their magnitudes */
    double moment_imbalance; /* likewise about the body's centre */
    double strain_energy;    /* ½ u·K u */
    double work;             /* of loads and reactions: ½ (f·u + r·g) */
    double energy_imbalance; /* |strain_energy - work| / larger */
    int finite;
} OstChecks;

/* One rank's piece of the answer. */
typedef struct OstResult {
    OstContext *ctx;
    const OstMesh *mesh;
    const OstMaterialField *field;
    double *displacement;          /* 3 × node_count */
    double *force;                 /* 3 × owned_nodes: the loads */
    double *reaction;              /* 3 × node_count; zero where nothing is held */
    double *strain, *stress;       /* 6 × owned_tets: means (11 22 33 12 23 31, strain with 2e), or NULL */
    double *strain_energy_density; /* owned_tets, or NULL */
    double *node_stress;           /* 6 × node_count, or NULL */
    OstGlobal unknowns;
    double largest_displacement;
    double largest_at[3];
    OstSolveReport solve;
    OstChecks checks;
} OstResult;

#endif
