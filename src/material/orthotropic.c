/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "orthostat/material.h"

#include <math.h>
#include <stdio.h>

/* Both nu_ij and nu_ji may be given if they agree to this; printed tables have few digits. */
static const double pair_tolerance = 1e-6;

static double mean_modulus(double a, double b, OstShearRule rule)
{
    switch (rule) {
    case OST_SHEAR_ARITHMETIC:
        return 0.5 * (a + b);
    case OST_SHEAR_MIN:
        return fmin(a, b);
    case OST_SHEAR_MAX:
        return fmax(a, b);
    case OST_SHEAR_GEOMETRIC:
        break;
    }
    return sqrt(a) * sqrt(b);
}

void ost_orthotropic_shear(const double youngs_modulus[3], double nu, OstShearRule rule, double shear_modulus[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        shear_modulus[i] = mean_modulus(youngs_modulus[i], youngs_modulus[j], rule) / (2.0 * (1.0 + nu));
    }
}

OstOrthotropic ost_orthotropic_isotropic(double youngs_modulus, double poissons_ratio)
{
    const double shear_modulus = youngs_modulus / (2.0 * (1.0 + poissons_ratio));
    return (OstOrthotropic){
        .youngs_modulus = {youngs_modulus, youngs_modulus, youngs_modulus},
        .poissons_ratio = {poissons_ratio, poissons_ratio, poissons_ratio},
        .shear_modulus = {shear_modulus, shear_modulus, shear_modulus},
    };
}

OstOrthotropic ost_orthotropic_family(const double youngs_modulus[3], double nu, OstShearRule rule)
{
    OstOrthotropic constants;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        constants.youngs_modulus[i] = youngs_modulus[i];
        constants.poissons_ratio[i] = nu * (sqrt(youngs_modulus[i]) / sqrt(youngs_modulus[j]));
    }
    ost_orthotropic_shear(youngs_modulus, nu, rule, constants.shear_modulus);
    return constants;
}

OstOrthotropic ost_orthotropic_transverse(double e_plane, double e_axis, double nu_plane, double nu_plane_axis,
                                          double g_axis)
{
    const double youngs_modulus[3] = {e_plane, e_plane, e_axis};
    OstOrthotropic constants = ost_orthotropic_family(youngs_modulus, nu_plane, OST_SHEAR_GEOMETRIC);
    constants.shear_modulus[0] = e_plane / (2.0 * (1.0 + nu_plane));
    if (!isnan(nu_plane_axis)) {
        constants.poissons_ratio[1] = nu_plane_axis;
        constants.poissons_ratio[2] = nu_plane_axis * e_axis / e_plane;
    }
    if (!isnan(g_axis))
        constants.shear_modulus[1] = constants.shear_modulus[2] = g_axis;
    return constants;
}

/* The same but for rounding. */
static int same(double a, double b)
{
    return fabs(a - b) <= 1e-9 * fmax(fabs(a), fabs(b));
}

/* Equally stiff in all directions of the plane across e_axis: constants of eq. 19 and 20, in the order 12, 23, 31. */
int ost_orthotropic_is_transverse(const OstOrthotropic *k, int axis)
{
    const int a = (axis + 1) % 3, b = (axis + 2) % 3; /* nu and G of a: a with b; of b: b with the axis */
    const double *e = k->youngs_modulus, *nu = k->poissons_ratio, *g = k->shear_modulus;
    return same(e[a], e[b]) && same(g[b], g[axis]) && same(nu[b] / e[b], nu[axis] / e[axis]) &&
           same(g[a], e[a] / (2.0 * (1.0 + nu[a])));
}

void ost_orthotropic_words(const OstOrthotropic *constants, char text[OST_MODULI_WORDS])
{
    const double *e = constants->youngs_modulus;
    int odd = 0; /* the axis whose modulus the other two do not share */
    while (odd < 3 && !same(e[(odd + 1) % 3], e[(odd + 2) % 3]))
        odd++;
    if (odd == 3)
        snprintf(text, OST_MODULI_WORDS, "E = %.6g along e1, %.6g along e2, %.6g along e3", e[0], e[1], e[2]);
    else if (same(e[0], e[1]) && same(e[1], e[2]))
        snprintf(text, OST_MODULI_WORDS, "E = %.6g along e1, e2 and e3", e[0]);
    else
        snprintf(text, OST_MODULI_WORDS, "E = %.6g along e%d%s, %.6g along e%d and e%d", e[odd], odd + 1,
                 ost_orthotropic_is_transverse(constants, odd) ? " (the axis)" : "", e[(odd + 1) % 3], odd == 0 ? 2 : 1,
                 odd == 2 ? 2 : 3);
}

/* nu_ij as the user gave it, or from nu_ji by nu_ij / E_i = nu_ji / E_j. */
static OstStatus resolve_pair(OstContext *ctx, const char *what, int i, const double youngs[3], double forward,
                              double backward, double *nu)
{
    const int j = (i + 1) % 3;
    const int a = i + 1;
    const int b = j + 1;
    if (isnan(forward) && isnan(backward))
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "%s: neither nu%d%d nor nu%d%d is given; give one of them, or one number (the stable family) "
                         "for all",
                         what, a, b, b, a);
    const double implied = backward * (youngs[i] / youngs[j]);
    *nu = isnan(forward) ? implied : forward;
    if (isnan(forward) || isnan(backward) ||
        fabs(forward - implied) <= pair_tolerance * fmax(fabs(forward), fabs(implied)))
        return OST_SUCCESS;
    return OST_RAISE(ctx, OST_INVALID_INPUT,
                     "%s: nu%d%d = %g and nu%d%d = %g contradict each other: nu%d%d/E%d = nu%d%d/E%d asks for nu%d%d = "
                     "%.9g; give only one of them",
                     what, a, b, forward, b, a, backward, a, b, a, b, a, b, b, a, forward * (youngs[j] / youngs[i]));
}

OstStatus ost_orthotropic_named(OstContext *ctx, const char *what, const double youngs[3], const double nu[6],
                                const double shear[3], OstOrthotropic *constants)
{
    for (int i = 0; i < 3; i++) {
        const int a = i + 1;
        const int b = (i + 1) % 3 + 1;
        if (!(youngs[i] > 0.0) || !isfinite(youngs[i]))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: E%d = %g; a positive, finite number is expected", what, a,
                             youngs[i]);
        if (isnan(shear[i]))
            return OST_RAISE(ctx, OST_INVALID_INPUT,
                             "%s: G%d%d is not given; nine constants need G12, G23 and G31 (or G13)", what, a, b);
        if (!(shear[i] > 0.0) || !isfinite(shear[i]))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: G%d%d = %g; a positive, finite number is expected", what, a,
                             b, shear[i]);
        constants->youngs_modulus[i] = youngs[i];
        constants->shear_modulus[i] = shear[i];
    }
    for (int i = 0; i < 3; i++)
        OST_TRY(resolve_pair(ctx, what, i, youngs, nu[2 * i], nu[2 * i + 1], &constants->poissons_ratio[i]));
    return OST_SUCCESS;
}
