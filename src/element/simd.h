/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ELEMENT_SIMD_H
#define ORTHOSTAT_ELEMENT_SIMD_H

#include <math.h>
#include <stdint.h>

/* One number of each tet of a batch. A kernel reads as if it were written for one tet, and computes the whole batch at
 * once in SIMD registers, as wide as those of the processor that the program is built for. */
#ifdef __AVX512F__
enum { OST_SIMD_WIDTH = 8 };
#else
enum { OST_SIMD_WIDTH = 4 };
#endif
typedef double OstSimd __attribute__((vector_size(OST_SIMD_WIDTH * sizeof(double))));

/* Four numbers of one tet, at any address of doubles. (With memcpy, GCC may copy them through the stack in two halves,
 * which stalls.) */
enum { OST_SIMD_FOUR = 4 };
typedef double OstSimdFour
    __attribute__((vector_size(OST_SIMD_FOUR * sizeof(double)), aligned(sizeof(double)), may_alias));

/* Two of them. */
typedef double OstSimdTwo __attribute__((vector_size(2 * sizeof(double)), aligned(sizeof(double)), may_alias));

/* What comparisons yield: all bits of a tet's number, or none. */
typedef int64_t OstSimdMask __attribute__((vector_size(OST_SIMD_WIDTH * sizeof(int64_t))));

/* Of each tet one of two numbers. (An if, or fmax of libm, would go through the tets one by one.) */
#define OST_SIMD_SELECT(where, yes, no) ((OstSimd)(((where) & (OstSimdMask)(yes)) | (~(where) & (OstSimdMask)(no))))

/* Is it so of any tet? */
static inline int ost_simd_any(const OstSimdMask *where)
{
    int64_t any = 0;
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        any |= (*where)[slot];
    return any != 0;
}

static inline void ost_simd_square_root(OstSimd *a)
{
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        (*a)[slot] = sqrt((*a)[slot]);
}

/* Transposes 4 × 4 numbers. */
static inline void ost_simd_transpose(const OstSimdFour in[OST_SIMD_FOUR], OstSimdFour out[OST_SIMD_FOUR])
{
    const OstSimdFour low01 = __builtin_shufflevector(in[0], in[1], 0, 4, 2, 6);
    const OstSimdFour high01 = __builtin_shufflevector(in[0], in[1], 1, 5, 3, 7);
    const OstSimdFour low23 = __builtin_shufflevector(in[2], in[3], 0, 4, 2, 6);
    const OstSimdFour high23 = __builtin_shufflevector(in[2], in[3], 1, 5, 3, 7);
    out[0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
    out[1] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
    out[2] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
    out[3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
}

/* Three numbers of each tet, each from its own place. (Number by number the registers would be put together in memory,
 * and wait for it.) */
static inline void ost_simd_gather3(const double *const from[OST_SIMD_WIDTH], OstSimd gathered[3])
{
    OstSimdFour row[OST_SIMD_WIDTH], number[OST_SIMD_WIDTH];
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++)
        row[slot] = (OstSimdFour){from[slot][0], from[slot][1], from[slot][2]};
    for (int first = 0; first < OST_SIMD_WIDTH; first += OST_SIMD_FOUR)
        ost_simd_transpose(row + first, number + first);
    for (int i = 0; i < 3; i++)
#ifdef __AVX512F__
        gathered[i] = __builtin_shufflevector(number[i], number[OST_SIMD_FOUR + i], 0, 1, 2, 3, 4, 5, 6, 7);
#else
        gathered[i] = number[i];
#endif
}

/* Up to four numbers, tet by tet. */
static inline void ost_simd_rows(int count, const OstSimd *numbers, OstSimdFour row[OST_SIMD_WIDTH])
{
    OstSimdFour number[OST_SIMD_WIDTH] = {{0}};
    for (int i = 0; i < count; i++) {
#ifdef __AVX512F__
        number[i] = __builtin_shufflevector(numbers[i], numbers[i], 0, 1, 2, 3);
        number[OST_SIMD_FOUR + i] = __builtin_shufflevector(numbers[i], numbers[i], 4, 5, 6, 7);
#else
        number[i] = numbers[i];
#endif
    }
    for (int first = 0; first < OST_SIMD_WIDTH; first += OST_SIMD_FOUR)
        ost_simd_transpose(number + first, row + first);
}

/* Adds three numbers of each tet, each in its own place. */
static inline void ost_simd_scatter3(const OstSimd added[3], double *const to[OST_SIMD_WIDTH])
{
    OstSimdFour row[OST_SIMD_WIDTH];
    ost_simd_rows(3, added, row);
    for (int slot = 0; slot < OST_SIMD_WIDTH; slot++) {
        *(OstSimdTwo *)to[slot] += __builtin_shufflevector(row[slot], row[slot], 0, 1);
        to[slot][2] += row[slot][2];
    }
}

#endif
