/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ACCURACY_COMPLEMENT_BLOCKS_H
#define ORTHOSTAT_ACCURACY_COMPLEMENT_BLOCKS_H

#include "accuracy/complement/complement.h"

/* The inverse of a function's 3×3 block of the stiffness as N'N, N the inverse of its Cholesky factor: so it stays
 * positive definite in single precision, however far moduli differ. Eight numbers: 11 22 33 0, 21 32 31 0. */
enum { OST_PER_BLOCK = 8 };

/* Local. N of a symmetric block (11 22 33 12 23 31). A pivot below `least` times the diagonal's is taken for that; with
 * 0, none may be: returns 0 then, and 1 else. */
int ost_block_factor(const double symmetric[6], double least, float factor[OST_PER_BLOCK]);

/* Local. Turns the blocks that were summed in single precision (11 22 33 0 12 23 31 0 of each function) into N. */
void ost_blocks_factor(const OstComplement *complement, float *block);

/* Local. What a step of conjugate gradients does to the functions: e += length p, r -= length q, and the products
 * sums[0] = r'N'N r, sums[1] = q'N'N r. */
void ost_blocks_step(size_t count, const float *factor, double length, const float *p, const float *q, float *e,
                     float *r, double sums[2]);

/* Local. r'N'N r */
double ost_blocks_square(size_t count, const float *factor, const float *r);

/* Local. p = N'N r + share p; a p of no share may be anything. */
void ost_blocks_turn(size_t count, const float *factor, const float *r, double share, float *p);

/* Local. Of vectors of the functions: b += share a; and p = z + share p, where a p of no share may be anything. */
void ost_functions_add(size_t count, double share, const float *a, float *b);
void ost_functions_turn(size_t count, const float *z, double share, float *p);

/* Local. a'b of vectors of the functions. */
double ost_functions_dot(size_t count, const float *a, const float *b);

#endif
