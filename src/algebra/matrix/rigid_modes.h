/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_RIGID_MODES_H
#define ORTHOSTAT_ALGEBRA_MATRIX_RIGID_MODES_H

#include "orthostat/context.h"

/* Local. Rigid body modes of nodes about the point `about`: 6 columns of 3 × count, three translations and three
 * rotations. */
void ost_rigid_body_modes(OstLocal count, const double *coordinates, const double about[3], double *modes);

#endif
