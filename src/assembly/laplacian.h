/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_LAPLACIAN_H
#define ORTHOSTAT_ASSEMBLY_LAPLACIAN_H

#include "assembly/system.h"

/* Three harmonic potentials at once, in place of the three components of the displacement. Their gradients give the
 * axes of materials with gradient axes. */

/* Local. Fills the system's matrix with the Laplacian L of each component, constrained as K would be, and `rhs` (3 ×
 * rows) with -P L g. */
OstStatus ost_system_fill_laplacian(OstSystem *system, double *rhs);

/* Local. Mean gradient of each component in a tet: du_i/dx_j at 3i + j. u has 3 numbers a node. */
void ost_tet_component_gradients(const OstMesh *mesh, OstLocal tet, const double *u, double gradients[9]);

/* Local. The gradient of one component at each node of a quadratic tet: 10 × 3. */
void ost_tet_node_gradients(const OstMesh *mesh, OstLocal tet, const double *u, int component, double gradients[30]);

#endif
