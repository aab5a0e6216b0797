/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_VECTOR_H
#define ORTHOSTAT_ALGEBRA_MATRIX_VECTOR_H

#include "orthostat/context.h"

/* Vectors distributed over the ranks; n numbers on this one. */

/* Local. The largest absolute value. */
double ost_largest(size_t n, const double *values);

/* a·b: local, of this rank's numbers; collective, over all ranks. */
double ost_dot(size_t n, const double *a, const double *b);
OstStatus ost_vector_dot(OstContext *ctx, size_t n, const double *a, const double *b, double *product);

/* Collective. The largest power of two not above the largest absolute value, 1 if that is 0 or not finite. Dividing by
 * it makes no rounding error. */
OstStatus ost_vector_size(OstContext *ctx, size_t n, const double *values, double *size);

#endif
