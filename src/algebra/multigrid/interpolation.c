/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/multigrid/interpolation.h"

#include "core/error.h"
#include "core/memory.h"

#include <string.h>

enum { PARENTS = 4 };

OstStatus ost_interpolation_create(const OstCoarseSpace *space, const OstScaling *quadratic, const OstScaling *linear,
                                   OstInterpolation **interpolation)
{
    OstContext *ctx = quadratic->ctx;
    OstInterpolation *made = NULL;
    *interpolation = NULL;
    OST_TRY(OST_NEW(ctx, &made, 1));
    made->ctx = ctx;
    made->quadratic = quadratic;
    made->linear = linear;
    made->parents = space->parents;
    made->weights = space->weights;
    made->halo = space->matrix->halo;
    OstStatus status = OST_NEW(ctx, &made->fine, 3 * (size_t)quadratic->rows);
    if (status == OST_SUCCESS)
        status = OST_NEW(ctx, &made->coarse, 3 * (size_t)space->matrix->columns);
    if (status != OST_SUCCESS)
        ost_interpolation_destroy(&made);
    *interpolation = made;
    return status;
}

void ost_interpolation_destroy(OstInterpolation **interpolation)
{
    if (!*interpolation)
        return;
    OST_FREE((*interpolation)->fine);
    OST_FREE((*interpolation)->coarse);
    OST_FREE(*interpolation);
}

OstStatus ost_interpolation_add(const OstInterpolation *interpolation, const double *c, double *x)
{
    const OstLocal rows = interpolation->quadratic->rows;
    double *fine = interpolation->fine, *coarse = interpolation->coarse;
    ost_scaling_from_scaled(interpolation->linear, c, coarse);
    OST_TRY(ost_halo_import(interpolation->halo, 3 * sizeof *coarse, coarse));
    memset(fine, 0, 3 * (size_t)rows * sizeof *fine);
    for (OstLocal row = 0; row < rows; row++)
        for (size_t k = PARENTS * (size_t)row; k < PARENTS * ((size_t)row + 1); k++) {
            const OstLocal parent = interpolation->parents[k];
            for (size_t i = 0; i < 3 && parent >= 0; i++)
                fine[3 * (size_t)row + i] += interpolation->weights[k] * coarse[3 * (size_t)parent + i];
        }
    ost_scaling_to_scaled_mode(interpolation->quadratic, fine, fine);
    for (size_t i = 0; i < 3 * (size_t)rows; i++)
        x[i] += fine[i];
    return OST_SUCCESS;
}

OstStatus ost_interpolation_restrict(const OstInterpolation *interpolation, const double *x, double *c)
{
    const OstLocal rows = interpolation->quadratic->rows;
    const OstHalo *halo = interpolation->halo;
    double *fine = interpolation->fine, *coarse = interpolation->coarse;
    ost_scaling_unscale_residual(interpolation->quadratic, x, fine);
    memset(coarse, 0, 3 * ((size_t)halo->owned + (size_t)halo->ghosts) * sizeof *coarse);
    for (OstLocal row = 0; row < rows; row++)
        for (size_t k = PARENTS * (size_t)row; k < PARENTS * ((size_t)row + 1); k++) {
            const OstLocal parent = interpolation->parents[k];
            for (size_t i = 0; i < 3 && parent >= 0; i++)
                coarse[3 * (size_t)parent + i] += interpolation->weights[k] * fine[3 * (size_t)row + i];
        }
    OST_TRY(ost_halo_add_to_owners(interpolation->halo, 3, coarse));
    ost_scaling_to_scaled(interpolation->linear, coarse, c);
    return OST_SUCCESS;
}
