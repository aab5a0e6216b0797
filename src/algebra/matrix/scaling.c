/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/matrix/scaling.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"

#include <string.h>

void ost_scaling_destroy(OstScaling **scaling)
{
    if (!*scaling)
        return;
    OST_FREE((*scaling)->factor);
    OST_FREE(*scaling);
}

/* S = L^-1 of a lower triangular L (row-major). */
static void invert_lower(const double l[9], double s[6])
{
    s[0] = 1.0 / l[0];
    s[2] = 1.0 / l[4];
    s[5] = 1.0 / l[8];
    s[1] = -l[3] * s[0] * s[2];
    s[4] = -l[7] * s[2] * s[5];
    s[3] = -(l[6] * s[0] + l[7] * s[1]) * s[5];
}

static int all_finite(const double a[9])
{
    for (int k = 0; k < 9; k++)
        if (!isfinite(a[k]))
            return 0;
    return 1;
}

static OstStatus factor_rows(const OstBlockMatrix *matrix, OstScaling *scaling)
{
    for (OstLocal i = 0; i < matrix->rows; i++) {
        const double *block = ost_block_matrix_diagonal(matrix, i);
        double l[9];
        memcpy(l, block, sizeof l);
        if (!all_finite(block) || ost_cholesky(3, l) != 0)
            return OST_RAISE(matrix->ctx, OST_INVALID_INPUT,
                             "the diagonal block of row %lld of the stiffness (diagonal %g, %g, %g) is not positive "
                             "definite: a node without stiffness, or an unusable material or tet; check the materials "
                             "and tets there",
                             (long long)(matrix->first_row + i), block[0], block[4], block[8]);
        invert_lower(l, scaling->factor + 6 * (size_t)i);
    }
    return OST_SUCCESS;
}

OstStatus ost_scaling_create(const OstBlockMatrix *matrix, OstScaling **scaling)
{
    OstContext *ctx = matrix->ctx;
    OstScaling *made = NULL;
    *scaling = NULL;
    OstStatus status = OST_NEW(ctx, &made, 1);
    OST_THEN(OST_NEW(ctx, &made->factor, 6 * (size_t)matrix->columns));
    if (status == OST_SUCCESS) {
        made->ctx = ctx;
        made->rows = matrix->rows;
        status = factor_rows(matrix, made);
    }
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_agree(ctx, ost_halo_import(matrix->halo, 6 * sizeof(double), made->factor)));
done:
    if (status != OST_SUCCESS)
        ost_scaling_destroy(&made);
    *scaling = made;
    return status;
}

/* b = S^-1 a */
static inline void solve(const double s[6], const double a[3], double b[3])
{
    const double b0 = a[0] / s[0], b1 = (a[1] - s[1] * b0) / s[2];
    b[2] = (a[2] - s[3] * b0 - s[4] * b1) / s[5];
    b[1] = b1;
    b[0] = b0;
}

void ost_scaling_to_scaled(const OstScaling *scaling, const double *f, double *scaled_f)
{
    for (OstLocal i = 0; i < scaling->rows; i++) {
        const double *s = scaling->factor + 6 * (size_t)i, *a = f + 3 * (size_t)i;
        double *b = scaled_f + 3 * (size_t)i;
        const double b1 = s[1] * a[0] + s[2] * a[1], b0 = s[0] * a[0];
        b[2] = s[3] * a[0] + s[4] * a[1] + s[5] * a[2];
        b[1] = b1;
        b[0] = b0;
    }
}

void ost_scaling_from_scaled(const OstScaling *scaling, const double *scaled_u, double *u)
{
    for (OstLocal i = 0; i < scaling->rows; i++) {
        const double *s = scaling->factor + 6 * (size_t)i, *a = scaled_u + 3 * (size_t)i;
        double *b = u + 3 * (size_t)i;
        b[0] = s[0] * a[0] + s[1] * a[1] + s[3] * a[2];
        b[1] = s[2] * a[1] + s[4] * a[2];
        b[2] = s[5] * a[2];
    }
}

void ost_scaling_unscale_residual(const OstScaling *scaling, const double *scaled_r, double *r)
{
    for (OstLocal i = 0; i < scaling->rows; i++)
        solve(scaling->factor + 6 * (size_t)i, scaled_r + 3 * (size_t)i, r + 3 * (size_t)i);
}

void ost_scaling_to_scaled_mode(const OstScaling *scaling, const double *mode, double *scaled_mode)
{
    for (OstLocal i = 0; i < scaling->rows; i++) {
        const double *s = scaling->factor + 6 * (size_t)i, *a = mode + 3 * (size_t)i;
        double *b = scaled_mode + 3 * (size_t)i;
        const double b2 = a[2] / s[5], b1 = (a[1] - s[4] * b2) / s[2];
        b[0] = (a[0] - s[1] * b1 - s[3] * b2) / s[0];
        b[1] = b1;
        b[2] = b2;
    }
}

double ost_scaling_residual_square(const OstScaling *scaling, const double *scaled_r)
{
    double sum = 0.0;
    for (OstLocal i = 0; i < scaling->rows; i++) {
        double r[3];
        solve(scaling->factor + 6 * (size_t)i, scaled_r + 3 * (size_t)i, r);
        sum += ost_dot3(r, r);
    }
    return sum;
}
