/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef HARD_GRID_TWOFOLD_H
#define HARD_GRID_TWOFOLD_H

#include <math.h>

/* An unevaluated sum of two doubles, some 32 digits (double-double). */
typedef struct Twofold {
    double high, low;
} Twofold;

/* a + b, and a - b c, to a relative 1e-32 (Dekker, Knuth). */
static inline Twofold hard_plus(Twofold a, double b)
{
    const double sum = a.high + b, part = sum - a.high;
    const double low = (a.high - (sum - part)) + (b - part) + a.low;
    const double high = sum + low;
    return (Twofold){high, low - (high - sum)};
}

static inline Twofold hard_minus_product(Twofold a, double b, Twofold c)
{
    const double product = -b * c.high;
    a = hard_plus(a, product);
    a.low += fma(-b, c.high, -product) - b * c.low;
    return a;
}

#endif
