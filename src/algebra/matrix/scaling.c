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
    OST_FREE((*scaling)->inverse);
    OST_FREE(*scaling);
}

/* S = L^-1 of a lower triangular L. */
static void invert_lower(const double l[9], double s[9])
{
    s[0] = 1.0 / l[0];
    s[4] = 1.0 / l[4];
    s[8] = 1.0 / l[8];
    s[3] = -l[3] * s[0] * s[4];
    s[7] = -l[7] * s[4] * s[8];
    s[6] = -(l[6] * s[0] + l[7] * s[3]) * s[8];
    s[1] = s[2] = s[5] = 0.0;
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
        const double *block = matrix->value + 9 * (size_t)matrix->diagonal[i];
        double *l = scaling->inverse + 9 * (size_t)i;
        memcpy(l, block, 9 * sizeof *l);
        if (!all_finite(block) || ost_cholesky(3, l) != 0)
            return OST_RAISE(matrix->ctx, OST_INVALID_INPUT,
                             "the diagonal block of row %lld of the stiffness (diagonal %g, %g, %g) is not positive "
                             "definite: a node without stiffness, or an unusable material or tet; check the materials "
                             "and tets there",
                             (long long)(matrix->first_row + i), block[0], block[4], block[8]);
        invert_lower(l, scaling->factor + 9 * (size_t)i);
    }
    return OST_SUCCESS;
}

OstStatus ost_scaling_create(const OstBlockMatrix *matrix, OstScaling **scaling)
{
    OstContext *ctx = matrix->ctx;
    OstScaling *made = NULL;
    *scaling = NULL;
    OstStatus status = OST_NEW(ctx, &made, 1);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &made->factor, 9 * (size_t)matrix->columns);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &made->inverse, 9 * (size_t)matrix->rows);
    if (status == OST_SUCCESS) {
        made->ctx = ctx;
        made->rows = matrix->rows;
        status = factor_rows(matrix, made);
    }
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_agree(ctx, ost_halo_import(matrix->halo, 9 * sizeof(double), made->factor)));
done:
    if (status != OST_SUCCESS)
        ost_scaling_destroy(&made);
    *scaling = made;
    return status;
}

static void apply_rows(OstLocal rows, const double *matrices, const double *x, double *y)
{
    for (OstLocal i = 0; i < rows; i++) {
        double product[3];
        ost_apply3(matrices + 9 * (size_t)i, x + 3 * (size_t)i, product);
        memcpy(y + 3 * (size_t)i, product, sizeof product);
    }
}

static void apply_rows_transposed(OstLocal rows, const double *matrices, const double *x, double *y)
{
    for (OstLocal i = 0; i < rows; i++) {
        double product[3];
        ost_apply3_transposed(matrices + 9 * (size_t)i, x + 3 * (size_t)i, product);
        memcpy(y + 3 * (size_t)i, product, sizeof product);
    }
}

void ost_scaling_to_scaled(const OstScaling *scaling, const double *f, double *scaled_f)
{
    apply_rows(scaling->rows, scaling->factor, f, scaled_f);
}

void ost_scaling_from_scaled(const OstScaling *scaling, const double *scaled_u, double *u)
{
    apply_rows_transposed(scaling->rows, scaling->factor, scaled_u, u);
}

void ost_scaling_unscale_residual(const OstScaling *scaling, const double *scaled_r, double *r)
{
    apply_rows(scaling->rows, scaling->inverse, scaled_r, r);
}

void ost_scaling_to_scaled_mode(const OstScaling *scaling, const double *mode, double *scaled_mode)
{
    apply_rows_transposed(scaling->rows, scaling->inverse, mode, scaled_mode);
}

double ost_scaling_residual_square(const OstScaling *scaling, const double *scaled_r)
{
    double sum = 0.0;
    for (OstLocal i = 0; i < scaling->rows; i++) {
        double r[3];
        ost_apply3(scaling->inverse + 9 * (size_t)i, scaled_r + 3 * (size_t)i, r);
        sum += ost_dot3(r, r);
    }
    return sum;
}
