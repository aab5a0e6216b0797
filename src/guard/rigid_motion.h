/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_RIGID_MOTION_H
#define ORTHOSTAT_GUARD_RIGID_MOTION_H

#include "assembly/system.h"

/* A body does not resist rigid motion: K times each of the six modes is zero, and multigrid builds on it. Two tests of
 * that, made before every solve. Both try one motion that all six modes have part in, so that they cost about a product
 * with K each; only if it is resisted are the modes tried one by one, to name the one at fault.
 *
 * What is measured is the size of the force over |K| |motion|. Rounding leaves a few 1e-16 of it, times the slenderness
 * of the tet (longest edge² over largest face), because a needle's gradients are differences of nearly equal products.
 * A mistake in a formula is of order 1; in a far turn seen by a small tet, of the tet's size over the body's. The limit
 * is sqrt(DBL_EPSILON), half of the digits: between the two for slenderness up to 1e6 and tets down to 1e-7 of the
 * body. */

/* Collective. Are the unsupported tets, by the kernel that the true residual is summed with, free of force under rigid
 * motion about themselves? Fills `worst` (over the body); raises OST_CHECK_FAILED naming tet and mode. */
OstStatus ost_rigid_motion_of_tets(const OstMesh *mesh, const OstMaterialField *field, double *worst);

/* Collective. Are the rows of the assembled matrix that no support touches free of force under the very modes that
 * multigrid is given (as ost_system_geometry makes them)? Fills `worst`; raises OST_CHECK_FAILED naming vertex and
 * mode. Without such a row there is nothing to test, and `worst` is 0. */
OstStatus ost_rigid_motion_of_rows(const OstSystem *system, const double *modes, double *worst);

#endif
