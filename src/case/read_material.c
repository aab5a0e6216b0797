/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "case/strength/read_strength.h"
#include "case/yaml/message.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

typedef enum { YOUNGS_NUMBER, YOUNGS_THREE, YOUNGS_PLANE } YoungsForm;
typedef enum { POISSONS_NUMBER, POISSONS_NAMED, POISSONS_PLANE } PoissonsForm;
typedef enum { SHEAR_RULE, SHEAR_NAMED, SHEAR_AXIS } ShearForm;

/* The constants as the case states them, before they become nine. */
typedef struct Stated {
    YoungsForm youngs_form;
    PoissonsForm poissons_form;
    ShearForm shear_form;
    double youngs[3];
    double nu;       /* NUMBER; PLANE: in the plane */
    double nu_axis;  /* PLANE: from the plane to the axis, or NAN */
    double named[6]; /* NAMED: 12 21 23 32 31 13, or NAN */
    OstShearRule rule;
    int has_rule;
    double shear[3]; /* NAMED: 12 23 31, or NAN */
    double g_axis;   /* AXIS */
} Stated;

static OstStatus read_youngs(const OstYaml *yaml, const OstYamlNode *node, Stated *stated)
{
    if (ost_yaml_is(yaml, node, OST_YAML_SEQUENCE)) {
        stated->youngs_form = YOUNGS_THREE;
        return ost_yaml_positives(yaml, node, 3, stated->youngs);
    }
    if (ost_yaml_is(yaml, node, OST_YAML_MAPPING)) {
        OstYamlKey keys[] = {{.name = "plane", .needed = 1}, {.name = "axis", .needed = 1}};
        stated->youngs_form = YOUNGS_PLANE;
        OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
        OST_TRY(ost_yaml_positive(yaml, keys[0].value, &stated->youngs[0]));
        stated->youngs[1] = stated->youngs[0];
        return ost_yaml_positive(yaml, keys[1].value, &stated->youngs[2]);
    }
    stated->youngs_form = YOUNGS_NUMBER;
    OST_TRY(ost_yaml_positive(yaml, node, &stated->youngs[0]));
    stated->youngs[1] = stated->youngs[2] = stated->youngs[0];
    return OST_SUCCESS;
}

/* {field: NAME, factor, power, least, ratios}: E is factor × field^power tet by tet, not below `least`; `ratios` are
 * the moduli of the axes over it, in any of the forms above. */
static OstStatus read_youngs_field(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstCaseMaterial *material,
                                   Stated *stated)
{
    enum { FIELD, FACTOR, POWER, LEAST, RATIOS };
    OstModulusField *modulus = &material->modulus;
    OstYamlKey keys[] = {[FIELD] = {.name = "field", .needed = 1},
                         [FACTOR] = {.name = "factor", .read = ost_yaml_positive, .into = &modulus->factor},
                         [POWER] = {.name = "power", .read = ost_yaml_number, .into = &modulus->power},
                         [LEAST] = {.name = "least", .read = ost_yaml_positive, .into = &modulus->least},
                         [RATIOS] = {.name = "ratios"}};
    modulus->factor = modulus->power = 1.0;
    modulus->place = ost_yaml_at(node);
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_read_field(yaml, keys[FIELD].value, OST_CASE_FIELD_OF_NUMBERS, c, &modulus->field));
    if (keys[RATIOS].value)
        return read_youngs(yaml, keys[RATIOS].value, stated);
    stated->youngs_form = YOUNGS_NUMBER;
    stated->youngs[0] = stated->youngs[1] = stated->youngs[2] = 1.0;
    return OST_SUCCESS;
}

static OstStatus read_youngs_or_field(const OstYaml *yaml, const OstYamlNode *node, OstCase *c,
                                      OstCaseMaterial *material, Stated *stated)
{
    return ost_yaml_is(yaml, node, OST_YAML_MAPPING) && ost_yaml_has(yaml, node, "field")
               ? read_youngs_field(yaml, node, c, material, stated)
               : read_youngs(yaml, node, stated);
}

static OstStatus read_poissons(const OstYaml *yaml, const OstYamlNode *node, Stated *stated)
{
    enum { NAMED = 6, PLANE = 6, PLANE_AXIS = 7 };
    OstYamlKey keys[] = {
        {.name = "nu12"},
        {.name = "nu21"},
        {.name = "nu23"},
        {.name = "nu32"},
        {.name = "nu31"},
        {.name = "nu13"},
        [PLANE] = {.name = "plane"},
        [PLANE_AXIS] = {.name = "plane_axis"},
    };
    stated->poissons_form = POISSONS_NUMBER;
    if (ost_yaml_is(yaml, node, OST_YAML_SEQUENCE))
        return ost_yaml_raise(yaml, node,
                              "programs differ in the order of the ratios; give them by name, as {nu12: 0.35, "
                              "nu23: 0.4, nu31: 0.02}, or one number");
    if (!ost_yaml_is(yaml, node, OST_YAML_MAPPING))
        return ost_yaml_number(yaml, node, &stated->nu);
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    int named = 0;
    for (int k = 0; k < NAMED; k++) {
        stated->named[k] = NAN;
        named += keys[k].value != NULL;
        if (keys[k].value)
            OST_TRY(ost_yaml_number(yaml, keys[k].value, &stated->named[k]));
    }
    stated->poissons_form = named > 0 ? POISSONS_NAMED : POISSONS_PLANE;
    if (named > 0 && !keys[PLANE].value && !keys[PLANE_AXIS].value)
        return OST_SUCCESS;
    if (named > 0 || !keys[PLANE].value)
        return ost_yaml_raise(yaml, node,
                              "expected either one each of nu12|nu21, nu23|nu32 and nu31|nu13, or plane and "
                              "perhaps plane_axis");
    if (keys[PLANE_AXIS].value)
        OST_TRY(ost_yaml_number(yaml, keys[PLANE_AXIS].value, &stated->nu_axis));
    return ost_yaml_number(yaml, keys[PLANE].value, &stated->nu);
}

static OstStatus read_shear(const OstYaml *yaml, const OstYamlNode *node, Stated *stated)
{
    static const char *const rules[] = {
        [OST_SHEAR_GEOMETRIC] = "geometric",
        [OST_SHEAR_ARITHMETIC] = "arithmetic",
        [OST_SHEAR_MIN] = "min",
        [OST_SHEAR_MAX] = "max",
    };
    enum { NAMED = 6, AXIS = 6 };
    OstYamlKey keys[] = {
        {.name = "G12"}, {.name = "G21"}, {.name = "G23"},           {.name = "G32"},
        {.name = "G31"}, {.name = "G13"}, [AXIS] = {.name = "axis"},
    };
    if (ost_yaml_is(yaml, node, OST_YAML_SCALAR)) {
        int rule;
        OST_TRY(ost_yaml_word(yaml, node, "shear rule", rules, OST_COUNT_OF(rules), &rule));
        stated->rule = (OstShearRule)rule;
        stated->has_rule = 1;
        return OST_SUCCESS;
    }
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    int named = 0;
    for (int k = 0; k < NAMED; k++) {
        named += keys[k].value != NULL;
        if (keys[k].value && keys[k ^ 1].value)
            return ost_yaml_raise(yaml, keys[k ^ 1].value, "'%s' and '%s' are the same modulus; state one of them",
                                  keys[k].name, keys[k ^ 1].name);
        if (keys[k].value)
            OST_TRY(ost_yaml_positive(yaml, keys[k].value, &stated->shear[k / 2]));
    }
    stated->shear_form = keys[AXIS].value ? SHEAR_AXIS : SHEAR_NAMED;
    if (keys[AXIS].value ? named == 0 : named == 3)
        return keys[AXIS].value ? ost_yaml_positive(yaml, keys[AXIS].value, &stated->g_axis) : OST_SUCCESS;
    return ost_yaml_raise(yaml, node, "expected either G12, G23 and G31 (or G13), or axis alone");
}

/* A transversely isotropic material: Young's moduli of plane and axis; one nu, or two of plane and axis; shear by a
 * rule, or of the axis. */
static OstStatus resolve_transverse(const OstYaml *yaml, const OstYamlNode *node, const Stated *stated,
                                    OstOrthotropic *constants)
{
    double g_axis = stated->shear_form == SHEAR_AXIS ? stated->g_axis : NAN;
    if (stated->poissons_form == POISSONS_NAMED)
        return ost_yaml_raise(
            yaml, node,
            "with youngs_modulus {plane, axis} (the axis is e3), poissons_ratio is a number or {plane, "
            "plane_axis}; for nu12, nu23, nu31 give youngs_modulus as [E1, E2, E3]");
    if (stated->shear_form == SHEAR_NAMED)
        return ost_yaml_raise(
            yaml, node,
            "with youngs_modulus {plane, axis} (the axis is e3), shear_modulus is a rule or {axis: G}; the "
            "plane's follows from its modulus and ratio");
    if (stated->has_rule) {
        double shear[3];
        ost_orthotropic_shear(stated->youngs, stated->nu, stated->rule, shear);
        g_axis = shear[1];
    }
    *constants = ost_orthotropic_transverse(stated->youngs[0], stated->youngs[2], stated->nu, stated->nu_axis, g_axis);
    return OST_SUCCESS;
}

static OstStatus resolve_constants(const OstYaml *yaml, const OstYamlNode *node, const char *what, const Stated *stated,
                                   OstOrthotropic *constants)
{
    if (stated->youngs_form == YOUNGS_PLANE)
        return resolve_transverse(yaml, node, stated, constants);
    if (stated->poissons_form == POISSONS_PLANE)
        return ost_yaml_raise(
            yaml, node, "poissons_ratio {plane, plane_axis} needs youngs_modulus {plane, axis}, where the axis is e3");
    if (stated->shear_form == SHEAR_AXIS)
        return ost_yaml_raise(yaml, node,
                              "shear_modulus {axis} needs youngs_modulus {plane, axis}, where the axis is e3");
    if (stated->poissons_form == POISSONS_NAMED && stated->shear_form != SHEAR_NAMED)
        return ost_yaml_raise(yaml, node,
                              "nu12, nu23 and nu31 need shear_modulus {G12, G23, G31}; the shear rules belong "
                              "to the stable family, which is stated by one number as poissons_ratio");
    if (stated->poissons_form == POISSONS_NAMED)
        return ost_yaml_located(
            yaml, node,
            ost_orthotropic_named(yaml->ctx, what, stated->youngs, stated->named, stated->shear, constants));
    *constants = ost_orthotropic_family(stated->youngs, stated->nu, stated->rule);
    if (stated->youngs_form == YOUNGS_NUMBER && stated->shear_form != SHEAR_NAMED)
        *constants = ost_orthotropic_isotropic(stated->youngs[0], stated->nu);
    if (stated->shear_form == SHEAR_NAMED)
        memcpy(constants->shear_modulus, stated->shear, sizeof stated->shear);
    return OST_SUCCESS;
}

int ost_strain_has_directions(const double strain[6])
{
    return strain[0] != strain[1] || strain[1] != strain[2] || strain[3] != 0.0 || strain[4] != 0.0 || strain[5] != 0.0;
}

/* One number for every direction, three along e1, e2, e3, or six with the shears 12, 23, 31. */
static OstStatus read_strain(const OstYaml *yaml, const OstYamlNode *node, double strain[6])
{
    static const char expected[] = "a strain: one number, three along e1, e2, e3, or six with the shears 12, 23, 31";
    int count = 1;
    if (ost_yaml_is(yaml, node, OST_YAML_SCALAR)) {
        OST_TRY(ost_yaml_number(yaml, node, &strain[0]));
        strain[1] = strain[2] = strain[0];
        return OST_SUCCESS;
    }
    OST_TRY(ost_yaml_list(yaml, node, expected, &count));
    if (count != 3 && count != 6)
        return ost_yaml_raise_type(yaml, node, expected, "");
    return ost_yaml_numbers(yaml, node, count, strain);
}

/* All eigenstrains of a case follow the same function of time. */
static OstStatus agree_with_others(const OstYaml *yaml, const OstYamlNode *node, const OstCaseMaterial *material,
                                   int table, OstCase *c)
{
    for (const OstCaseMaterial *other = c->materials; other < material; other++) {
        if (other->eigenstrained && c->eigen_table != table)
            return ost_yaml_raise(yaml, node,
                                  "this eigenstrain follows another time table than that of region '%.80s' in line %d; "
                                  "give all eigenstrains the same, or none",
                                  other->region, other->line);
    }
    c->eigen_table = table;
    return OST_SUCCESS;
}

int ost_case_find_field(const OstCase *c, const char *name)
{
    for (int f = 0; f < c->field_count; f++)
        if (strcmp(c->fields[f].name, name) == 0)
            return f;
    return -1;
}

OstStatus ost_read_field(const OstYaml *yaml, const OstYamlNode *node, OstCaseFieldUse use, OstCase *c, char **name)
{
    OST_TRY(ost_read_string(yaml, node, name));
    const int known = ost_case_find_field(c, *name);
    if (known >= 0 && c->fields[known].use != use)
        return ost_yaml_raise(yaml, node,
                              "the field '%.80s' stands for directions here or in line %d, and for numbers in "
                              "the other place",
                              *name, c->fields[known].place.line);
    if (known < 0 && c->field_count == OST_MOST_TET_FIELDS)
        return ost_yaml_raise(yaml, node, "a case reads %d fields of the mesh file at most", OST_MOST_TET_FIELDS);
    if (known < 0)
        c->fields[c->field_count++] = (OstCaseField){*name, ost_yaml_at(node), use};
    return OST_SUCCESS;
}

static OstStatus take_eigen_field(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstCaseMaterial *material)
{
    material->eigen_place = ost_yaml_at(node);
    return ost_read_field(yaml, node, OST_CASE_FIELD_OF_NUMBERS, c, &material->eigen_field);
}

/* A number, or {field: NAME}. */
static OstStatus read_change(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstCaseMaterial *material)
{
    double change = 1.0;
    OstYamlKey field = {.name = "field", .needed = 1};
    if (ost_yaml_is(yaml, node, OST_YAML_MAPPING)) {
        material->eigen_per_unit = 1;
        OST_TRY(ost_yaml_mapping(yaml, node, &field, 1));
        return take_eigen_field(yaml, field.value, c, material);
    }
    OST_TRY(ost_yaml_number(yaml, node, &change));
    for (int p = 0; p < 6; p++)
        material->eigenstrain[p] *= change;
    return OST_SUCCESS;
}

enum { VALUE, PER_UNIT, FIELD, EIGEN_FORMS, CHANGE = EIGEN_FORMS, TIME, EIGEN_KEYS };

static OstStatus read_eigenstrain_keys(const OstYaml *yaml, const OstYamlNode *node, OstYamlKey *keys, OstCase *c,
                                       OstCaseMaterial *material)
{
    int form;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, EIGEN_KEYS));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, EIGEN_FORMS, &form));
    if (form == PER_UNIT && !keys[CHANGE].value)
        return ost_yaml_raise(yaml, node, "'per_unit' is a strain for each unit of a change; give the 'change' too");
    if (form != PER_UNIT && keys[CHANGE].value)
        return ost_yaml_raise(yaml, keys[CHANGE].value, "'change' belongs to 'per_unit', not to '%s'", keys[form].name);
    if (form == FIELD)
        return take_eigen_field(yaml, keys[FIELD].value, c, material);
    OST_TRY(read_strain(yaml, keys[form].value, material->eigenstrain));
    return form == PER_UNIT ? read_change(yaml, keys[CHANGE].value, c, material) : OST_SUCCESS;
}

/* A strain; or one for each unit of a change (of temperature, of moisture), and the change; or a field of the file. */
static OstStatus read_eigenstrain(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstCaseMaterial *material)
{
    int table = 0;
    OstYamlKey keys[EIGEN_KEYS] = {[VALUE] = {.name = "value"},
                                   [PER_UNIT] = {.name = "per_unit"},
                                   [FIELD] = {.name = "field"},
                                   [CHANGE] = {.name = "change"},
                                   [TIME] = {.name = "time"}};
    material->eigenstrained = 1;
    if (ost_yaml_is(yaml, node, OST_YAML_MAPPING))
        OST_TRY(read_eigenstrain_keys(yaml, node, keys, c, material));
    else
        OST_TRY(read_strain(yaml, node, material->eigenstrain));
    if (keys[TIME].value)
        OST_TRY(ost_read_time(yaml, keys[TIME].value, c, &table));
    if (ost_strain_has_directions(material->eigenstrain) || (material->eigen_field && !material->eigen_per_unit))
        material->material.isotropic = 0;
    return agree_with_others(yaml, node, material, table, c);
}

/* Are an eigenstrain and strengths the same in all directions across an axis? */
static int is_same_across(const OstCaseMaterial *material, int axis)
{
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    const double *e = material->eigenstrain;
    const OstStrength *s = &material->material.strength;
    const int strain = e[a] == e[b] && e[3] == 0.0 && e[4] == 0.0 && e[5] == 0.0 &&
                       (!material->eigen_field || material->eigen_per_unit);
    return strain && s->tension[a] == s->tension[b] && s->compression[a] == s->compression[b] &&
           s->shear[axis] == s->shear[b] && s->interaction[axis] == s->interaction[b];
}

/* One direction is enough where the material is transversely isotropic about it. */
static OstStatus check_single(const OstYaml *yaml, const OstYamlNode *node, const OstCaseMaterial *material)
{
    const int axis = material->axes.single - 1;
    char moduli[OST_MODULI_WORDS];
    if (axis < 0 || material->material.isotropic ||
        (ost_orthotropic_is_transverse(&material->material.constants, axis) && is_same_across(material, axis)))
        return OST_SUCCESS;
    ost_orthotropic_words(&material->material.constants, moduli);
    return ost_yaml_raise(yaml, node,
                          "e%d alone does not place a material that differs across it too, in its moduli (%s), "
                          "eigenstrain or strengths; give e1 and e2",
                          axis + 1, moduli);
}

/* axes, or the fibre of a transversely isotropic material. Without either it lies along the world's axes, which is said
 * where the case calls one direction the axis. */
static OstStatus read_directions(const OstYaml *yaml, const OstYamlNode *axes, const OstYamlNode *fibre,
                                 const Stated *stated, OstCase *c, OstCaseMaterial *material)
{
    if (axes && fibre)
        return ost_yaml_raise(yaml, fibre, "give the fibre, or the axes, not both");
    if (fibre && stated->youngs_form != YOUNGS_PLANE)
        return ost_yaml_raise(yaml, fibre,
                              "a fibre belongs to youngs_modulus: {plane: E, axis: E}, whose axis it is; "
                              "for other moduli give axes");
    if (fibre) {
        OST_TRY(ost_read_fibre(yaml, fibre, c, &material->axes));
        return check_single(yaml, fibre, material);
    }
    if (axes) {
        OST_TRY(ost_read_axes(yaml, axes, material->region, c, &material->axes));
        return check_single(yaml, axes, material);
    }
    if (stated->youngs_form == YOUNGS_PLANE)
        ost_warn(yaml->ctx,
                 "%s:%d: the axis of region '%.80s' lies along z, as nothing else is said; state it: fibre: [0, 0, 1]",
                 c->path, material->line, material->region);
    return OST_SUCCESS;
}

/* Near 1/2 the family's one ratio keeps sqrt(E1) e11 + sqrt(E2) e22 + sqrt(E3) e33, which is the volume of equal moduli
 * alone. */
static void warn_of_volume(const OstYaml *yaml, const OstYamlNode *node, const Stated *stated, const char *what)
{
    const double *e = stated->youngs;
    double change = 0.0;
    int axis = 0;
    for (int i = 0; i < 3; i++) {
        const double here = 1.0 - stated->nu * (sqrt(e[i] / e[(i + 1) % 3]) + sqrt(e[i] / e[(i + 2) % 3]));
        if (fabs(here) > fabs(change)) {
            change = here;
            axis = i;
        }
    }
    if (stated->nu >= 0.49 && fabs(change) > 0.1)
        ost_warn(yaml->ctx,
                 "%s:%d: %s: one ratio near 1/2 keeps the volume of equal moduli alone: stretched along e%d, this "
                 "material's changes by %.2g times the strain; ratios that keep it are in docs/case.md, Volume",
                 yaml->path, ost_yaml_line(node), what, axis + 1, change);
}

static OstStatus read_material(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstCaseMaterial *material)
{
    enum { REGION, YOUNGS, POISSONS, SHEAR, DENSITY, AXES, FIBRE, EIGENSTRAIN, STRENGTHS };
    OstYamlKey keys[] = {
        [REGION] = {.name = "region", .needed = 1},
        [YOUNGS] = {.name = "youngs_modulus", .needed = 1},
        [POISSONS] = {.name = "poissons_ratio", .needed = 1},
        [SHEAR] = {.name = "shear_modulus"},
        [DENSITY] = {.name = "density"},
        [AXES] = {.name = "axes"},
        [FIBRE] = {.name = "fibre"},
        [EIGENSTRAIN] = {.name = "eigenstrain"},
        [STRENGTHS] = {.name = "strengths"},
    };
    Stated stated = {.nu_axis = NAN};
    OstOrthotropic constants;
    double density = 0.0;
    char what[128];
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_read_string(yaml, keys[REGION].value, &material->region));
    material->line = ost_yaml_line(node);
    material->region_place = ost_yaml_at(keys[REGION].value);
    material->axes_place = ost_yaml_at(keys[AXES].value    ? keys[AXES].value
                                       : keys[FIBRE].value ? keys[FIBRE].value
                                                           : node);
    snprintf(what, sizeof what, "region '%.80s'", material->region);
    OST_TRY(read_youngs_or_field(yaml, keys[YOUNGS].value, c, material, &stated));
    OST_TRY(read_poissons(yaml, keys[POISSONS].value, &stated));
    if (keys[SHEAR].value)
        OST_TRY(read_shear(yaml, keys[SHEAR].value, &stated));
    if (keys[DENSITY].value)
        OST_TRY(ost_yaml_number(yaml, keys[DENSITY].value, &density));
    if (!(density >= 0.0))
        return ost_yaml_raise_type(yaml, keys[DENSITY].value, "a density, 0 or above", "");
    OST_TRY(resolve_constants(yaml, keys[POISSONS].value, what, &stated, &constants));
    OST_TRY(
        ost_yaml_located(yaml, keys[POISSONS].value,
                         ost_material_create(yaml->ctx, material->region, &constants, density, &material->material)));
    if (stated.poissons_form == POISSONS_NUMBER)
        warn_of_volume(yaml, keys[POISSONS].value, &stated, what);
    if (keys[EIGENSTRAIN].value)
        OST_TRY(read_eigenstrain(yaml, keys[EIGENSTRAIN].value, c, material));
    if (keys[STRENGTHS].value)
        OST_TRY(ost_read_strength(yaml, keys[STRENGTHS].value, &material->material.strength));
    if (ost_strength_has_directions(&material->material.strength)) /* as of an eigenstrain */
        material->material.isotropic = 0;
    return read_directions(yaml, keys[AXES].value, keys[FIBRE].value, &stated, c, material);
}

/* An entry of which later ones leave nothing: its author likely took the first to count. */
static void warn_overridden(const OstCase *c)
{
    for (int i = 0; i < c->material_count; i++)
        for (int later = i + 1; later < c->material_count; later++) {
            const char *region = c->materials[i].region, *other = c->materials[later].region;
            if (!ost_is_every_region(other) && strcmp(region, other) != 0)
                continue;
            ost_warn(
                c->ctx,
                "%s:%d: the material of region '%.80s' is nowhere, as the later one in line %d stands for '%.80s'; "
                "put that before it",
                c->path, c->materials[i].line, region, c->materials[later].line, other);
            break;
        }
}

OstStatus ost_read_materials(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    int count;
    OST_TRY(ost_yaml_short_list(yaml, node, "a list of materials (- region: all ...)", &count));
    OST_TRY(OST_NEW(yaml->ctx, &c->materials, count));
    c->material_count = count;
    for (int i = 0; i < count; i++)
        c->materials[i].axes = (OstAxesSpec){
            .fixed = {1, 0, 0, 0, 1, 0, 0, 0, 1}, .axis = {0, 0, 1}, .order = {OST_AXIAL, OST_RADIAL, OST_TANGENTIAL}};
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item))
        OST_TRY(read_material(yaml, item, c, &c->materials[i]));
    warn_overridden(c);
    return OST_SUCCESS;
}
