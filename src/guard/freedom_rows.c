/* SPDX-License-Identifier: BSD-3-Clause */
#include "guard/freedom_rows.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"

#include <string.h>

void dgesvd_(const char *job_u, const char *job_v, const int *rows, const int *columns, double *a, const int *leading,
             double *values, double *u, const int *leading_u, double *v, const int *leading_v, double *work,
             const int *work_size, int *info, size_t job_u_length, size_t job_v_length);

void ost_rows_of_point(const OstRigidFrame *frame, const double point[3], const double direction[3], double row[6])
{
    double arm[3];
    for (int i = 0; i < 3; i++) {
        arm[i] = (point[i] - frame->centre[i]) / frame->radius;
        row[i] = direction[i];
    }
    ost_cross3(arm, direction, row + 3); /* n · (w × a) = w · (a × n) */
}

void ost_rows_add(double triangle[OST_ROWS], const double row[6])
{
    double rest[6];
    memcpy(rest, row, sizeof rest);
    for (int j = 0; j < 6; j++) {
        if (rest[j] == 0.0)
            continue;
        double *kept = triangle + 6 * j;
        const double length = hypot(kept[j], rest[j]);
        const double c = kept[j] / length;
        const double s = rest[j] / length;
        for (int k = j; k < 6; k++) {
            const double above = kept[k];
            kept[k] = c * above + s * rest[k];
            rest[k] = c * rest[k] - s * above;
        }
    }
}

void ost_rows_change_frame(const OstRigidFrame *from, const OstRigidFrame *to, double change[OST_ROWS])
{
    double d[3];
    memset(change, 0, OST_ROWS * sizeof *change);
    for (int i = 0; i < 3; i++) {
        d[i] = (to->centre[i] - from->centre[i]) / from->radius;
        change[7 * i] = 1.0;
        change[21 + 7 * i] = to->radius / from->radius;
    }
    for (int i = 0; i < 3; i++) { /* (w × d)_i = w_j d_k - w_k d_j */
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        change[6 * i + 3 + j] = d[k];
        change[6 * i + 3 + k] = -d[j];
    }
}

void ost_rows_multiply(const double *a, const double *b, double *c)
{
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            double sum = 0.0;
            for (int k = 0; k < 6; k++)
                sum += a[6 * i + k] * b[6 * k + j];
            c[6 * i + j] = sum;
        }
}

/* LAPACK takes rows for columns: null vectors are then left singular vectors, each contiguous. */
static OstStatus decompose(OstContext *ctx, int rows, int columns, double *matrix, double *values, double *basis)
{
    int info = 0;
    int work_size = -1;
    const int one = 1;
    double wanted = 0.0;
    double *work = NULL;
    dgesvd_("A", "N", &columns, &rows, matrix, &columns, values, basis, &columns, NULL, &one, &wanted, &work_size,
            &info, 1, 1);
    work_size = (int)wanted;
    OST_TRY(OST_NEW(ctx, &work, work_size));
    dgesvd_("A", "N", &columns, &rows, matrix, &columns, values, basis, &columns, NULL, &one, work, &work_size, &info,
            1, 1);
    OST_FREE(work);
    if (info != 0)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "LAPACK's dgesvd returned %d on a %d×%d matrix", info, rows, columns);
    return OST_SUCCESS;
}

OstStatus ost_null_space(OstContext *ctx, int rows, int columns, double *matrix, double tolerance, int *count,
                         double *basis)
{
    const int values_count = rows < columns ? rows : columns;
    double *values = NULL;
    *count = 0;
    if (columns == 0)
        return OST_SUCCESS;
    if (rows == 0) {
        memset(basis, 0, (size_t)columns * (size_t)columns * sizeof *basis);
        for (int i = 0; i < columns; i++)
            basis[(size_t)i * (size_t)columns + (size_t)i] = 1.0;
        *count = columns;
        return OST_SUCCESS;
    }
    OST_TRY(OST_NEW(ctx, &values, values_count));
    const OstStatus status = decompose(ctx, rows, columns, matrix, values, basis);
    if (status == OST_SUCCESS) {
        int rank = 0;
        while (rank < values_count && values[rank] > tolerance)
            rank++;
        *count = columns - rank;
        memmove(basis, basis + (size_t)rank * (size_t)columns, (size_t)*count * (size_t)columns * sizeof *basis);
    }
    OST_FREE(values);
    return status;
}
