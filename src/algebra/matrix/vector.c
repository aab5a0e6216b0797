/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/vector.h"

#include "core/error.h"
#include "core/kernel.h"
#include "core/parallel/reduce.h"

#include <float.h>
#include <math.h>

OST_KERNEL double ost_dot(size_t n, const double *restrict a, const double *restrict b)
{
    double total = 0.0;
#pragma omp simd reduction(+ : total)
    for (size_t i = 0; i < n; i++)
        total += a[i] * b[i];
    return total;
}

OstStatus ost_vector_dot(OstContext *ctx, size_t n, const double *a, const double *b, double *product)
{
    *product = ost_dot(n, a, b);
    return ost_sum(ctx, 1, product);
}

OST_KERNEL double ost_largest(size_t n, const double *values)
{
    double largest = 0.0;
#pragma omp simd reduction(max : largest)
    for (size_t i = 0; i < n; i++)
        largest = fabs(values[i]) > largest ? fabs(values[i]) : largest;
    return largest;
}

OstStatus ost_vector_size(OstContext *ctx, size_t n, const double *values, double *size)
{
    double largest = ost_largest(n, values);
    OST_TRY(ost_max(ctx, 1, &largest));
    *size = largest >= DBL_MIN && isfinite(largest) ? exp2(floor(log2(largest))) : 1.0;
    return OST_SUCCESS;
}
