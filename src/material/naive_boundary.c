/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "orthostat/material.h"

#include <math.h>

static OstStatus is_stable(OstContext *ctx, double nu, const double direction[2], double radius, int *stable)
{
    const OstOrthotropic constants = {
        .youngs_modulus = {exp(radius * direction[0]), 1.0, exp(radius * direction[1])},
        .poissons_ratio = {nu, nu, nu},
        .shear_modulus = {1.0, 1.0, 1.0},
    };
    double eigenvalues[3];
    OST_TRY(ost_orthotropic_eigenvalues(ctx, &constants, eigenvalues));
    *stable = eigenvalues[0] > 0.0;
    return OST_SUCCESS;
}

/* The stable region is convex in the logarithms u, v of the ratios (1 - nu² (e^-u + e^v + e^(u-v)) - 2 nu³ > 0), so a
 * ray from the origin leaves it once: bisection. */
static OstStatus find_radius(OstContext *ctx, double nu, const double direction[2], double *radius)
{
    double inside = 0.0;
    double outside = 1.0;
    int stable = 1;
    for (;;) {
        OST_TRY(is_stable(ctx, nu, direction, outside, &stable));
        if (!stable)
            break;
        inside = outside;
        outside *= 2.0;
    }
    while (outside - inside > 1e-14 * outside) {
        const double middle = 0.5 * (inside + outside);
        OST_TRY(is_stable(ctx, nu, direction, middle, &stable));
        *(stable ? &inside : &outside) = middle;
    }
    *radius = outside;
    return OST_SUCCESS;
}

OstStatus ost_orthotropic_naive_boundary(OstContext *ctx, double nu, int count, double *ratios)
{
    if (!(nu > -1.0 && nu < 0.5) || fabs(nu) < 1e-6)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "nu = %g has no stability boundary: -1 < nu < 0.5 without 0 is expected (at 0 all ratios of "
                         "Young's moduli are stable, outside none)",
                         nu);
    for (int i = 0; i < count; i++) {
        const double angle = 2.0 * M_PI * i / count;
        const double direction[2] = {cos(angle), sin(angle)};
        double radius = 0.0;
        OST_TRY(find_radius(ctx, nu, direction, &radius));
        ratios[2 * i] = exp(radius * direction[0]);
        ratios[2 * i + 1] = exp(radius * direction[1]);
    }
    return OST_SUCCESS;
}
