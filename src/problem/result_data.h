/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBLEM_RESULT_DATA_H
#define ORTHOSTAT_PROBLEM_RESULT_DATA_H

#include "case/case_data.h"
#include "material/field_data.h"
#include "mesh/mesh_data.h"
#include "orthostat/problem.h"
#include "orthostat/result.h"

#include <math.h>

/* Estimated relative error of linear theory, which takes strains and rotations as small. Rotated by an angle, a part
 * comes out longer by half the angle's square (a cantilever whose end turns by 0.5 bends 10 % too far: Mattiasson, Int.
 * J. Numer. Meth. Eng. 17, 1981, has 0.30172 of the length where linear theory has 1/3). A small strain e is e + e²/2
 * by Green's measure. Stress stiffens a body that turns under tension, or softens it: by linear theory, which leaves
 * that out, it moves too far by as much, or not far enough. */
static inline double ost_linear_error(const OstChecks *checks)
{
    const double turned = 0.5 * checks->largest_rotation * checks->largest_rotation;
    const double strained = 0.5 * checks->largest_strain;
    return fmax(fmax(turned, strained), fabs(checks->stiffening));
}

/* Objections to solving a problem, or to an answer, in words. One may list all strategies that were tried. */
enum { OST_MOST_OBJECTIONS = 8, OST_LONGEST_OBJECTION = OST_ERROR_TEXT_SIZE };

typedef struct OstVerdict {
    int count;        /* 0 if there are none; the same on all ranks */
    OstStatus status; /* what to fail with: that of the first objection */
    char text[OST_MOST_OBJECTIONS][OST_LONGEST_OBJECTION];
} OstVerdict;

/* The error of the quantity that the case asks about (accuracy: of), by its adjoint problem. */
typedef struct OstInterestError {
    const OstWatch *watch; /* the case's; NULL: none is asked about, or its error is not known */
    double value, error;   /* the exact value less this one, as estimated */
    double doubt;          /* of it, of either sign */
    double size;           /* of a reaction: the sum of the lengths of its terms */
    double *share;         /* owned_tets: each one's share of it, where a mesh should be refined for it */
    double sum;            /* of the shares: |error|, or more where parts of it cancel */
    int has_no_answer;     /* could the adjoint problem not be solved? */
} OstInterestError;

/* Of a watched reaction, or mean stress, whose adjoint problem is solved (solve/reactions/). */
typedef struct OstWatchedReaction {
    int known;
    double missing; /* to be added to the sum over the nodes: the share of what the solve left out of balance */
    double error;   /* the exact value less that, as estimated */
} OstWatchedReaction;

/* One rank's piece of the answer. */
struct OstResult {
    OstContext *ctx;
    const OstMesh *mesh;
    const OstMaterialField *field;
    double t;                     /* factor of what grows with t */
    OstFormulation formulation;   /* by which strain follows from the displacement */
    int conservative;             /* are the loads the gradient of a work function? */
    double *displacement;         /* 3 × node_count */
    double *pressure;             /* 4 × tet_count: of a mixed form, at the tets' vertices; else NULL */
    OstMaterialField at_pressure; /* with a pressure: the field that has it, which `field` then is */
    double *internal;        /* 3 × owned_nodes: forces of the tets, where the solve has left them to the checks */
    double *force;           /* 3 × owned_nodes: the loads; NULL unless reached */
    double *reaction;        /* 3 × node_count; zero where nothing is constrained; NULL unless reached */
    double *passed;          /* 3 × owned_nodes: the part of it that links and moved couplings pass on, where a
                                reaction is watched and there are such; or NULL */
    double *moved;           /* likewise: of that, the part of moved couplings; or NULL */
    double *strain, *stress; /* 6 × owned_tets: means (11 22 33 12 23 31, strain with 2e), or NULL */
    double *strain_energy_density; /* owned_tets, or NULL */
    double *node_stress;           /* 6 × node_count, or NULL */
    double *rotation;              /* 9 × owned_tets: of each tet's mean F, where rotations are large; or NULL */
    double *tet_error;             /* owned_tets: error in the norm of the energy, or NULL */
    double *surplus;               /* 3 × node_count: what the estimate adds to the displacement, or NULL */
    double *left_out;           /* 3 × node_count: what large rotations add to a linear displacement, to first order,
                                   or NULL */
    double *left_out_reaction;  /* 3 × owned_nodes: the same of the reactions, or NULL */
    double *stress_surplus;     /* 6 × owned_tets: what it adds to the mean stress, or NULL */
    double *along_axes_surplus; /* 6 × owned_tets: what that along material axes has more, as they vary within the tet,
                                   or NULL */
    float *node_stress_surplus; /* 6 for each node of each tet: what it adds to the stress there, or NULL */
    OstWatchedReaction *reactions; /* one for each quantity watched, or NULL */
    OstInterestError interest;     /* of the quantity that the case asks about */
    unsigned asked;                /* bits of OstOutputFieldBit */
    OstGlobal unknowns;
    double largest_displacement;
    double largest_at[3];
    OstSolveReport solve;
    OstNewtonReport newton;
    int linear_alone;  /* cannot large rotations be solved for? */
    OstWorstTet worst; /* where rotations are large: the tet that is compressed the most */
    OstChecks checks;
    OstFailure failure;
    OstBuckling buckling;
    double *buckling_mode[OST_MOST_BUCKLING_MODES]; /* 3 × node_count each, or NULL */
    OstAnswerError answer;                          /* the error that the mesh makes */
    int reached;                                    /* is there a displacement? Not if no solver could be made */
    int unfinished;                                 /* did the solver stop short of the requested residual? */
    OstVerdict verdict;                             /* no objections: the result is an answer */
};

#endif
