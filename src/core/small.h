/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_SMALL_H
#define ORTHOSTAT_CORE_SMALL_H

#include "orthostat/context.h"

#include <math.h>

/* Vectors of 3, row-major 3×3 matrices, and small symmetric matrices. Symmetric 3×3 matrices in six numbers have the
 * order of strains, 11 22 33 12 23 31. */

static inline double ost_dot3(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline double ost_norm3(const double a[3])
{
    return sqrt(ost_dot3(a, a));
}

static inline void ost_cross3(const double a[3], const double b[3], double c[3])
{
    c[0] = a[1] * b[2] - a[2] * b[1];
    c[1] = a[2] * b[0] - a[0] * b[2];
    c[2] = a[0] * b[1] - a[1] * b[0];
}

static inline double ost_dot6(const double a[6], const double b[6])
{
    double sum = 0.0;
    for (int i = 0; i < 6; i++)
        sum += a[i] * b[i];
    return sum;
}

/* y = C x for a 6×6 matrix: a stress from a strain. */
static inline void ost_apply6(const double c[36], const double x[6], double y[6])
{
    for (int i = 0; i < 6; i++)
        y[i] = ost_dot6(c + 6 * i, x);
}

/* gathered[3 a + i] = component i of vectors' entry nodes[a]. */
static inline void ost_gather3(int count, const OstLocal *nodes, const double *vectors, double *gathered)
{
    for (int a = 0; a < count; a++)
        for (int i = 0; i < 3; i++)
            gathered[3 * a + i] = vectors[3 * (size_t)nodes[a] + (size_t)i];
}

/* y = A x and y = Aᵀ x */
static inline void ost_apply3(const double a[9], const double x[3], double y[3])
{
    for (int i = 0; i < 3; i++)
        y[i] = a[3 * i] * x[0] + a[3 * i + 1] * x[1] + a[3 * i + 2] * x[2];
}

static inline void ost_apply3_transposed(const double a[9], const double x[3], double y[3])
{
    for (int i = 0; i < 3; i++)
        y[i] = a[i] * x[0] + a[3 + i] * x[1] + a[6 + i] * x[2];
}

/* c = A B and c = Aᵀ B; c may not be a or b. */
static inline void ost_multiply3(const double a[9], const double b[9], double c[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
}

static inline void ost_multiply3_transposed_left(const double a[9], const double b[9], double c[9])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            c[3 * i + j] = a[i] * b[j] + a[3 + i] * b[3 + j] + a[6 + i] * b[6 + j];
}

static inline double ost_determinant3(const double a[9])
{
    return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) + a[2] * (a[3] * a[7] - a[4] * a[6]);
}

/* b = A⁻¹ by cofactors; returns det A. If that is 0, b is unchanged. */
static inline double ost_invert3(const double a[9], double b[9])
{
    const double determinant = ost_determinant3(a);
    if (determinant == 0.0)
        return 0.0;
    const double inverse = 1.0 / determinant;
    b[0] = (a[4] * a[8] - a[5] * a[7]) * inverse;
    b[1] = (a[2] * a[7] - a[1] * a[8]) * inverse;
    b[2] = (a[1] * a[5] - a[2] * a[4]) * inverse;
    b[3] = (a[5] * a[6] - a[3] * a[8]) * inverse;
    b[4] = (a[0] * a[8] - a[2] * a[6]) * inverse;
    b[5] = (a[2] * a[3] - a[0] * a[5]) * inverse;
    b[6] = (a[3] * a[7] - a[4] * a[6]) * inverse;
    b[7] = (a[1] * a[6] - a[0] * a[7]) * inverse;
    b[8] = (a[0] * a[4] - a[1] * a[3]) * inverse;
    return determinant;
}

/* Local. Eigenvalues (ascending) of the symmetric n×n matrix a (n <= 12), and its orthonormal eigenvectors as the rows
 * of `vectors` unless that is NULL. LAPACK's dsyev. */
OstStatus ost_symmetric_eigen(OstContext *ctx, int n, const double *a, double *values, double *vectors);

/* Local. Such a matrix without its negative eigenvalues. */
OstStatus ost_symmetric_positive_part(OstContext *ctx, int n, double *a);

/* Local. Lower Cholesky factor of a symmetric n×n matrix in place (upper part set to 0); returns 0, or the 1-based
 * index of the first pivot that is not positive. */
int ost_cholesky(int n, double *a);

#endif
