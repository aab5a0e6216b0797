/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/vector.h"

#include "core/error.h"

#include <float.h>
#include <math.h>

OstStatus ost_vector_dot(OstContext *ctx, size_t n, const double *a, const double *b, double *product)
{
    *product = 0.0;
    for (size_t i = 0; i < n; i++)
        *product += a[i] * b[i];
    return OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, product, 1, MPI_DOUBLE, MPI_SUM, ost_comm(ctx)));
}

OstStatus ost_vector_size(OstContext *ctx, size_t n, const double *values, double *size)
{
    double largest = 0.0;
    for (size_t i = 0; i < n; i++)
        largest = fabs(values[i]) <= largest ? largest : fabs(values[i]);
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, ost_comm(ctx))));
    *size = largest >= DBL_MIN && isfinite(largest) ? exp2(floor(log2(largest))) : 1.0;
    return OST_SUCCESS;
}
