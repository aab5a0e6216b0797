/* SPDX-License-Identifier: BSD-3-Clause */
#include "orthostat/material.h"

#include "core/error.h"
#include "core/small.h"
#include "material/definite.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Constants that differ from an isotropic material's by no more than this count as isotropic. */
static const double isotropic_tolerance = 1e-12;

static int nearly_equal(double a, double b)
{
    return fabs(a - b) <= isotropic_tolerance * fmax(fabs(a), fabs(b));
}

static int is_isotropic(const OstOrthotropic *constants)
{
    const OstOrthotropic body = ost_orthotropic_isotropic(constants->youngs_modulus[0], constants->poissons_ratio[0]);
    for (int i = 0; i < 3; i++)
        if (!nearly_equal(constants->youngs_modulus[i], body.youngs_modulus[i]) ||
            !nearly_equal(constants->poissons_ratio[i], body.poissons_ratio[i]) ||
            !nearly_equal(constants->shear_modulus[i], body.shear_modulus[i]))
            return 0;
    return 1;
}

/* C and S from the normalised block N: S_n = D^-1/2 N D^-1/2 and C_n = D^1/2 N^-1 D^1/2 with D = diag E. This is eq.
 * 4-8, but bitwise symmetric, and without overflow if moduli differ by many orders of magnitude. */
static void fill_stiffness(const OstOrthotropic *constants, OstMaterial *material)
{
    double ratios[3], block[9], inverse[9], root[3];
    ost_orthotropic_normalised_ratios(constants, ratios);
    ost_normalised_block(ratios, block);
    ost_invert3(block, inverse);
    for (int i = 0; i < 3; i++)
        root[i] = sqrt(constants->youngs_modulus[i]);
    memset(material->stiffness, 0, sizeof material->stiffness);
    memset(material->compliance, 0, sizeof material->compliance);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            material->stiffness[6 * i + j] = material->incompressible ? NAN : root[i] * root[j] * inverse[3 * i + j];
            material->compliance[6 * i + j] = block[3 * i + j] / (root[i] * root[j]);
        }
        material->stiffness[7 * (i + 3)] = constants->shear_modulus[i];
        material->compliance[7 * (i + 3)] = 1.0 / constants->shear_modulus[i];
    }
}

OstStatus ost_material_create(OstContext *ctx, const char *name, const OstOrthotropic *constants, double density,
                              OstMaterial *material)
{
    double eigenvalues[3];
    OST_TRY(ost_orthotropic_check(ctx, name, constants, eigenvalues));
    if (!(density >= 0.0) || !isfinite(density))
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "material '%s': density = %g; a finite number that is not negative is expected", name,
                         density);
    memset(material, 0, sizeof *material);
    snprintf(material->name, sizeof material->name, "%s", name);
    material->density = density;
    material->isotropic = is_isotropic(constants);
    material->constants = *constants;
    material->incompressible = eigenvalues[0] == 0.0;
    material->condition = eigenvalues[2] / eigenvalues[0];
    fill_stiffness(constants, material);
    return OST_SUCCESS;
}
