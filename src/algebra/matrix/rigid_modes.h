/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_RIGID_MODES_H
#define ORTHOSTAT_ALGEBRA_MATRIX_RIGID_MODES_H

#include "orthostat/context.h"

/* Local. The rigid body modes of nodes: 6 columns of 3 × count numbers, three translations, then three rotations about
 * axes through the point `about`. */
void ost_rigid_body_modes(OstLocal count, const double *coordinates, const double about[3], double *modes);

#endif
