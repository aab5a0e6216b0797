/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_RESULT_H
#define ORTHOSTAT_RESULT_H

#include "orthostat/material.h"
#include "orthostat/output_field.h"
#include "orthostat/solver.h"
#include "orthostat/steps_file.h"

OST_API_BEGIN

/* What the checks after the solve found; every number is over the whole body. */
typedef struct OstChecks {
    double relative_residual;  /* ||P (f - K u)|| / ||f_rhs||, K u summed tet by tet without the matrix */
    double rounding;           /* what of it rounding may explain: a few 1e-16 of || |K| |u| || / ||f_rhs|| */
    double rigid_motion;       /* most that a tet, or a row of the matrix, resisted rigid motion, over |K| |motion| */
    double displacement_error; /* relative error of the displacement in the equations, 2-norm; NAN if not known */
    double force_error;        /* the same of reactions and stresses: the larger of them, or of the imbalances of force
                                  and moment; NAN if not known */
    double load[3], reaction[3];
    double force_imbalance;  /* |sum of loads + reactions| over the sum of |load + reaction| of each node, with the
                                forces of springs apart */
    double moment_imbalance; /* likewise about the body's centre */
    int linear;              /* is the problem? The next two are only compared if so */
    double strain_energy;    /* if linear, ½ u·K u */
    double work;             /* ½ (f·u + r·g), of loads and reactions: the whole work if linear */
    double energy_imbalance; /* |strain_energy - work| over ½ the sum of |load + reaction| |u| by component; 0 if not
                                linear */
    int finite;
    double largest_strain;   /* of a tet's mean, by size: the largest principal strain */
    double largest_rotation; /* of a tet's mean, in radians, as linear theory has it: half the curl of u */
    double stiffening; /* if linear: how much stiffer stress makes the body as it turns, relative to its stiffness; less
                          than 0: softer. NAN: not looked at */
    double volume_ratio; /* where rotations are large, deformed over undeformed volume, the mean of det F; else 0 */
} OstChecks;

/* What was found out about large rotations, and what was done about them (large_rotation in docs/case.md). */
typedef struct OstNewtonReport {
    int judged;           /* was linear theory's error estimated? */
    double linear_error;  /* that estimate, relative */
    double accuracy;      /* what it was compared with */
    double linear_strain; /* largest strain and rotation (radians) of the linear solution */
    double linear_rotation;
    double linear_stiffening; /* the OstChecks' stiffening of the linear solution */
    double linear_change;     /* of its displacement along itself by what linear theory leaves out, to first order, over
                                 the largest displacement; 0: not looked at */
    int used;                 /* was the nonlinear problem solved, by Newton's method? What follows is 0 if not. */
    double reached;           /* load factor of the last state at rest: 1 is all of the load */
    int load_steps;           /* taken */
    int cut_backs;            /* load steps given up, and tried again half as large */
    int iterations;           /* of Newton's method, given-up steps included */
    int definite;          /* those of them with the stiffness made positive definite, the exact one being indefinite */
    int cuts;              /* of the line search */
    int linear_iterations; /* of the linear solver, over all of them */
    int setups;            /* of its hierarchy, or factorisations */
    double relative_residual; /* of the last state, relative to loads and reactions */
    double change;            /* its last correction over the displacement, in the 2-norm */
    int rounding_limited;     /* rounding, and not the residual asked for, ended an iteration */
    int jumps;                /* load steps over which the body jumped from one state to another: snap-through */
    double jump_at;           /* load factor at the end of the last of these */
    int stability_unknown; /* whether the last state is stable could not be told: 1 for its pressures, 2 for a load that
                              has no work function; else 0 */
    double seconds;        /* of Newton's method */
} OstNewtonReport;

/* The estimated error of the answer that the mesh and its elements make (not that of the equations, which OstChecks
 * has): the distance from the solution of the continuous problem. */
typedef struct OstAnswerError {
    double energy_norm;        /* |e|_E, in the norm of the energy: sqrt(2 × the strain energy of e) */
    double relative;           /* that over |u + e|_E */
    double displacement;       /* largest |e| at a node, over the largest |u + e|; NAN where a distributing coupling is
                                  moved: its force has an error that is not in e */
    int displacement_is_least; /* 1: the true one may be up to five times that, as multigrid finds e slowly and nothing
                                  is watched */
    double by_loads;           /* how much of the work that strains the body loads do, 0 to 1; the rest is that of
                                  supports that are moved */
    int known;                 /* 0: no estimate was asked for, or none could be made; all numbers are then 0 */
    int is_indefinite;         /* 1: none could be made, as the stiffness that it takes is not positive
                                  definite */
    int region;                /* of the mesh, the one with the largest share of the squared error; and that share */
    double region_share;
    double place[3];  /* centroid of the tet with the largest share */
    double cut_off;   /* not in any of these: what faces cut off the body, as a share of its volume, if its surface is
                         meant to be curved where they meet at less than 40 degrees */
    double filled_in; /* and what they add in hollows */
} OstAnswerError;

/* The load factors at which a body buckles by linear theory: its stiffness, and the stress of the linear answer times
 * such a factor, have a motion that costs no energy. */
typedef struct OstBuckling {
    int known;                              /* 0: not looked for, or not found because it does not matter */
    int count;                              /* of load factors */
    double factor[OST_MOST_BUCKLING_MODES]; /* the lowest first; INFINITY: however much the load grows, it does not */
    int iterations;
    int converged; /* else the true factors may be lower */
    double seconds;
} OstBuckling;

/* Where the body is nearest to failure by one criterion: by how much the load may grow until the mean stress of a tet
 * fails (OST_MOST_LOAD_FACTOR: nowhere), and which tet that is. */
typedef struct OstLeastFactor {
    double factor;
    OstGlobal tet; /* its label */
    int region;
    double place[3]; /* its centroid */
} OstLeastFactor;

typedef struct OstFailure {
    int known; /* 0: no material has strengths, or no load factor was asked for */
    OstLeastFactor least[OST_CRITERIA];
} OstFailure;

/* One rank's piece of the answer, on one piece of a mesh; the mesh outlives it. */
typedef struct OstResult OstResult;

/* Local. "accepted"; "unfinished" where the solver stopped early; "refused" where a check failed. */
const char *ost_result_status(const OstResult *result);

/* Local. What speaks against the answer, in words: how many objections (none: it is accepted), and one of them. */
int ost_result_objection_count(const OstResult *result);
const char *ost_result_objection(const OstResult *result, int number);

/* Local. The fields, which live as long as the result; NULL where a field was not asked for, or not reached. Units are
 * the user's. Symmetric tensors are 11 22 33 12 23 31 in world axes. Strains have engineering shear: 2 e12, 2 e23, 2
 * e31; the file of fields has the tensor, with e12, e23, e31. */
const OstBuckling *ost_result_buckling(const OstResult *result);
const double *ost_result_displacement(const OstResult *result); /* node_count × 3, ghosts included */
const double *ost_result_reaction(const OstResult *result);     /* node_count × 3, 0 where nothing constrains */
const double *ost_result_load(const OstResult *result);         /* owned_nodes × 3: the forces on the nodes */
const double *ost_result_stress(const OstResult *result);       /* owned_tets × 6: mean over the tet */
const double *ost_result_strain(const OstResult *result);       /* owned_tets × 6: mean, shear doubled */
const double *ost_result_strain_energy_density(const OstResult *result); /* owned_tets */
const double *ost_result_node_stress(const OstResult *result);           /* node_count × 6 */
const double *ost_result_tet_error(const OstResult *result); /* owned_tets: each one's error in the norm of the energy,
                                                                whose squares add up to that of OstAnswerError */

/* A field as the file has it (docs/output.md). Texts are the library's. */
typedef struct OstFieldValues {
    const char *unit, *description;
    const char *component_names; /* with blanks between them; "" if there is one */
    int components;
    int is_integer; /* are the values int32_t? Otherwise they are double */
    OstLocal rows;  /* node_count or owned_tets */
    void *values;   /* rows × components; NULL: the result has nothing that it could be made of */
    int is_made; /* were they made for the caller, who frees them by ost_free_memory? Otherwise the result has them */
} OstFieldValues;

/* Collective. One of the result's fields, or one that follows from them, as von Mises stress does. Raises
 * OST_OUT_OF_MEMORY. */
OstStatus ost_result_field(const OstResult *result, OstOutputFieldBit field, OstFieldValues *found);

/* Local. Over the whole body: the largest displacement and, unless NULL, the place of its node; the unknowns. */
double ost_result_largest_displacement(const OstResult *result, double at[3]);
OstGlobal ost_result_unknowns(const OstResult *result);

/* Local. What was found out about the solve and about the answer; both live as long as the result. Later versions may
 * add to the ends of these structs, which only the library makes. */
const OstSolveReport *ost_result_solve_report(const OstResult *result);
const OstChecks *ost_result_checks(const OstResult *result);
const OstNewtonReport *ost_result_newton_report(const OstResult *result);
const OstAnswerError *ost_result_answer_error(const OstResult *result);
const OstFailure *ost_result_failure(const OstResult *result);

/* A quantity of interest (`watch` in a case), as the answer has it. */
typedef struct OstWatchedValue {
    const char *name;
    double value;
    double expected; /* NAN if not known, as is `error`: the exact value less this one, as estimated */
    double error;
    int by_adjoint; /* is the error by the adjoint problem, so that adding it makes the value better? */
    int placed;     /* is it a least or largest value, and `place` where it is (else NAN)? */
    double place[3];
    const char *why;   /* is the error not known although the estimate was asked for; NULL else */
    const char *exact; /* why the value has no error of the mesh, in words; NULL: it has one, or it is not known */
    double terms;      /* of a reaction: the sum of the sizes of its nodes' forces, or moments; else 0 */
} OstWatchedValue;

/* Collective. Writes the file of a result, with those of the fields (bits of OstOutputFieldBit) that the result has or
 * that follow from them; its form is that of the ending of `path`, .vtkhdf, .hdf, .vtu or .pvtu (with a .vtu beside it;
 * docs/output.md). A result with objections is marked: attribute Status of /VTKHDF (as ost_result_status gives it),
 * field data `refused`, the reasons in /Orthostat/Objections. Raises OST_FILE_FAILED, OST_INVALID_USAGE for another
 * ending. */
OstStatus ost_result_write(const OstResult *result, unsigned fields, const char *path);

/* Collective. The same as one step more of a file of several, with its place in time and its name, of a letter at
 * least. All are of one mesh. Raises OST_FILE_FAILED, OST_INVALID_INPUT where there is no room for one more. */
OstStatus ost_result_write_step(const OstResult *result, unsigned fields, OstStepsFile *file, double time,
                                const char *name);

/* Local. Frees the result; the pointer is nulled. */
void ost_result_destroy(OstResult **result);

OST_API_END

#endif
