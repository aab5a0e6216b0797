/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ALGEBRA_MATRIX_VECTOR_H
#define ORTHOSTAT_ALGEBRA_MATRIX_VECTOR_H

#include "orthostat/context.h"

/* Vectors shared out over the ranks, n numbers on this one. Collective. */

/* a·b of this rank, and over all ranks. */
double ost_dot(size_t n, const double *a, const double *b);
OstStatus ost_vector_dot(OstContext *ctx, size_t n, const double *a, const double *b, double *product);

/* The power of two next below the largest number of all ranks, 1 if that is 0 or not finite: dividing by it is exact.
 */
OstStatus ost_vector_size(OstContext *ctx, size_t n, const double *values, double *size);

#endif
