/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_POLAR_H
#define ORTHOSTAT_ELEMENT_POLAR_H

#include "element/simd.h"

/* The signed polar decomposition F = R U at one point of each tet of a batch, by its parts: F v_k = stretch_k a_k, with
 * v_k the principal directions before and a_k those after the deformation, both right-handed. R = sum of a_k v_k' is a
 * proper rotation; U = sum of stretch_k v_k v_k'. stretch_1 >= stretch_2 >= |stretch_3|, and stretch_3 has the sign of
 * det F: where a tet is inverted, its smallest stretch is negative (G. Irving, J. Teran and R. Fedkiw, Invertible
 * finite elements for robust simulation of large deformation, 2004). */
typedef struct OstPolar {
    OstSimd before[9]; /* rows v_1 v_2 v_3 */
    OstSimd after[9];  /* rows a_1 a_2 a_3 */
    OstSimd stretch[3];
    OstSimd strain[3]; /* stretch - 1, without cancellation where the displacement gradient is small */
} OstPolar;

/* Local. From the displacement gradient, slope = F - I (du_i / dx_j at 3i + j). */
void ost_polar(const OstSimd slope[9], OstPolar *polar);

/* Local. R, row-major. */
void ost_polar_rotation(const OstPolar *polar, OstSimd rotation[9]);

#endif
