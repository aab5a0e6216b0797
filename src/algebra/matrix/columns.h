/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_COLUMNS_H
#define ORTHOSTAT_ALGEBRA_MATRIX_COLUMNS_H

#include "orthostat/context.h"

/* Several vectors side by side: number i of all of them, then number i + 1. What is read of a matrix then serves
 * OST_COLUMNS products at once. */
enum { OST_COLUMNS = 8 };
typedef double OstColumns __attribute__((vector_size(64), aligned(8), may_alias));

/* Half of them. Sums of OstColumns are made by halves: without registers of 512 bits GCC 12 keeps a vector of eight
 * doubles in memory, and moves it number by number. */
typedef double OstHalfColumns __attribute__((vector_size(32), aligned(8), may_alias));

/* In single precision, as multigrid's levels have them; a register of AVX. */
typedef float OstLightColumns __attribute__((vector_size(32), aligned(4), may_alias));

/* Fewer than these are quicker one after another. */
enum { OST_FEWEST_COLUMNS = 3 };

/* Local. How many of `left` vectors are taken side by side next: 1 where they are quicker one after another. */
static inline int ost_columns_next(int left)
{
    return left < OST_FEWEST_COLUMNS ? 1 : left < OST_COLUMNS ? left : OST_COLUMNS;
}

/* Local. Puts `count` vectors of n numbers side by side; the columns that are left are 0. */
void ost_columns_pack(size_t n, int count, const double *const *vector, double *columns);

/* Local. Takes the first `count` columns apart. */
void ost_columns_unpack(size_t n, int count, const double *columns, double *const *vector);

#endif
