/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_LEVEL_SIMD_H
#define ORTHOSTAT_ALGEBRA_LEVEL_SIMD_H

#ifdef __AVX__
#include <immintrin.h>
#endif

/* Products of small blocks by the compiler's vector types (GCC and Clang; the processor need not have registers that
 * wide). Rows of three numbers are read as vectors of four; the number after the row is not used. So all arrays that
 * are read this way are padded at their end. */
typedef double OstDouble2 __attribute__((vector_size(16), aligned(8), may_alias));
typedef double OstDouble4 __attribute__((vector_size(32), aligned(8), may_alias));
typedef float OstFloat2 __attribute__((vector_size(8), aligned(4), may_alias));
typedef float OstFloat4 __attribute__((vector_size(16), aligned(4), may_alias));
typedef float OstFloat8 __attribute__((vector_size(32), aligned(4), may_alias));

/* A row of six. Not one vector of eight: without registers of 512 bits GCC 12 keeps that in memory, and moves it there
 * number by number, which takes four times as long. */
typedef struct OstRow6 {
    OstDouble4 low;
    OstDouble2 high;
} OstRow6;

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
#define OST_LOAD4(p) (*(const OstDouble4 *)(p))
#define OST_LOAD2(p) (*(const OstDouble2 *)(p))

OST_UNROLLED void ost_load_row6(const double *p, OstRow6 *row)
{
    row->low = OST_LOAD4(p);
    row->high = OST_LOAD2(p + 4);
}

OST_UNROLLED void ost_load_float_row6(const float *p, OstRow6 *row)
{
    row->low = OST_LOAD_FLOAT4(p);
    row->high = __builtin_convertvector(*(const OstFloat2 *)(p + 4), OstDouble2);
}

/* sum += factor × row */
OST_UNROLLED void ost_add_scaled_row6(double factor, const OstRow6 *row, OstRow6 *sum)
{
    sum->low += factor * row->low;
    sum->high += factor * row->high;
}

/* sum += a × b, number by number */
OST_UNROLLED void ost_add_product_row6(const OstRow6 *a, const OstRow6 *b, OstRow6 *sum)
{
    sum->low += a->low * b->low;
    sum->high += a->high * b->high;
}

/* *target += v, a row of three or six, and nothing after it: storing a whole register would overlap the next row and
 * stall the load of that row. */
OST_UNROLLED void ost_add_row3(const OstDouble4 *v, double *target)
{
    *(OstDouble2 *)target += __builtin_shufflevector(*v, *v, 0, 1);
    target[2] += (*v)[2];
}

OST_UNROLLED void ost_add_row6(const OstRow6 *row, double *target)
{
    *(OstDouble4 *)target += row->low;
    *(OstDouble2 *)(target + 4) += row->high;
}

OST_UNROLLED double ost_sum_row3(const OstDouble4 *v)
{
    return (*v)[0] + (*v)[1] + (*v)[2];
}

OST_UNROLLED double ost_sum_row6(const OstRow6 *row)
{
    return ((row->low[0] + row->low[1]) + (row->low[2] + row->low[3])) + (row->high[0] + row->high[1]);
}

/* sum[r] += the rows of a b; a is size × size, b is size rows of six. */
OST_UNROLLED void ost_block_multiply(int size, const double *a, const float *b, OstRow6 *sum)
{
    OstRow6 row[OST_MODES];
    for (int c = 0; c < size; c++)
        ost_load_float_row6(b + OST_MODES * c, &row[c]);
    for (int r = 0; r < size; r++) {
        OstRow6 total = sum[r];
        for (int c = 0; c < size; c++)
            ost_add_scaled_row6(a[size * r + c], &row[c], &total);
        sum[r] = total;
    }
}

#endif
