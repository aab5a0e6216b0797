/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_MATERIAL_DEFINITE_H
#define ORTHOSTAT_MATERIAL_DEFINITE_H

#include "orthostat/material.h"

/* The three numbers nu12 sqrt(E2/E1), nu23 sqrt(E3/E2), nu31 sqrt(E1/E3): signed geometric means of nu_ij and nu_ji,
 * off-diagonals (with a minus sign) of the normalised normal block. The family has all three equal to nu. */
void ost_orthotropic_normalised_ratios(const OstOrthotropic *constants, double ratios[3]);

/* The symmetric block with ones on the diagonal and -ratios (12, 23, 31) off it. */
void ost_normalised_block(const double ratios[3], double block[9]);

/* Local. Raises OST_INVALID_INPUT, with the constant or inequality at fault, unless the numbers are finite, the moduli
 * positive and the normal block positive definite; returns the eigenvalues of the normalised block. The family and
 * isotropy may be incompressible (nu = 1/2): the least eigenvalue is then 0. */
OstStatus ost_orthotropic_check(OstContext *ctx, const char *name, const OstOrthotropic *constants,
                                double eigenvalues[3]);

#endif
