/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/small.h"

#include "core/error.h"

#include <string.h>

enum { LARGEST_EIGEN = 12, EIGEN_WORK = 34 * LARGEST_EIGEN };

void dsyev_(const char *job, const char *triangle, const int *n, double *a, const int *leading, double *values,
            double *work, const int *work_size, int *info, size_t job_length, size_t triangle_length);

OstStatus ost_symmetric_eigen(OstContext *ctx, int n, const double *a, double *values, double *vectors)
{
    double copy[LARGEST_EIGEN * LARGEST_EIGEN];
    double work[EIGEN_WORK];
    const int work_size = EIGEN_WORK;
    int info = 0;
    if (n < 1 || n > LARGEST_EIGEN)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "eigenvalues of a matrix of size %d asked for, 1 to %d possible", n,
                         (int)LARGEST_EIGEN);
    memcpy(copy, a, sizeof(double) * (size_t)(n * n));
    dsyev_(vectors ? "V" : "N", "U", &n, copy, &n, values, work, &work_size, &info, 1, 1);
    if (info != 0)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "LAPACK's dsyev returned %d on a %d×%d matrix", info, n, n);
    if (vectors)
        memcpy(vectors, copy, sizeof(double) * (size_t)(n * n));
    return OST_SUCCESS;
}

OstStatus ost_symmetric_positive_part(OstContext *ctx, int n, double *a)
{
    double values[LARGEST_EIGEN], vectors[LARGEST_EIGEN * LARGEST_EIGEN];
    OST_TRY(ost_symmetric_eigen(ctx, n, a, values, vectors));
    memset(a, 0, sizeof(double) * (size_t)(n * n));
    for (int m = 0; m < n; m++)
        for (int k = 0; k < n * n; k++)
            a[k] += fmax(values[m], 0.0) * vectors[n * m + k / n] * vectors[n * m + k % n];
    return OST_SUCCESS;
}

int ost_cholesky(int n, double *a)
{
    for (int j = 0; j < n; j++) {
        double pivot = a[j * n + j];
        for (int k = 0; k < j; k++)
            pivot -= a[j * n + k] * a[j * n + k];
        if (!(pivot > 0.0))
            return j + 1;
        pivot = sqrt(pivot);
        a[j * n + j] = pivot;
        for (int i = j + 1; i < n; i++) {
            double sum = a[i * n + j];
            for (int k = 0; k < j; k++)
                sum -= a[i * n + k] * a[j * n + k];
            a[i * n + j] = sum / pivot;
            a[j * n + i] = 0.0;
        }
    }
    return 0;
}
