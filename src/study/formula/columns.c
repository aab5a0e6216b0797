/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/formula/formula.h"

#include "core/error.h"

#include <math.h>

/* Bars along z with the section |x| <= a/2, |y| <= b/2, of a material whose axes are the world's. */
static const char column[] = "a block with its origin at [-a/2, -b/2, 0]";

/* --- torsion --- */

/* Saint-Venant's torsion of a rectangular orthotropic bar (Lekhnitskii, Theory of Elasticity of an Anisotropic Body,
 * §36): u = theta (-y z, x z, phi), phi = x y + sum c_n sin(k_n x) sinh(m_n y) with k_n = (2n + 1) pi / a,
 * m_n = k_n sqrt(Gxz / Gyz), c_n = -8 (-1)^n / (a k_n² m_n cosh(m_n b / 2)), and
 *   T / theta = Gyz a³ b / 3 - (64 Gyz / a) sum tanh(m_n b / 2) / (k_n⁴ m_n). */
enum { GXZ, GYZ, A, B, TWIST };
enum { FIELD_TERMS = 40, STIFFNESS_TERMS = 2000 };

static double torsional_stiffness(const double *k)
{
    double sum = 0.0;
    for (int n = STIFFNESS_TERMS - 1; n >= 0; n--) {
        const double wave = (2 * n + 1) * M_PI / k[A];
        const double decay = wave * sqrt(k[GXZ] / k[GYZ]);
        sum += tanh(0.5 * decay * k[B]) / (pow(wave, 4) * decay);
    }
    return k[GYZ] * pow(k[A], 3) * k[B] / 3.0 - 64.0 * k[GYZ] / k[A] * sum;
}

static OstStatus prepare_torsion(const OstCase *c, const double *parameter, OstFormulaData *data)
{
    double *k = data->constant;
    OST_TRY(ost_formula_wants_bar(c, 2, column));
    k[GYZ] = c->materials[0].material.constants.shear_modulus[1];
    k[GXZ] = c->materials[0].material.constants.shear_modulus[2];
    k[A] = c->block.size[0];
    k[B] = c->block.size[1];
    k[TWIST] = parameter[0];
    data->length = fmin(k[A], k[B]);
    data->value[0] = torsional_stiffness(k);
    return OST_SUCCESS;
}

/* phi and its derivatives by x and y. */
static void torsion_warping(const double *k, const double p[3], double phi[3])
{
    const double half = 0.5 * k[B];
    phi[0] = p[0] * p[1];
    phi[1] = p[1];
    phi[2] = p[0];
    /* sinh(decay y) and cosh(decay y) over cosh(decay b / 2), without overflow; each term's functions from the last's
     */
    const double wave = M_PI / k[A], decay = wave * sqrt(k[GXZ] / k[GYZ]);
    const double turn[2] = {cos(2.0 * wave * p[0]), sin(2.0 * wave * p[0])};
    const double rises = exp(decay * (p[1] - half)), falls = exp(-decay * (p[1] + half)),
                 wholes = exp(-2.0 * decay * half);
    double cosine = cos(wave * p[0]), sine = sin(wave * p[0]), rise = rises, fall = falls, whole = wholes;
    double factor = -8.0 / (k[A] * wave * wave * decay);
    for (int n = 1; n < 2 * FIELD_TERMS; n += 2) {
        const double times = factor / (1.0 + whole) / (n * n);
        phi[0] += times * sine * (rise - fall) / n;
        phi[1] += times * wave * cosine * (rise - fall);
        phi[2] += times * decay * sine * (rise + fall);
        const double turned = cosine * turn[0] - sine * turn[1];
        sine = sine * turn[0] + cosine * turn[1];
        cosine = turned;
        rise *= rises * rises, fall *= falls * falls, whole *= wholes * wholes, factor = -factor;
    }
}

static void torsion(const double *k, const double p[3], double u[3])
{
    double phi[3];
    torsion_warping(k, p, phi);
    u[0] = -k[TWIST] * p[1] * p[2];
    u[1] = k[TWIST] * p[0] * p[2];
    u[2] = k[TWIST] * phi[0];
}

static void torsion_gradient(const double *k, const double p[3], double g[9])
{
    double phi[3];
    torsion_warping(k, p, phi);
    const double by_twist[9] = {0.0, -p[2], -p[1], p[2], 0.0, p[0], phi[1], phi[2], 0.0};
    for (int i = 0; i < 9; i++)
        g[i] = k[TWIST] * by_twist[i];
}

const OstFormula ost_formula_torsion = {
    .name = "torsion",
    .parameter_name = {"twist"},
    .value_name = {"torsional_stiffness"},
    .prepare = prepare_torsion,
    .displacement = torsion,
    .gradient = torsion_gradient,
};

/* --- a bar that hangs by its upper end --- */

/* Timoshenko and Goodier, §96; orthotropic: Lekhnitskii, §21. sigma_zz = rho g z. The mean of u_z over the upper end is
 * zero. */
enum { PER_LENGTH, NU31, NU32, WIDTH_X, WIDTH_Y, HEIGHT };

static OstStatus prepare_hanging_bar(const OstCase *c, const double *parameter, OstFormulaData *data)
{
    const OstOrthotropic *o = &c->materials[0].material.constants;
    const double *e = o->youngs_modulus;
    double *k = data->constant;
    OST_TRY(ost_formula_wants_bar(c, 2, column));
    k[PER_LENGTH] = c->materials[0].material.density * parameter[0] / e[2];
    k[NU31] = o->poissons_ratio[2];
    k[NU32] = o->poissons_ratio[1] * e[2] / e[1];
    k[WIDTH_X] = c->block.size[0];
    k[WIDTH_Y] = c->block.size[1];
    k[HEIGHT] = c->block.size[2];
    data->length = fmin(k[WIDTH_X], k[WIDTH_Y]);
    data->value[0] = -0.5 * k[PER_LENGTH] * k[HEIGHT] * k[HEIGHT];
    return OST_SUCCESS;
}

static void hanging_bar(const double *k, const double p[3], double u[3])
{
    const double spread = (k[NU31] * k[WIDTH_X] * k[WIDTH_X] + k[NU32] * k[WIDTH_Y] * k[WIDTH_Y]) / 12.0;
    u[0] = -k[PER_LENGTH] * k[NU31] * p[0] * p[2];
    u[1] = -k[PER_LENGTH] * k[NU32] * p[1] * p[2];
    u[2] = 0.5 * k[PER_LENGTH] *
           (p[2] * p[2] - k[HEIGHT] * k[HEIGHT] + k[NU31] * p[0] * p[0] + k[NU32] * p[1] * p[1] - spread);
}

const OstFormula ost_formula_hanging_bar = {
    .name = "hanging_bar",
    .parameter_name = {"gravity"},
    .value_name = {"end_displacement"},
    .prepare = prepare_hanging_bar,
    .displacement = hanging_bar,
};
