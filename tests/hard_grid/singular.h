/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef HARD_GRID_SINGULAR_H
#define HARD_GRID_SINGULAR_H

#include "hard_grid/direct.h"
#include "hard_grid/grid.h"

/* Collective. Shows without factors what rounding leaves of K, as far as displacements tell that are polynomials of
 * degree 3: plates and beams that bend are among them. Energies x·Kx are summed in twice the precision. The softest
 * such motion has one of 0 or less: truth->indefinite. truth->rounded: by so much of its energy that of the best
 * polynomial answer changes, in the root mean square, when every entry of K changes by 2^-53 of itself with random
 * sign; the answer changes by no less, in the norm of the energy. Other polynomials may be softer yet: what is not
 * found here is not refuted. */
OstStatus hard_find_softest(const OstScene *scene, HardDirect *direct, HardTruth *truth);

#endif
