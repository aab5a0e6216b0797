/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/formula/formula.h"

#include "core/error.h"
#include "core/small.h"

#include <math.h>
#include <string.h>

/* Fields that fit any body: a uniform stress, waves, and polynomials. */

/* --- a uniform stress, in world axes --- */

enum { GRADIENT = 0 }; /* nine: symmetric */

/* Young's modulus along x of a material turned about z, e1 at an angle to x with cosine c and sine s (Lekhnitskii,
 * Anisotropic Plates, §9; Jones, Mechanics of Composite Materials, eq. 2.97). */
static double modulus_along_x(const OstOrthotropic *o, double c, double s)
{
    const double c2 = c * c, s2 = s * s;
    return 1.0 / (c2 * c2 / o->youngs_modulus[0] + s2 * s2 / o->youngs_modulus[1] +
                  (1.0 / o->shear_modulus[0] - 2.0 * o->poissons_ratio[0] / o->youngs_modulus[0]) * s2 * c2);
}

static OstStatus prepare_uniform_stress(const OstCase *c, const double *parameter, OstFormulaData *data)
{
    static const double world[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const OstCaseMaterial *stated = &c->materials[0];
    const double *axes = stated->axes.kind == OST_AXES_NONE ? world : stated->axes.fixed;
    double *g = data->constant + GRADIENT;
    double s[36], strain[6], eigenstrain[6];
    OST_TRY(ost_formula_wants(c, !ost_axes_vary(&stated->axes), "axes that are the same everywhere"));
    ost_material_rotate_compliance(stated->material.compliance, axes, s);
    ost_apply6(s, parameter, strain);
    ost_strain_to_world(stated->eigenstrain, axes, eigenstrain);
    for (int p = 0; p < 6; p++)
        strain[p] += eigenstrain[p];
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        g[4 * i] = strain[i];
        g[3 * i + next] = g[3 * next + i] = 0.5 * strain[3 + i];
    }
    data->length = 1.0;
    if (c->mesh_kind != OST_MESH_BLOCK)
        return OST_SUCCESS;
    data->value[0] = c->block.size[0] * parameter[0] / modulus_along_x(&stated->material.constants, axes[0], axes[1]);
    data->value[1] = c->block.size[1] * c->block.size[2] * parameter[0];
    return OST_SUCCESS;
}

static void uniform_displacement(const double *k, const double x[3], double u[3])
{
    ost_apply3(k + GRADIENT, x, u);
}

static void uniform_gradient(const double *k, const double x[3], double gradient[9])
{
    (void)x;
    memcpy(gradient, k + GRADIENT, 9 * sizeof *gradient);
}

/* The values hold for a block under sigma_xx alone, e3 along z. */
const OstFormula ost_formula_uniform_stress = {
    .name = "uniform_stress",
    .parameter_name = {"xx", "yy", "zz", "xy", "yz", "zx"},
    .value_name = {"elongation", "force"},
    .prepare = prepare_uniform_stress,
    .displacement = uniform_displacement,
    .gradient = uniform_gradient,
};

/* --- waves: the method of manufactured solutions (Roache, Verification and Validation in Computational Science) --- */

/* u_i = amplitude sin(q_i · x + phase_i) */
enum { AMPLITUDE, WAVE };
static const double wave_vector[3][3] = {{1.0, 0.7, -0.4}, {-0.5, 0.9, 0.8}, {0.6, -0.3, 1.1}};
static const double phase[3] = {0.3, 1.1, -0.6};

static OstStatus prepare_waves(const OstCase *c, const double *parameter, OstFormulaData *data)
{
    data->constant[AMPLITUDE] = parameter[0];
    data->constant[WAVE] = parameter[1];
    data->length = 1.0 / parameter[1];
    return ost_formula_wants(c, parameter[1] > 0.0, "a wave number above 0");
}

static void waves(const double *k, const double x[3], double u[3])
{
    for (int i = 0; i < 3; i++)
        u[i] = k[AMPLITUDE] * sin(k[WAVE] * ost_dot3(wave_vector[i], x) + phase[i]);
}

static void waves_gradient(const double *k, const double x[3], double gradient[9])
{
    for (int i = 0; i < 3; i++) {
        const double slope = k[AMPLITUDE] * k[WAVE] * cos(k[WAVE] * ost_dot3(wave_vector[i], x) + phase[i]);
        for (int j = 0; j < 3; j++)
            gradient[3 * i + j] = slope * wave_vector[i][j];
    }
}

const OstFormula ost_formula_waves = {
    .name = "waves",
    .parameter_name = {"amplitude", "wave_number"},
    .prepare = prepare_waves,
    .displacement = waves,
    .gradient = waves_gradient,
};

/* --- polynomials, which elements of that order represent exactly: patch tests (Irons and Razzaque 1972) --- */

enum { QUADRATIC };
static const double first[3][3] = {{0.010, -0.004, 0.007}, {0.006, -0.008, 0.003}, {-0.005, 0.009, 0.004}};
/* Of x², y², z², xy, yz, zx. */
static const double second[3][6] = {{0.004, -0.003, 0.002, 0.005, -0.001, 0.003},
                                    {-0.002, 0.006, 0.001, -0.003, 0.004, 0.002},
                                    {0.003, 0.001, -0.005, 0.002, 0.003, -0.004}};

static OstStatus prepare_polynomial(const OstCase *c, const double *parameter, OstFormulaData *data)
{
    data->constant[QUADRATIC] = parameter[0] == 2.0;
    data->length = 1.0;
    return ost_formula_wants(c, parameter[0] == 1.0 || parameter[0] == 2.0, "degree 1 or 2");
}

static void polynomial(const double *k, const double x[3], double u[3])
{
    const double squares[6] = {x[0] * x[0], x[1] * x[1], x[2] * x[2], x[0] * x[1], x[1] * x[2], x[2] * x[0]};
    for (int i = 0; i < 3; i++) {
        u[i] = ost_dot3(first[i], x);
        for (int s = 0; s < 6 && k[QUADRATIC] != 0.0; s++)
            u[i] += second[i][s] * squares[s];
    }
}

static void polynomial_gradient(const double *k, const double x[3], double gradient[9])
{
    for (int i = 0; i < 3; i++) {
        const double *s = second[i];
        const double rise[3] = {2.0 * s[0] * x[0] + s[3] * x[1] + s[5] * x[2],
                                2.0 * s[1] * x[1] + s[3] * x[0] + s[4] * x[2],
                                2.0 * s[2] * x[2] + s[4] * x[1] + s[5] * x[0]};
        for (int j = 0; j < 3; j++)
            gradient[3 * i + j] = first[i][j] + k[QUADRATIC] * rise[j];
    }
}

const OstFormula ost_formula_polynomial = {
    .name = "polynomial",
    .parameter_name = {"degree"},
    .prepare = prepare_polynomial,
    .displacement = polynomial,
    .gradient = polynomial_gradient,
};
