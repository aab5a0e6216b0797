/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_SIMD_H
#define ORTHOSTAT_ALGEBRA_LEVEL_SIMD_H

#ifdef __AVX__
#include <immintrin.h>
#endif

/* Products of small blocks by the compiler's vector types (GCC and Clang; the processor need not have registers that
 * wide). Rows of three numbers are read as vectors of four, rows of six as vectors of eight; the numbers after the row
 * are not used. So all arrays that are read this way are padded at their end. */
typedef double OstDouble2 __attribute__((vector_size(16), aligned(8), may_alias));
typedef double OstDouble4 __attribute__((vector_size(32), aligned(8), may_alias));
typedef double OstDouble8 __attribute__((vector_size(64), aligned(8), may_alias));
typedef float OstFloat4 __attribute__((vector_size(16), aligned(4), may_alias));
typedef float OstFloat8 __attribute__((vector_size(32), aligned(4), may_alias));

/* A coarse node carries the six modes of its aggregate: coarse rows are six numbers wide. */
enum { OST_MODES = 6, OST_PADDING = 8 };

/* Inlined with constant `size` or `height`, so that the loops over it unroll. */
#define OST_UNROLLED static inline __attribute__((always_inline))

/* Load a row as doubles. Intrinsics, as GCC 12 takes five instructions for the general conversion. */
#ifdef __AVX__
#define OST_LOAD_FLOAT4(p) ((OstDouble4)_mm256_cvtps_pd(_mm_loadu_ps(p)))
#else
#define OST_LOAD_FLOAT4(p) __builtin_convertvector(*(const OstFloat4 *)(p), OstDouble4)
#endif
#ifdef __AVX512F__
#define OST_LOAD_FLOAT8(p) ((OstDouble8)_mm512_cvtps_pd(_mm256_loadu_ps(p)))
#else
#define OST_LOAD_FLOAT8(p) __builtin_convertvector(*(const OstFloat8 *)(p), OstDouble8)
#endif
#define OST_LOAD4(p) (*(const OstDouble4 *)(p))
#define OST_LOAD8(p) (*(const OstDouble8 *)(p))

/* *target += v, a row of three or six, and nothing after it: storing a whole register would overlap the next row and
 * stall the load of that row. */
OST_UNROLLED void ost_add_row3(const OstDouble4 *v, double *target)
{
    *(OstDouble2 *)target += __builtin_shufflevector(*v, *v, 0, 1);
    target[2] += (*v)[2];
}

OST_UNROLLED void ost_add_row6(const OstDouble8 *v, double *target)
{
    *(OstDouble4 *)target += __builtin_shufflevector(*v, *v, 0, 1, 2, 3);
    *(OstDouble2 *)(target + 4) += __builtin_shufflevector(*v, *v, 4, 5);
}

OST_UNROLLED double ost_sum_row3(const OstDouble4 *v)
{
    return (*v)[0] + (*v)[1] + (*v)[2];
}

OST_UNROLLED double ost_sum_row6(const OstDouble8 *v)
{
    return (((*v)[0] + (*v)[1]) + ((*v)[2] + (*v)[3])) + ((*v)[4] + (*v)[5]);
}

/* sum[r] += the rows of a b; a is size × size, b is size rows of six. */
OST_UNROLLED void ost_block_multiply(int size, const double *a, const float *b, OstDouble8 *sum)
{
    OstDouble8 row[OST_MODES];
    for (int c = 0; c < size; c++)
        row[c] = OST_LOAD_FLOAT8(b + OST_MODES * c);
    for (int r = 0; r < size; r++) {
        OstDouble8 total = sum[r];
        for (int c = 0; c < size; c++)
            total += a[size * r + c] * row[c];
        sum[r] = total;
    }
}

#endif
