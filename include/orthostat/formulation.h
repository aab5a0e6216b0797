/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMULATION_H
#define ORTHOSTAT_FORMULATION_H

/* How strain follows from the displacement u.
 *
 * Linear: small rotations, strain = sym(grad u), energy density 1/2 strain : C : strain.
 *
 * Consistent: large rotations, small or moderate strains. F = I + grad u = R U with R a rotation and U symmetric;
 * energy density 1/2 (U - I) : C : (U - I), with C turned with the material. Forces are the energy's gradient.
 *
 * Classical: Li and Barbic's corotational form, f = R K (R'x - X), with R the rotation of a tet's mean F. It is the
 * gradient of no energy where the material is not isotropic, and its forces may then have a moment. */
typedef enum OstFormulation {
    OST_FORMULATION_LINEAR,
    OST_FORMULATION_CONSISTENT,
    OST_FORMULATION_CLASSICAL
} OstFormulation;

#endif
