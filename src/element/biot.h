/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_BIOT_H
#define ORTHOSTAT_ELEMENT_BIOT_H

#include "element/polar.h"

/* Energy density W = 1/2 (U - I) : C : (U - I) at one point of each tet of a batch, with F = R U (polar.h): U - I is
 * Biot's strain, C in world axes of the undeformed body. With p and q the principal directions after and before,
 * sigma the stretches and s the stress C : (U - I) along the directions before, the first Piola stress is
 * P = sum over i, j of 2 sigma_i s_ij / (sigma_i + sigma_j) a_i v_j'.
 * It has no singularity where a tet passes through inversion. Only where it is inverted and sigma_2 + sigma_3 = 0 does
 * R jump: there sums of stretches below OST_LEAST_STRETCH_SUM are replaced by that, which bounds P and its derivative;
 * P is then no longer the energy's gradient. */
#define OST_LEAST_STRETCH_SUM 1e-3

/* Local. U - I in world axes (11 22 33 12 23 31, engineering shear). */
void ost_biot_strain(const OstPolar *polar, OstSimd strain[6]);

/* Local. The derivative of U - I along a change dF of F (row-major), in world axes. */
void ost_biot_strain_change(const OstPolar *polar, const OstSimd df[9], OstSimd change[6]);

/* Local. P (row-major) from the stress conjugate to U - I, in world axes. */
void ost_biot_piola(const OstPolar *polar, const OstSimd stress[6], OstSimd piola[9]);

/* Local. The second derivative of W by F: 9 × 9, with F_ij at 3 j + i, i along world axes and j along the principal
 * directions before (what a node's force needs is then few products). If `definite`, those that have a negative
 * eigenvalue are made positive semidefinite by setting their negative eigenvalues to 0; the others stay as they are. c
 * is C's upper triangle; the stress may have parts that are not C : (U - I), such as that of a mean. */
void ost_biot_hessian(const OstPolar *polar, const OstSimd *c, const OstSimd stress[6], int definite,
                      OstSimd hessian[81]);

#endif
