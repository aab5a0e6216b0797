/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/formula/formula.h"

#include "core/error.h"

#include <math.h>
#include <string.h>

/* Bars along x with the section |y| <= b/2, |z| <= h/2, of a material whose axes are the world's. Displacements are
 * normalised by means over the section, as in Timoshenko's theory after Cowper (1966): at x = 0 the mean deflection and
 * the mean rotation (the first moment of u_x over I) are zero. */
enum { E, NU12, NU13, G12, G13, E3, LENGTH, B, H, LOAD, BAR_CONSTANTS };

static OstStatus prepare_bar(const OstCase *c, double load, OstFormulaData *data)
{
    const OstBlockShape *block = &c->block;
    const OstOrthotropic *o = &c->materials[0].material.constants;
    double *k = data->constant;
    OST_TRY(ost_formula_wants_bar(c, 0, "a block with its origin at [0, -b/2, -h/2]"));
    k[E] = o->youngs_modulus[0];
    k[E3] = o->youngs_modulus[2];
    k[NU12] = o->poissons_ratio[0];
    k[NU13] = o->poissons_ratio[2] * o->youngs_modulus[0] / o->youngs_modulus[2];
    k[G12] = o->shear_modulus[0];
    k[G13] = o->shear_modulus[2];
    k[LENGTH] = block->size[0];
    k[B] = block->size[1];
    k[H] = block->size[2];
    k[LOAD] = load;
    data->length = fmin(k[B], k[H]);
    return OST_SUCCESS;
}

static double area(const double *k)
{
    return k[B] * k[H];
}

static double second_moment(const double *k)
{
    return k[B] * pow(k[H], 3) / 12.0;
}

/* --- flexure by a force at the end --- */

/* Saint-Venant's flexure (Love, A Treatise on the Mathematical Theory of Elasticity, §229-230; for an orthotropic bar
 * Lekhnitskii, Theory of Elasticity of an Anisotropic Body, §44-45). With the curvature kappa(x) = P (L - x) / (E I),
 *   u_x = -w0'(x) z + kappa' X(y, z),  u_y = nu12 kappa y z,  u_z = w0(x) + kappa (nu13 z² - nu12 y²) / 2,
 * and no traction on the sides,
 *   X = -nu12 y² z / 2 + A z³ / 6 + C z + sum c_n cos(2 n pi y / b) sinh(k_n z),
 *   A = E / G13 - nu13,  C = nu12 b² / 12 - E h² / (8 G13),  k_n = (2 n pi / b) sqrt(G12 / G13),
 *   c_n k_n cosh(k_n h / 2) = nu12 (b / pi)² (-1)^n / n². */
enum { FLEXURE_TERMS = 40 };

/* X and its derivatives by y and z. */
static void warping(const double *k, double y, double z, double x[3])
{
    const double a = k[E] / k[G13] - k[NU13];
    const double c = k[NU12] * k[B] * k[B] / 12.0 - k[E] * k[H] * k[H] / (8.0 * k[G13]);
    const double half = 0.5 * k[H];
    x[0] = -0.5 * k[NU12] * y * y * z + a * z * z * z / 6.0 + c * z;
    x[1] = -k[NU12] * y * z;
    x[2] = -0.5 * k[NU12] * y * y + 0.5 * a * z * z + c;
    if (k[NU12] == 0.0)
        return;
    /* sinh(decay z) and cosh(decay z) over cosh(decay h / 2), without overflow; each term's functions from the last's
     */
    const double wave = 2.0 * M_PI / k[B], decay = wave * sqrt(k[G12] / k[G13]);
    const double turn[2] = {cos(wave * y), sin(wave * y)};
    const double rises = exp(decay * (z - half)), falls = exp(-decay * (z + half)), wholes = exp(-2.0 * decay * half);
    double cosine = 1.0, sine = 0.0, rise = 1.0, fall = 1.0, whole = 1.0,
           factor = k[NU12] * pow(k[B] / M_PI, 2) / decay;
    for (int n = 1; n <= FLEXURE_TERMS; n++) {
        const double turned = cosine * turn[0] - sine * turn[1];
        sine = sine * turn[0] + cosine * turn[1];
        cosine = turned;
        rise *= rises, fall *= falls, whole *= wholes, factor = -factor;
        const double times = factor / (1.0 + whole) / (n * n);
        x[0] += times * cosine * (rise - fall) / n;
        x[1] -= times * wave * sine * (rise - fall);
        x[2] += times * decay * cosine * (rise + fall);
    }
}

/* The first moment of X over I, and with it Timoshenko's shear coefficient: 1 / kappa_T = 6/5 - nu13 G13 / (5 E), which
 * is Cowper's (12 + 11 nu) / (10 (1 + nu)) where the bar is isotropic. */
static double warping_moment(const double *k)
{
    const double a = k[E] / k[G13] - k[NU13];
    const double c = k[NU12] * k[B] * k[B] / 12.0 - k[E] * k[H] * k[H] / (8.0 * k[G13]);
    return -k[NU12] * k[B] * k[B] / 24.0 + a * k[H] * k[H] / 40.0 + c;
}

static double inverse_shear_coefficient(const double *k)
{
    return 1.2 - k[NU13] * k[G13] / (5.0 * k[E]);
}

static OstStatus prepare_flexure(const OstCase *c, const double *parameter, OstFormulaData *data)
{
    OST_TRY(prepare_bar(c, parameter[0], data));
    const double *k = data->constant;
    const double bending = k[LOAD] * pow(k[LENGTH], 3) / (3.0 * k[E] * second_moment(k));
    const double shear = k[LOAD] * k[LENGTH] * inverse_shear_coefficient(k) / (k[G13] * area(k));
    data->value[0] = bending + shear;
    data->value[1] = shear / (bending + shear);
    return OST_SUCCESS;
}

/* Curvature, and the mean line's slope and deflection. */
typedef struct MeanLine {
    double change; /* kappa' */
    double kappa, rotation, deflection;
} MeanLine;

static MeanLine mean_line(const double *k, double x)
{
    const double change = -k[LOAD] / (k[E] * second_moment(k));
    const double start = change * warping_moment(k); /* so that the mean rotation at x = 0 is zero */
    const double spread = (k[NU13] * k[H] * k[H] - k[NU12] * k[B] * k[B]) / 24.0; /* mean of what u_z adds to w0 */
    return (MeanLine){
        .change = change,
        .kappa = change * (x - k[LENGTH]),
        .rotation = change * (x * x / 2.0 - k[LENGTH] * x) + start,
        .deflection = change * (x * x * x / 6.0 - k[LENGTH] * x * x / 2.0 + k[LENGTH] * spread) + start * x,
    };
}

static void flexure(const double *k, const double p[3], double u[3])
{
    const double y = p[1], z = p[2];
    const MeanLine line = mean_line(k, p[0]);
    double x[3];
    warping(k, y, z, x);
    u[0] = -line.rotation * z + line.change * x[0];
    u[1] = k[NU12] * line.kappa * y * z;
    u[2] = line.deflection + 0.5 * line.kappa * (k[NU13] * z * z - k[NU12] * y * y);
}

static void flexure_gradient(const double *k, const double p[3], double g[9])
{
    const double y = p[1], z = p[2];
    const MeanLine line = mean_line(k, p[0]);
    double x[3];
    warping(k, y, z, x);
    g[0] = -line.kappa * z;
    g[1] = line.change * x[1];
    g[2] = -line.rotation + line.change * x[2];
    g[3] = k[NU12] * line.change * y * z;
    g[4] = k[NU12] * line.kappa * z;
    g[5] = k[NU12] * line.kappa * y;
    g[6] = line.rotation + 0.5 * line.change * (k[NU13] * z * z - k[NU12] * y * y);
    g[7] = -k[NU12] * line.kappa * y;
    g[8] = k[NU13] * line.kappa * z;
}

const OstFormula ost_formula_flexure = {
    .name = "flexure",
    .parameter_name = {"force"},
    .value_name = {"tip_deflection", "shear_share"},
    .prepare = prepare_flexure,
    .displacement = flexure,
    .gradient = flexure_gradient,
};

/* --- the same in plane strain --- */

/* The end-loaded strip (Timoshenko and Goodier, Theory of Elasticity, §21; orthotropic: Lekhnitskii, Anisotropic
 * Plates, §16): flexure without y, E and nu13 those of plane strain, beta_ij = S_ij - S_i2 S_j2 / S_22. Force per unit
 * depth. */
static OstStatus prepare_strip(const OstCase *c, const double *parameter, OstFormulaData *data)
{
    const OstOrthotropic *o = &c->materials[0].material.constants;
    const double *e = o->youngs_modulus;
    OST_TRY(prepare_bar(c, parameter[0] * c->block.size[1], data));
    double *k = data->constant;
    const double s12 = -o->poissons_ratio[0] / e[0], s23 = -o->poissons_ratio[1] / e[1];
    const double s13 = -o->poissons_ratio[2] / e[2], s22 = 1.0 / e[1];
    const double beta11 = 1.0 / e[0] - s12 * s12 / s22;
    const double beta13 = s13 - s12 * s23 / s22;
    k[E] = 1.0 / beta11;
    k[NU13] = -beta13 / beta11;
    k[NU12] = 0.0;
    data->length = k[H];
    return OST_SUCCESS;
}

const OstFormula ost_formula_strip = {
    .name = "strip",
    .parameter_name = {"force"},
    .prepare = prepare_strip,
    .displacement = flexure,
    .gradient = flexure_gradient,
};

/* --- bending by a couple at the end --- */

/* Pure bending (Timoshenko and Goodier, §102; Lekhnitskii, §20): flexure with the curvature M / (E I) throughout. */
static OstStatus prepare_bending(const OstCase *c, const double *parameter, OstFormulaData *data)
{
    OST_TRY(prepare_bar(c, parameter[0], data));
    const double *k = data->constant;
    data->value[0] = k[LOAD] * k[LENGTH] * k[LENGTH] / (2.0 * k[E] * second_moment(k));
    return OST_SUCCESS;
}

static void bending(const double *k, const double p[3], double u[3])
{
    const double x = p[0], y = p[1], z = p[2];
    const double kappa = k[LOAD] / (k[E] * second_moment(k));
    const double spread = (k[NU13] * k[H] * k[H] - k[NU12] * k[B] * k[B]) / 24.0;
    u[0] = -kappa * x * z;
    u[1] = k[NU12] * kappa * y * z;
    u[2] = 0.5 * kappa * (x * x + k[NU13] * z * z - k[NU12] * y * y) - kappa * spread;
}

const OstFormula ost_formula_bending = {
    .name = "bending",
    .parameter_name = {"moment"},
    .value_name = {"tip_deflection"},
    .prepare = prepare_bending,
    .displacement = bending,
};

/* --- bending by a uniform force per volume --- */

/* After Timoshenko and Goodier, §22, with the load in the volume, not on the upper face, and without Poisson's ratios,
 * for which the plane solution is that of the bar. With load q per length and S = q (L - x):
 *   tau_xz = S (h²/4 - z²) / (2 I),  sigma_zz = (q / b) (z / (2 h) - 2 z³ / h³),
 *   sigma_xx = -q (L - x)² z / (2 I) + (E q / (G I)) (z³ / 6 - h² z / 40). */
static OstStatus prepare_uniform_load(const OstCase *c, const double *parameter, OstFormulaData *data)
{
    OST_TRY(prepare_bar(c, parameter[0], data));
    const double *k = data->constant;
    const double nu23 = c->materials[0].material.constants.poissons_ratio[1];
    OST_TRY(
        ost_formula_wants(c, k[NU12] == 0.0 && k[NU13] == 0.0 && nu23 == 0.0, "a material without Poisson's ratios"));
    data->value[0] = k[LOAD] * pow(k[LENGTH], 4) / (8.0 * k[E] * second_moment(k)) +
                     k[LOAD] * k[LENGTH] * k[LENGTH] * 1.2 / (2.0 * k[G13] * area(k));
    return OST_SUCCESS;
}

static void uniform_load(const double *k, const double p[3], double u[3])
{
    const double x = p[0], z = p[2], length = k[LENGTH], h = k[H], left = length - x;
    const double cube = length * length * length, cubed = z * z * z; /* pow would take most of the time */
    const double bend = k[LOAD] / (k[E] * second_moment(k));
    const double shear = k[LOAD] / (k[G13] * second_moment(k));
    const double rotation = bend * (cube - left * left * left) / 6.0;
    const double deflection = bend / 6.0 * (cube * x + (left * left * left * left - cube * length) / 4.0);
    const double slip = shear * h * h / 10.0 * (length * x - x * x / 2.0);
    /* Integral of sigma_zz / E3 over z, of mean zero over the section. */
    const double squash =
        k[LOAD] / (k[B] * k[E3]) * (z * z / (4.0 * h) - cubed * z / (2.0 * h * h * h) - 7.0 * h / 480.0);
    u[0] = -rotation * z + shear * x * (cubed / 6.0 - h * h * z / 40.0) +
           0.5 * shear * length * (h * h * z / 20.0 - cubed / 3.0);
    u[1] = 0.0;
    u[2] = deflection + slip + squash;
}

const OstFormula ost_formula_uniform_load = {
    .name = "uniform_load",
    .parameter_name = {"load"},
    .value_name = {"tip_deflection"},
    .prepare = prepare_uniform_load,
    .displacement = uniform_load,
};
