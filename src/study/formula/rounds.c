/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/formula/formula.h"

#include "core/error.h"
#include "core/small.h"

#include <math.h>

/* Thick tubes and hollow spheres under pressure. */

/* --- a tube about the z axis, in plane strain --- */

/* Lekhnitskii, Theory of Elasticity of an Anisotropic Body, §41, for a cylindrically orthotropic tube; with k = 1
 * Lamé's (Timoshenko and Goodier, §28). With beta_ij = S_ij - S_iz S_jz / S_zz and k² = beta_rr / beta_tt,
 *   sigma_r = C r^(k-1) + D r^(-k-1),  sigma_t = k C r^(k-1) - k D r^(-k-1),  u_r = r (beta_rt sigma_r + beta_tt
 * sigma_t), sigma_z = -(S_rz sigma_r + S_tz sigma_t) / S_zz, C and D such that sigma_r = -p at the inner radius and 0
 * at the outer. */
enum { EXPONENT, C, D, BETA_RT, BETA_TT, AXIAL_R, AXIAL_T };

static OstStatus find_directions(const OstCase *c, int *radial, int *tangential, int *axial)
{
    const OstAxesSpec *axes = &c->materials[0].axes;
    *radial = 0;
    *tangential = 1;
    *axial = 2;
    if (c->materials[0].material.isotropic)
        return OST_SUCCESS;
    OST_TRY(ost_formula_wants(c,
                              axes->kind == OST_AXES_CYLINDRICAL && fabs(axes->axis[2]) == 1.0 &&
                                  axes->origin[0] == 0.0 && axes->origin[1] == 0.0,
                              "axes that are cylindrical about the z axis"));
    for (int i = 0; i < 3; i++) {
        int *direction = axes->order[i] == OST_RADIAL ? radial : axes->order[i] == OST_AXIAL ? axial : tangential;
        *direction = i;
    }
    return OST_SUCCESS;
}

static double compliance(const OstOrthotropic *o, int i, int j)
{
    if (i == j)
        return 1.0 / o->youngs_modulus[i];
    const int first = (i + 1) % 3 == j ? i : j; /* of 12, 23, 31 */
    return -o->poissons_ratio[first] / o->youngs_modulus[first];
}

static double tube_radial_stress(const double *k, double r)
{
    return k[C] * pow(r, k[EXPONENT] - 1.0) + k[D] * pow(r, -k[EXPONENT] - 1.0);
}

static double tube_hoop_stress(const double *k, double r)
{
    return k[EXPONENT] * (k[C] * pow(r, k[EXPONENT] - 1.0) - k[D] * pow(r, -k[EXPONENT] - 1.0));
}

static double tube_expansion(const double *k, double r)
{
    return r * (k[BETA_RT] * tube_radial_stress(k, r) + k[BETA_TT] * tube_hoop_stress(k, r));
}

static OstStatus prepare_cylinder(const OstCase *c, const double *parameter, OstFormulaData *data)
{
    const OstOrthotropic *o = &c->materials[0].material.constants;
    const double inner = parameter[0], outer = parameter[1], pressure = parameter[2];
    double *k = data->constant;
    int r, t, z;
    OST_TRY(find_directions(c, &r, &t, &z));
    OST_TRY(ost_formula_wants(c, 0.0 < inner && inner < outer, "an inner radius below the outer"));
    const double zz = compliance(o, z, z);
    const double rr = compliance(o, r, r) - compliance(o, r, z) * compliance(o, r, z) / zz;
    k[BETA_RT] = compliance(o, r, t) - compliance(o, r, z) * compliance(o, t, z) / zz;
    k[BETA_TT] = compliance(o, t, t) - compliance(o, t, z) * compliance(o, t, z) / zz;
    k[AXIAL_R] = -compliance(o, r, z) / zz;
    k[AXIAL_T] = -compliance(o, t, z) / zz;
    k[EXPONENT] = sqrt(rr / k[BETA_TT]);
    const double e = k[EXPONENT];
    /* C b^(e-1) = -D b^(-e-1); C a^(e-1) + D a^(-e-1) = -p */
    k[C] = pressure / (pow(outer, 2.0 * e) * pow(inner, -e - 1.0) - pow(inner, e - 1.0));
    k[D] = -k[C] * pow(outer, 2.0 * e);
    data->length = inner;
    data->value[0] = tube_expansion(k, inner);
    data->value[1] = tube_expansion(k, outer);
    data->value[2] = tube_hoop_stress(k, inner);
    data->value[3] = e;
    return OST_SUCCESS;
}

static void cylinder(const double *k, const double p[3], double u[3])
{
    const double r = hypot(p[0], p[1]);
    const double stretch = tube_expansion(k, r) / r;
    u[0] = stretch * p[0];
    u[1] = stretch * p[1];
    u[2] = 0.0;
}

static void cylinder_stress(const double *k, const double p[3], double stress[6])
{
    const double r = hypot(p[0], p[1]), x = p[0] / r, y = p[1] / r;
    const double radial = tube_radial_stress(k, r), hoop = tube_hoop_stress(k, r);
    stress[0] = radial * x * x + hoop * y * y;
    stress[1] = radial * y * y + hoop * x * x;
    stress[2] = k[AXIAL_R] * radial + k[AXIAL_T] * hoop;
    stress[3] = (radial - hoop) * x * y;
    stress[4] = stress[5] = 0.0;
}

const OstFormula ost_formula_cylinder = {
    .name = "cylinder",
    .parameter_name = {"inner_radius", "outer_radius", "pressure"},
    .value_name = {"inner_displacement", "outer_displacement", "inner_hoop_stress", "exponent"},
    .prepare = prepare_cylinder,
    .displacement = cylinder,
    .stress = cylinder_stress,
};

/* --- a hollow sphere about the origin --- */

/* Lamé (Timoshenko and Goodier, §136): u_r = p a³ / (E (b³ - a³)) ((1 - 2 nu) r + (1 + nu) b³ / (2 r²));
 * sigma_r = p a³ / (b³ - a³) (1 - b³ / r³), sigma_t = p a³ / (b³ - a³) (1 + b³ / (2 r³)). */
enum { LINEAR, INVERSE_SQUARE, UNIFORM, OUTER_CUBE };

static OstStatus prepare_sphere(const OstCase *c, const double *parameter, OstFormulaData *data)
{
    const OstOrthotropic *o = &c->materials[0].material.constants;
    const double inner = parameter[0], outer = parameter[1], pressure = parameter[2], nu = o->poissons_ratio[0];
    double *k = data->constant;
    OST_TRY(ost_formula_wants(c, c->materials[0].material.isotropic && 0.0 < inner && inner < outer,
                              "an isotropic material, and an inner radius below the outer"));
    const double size = pressure * pow(inner, 3) / (o->youngs_modulus[0] * (pow(outer, 3) - pow(inner, 3)));
    k[LINEAR] = size * (1.0 - 2.0 * nu);
    k[INVERSE_SQUARE] = size * 0.5 * (1.0 + nu) * pow(outer, 3);
    k[UNIFORM] = size * o->youngs_modulus[0];
    k[OUTER_CUBE] = pow(outer, 3);
    data->length = inner;
    data->value[0] = k[LINEAR] * inner + k[INVERSE_SQUARE] / (inner * inner);
    data->value[1] = k[LINEAR] * outer + k[INVERSE_SQUARE] / (outer * outer);
    return OST_SUCCESS;
}

static void sphere(const double *k, const double p[3], double u[3])
{
    const double stretch = k[LINEAR] + k[INVERSE_SQUARE] / pow(ost_norm3(p), 3);
    for (int i = 0; i < 3; i++)
        u[i] = stretch * p[i];
}

static void sphere_stress(const double *k, const double p[3], double stress[6])
{
    const double r = ost_norm3(p), cube = k[OUTER_CUBE] / (r * r * r);
    const double radial = k[UNIFORM] * (1.0 - cube), hoop = k[UNIFORM] * (1.0 + 0.5 * cube);
    for (int i = 0; i < 3; i++) {
        stress[i] = hoop + (radial - hoop) * p[i] * p[i] / (r * r);
        stress[3 + i] = (radial - hoop) * p[i] * p[(i + 1) % 3] / (r * r);
    }
}

const OstFormula ost_formula_sphere = {
    .name = "sphere",
    .parameter_name = {"inner_radius", "outer_radius", "pressure"},
    .value_name = {"inner_displacement", "outer_displacement"},
    .prepare = prepare_sphere,
    .displacement = sphere,
    .stress = sphere_stress,
};
