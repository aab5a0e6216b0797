/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_OPERATOR_H
#define ORTHOSTAT_ACCURACY_OPERATOR_H

#include "accuracy/light/light_tets.h"
#include "problem/problem.h"

/* Forces and stiffness of the elements and their complement together, tet by tet without a matrix. A displacement has
 * 3 numbers for each node and OST_PER_FUNCTION for each function, ghosts included; forces are complete on those that
 * this rank owns. Those of the functions are in single precision: so the stiffness is taken over `unit`, which makes
 * forces as large as displacements, and both are near one if the caller sees to it. */
typedef struct OstOperator {
    const OstProblem *problem;
    const OstComplement *complement;
    double unit;
    const double
        *turned_by;      /* where rotations are large: the displacement whose rotations turn the stiffness; or NULL */
    OstLightTets *light; /* the stiffness of linear tets that is not turned, if it may be less precise; or NULL */
} OstOperator;

/* Collective. A stiffness of the size of this problem's, the same on all ranks. */
OstStatus ost_operator_unit(const OstProblem *problem, double *unit);

/* Local. Minus the internal forces on the functions (3 numbers each; not over the unit) at t of the displacement u of
 * the nodes. On the nodes, where rotations are large: by how much those of the elements' own quadrature are larger (3 ×
 * owned_nodes); 0 else, as they balance the loads, and what finer quadrature says more is small (effectivities of
 * `verify` are the same within 0.008). energy: of this rank's tets, or NAN where the forces do not tell. */
OstStatus ost_operator_force(const OstOperator *operator, double t, const double *u, double *missing,
                             double *of_functions, double *energy);

/* Local. The forces on the nodes (3 × owned_nodes; NULL: not wanted), and minus those on the functions (3 numbers each;
 * not over the unit), of a small displacement, and of the pressure and a share of the eigenstrain of the problem's
 * field. Curved tets are taken as they are. All are turned with the body where rotations are large. */
void ost_operator_small_force(const OstOperator *operator, double eigen_share, const double *u, double *force,
                              double *of_functions);

/* Local. The stiffness of small displacements times one: that of linear theory, turned at each point with the body, and
 * of straight tets where they are curved. (What the stress adds to it is left out: so it is definite.)
 * u: NULL, where the nodes are at rest. */
void ost_operator_apply(const OstOperator *operator, const double * u, const float *w, double *force,
                        float *of_functions);

/* Local. Of the functions' own 3×3 blocks of the stiffness, along the directions that are not constrained, the inverses
 * as N'N (accuracy/complement/blocks.h). */
OstStatus ost_operator_blocks(const OstOperator *operator, float * factor);

/* Local. Of each owned tet, twice the strain energy of a displacement. */
void ost_operator_energy(const OstOperator *operator, const double * u, const float *w, double *energy);

/* Local. Adds what `factor` times a displacement, and the pressure of a mixed form's field, add to the stress, in a
 * frame that turns with the tet where rotations are large. Of each tet, ghosts included, at its nodes, 6 numbers each,
 * not over the unit; the mean over each owned tet; and what the mean along material axes has more, as they vary within
 * it (ost_vary_axes). Each may be NULL, as may `w`: no functions. */
void ost_operator_add_stress(const OstOperator *operator, const double * u, const float *w, double factor,
                             float *at_nodes, double *mean, double *along_axes);

#endif
