/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_SCALING_H
#define ORTHOSTAT_ALGEBRA_MATRIX_SCALING_H

#include "algebra/matrix/block_matrix.h"

/* Scaling by the Cholesky factor L of each row's diagonal block: with S = L^-1, A' = S A S^T has identity blocks on its
 * diagonal, whatever the units and the stiffness of the node. A u = f becomes A' u' = f' with
 *     f' = S f,   u = S^T u',   r = S^-1 r',   modes' = S^-T modes. */
typedef struct OstScaling {
    OstContext *ctx;
    OstLocal rows;
    double *factor; /* S, columns × 6 (ghosts' too): 11, 21 22, 31 32 33 of a lower triangle */
} OstScaling;

/* Collective. Raises OST_INVALID_INPUT with the global row whose diagonal block is not finite or not positive
 * definite. */
OstStatus ost_scaling_create(const OstBlockMatrix *matrix, OstScaling **scaling);
void ost_scaling_destroy(OstScaling **scaling);

/* Local. Block (i, j) of S A S^T; j may be a ghost. */
static inline void ost_scaling_block(const OstScaling *scaling, OstLocal i, OstLocal j, const double block[9],
                                     double scaled[9])
{
    const double *s = scaling->factor + 6 * (size_t)i;
    const double *t = scaling->factor + 6 * (size_t)j;
    double left[9];
    for (int c = 0; c < 3; c++) {
        left[c] = s[0] * block[c];
        left[3 + c] = s[1] * block[c] + s[2] * block[3 + c];
        left[6 + c] = s[3] * block[c] + s[4] * block[3 + c] + s[5] * block[6 + c];
    }
    for (int r = 0; r < 9; r += 3) {
        scaled[r] = left[r] * t[0];
        scaled[r + 1] = left[r] * t[1] + left[r + 1] * t[2];
        scaled[r + 2] = left[r] * t[3] + left[r + 1] * t[4] + left[r + 2] * t[5];
    }
}

/* Local. 3 × rows numbers each; input and output may be the same array. */
void ost_scaling_to_scaled(const OstScaling *scaling, const double *f, double *scaled_f);            /* S f */
void ost_scaling_from_scaled(const OstScaling *scaling, const double *scaled_u, double *u);          /* S^T u' */
void ost_scaling_unscale_residual(const OstScaling *scaling, const double *scaled_r, double *r);     /* S^-1 r' */
void ost_scaling_to_scaled_mode(const OstScaling *scaling, const double *mode, double *scaled_mode); /* S^-T m */

/* Local. This rank's part of ||S^-1 r'||². */
double ost_scaling_residual_square(const OstScaling *scaling, const double *scaled_r);

#endif
