/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_RESULT_DATA_H
#define ORTHOSTAT_PROBLEM_RESULT_DATA_H

#include "material/field_data.h"
#include "mesh/mesh_data.h"
#include "orthostat/result.h"

/* What linear theory is off by, about, because strains and rotations are not small. A part turned by an angle comes out
 * longer by half its square (a cantilever whose end turns by 0.5 bends 10 % too far: Mattiasson, Int. J. Numer. Meth.
 * Eng. 17, 1981, has 0.30172 of the length where linear theory has 1/3), and what small strain takes for e is e + e²/2
 * by Green's measure. */
static inline double ost_linear_error(const OstChecks *checks)
{
    const double turned = 0.5 * checks->largest_rotation * checks->largest_rotation;
    const double strained = 0.5 * checks->largest_strain;
    return turned > strained ? turned : strained;
}

/* What speaks against solving a problem, or against an answer, in words. One objection may be all that a solver tried.
 */
enum { OST_MOST_OBJECTIONS = 8, OST_LONGEST_OBJECTION = OST_ERROR_TEXT_SIZE };

typedef struct OstVerdict {
    int count;        /* 0: nothing does; the same on all ranks */
    OstStatus status; /* to fail with, of the first objection */
    char text[OST_MOST_OBJECTIONS][OST_LONGEST_OBJECTION];
} OstVerdict;

/* One rank's piece of the answer. */
struct OstResult {
    OstContext *ctx;
    const OstMesh *mesh;
    const OstMaterialField *field;
    double *displacement;          /* 3 × node_count */
    double *force;                 /* 3 × owned_nodes: the loads; NULL unless reached */
    double *reaction;              /* 3 × node_count; zero where nothing is constrained; NULL unless reached */
    double *strain, *stress;       /* 6 × owned_tets: means (11 22 33 12 23 31, strain with 2e), or NULL */
    double *strain_energy_density; /* owned_tets, or NULL */
    double *node_stress;           /* 6 × node_count, or NULL */
    OstGlobal unknowns;
    double largest_displacement;
    double largest_at[3];
    OstSolveReport solve;
    OstChecks checks;
    int reached;        /* is there a displacement to speak of? Not so if no solver came to work */
    int unfinished;     /* did the solver stop short of the requested residual? */
    OstVerdict verdict; /* no objections: the result is an answer */
};

/* A quantity that the case watches, as the answer has it. */
typedef struct OstWatchedValue {
    const char *name;
    double value;
    double expected; /* not a number where it is not known */
} OstWatchedValue;

#endif
