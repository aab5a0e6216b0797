/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/material_report.h"

#include "core/error.h"
#include "core/json_file.h"

#include <stdio.h>

/* An object or array that could not be made becomes NULL, which jansson's setters pass on as failure. */
static int add_number(json_t *object, const char *key, double value)
{
    return json_object_set_new(object, key, ost_json_number(value));
}

static json_t *numbers(int count, const double *values)
{
    json_t *array = json_array();
    for (int i = 0; i < count; i++)
        if (json_array_append_new(array, json_real(values[i])) != 0) {
            json_decref(array);
            return NULL;
        }
    return array;
}

static json_t *matrix(const double values[36])
{
    json_t *array = json_array();
    for (int i = 0; i < 6; i++)
        if (json_array_append_new(array, numbers(6, values + 6 * i)) != 0) {
            json_decref(array);
            return NULL;
        }
    return array;
}

static json_t *triple(const char *const names[3], const double values[3])
{
    json_t *object = json_object();
    int failed = 0;
    for (int i = 0; i < 3; i++)
        failed |= add_number(object, names[i], values[i]);
    if (!failed)
        return object;
    json_decref(object);
    return NULL;
}

static json_t *stable_range(const OstMaterialReport *report)
{
    static const char *const names[3] = {"nu12", "nu23", "nu31"};
    json_t *object = json_object();
    int failed = add_number(object, "scale", report->scale);
    for (int i = 0; i < 3; i++) {
        const double range[2] = {report->low[i], report->high[i]};
        failed |= json_object_set_new(object, names[i], numbers(2, range));
    }
    const double family[2] = {-1.0, 0.5};
    failed |= json_object_set_new(object, "family_nu", numbers(2, family));
    if (!failed)
        return object;
    json_decref(object);
    return NULL;
}

static int add_turned(json_t *root, const OstMaterialReport *report)
{
    static const char *const youngs[3] = {"Ex", "Ey", "Ez"};
    static const char *const poissons[3] = {"nuxy", "nuyz", "nuzx"};
    static const char *const shear[3] = {"Gxy", "Gyz", "Gzx"};
    json_t *world = json_object();
    int failed = json_object_set_new(world, "axes", numbers(9, report->axes));
    failed |= json_object_set_new(world, "stiffness", matrix(report->turned_stiffness));
    failed |= json_object_set_new(world, "youngs_modulus", triple(youngs, report->turned_constants.youngs_modulus));
    failed |= json_object_set_new(world, "poissons_ratio", triple(poissons, report->turned_constants.poissons_ratio));
    failed |= json_object_set_new(world, "shear_modulus", triple(shear, report->turned_constants.shear_modulus));
    return failed | json_object_set_new(root, "world", world);
}

static int fill(json_t *root, const OstMaterialReport *report)
{
    static const char *const youngs[3] = {"E1", "E2", "E3"};
    static const char *const forward[3] = {"nu12", "nu23", "nu31"};
    static const char *const reverse[3] = {"nu21", "nu32", "nu13"};
    static const char *const shear[3] = {"G12", "G23", "G31"};
    const OstOrthotropic *constants = &report->material.constants;
    json_t *ratios = triple(forward, constants->poissons_ratio);
    json_t *reversed = triple(reverse, report->reverse_ratio);
    int failed = json_object_update(ratios, reversed);
    json_decref(reversed);
    failed |= json_object_set_new(root, "kind", json_string(report->kind));
    failed |= json_object_set_new(root, "youngs_modulus", triple(youngs, constants->youngs_modulus));
    failed |= json_object_set_new(root, "poissons_ratio", ratios);
    failed |= json_object_set_new(root, "shear_modulus", triple(shear, constants->shear_modulus));
    failed |= json_object_set_new(root, "stiffness", matrix(report->material.stiffness));
    failed |= json_object_set_new(root, "compliance", matrix(report->material.compliance));
    failed |= json_object_set_new(root, "stiffness_eigenvalues", numbers(6, report->stiffness_eigenvalues));
    failed |= json_object_set_new(root, "normalised_eigenvalues", numbers(3, report->block_eigenvalues));
    failed |= add_number(root, "condition", report->material.condition);
    failed |= json_object_set_new(root, "stable_range", stable_range(report));
    return report->turned ? failed | add_turned(root, report) : failed;
}

OstStatus ost_material_report_print_json(OstContext *ctx, const OstMaterialReport *report)
{
    json_t *root = json_object();
    if (fill(root, report)) {
        json_decref(root);
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "the material's JSON could not be made");
    }
    return ost_json_write(ctx, root, "-");
}
