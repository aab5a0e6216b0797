/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_GUARD_RIGID_MOTION_H
#define ORTHOSTAT_GUARD_RIGID_MOTION_H

#include "assembly/system.h"

/* A body does not resist rigid motion: K times each of the six modes is zero, which multigrid relies on. Two tests of
 * that are made before every solve. Each tries one combination of all six modes, at about the cost of a product with K;
 * only if that meets a force are the modes tried one by one, to name the faulty one.
 *
 * Measured is the force over |K| |motion|. Rounding leaves a few 1e-16, times the slenderness of the tet (longest edge²
 * over largest face), because a needle's gradients are differences of nearly equal products. An error in a formula
 * gives about 1; in a rotation about a far axis, the size of the tet over that of the body. The limit is
 * sqrt(DBL_EPSILON), which lies between the two for slenderness up to 1e6 and tets down to 1e-7 of the body. */

/* Collective. Tests the tets, each moved about itself without its supports, by the kernel that sums the true residual.
 * Fills `worst` (over the body); raises OST_CHECK_FAILED naming tet and mode. */
OstStatus ost_rigid_motion_of_tets(const OstMesh *mesh, const OstMaterialField *field, double *worst);

/* Collective. Tests the rows of the assembled matrix that no support touches, with the modes that multigrid is given
 * (ost_system_geometry). Fills `worst`; raises OST_CHECK_FAILED naming vertex and mode. If there is no such row,
 * `worst` is 0. */
OstStatus ost_rigid_motion_of_rows(const OstSystem *system, const double *modes, double *worst);

#endif
