/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_RESULT_H
#define ORTHOSTAT_RESULT_H

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
const double *ost_result_displacement(const OstResult *result); /* node_count × 3, ghosts included */
const double *ost_result_reaction(const OstResult *result);     /* node_count × 3, 0 where nothing constrains */
const double *ost_result_load(const OstResult *result);         /* owned_nodes × 3: the forces on the nodes */
const double *ost_result_stress(const OstResult *result);       /* owned_tets × 6: mean over the tet */
const double *ost_result_strain(const OstResult *result);       /* owned_tets × 6: mean, shear doubled */
const double *ost_result_strain_energy_density(const OstResult *result); /* owned_tets */
const double *ost_result_node_stress(const OstResult *result);           /* node_count × 6 */

/* Local. Over the whole body: the largest displacement and, unless NULL, the place of its node; the unknowns. */
double ost_result_largest_displacement(const OstResult *result, double at[3]);
OstGlobal ost_result_unknowns(const OstResult *result);

/* Local. What was found out about the solve and about the answer; both live as long as the result. Later versions may
 * add to the ends of these structs, which only the library makes. */
const OstSolveReport *ost_result_solve_report(const OstResult *result);
const OstChecks *ost_result_checks(const OstResult *result);

/* Collective. Writes the VTKHDF file of a result, with those of the fields (bits of OstOutputFieldBit) that the result
 * has. A result with objections is marked: attribute Status of /VTKHDF (as ost_result_status gives it), field data
 * `refused`, the reasons in /Orthostat/Objections. Raises OST_FILE_FAILED. */
OstStatus ost_result_write(const OstResult *result, unsigned fields, const char *path);

/* Local. Frees the result; the pointer is nulled. */
void ost_result_destroy(OstResult **result);

OST_API_END

#endif
