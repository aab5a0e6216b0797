/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/veg/veg.h"
#include "orthostat/axes.h"

#include <string.h>

enum { KIND_SIZE = 40 };

/* Kinds of orthotropic lines: how many Poisson's ratios, shear values and entries of the rotation follow density, E1,
 * E2, E3. With one ratio the material is of the stable family, and its shear value is a factor. */
static const struct {
    const char *kind;
    int poissons, shears, rotation;
} orthotropic[] = {{"ORTHOTROPIC", 3, 3, 9},        {"ORTHOTROPIC_N3G3R9", 3, 3, 9}, {"ORTHOTROPIC_N3G3", 3, 3, 0},
                   {"ORTHOTROPIC_N1G1R9", 1, 1, 9}, {"ORTHOTROPIC_N1G1", 1, 1, 0},   {"ORTHOTROPIC_N1R9", 1, 0, 9},
                   {"ORTHOTROPIC_N1", 1, 0, 0}};

enum { ORTHOTROPIC_KINDS = sizeof orthotropic / sizeof *orthotropic };

static const char *const value_name[] = {"density", "E1", "E2", "E3"};
static const char *const three_ratio_name[] = {"nu12", "nu23", "nu31"};
static const char *const three_shear_name[] = {"G12", "G23", "G31"};

/* Puts file and line in front of the current error. */
static OstStatus add_place(const OstLineReader *reader, OstStatus status)
{
    char text[2048];
    if (status != OST_INVALID_INPUT)
        return status;
    strncpy(text, ost_error_text(reader->ctx), sizeof text - 1);
    text[sizeof text - 1] = '\0';
    return OST_RAISE_LINE(reader, "%s", text);
}

static OstStatus add_material(OstVeg *veg, const char *name, const OstOrthotropic *constants, double density,
                              const double axes[9])
{
    const int number = veg->material_names.count;
    OST_TRY(OST_RESIZE(veg->ctx, &veg->material, number + 1));
    OST_TRY(OST_RESIZE(veg->ctx, &veg->axes, 9 * ((size_t)number + 1)));
    OST_TRY(add_place(ost_veg_reader(veg),
                      ost_material_create(veg->ctx, name, constants, density, &veg->material[number])));
    memcpy(veg->axes + 9 * (size_t)number, axes, 9 * sizeof *axes);
    return ost_veg_names_add(veg, &veg->material_names, "*MATERIAL", name);
}

/* Our axes are rows. The file has the rotation row by row, and its columns are the axes. */
static OstStatus read_rotation(OstVeg *veg, const char *name, double axes[9])
{
    static const char *const entry[] = {"R0", "R1", "R2", "R3", "R4", "R5", "R6", "R7", "R8"};
    OstLineReader *reader = ost_veg_reader(veg);
    char what[OST_VEG_NAME_SIZE + 64];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            OST_TRY(ost_lines_number(reader, entry[3 * i + j], &axes[3 * j + i]));
    snprintf(what, sizeof what, "the axes of material '%s' (columns of R)", name);
    return add_place(reader, ost_axes_check(veg->ctx, what, axes));
}

static OstStatus check_family(const OstLineReader *reader, const double youngs_modulus[3], double nu)
{
    for (int i = 0; i < 3; i++)
        if (!(youngs_modulus[i] > 0.0))
            return OST_RAISE_LINE(reader, "E%d is %g, expected a positive number", i + 1, youngs_modulus[i]);
    if (!(nu > -1.0 && nu < 0.5))
        return OST_RAISE_LINE(reader, "nu is %g, expected more than -1 and less than 0.5", nu);
    return OST_SUCCESS;
}

static OstStatus read_values(OstLineReader *reader, int count, const char *const *names, double *values)
{
    for (int i = 0; i < count; i++)
        OST_TRY(ost_lines_number(reader, names[i], &values[i]));
    return OST_SUCCESS;
}

/* One ratio, and perhaps a factor on the shear moduli. */
static OstStatus read_family(OstVeg *veg, int has_factor, OstOrthotropic *constants)
{
    OstLineReader *reader = ost_veg_reader(veg);
    double nu = 0.0, factor = 1.0;
    OST_TRY(ost_lines_number(reader, "nu", &nu));
    if (has_factor)
        OST_TRY(ost_lines_number(reader, "G (a factor on the shear moduli)", &factor));
    OST_TRY(check_family(reader, constants->youngs_modulus, nu));
    *constants = ost_orthotropic_family(constants->youngs_modulus, nu, OST_SHEAR_GEOMETRIC);
    for (int i = 0; i < 3; i++)
        constants->shear_modulus[i] *= factor;
    return OST_SUCCESS;
}

static OstStatus read_orthotropic(OstVeg *veg, const char *name, int kind)
{
    OstLineReader *reader = ost_veg_reader(veg);
    OstOrthotropic constants = {.poissons_ratio = {0.0}};
    double axes[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    double values[4] = {0.0};
    OST_TRY(read_values(reader, 4, value_name, values));
    memcpy(constants.youngs_modulus, values + 1, sizeof constants.youngs_modulus);
    if (orthotropic[kind].poissons == 1) {
        OST_TRY(read_family(veg, orthotropic[kind].shears, &constants));
    } else {
        OST_TRY(read_values(reader, 3, three_ratio_name, constants.poissons_ratio));
        OST_TRY(read_values(reader, 3, three_shear_name, constants.shear_modulus));
    }
    if (orthotropic[kind].rotation)
        OST_TRY(read_rotation(veg, name, axes));
    OST_TRY(ost_lines_finish(reader, "the constants of the material"));
    return add_material(veg, name, &constants, values[0], axes);
}

static OstStatus add_isotropic(OstVeg *veg, const char *name, const double values[3])
{
    const double axes[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    const OstOrthotropic constants = ost_orthotropic_isotropic(values[1], values[2]);
    return add_material(veg, name, &constants, values[0], axes);
}

static OstStatus read_isotropic(OstVeg *veg, const char *name)
{
    static const char *const names[] = {"density", "E", "nu"};
    OstLineReader *reader = ost_veg_reader(veg);
    double values[3];
    OST_TRY(read_values(reader, 3, names, values));
    OST_TRY(ost_lines_finish(reader, "the constants of the material"));
    OST_TRY(check_family(reader, (double[3]){values[1], values[1], values[1]}, values[2]));
    return add_isotropic(veg, name, values);
}

OstStatus ost_veg_material(OstVeg *veg)
{
    char name[OST_VEG_NAME_SIZE], kind[KIND_SIZE];
    OST_TRY(ost_veg_name(veg, "*MATERIAL", name));
    OST_TRY(ost_veg_expect(veg, "the constants of the material are"));
    OstLineReader *reader = ost_veg_reader(veg);
    ost_lines_word(reader, kind, sizeof kind);
    if (strcmp(kind, "ENU") == 0)
        return read_isotropic(veg, name);
    for (int k = 0; k < ORTHOTROPIC_KINDS; k++)
        if (strcmp(kind, orthotropic[k].kind) == 0)
            return read_orthotropic(veg, name, k);
    if (strcmp(kind, "MOONEYRIVLIN") == 0)
        return OST_RAISE_LINE(reader,
                              "material '%s' is MOONEYRIVLIN, which is not linear elastic; give it as ENU or "
                              "ORTHOTROPIC",
                              name);
    return OST_RAISE_LINE(reader,
                          "material '%s' is of kind '%s', expected ENU, ORTHOTROPIC, or ORTHOTROPIC_ with "
                          "N3G3R9, N3G3, N1G1R9, N1G1, N1R9 or N1",
                          name, kind);
}

OstStatus ost_veg_default_material(OstVeg *veg)
{
    const double values[3] = {1000.0, 1e9, 0.45};
    ost_warn(veg->ctx, "%s: has no material; as in Vega FEM, it is isotropic with E = 1e9, nu = 0.45, density 1000",
             veg->reader[0].path);
    return add_isotropic(veg, "default", values);
}
