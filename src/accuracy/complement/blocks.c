/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/complement/blocks.h"

#include "core/kernel.h"

#include <math.h>
#include <string.h>

typedef float Four __attribute__((vector_size(4 * sizeof(float)), may_alias));

/* Sums run in single precision over so many functions, then in double precision. */
enum { RUN = 64, WIDTH = 8 };

/* What single precision leaves of a pivot may be as small as this beside the diagonal. */
static const float least_pivot = 3e-7F;

int ost_block_factor(const double symmetric[6], double least, float factor[OST_PER_BLOCK])
{
    const double *a = symmetric;
    const double pivot0 = a[0];
    const double l0 = sqrt(pivot0), l10 = a[3] / l0, l20 = a[5] / l0;
    const double pivot1 = fmax(a[1] - l10 * l10, least * a[1]);
    const double l1 = sqrt(pivot1), l21 = (a[4] - l20 * l10) / l1;
    const double pivot2 = fmax(a[2] - l20 * l20 - l21 * l21, least * a[2]);
    const double l2 = sqrt(pivot2);
    const double n[6] = {1.0 / l0,         1.0 / l1,         1.0 / l2,
                         -l10 / (l0 * l1), -l21 / (l1 * l2), (l10 * l21 - l20 * l1) / (l0 * l1 * l2)};
    for (int p = 0; p < 6; p++)
        factor[p < 3 ? p : p + 1] = (float)n[p];
    factor[3] = factor[7] = 0.0F;
    return pivot0 > 0.0 && pivot1 > 0.0 && pivot2 > 0.0 && isfinite(n[5]);
}

/* --- eight blocks at once --- */

typedef float Eight __attribute__((vector_size(WIDTH * sizeof(float))));

/* 1 / root of the pivot, or of the least that it may be */
static inline void invert_root(const Eight *pivot, const Eight *least, Eight *inverse)
{
    for (int slot = 0; slot < WIDTH; slot++)
        (*inverse)[slot] = 1.0F / sqrtf((*pivot)[slot] > (*least)[slot] ? (*pivot)[slot] : (*least)[slot]);
}

static inline void factor_eight(Eight a[6])
{
    Eight n[3], pivot = a[0], least = least_pivot * a[0];
    invert_root(&pivot, &least, &n[0]);
    const Eight l10 = a[3] * n[0], l20 = a[5] * n[0];
    pivot = a[1] - l10 * l10;
    least = least_pivot * a[1];
    invert_root(&pivot, &least, &n[1]);
    const Eight l21 = (a[4] - l20 * l10) * n[1];
    pivot = a[2] - l20 * l20 - l21 * l21;
    least = least_pivot * a[2];
    invert_root(&pivot, &least, &n[2]);
    memcpy(a, n, sizeof n);
    a[3] = -l10 * n[0] * n[1];
    a[4] = -l21 * n[1] * n[2];
    a[5] = (l10 * l21 * n[1] - l20) * n[0] * n[2];
}

/* Are `WIDTH` functions from `first` on all there, free, and this rank's? */
static int are_free(const OstComplement *complement, OstLocal first)
{
    int all = first + WIDTH <= complement->count && !complement->bed;
    for (OstLocal k = first; all && k < first + WIDTH; k++)
        all = complement->support[k] < 0 && ost_complement_owns(complement, k);
    return all;
}

static void factor_one(const OstComplement *complement, OstLocal function, float *block)
{
    double symmetric[6];
    for (int p = 0; p < 6; p++)
        symmetric[p] = (double)block[p < 3 ? p : p + 1];
    ost_complement_constrain_block(complement, function, symmetric);
    for (int p = 0; p < OST_PER_BLOCK && !ost_complement_owns(complement, function); p++)
        block[p] = 0.0F;
    if (ost_complement_owns(complement, function))
        (void)ost_block_factor(symmetric, (double)least_pivot, block);
}

OST_KERNEL void ost_blocks_factor(const OstComplement *complement, float *block)
{
    for (OstLocal first = 0; first < complement->count; first += WIDTH) {
        float *of_first = block + OST_PER_BLOCK * (size_t)first;
        if (!are_free(complement, first)) {
            for (OstLocal k = first; k < first + WIDTH && k < complement->count; k++)
                factor_one(complement, k, block + OST_PER_BLOCK * (size_t)k);
            continue;
        }
        float number[6][WIDTH];
        Eight a[6];
        for (int p = 0; p < 6; p++)
            for (int slot = 0; slot < WIDTH; slot++)
                number[p][slot] = of_first[OST_PER_BLOCK * slot + (p < 3 ? p : p + 1)];
        memcpy(a, number, sizeof a);
        factor_eight(a);
        memcpy(number, a, sizeof a);
        for (int p = 0; p < 6; p++)
            for (int slot = 0; slot < WIDTH; slot++)
                of_first[OST_PER_BLOCK * slot + (p < 3 ? p : p + 1)] = number[p][slot];
    }
}

/* --- vectors --- */

/* Two functions at a time; behind the last of an odd number there is nothing to read. */
typedef float Two __attribute__((vector_size(WIDTH * sizeof(float)), aligned(16), may_alias));

static inline void read_two(size_t left, const float *from, Eight *two)
{
    if (left > 1)
        *two = *(const Two *)from;
    else
        *two = __builtin_shufflevector(*(const Four *)from, (Four){0.0F}, 0, 1, 2, 3, 4, 5, 6, 7);
}

static inline void write_two(size_t left, const Eight *two, float *to)
{
    if (left > 1)
        *(Two *)to = *two;
    else
        *(Four *)to = __builtin_shufflevector(*two, *two, 0, 1, 2, 3);
}

/* Of two blocks N their diagonals and what is below. */
typedef struct Factors {
    Eight diagonal, others;
} Factors;

static inline void read_factors(size_t left, const float *factor, Factors *n)
{
    Eight first = *(const Two *)factor, second = {0.0F};
    if (left > 1)
        second = *(const Two *)(factor + OST_PER_BLOCK);
    n->diagonal = __builtin_shufflevector(first, second, 0, 1, 2, 3, 8, 9, 10, 11);
    n->others = __builtin_shufflevector(first, second, 4, 5, 6, 7, 12, 13, 14, 15);
}

#define OST_WITHIN(of, i, j, k, l) __builtin_shufflevector(of, of, i, j, k, l, 4 + i, 4 + j, 4 + k, 4 + l)

/* y = N r, and z = N'y. The fourth numbers are zeros, which shuffles put where a matrix has none. */
static inline void multiply(const Factors *n, const Eight *r, Eight *y)
{
    *y = n->diagonal * *r + OST_WITHIN(n->others, 3, 0, 1, 3) * OST_WITHIN(*r, 3, 0, 1, 3) +
         OST_WITHIN(n->others, 3, 3, 2, 3) * OST_WITHIN(*r, 3, 3, 0, 3);
}

static inline void multiply_transposed(const Factors *n, const Eight *y, Eight *z)
{
    *z = n->diagonal * *y + OST_WITHIN(n->others, 0, 1, 3, 3) * OST_WITHIN(*y, 1, 2, 3, 3) +
         OST_WITHIN(n->others, 2, 3, 3, 3) * OST_WITHIN(*y, 2, 3, 3, 3);
}

/* One function after the other, as rounding depends on it. */
static inline void add_product(const Eight *a, const Eight *b, Four *sum)
{
    *sum += __builtin_shufflevector(*a, *a, 0, 1, 2, 3) * __builtin_shufflevector(*b, *b, 0, 1, 2, 3);
    *sum += __builtin_shufflevector(*a, *a, 4, 5, 6, 7) * __builtin_shufflevector(*b, *b, 4, 5, 6, 7);
}

static inline double total(const Four *sum)
{
    return (double)(*sum)[0] + (double)(*sum)[1] + (double)(*sum)[2];
}

OST_KERNEL void ost_blocks_step(size_t count, const float *factor, double length, const float *p, const float *q,
                                float *e, float *r, double sums[2])
{
    const Eight by = (Eight){0.0F} + (float)length;
    sums[0] = sums[1] = 0.0;
    for (size_t first = 0; first < count; first += RUN) {
        const size_t end = first + RUN < count ? first + RUN : count;
        Four rz = {0.0F}, qz = {0.0F};
        for (size_t k = first; k < end; k += 2) {
            const size_t at = OST_PER_FUNCTION * k;
            Eight of_p, of_q, of_e, left, y, z;
            Factors n;
            read_factors(end - k, factor + OST_PER_BLOCK * k, &n);
            read_two(end - k, p + at, &of_p);
            read_two(end - k, q + at, &of_q);
            read_two(end - k, e + at, &of_e);
            read_two(end - k, r + at, &left);
            left -= by * of_q;
            of_e += by * of_p;
            write_two(end - k, &of_e, e + at);
            write_two(end - k, &left, r + at);
            multiply(&n, &left, &y);
            multiply_transposed(&n, &y, &z);
            add_product(&y, &y, &rz);
            add_product(&of_q, &z, &qz);
        }
        sums[0] += total(&rz);
        sums[1] += total(&qz);
    }
}

OST_KERNEL double ost_blocks_square(size_t count, const float *factor, const float *r)
{
    double square = 0.0;
    for (size_t first = 0; first < count; first += RUN) {
        const size_t end = first + RUN < count ? first + RUN : count;
        Four sum = {0.0F};
        for (size_t k = first; k < end; k += 2) {
            Eight left, y;
            Factors n;
            read_factors(end - k, factor + OST_PER_BLOCK * k, &n);
            read_two(end - k, r + OST_PER_FUNCTION * k, &left);
            multiply(&n, &left, &y);
            add_product(&y, &y, &sum);
        }
        square += total(&sum);
    }
    return square;
}

OST_KERNEL void ost_blocks_turn(size_t count, const float *factor, const float *r, double share, float *p)
{
    const Eight by = (Eight){0.0F} + (float)share;
    for (size_t k = 0; k < count; k += 2) {
        const size_t at = OST_PER_FUNCTION * k;
        Eight left, y, z, before;
        Factors n;
        read_factors(count - k, factor + OST_PER_BLOCK * k, &n);
        read_two(count - k, r + at, &left);
        multiply(&n, &left, &y);
        multiply_transposed(&n, &y, &z);
        if (share != 0.0) {
            read_two(count - k, p + at, &before);
            z += by * before;
        }
        write_two(count - k, &z, p + at);
    }
}

void ost_functions_add(size_t count, double share, const float *a, float *b)
{
    for (size_t i = 0; i < OST_PER_FUNCTION * count; i++)
        b[i] += (float)share * a[i];
}

void ost_functions_turn(size_t count, const float *z, double share, float *p)
{
    for (size_t i = 0; i < OST_PER_FUNCTION * count; i++)
        p[i] = share != 0.0 ? z[i] + (float)share * p[i] : z[i];
}

OST_KERNEL double ost_functions_dot(size_t count, const float *a, const float *b)
{
    double product = 0.0;
    for (size_t first = 0; first < count; first += RUN) {
        const size_t end = first + RUN < count ? first + RUN : count;
        Four sum = {0.0F};
        for (size_t k = first; k < end; k++)
            sum += *(const Four *)(a + OST_PER_FUNCTION * k) * *(const Four *)(b + OST_PER_FUNCTION * k);
        product += total(&sum);
    }
    return product;
}
