/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_OPERATOR_H
#define ORTHOSTAT_ACCURACY_OPERATOR_H

#include "accuracy/light_tets.h"
#include "problem/problem.h"

/* Forces and stiffness of the elements and their complement together, tet by tet without a matrix. A displacement has
 * 3 numbers for each node and for each function, ghosts included; forces are complete on those that this rank owns. */
typedef struct OstOperator {
    const OstProblem *problem;
    const OstComplement *complement;
    const double
        *turned_by;      /* where rotations are large: the displacement whose rotations turn the stiffness; or NULL */
    OstLightTets *light; /* the stiffness of linear tets that is not turned, if it may be less precise; or NULL */
} OstOperator;

/* Local. The internal forces on the functions at t of the displacement u of the nodes. On the nodes: by how much those
 * of the elements' own quadrature are larger (3 × owned_nodes). energy: of this rank's tets, or NAN where the forces do
 * not tell. */
OstStatus ost_operator_force(const OstOperator *operator, double t, const double *u, double *missing,
                             double *of_functions, double *energy);

/* Local. The stiffness of small displacements times one: that of linear theory, turned at each point with the body.
 * (What the stress adds to it is left out: so it is definite.) */
void ost_operator_apply(const OstOperator *operator, const double * u, const double *w, double *force,
                        double *of_functions);

/* Local. The inverses of the functions' own 3×3 blocks of the stiffness, along the directions that are not constrained:
 * 6 numbers for each function (11 22 33 12 23 31); 0 of those of other ranks, as far as forces there are 0. */
OstStatus ost_operator_diagonal(const OstOperator *operator, double * inverse);

/* Local. Of each owned tet, twice the strain energy of a displacement; and the mean of its stress (6 numbers), or NULL.
 */
void ost_operator_energy(const OstOperator *operator, const double * u, const double *w, double *energy,
                         double *stress);

/* Local. Of each tet, ghosts included, `factor` times the stress of a displacement at its nodes, 6 numbers each; by
 * linear theory.
 */
void ost_operator_node_stress(const OstOperator *operator, const double * u, const double *w, double factor,
                              float *stress);

#endif
