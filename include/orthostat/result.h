/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_RESULT_H
#define ORTHOSTAT_RESULT_H

#include "orthostat/field.h"
#include "orthostat/mesh.h"
#include "orthostat/solver.h"

OST_API_BEGIN

/* What the checks after the solve found; every number is over the whole body. */
typedef struct OstChecks {
    double relative_residual;  /* ||P (f - K u)|| / ||f_rhs||, K u summed tet by tet without the matrix */
    double rounding;           /* what of it rounding may explain: a few 1e-16 of || |K| |u| || / ||f_rhs|| */
    double rigid_motion;       /* most that a tet, or a row of the matrix, resisted rigid motion, over |K| |motion| */
    double displacement_error; /* relative error of the displacement in the equations: the solver's error_estimate,
                                  or energy_imbalance if that is larger and no support moves; NAN if not known */
    double force_error;        /* the same of reactions and stresses, about: the largest of the imbalances below and of
                                  the displacement's error relative to what strains the body; NAN if not known */
    double load[3], reaction[3];
    double force_imbalance;  /* |sum of loads + reactions| over the sum of |load + reaction| of each node */
    double moment_imbalance; /* likewise about the body's centre */
    int linear;              /* is the problem? The next two are only compared if so */
    double strain_energy;    /* if linear, ½ u·K u */
    double work;             /* ½ (f·u + r·g), of loads and reactions: the whole work if linear */
    double energy_imbalance; /* |strain_energy - work| over ½ the sum of |load + reaction| |u| by component; 0 if not
                                linear */
    int finite;
    double largest_strain;   /* of a tet's mean, by size: the largest principal strain */
    double largest_rotation; /* of a tet's mean, in radians, as linear theory has it: half the curl of u */
} OstChecks;

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
typedef struct OstResult {
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
} OstResult;

/* A quantity that the case watches, as the answer has it. */
typedef struct OstWatchedValue {
    const char *name;
    double value;
    double expected; /* not a number where it is not known */
} OstWatchedValue;

OST_API_END

#endif
