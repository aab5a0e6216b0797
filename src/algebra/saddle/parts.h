/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_SADDLE_PARTS_H
#define ORTHOSTAT_ALGEBRA_SADDLE_PARTS_H

#include "algebra/matrix/block_matrix.h"
#include "algebra/saddle/coupling.h"

/* Of the connected parts of the pressures' mass matrix (each a region of one material, or a piece of one), those whose
 * mean pressure is held by far less than the Schur complement's estimate says: soft inclusions, which only the stiff
 * body around them keeps from changing their volume. */
typedef struct OstPressureParts {
    int count;
    int *of_pressure; /* coupling->columns: the part, or -1 */
    double *mass;     /* count: of the estimate, z·S z of z = 1 in the part */
    double *loose;    /* count: z·C z */
} OstPressureParts;

/* Collective. The softest parts, `most` of them at the most. A part is soft if z·B D^-1 B'z + z·C z, with D the
 * diagonal of A, is below `soft` of z·S z: a cheap bound from below, but for a factor. */
OstStatus ost_pressure_parts_create(const OstBlockMatrix *matrix, const OstCoupling *coupling, double soft, int most,
                                    OstPressureParts *parts);
void ost_pressure_parts_clear(OstPressureParts *parts);

#endif
