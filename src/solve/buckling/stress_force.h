/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_BUCKLING_STRESS_FORCE_H
#define ORTHOSTAT_SOLVE_BUCKLING_STRESS_FORCE_H

#include "problem/problem.h"

/* Local. The forces at owned nodes (3 × owned_nodes each) by which the stress of a linear displacement u, with `share`
 * of the eigenstrain, resists displacements v (3 × node_count each): the derivative of the stress's work on what U - I
 * has to second order, ½ (H'H - e²) with H = grad v. `field` has the pressures of a mixed form. */
void ost_stress_force(const OstMesh *mesh, const OstMaterialField *field, double share, const double *u, int count,
                      double *const *v, double *const *force);

#endif
