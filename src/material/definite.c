/* SPDX-License-Identifier: BSD-3-Clause */
#include "material/definite.h"

#include "core/error.h"
#include "core/small.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

/* A smallest eigenvalue below this counts as 0, within rounding errors. */
static const double smallest_eigenvalue = 16.0 * DBL_EPSILON;

/* Suggested values lie this far inside the stability boundary, so that they are stable as printed, rounded. */
static const double suggestion_margin = 1e-5;

void ost_orthotropic_normalised_ratios(const OstOrthotropic *constants, double ratios[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        ratios[i] =
            constants->poissons_ratio[i] * (sqrt(constants->youngs_modulus[j]) / sqrt(constants->youngs_modulus[i]));
    }
}

void ost_normalised_block(const double ratios[3], double block[9])
{
    block[0] = block[4] = block[8] = 1.0;
    block[1] = block[3] = -ratios[0];
    block[5] = block[7] = -ratios[1];
    block[2] = block[6] = -ratios[2];
}

OstStatus ost_orthotropic_eigenvalues(OstContext *ctx, const OstOrthotropic *constants, double eigenvalues[3])
{
    double ratios[3], block[9];
    ost_orthotropic_normalised_ratios(constants, ratios);
    ost_normalised_block(ratios, block);
    return ost_symmetric_eigen(ctx, 3, block, eigenvalues, NULL);
}

double ost_equivalent_poisson(double least_eigenvalue)
{
    return round(0.5e12 * (1.0 - least_eigenvalue)) / 1e12; /* rounded, so that nu = 0.49 in a case gives just 0.49 */
}

int ost_has_one_stiff_mode(const double eigenvalues[3], double nu_limit)
{
    return ost_equivalent_poisson(eigenvalues[0]) > nu_limit && ost_equivalent_poisson(eigenvalues[1]) <= nu_limit;
}

double ost_orthotropic_stable_scale(const double eigenvalues[3])
{
    /* The block is I - t M with M's trace 0, so its smallest eigenvalue is 1 - t max(M). */
    const double largest = 1.0 - eigenvalues[0];
    return largest > DBL_EPSILON ? 1.0 / largest : INFINITY;
}

void ost_orthotropic_stable_range(const OstOrthotropic *constants, double low[3], double high[3])
{
    double ratios[3];
    ost_orthotropic_normalised_ratios(constants, ratios);
    for (int i = 0; i < 3; i++) {
        /* 1 - a² - b² - c² - 2abc > 0, a quadratic in a, has no solution unless |b| < 1 and |c| < 1. */
        const double b = ratios[(i + 1) % 3];
        const double c = ratios[(i + 2) % 3];
        const double half_width = fabs(b) < 1.0 && fabs(c) < 1.0 ? sqrt((1.0 - b * b) * (1.0 - c * c)) : NAN;
        const double unit = sqrt(constants->youngs_modulus[i] / constants->youngs_modulus[(i + 1) % 3]);
        low[i] = (-b * c - half_width) * unit;
        high[i] = (-b * c + half_width) * unit;
    }
}

static OstStatus check_positive(OstContext *ctx, const char *name, const char *symbol, double value)
{
    if (value > 0.0 && isfinite(value))
        return OST_SUCCESS;
    return OST_RAISE(ctx, OST_INVALID_INPUT, "material '%s': %s = %g; a positive, finite number is expected", name,
                     symbol, value);
}

static OstStatus check_numbers(OstContext *ctx, const char *name, const OstOrthotropic *constants)
{
    static const char *const youngs[3] = {"E1", "E2", "E3"};
    static const char *const poissons[3] = {"nu12", "nu23", "nu31"};
    for (int i = 0; i < 3; i++)
        OST_TRY(check_positive(ctx, name, youngs[i], constants->youngs_modulus[i]));
    for (int i = 0; i < 3; i++)
        if (!isfinite(constants->poissons_ratio[i]))
            return OST_RAISE(ctx, OST_INVALID_INPUT, "material '%s': %s = %g; a finite number is expected", name,
                             poissons[i], constants->poissons_ratio[i]);
    return OST_SUCCESS;
}

static OstStatus check_shear(OstContext *ctx, const char *name, const OstOrthotropic *constants)
{
    static const char *const shear[3] = {"G12", "G23", "G31"};
    for (int i = 0; i < 3; i++)
        OST_TRY(check_positive(ctx, name, shear[i], constants->shear_modulus[i]));
    return OST_SUCCESS;
}

static int is_family(const double ratios[3])
{
    const double tolerance = 1e-9 * fabs(ratios[0]);
    return fabs(ratios[1] - ratios[0]) <= tolerance && fabs(ratios[2] - ratios[0]) <= tolerance;
}

static OstStatus raise_outside_family(OstContext *ctx, const char *name, double nu)
{
    return OST_RAISE(
        ctx, OST_INVALID_INPUT,
        "material '%s': nu = %.9g is not stable; -1 < nu <= 0.5 is expected, which is stable for all Young's "
        "moduli (incompressible: 0.5)",
        name, nu);
}

/* Names the inequality of (16)-(17) in the paper that fails, with its numbers. */
static void describe_violation(const OstOrthotropic *constants, const double ratios[3], char *text, size_t size)
{
    for (int i = 0; i < 3; i++) {
        const int a = i + 1;
        const int b = (i + 1) % 3 + 1;
        const double nu = constants->poissons_ratio[i];
        if (fabs(ratios[i]) >= 1.0) {
            const double ratio = constants->youngs_modulus[i] / constants->youngs_modulus[b - 1];
            snprintf(text, size, "nu%d%d² = %.6g must be below E%d/E%d = %.6g (nu%d%d is %.6g)", a, b, nu * nu, a, b,
                     ratio, b, a, nu / ratio);
            return;
        }
    }
    const double determinant = 1.0 - ratios[0] * ratios[0] - ratios[1] * ratios[1] - ratios[2] * ratios[2] -
                               2.0 * ratios[0] * ratios[1] * ratios[2];
    snprintf(text, size, "1 - nu12 nu21 - nu23 nu32 - nu31 nu13 - 2 nu21 nu32 nu13 = %.6g must be positive%s",
             determinant, determinant > 0.0 ? " by more than rounding" : "");
}

/* Reduces `scale` by the margin and truncates it to four digits. */
static double truncate_to_four_digits(double scale)
{
    const double inside = scale * (1.0 - suggestion_margin);
    const double unit = pow(10.0, floor(log10(inside)) - 3.0);
    return floor(inside / unit) * unit;
}

/* The nu to propose for the family: the user's own if the three ratios are equal, otherwise the mean of the normalised
 * ratios; at a distance from the ends of the stable range. */
static double family_nu(const OstOrthotropic *constants, const double ratios[3])
{
    const double *nu = constants->poissons_ratio;
    const double wanted = is_family(nu) ? nu[0] : (ratios[0] + ratios[1] + ratios[2]) / 3.0;
    return fmin(fmax(round(wanted * 1000.0) / 1000.0, -0.9), 0.49);
}

/* Lists nu_ij and nu_ji, since the user may have given either: "nu12 = 0.3 (nu21 = 0.1), ...". */
static void list_ratios(const OstOrthotropic *constants, double scale, char *text, size_t size)
{
    const double *youngs = constants->youngs_modulus;
    size_t length = 0;
    for (int i = 0; i < 3 && length < size; i++) {
        const int j = (i + 1) % 3;
        const double nu = scale * constants->poissons_ratio[i];
        length += (size_t)snprintf(text + length, size - length, "%snu%d%d = %.7g (nu%d%d = %.7g)", i > 0 ? ", " : "",
                                   i + 1, j + 1, nu, j + 1, i + 1, nu * (youngs[j] / youngs[i]));
    }
}

static OstStatus raise_indefinite(OstContext *ctx, const char *name, const OstOrthotropic *constants,
                                  const double ratios[3], const double eigenvalues[3])
{
    char violation[160], stable[160], means[160];
    describe_violation(constants, ratios, violation, sizeof violation);
    const double scale = truncate_to_four_digits(ost_orthotropic_stable_scale(eigenvalues));
    const double proposed = family_nu(constants, ratios);
    const OstOrthotropic family = ost_orthotropic_family(constants->youngs_modulus, proposed, OST_SHEAR_GEOMETRIC);
    list_ratios(constants, scale, stable, sizeof stable);
    list_ratios(&family, 1.0, means, sizeof means);
    return OST_RAISE(ctx, OST_INVALID_INPUT,
                     "material '%s' is not stable (its stiffness is not positive definite, smallest normalised "
                     "eigenvalue %.3g): %s. Stable up to %.4g of the given ratios: %s. Or give one number, the stable "
                     "family, any nu in -1 < nu < 0.5: nu = %.3g means %s",
                     name, eigenvalues[0], violation, scale, stable, proposed, means);
}

OstStatus ost_orthotropic_check(OstContext *ctx, const char *name, const OstOrthotropic *constants,
                                double eigenvalues[3])
{
    double ratios[3];
    OST_TRY(check_numbers(ctx, name, constants));
    ost_orthotropic_normalised_ratios(constants, ratios);
    OST_TRY(ost_orthotropic_eigenvalues(ctx, constants, eigenvalues));
    const int definite = eigenvalues[0] > smallest_eigenvalue;
    if (!definite && is_family(ratios)) {
        if (!(fabs(eigenvalues[0]) <= smallest_eigenvalue && ratios[0] > 0.0))
            return raise_outside_family(ctx, name, ratios[0]);
        eigenvalues[0] = 0.0; /* incompressible */
        return check_shear(ctx, name, constants);
    }
    OST_TRY(check_shear(ctx, name, constants));
    return definite ? OST_SUCCESS : raise_indefinite(ctx, name, constants, ratios, eigenvalues);
}
