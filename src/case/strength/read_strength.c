/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/strength/read_strength.h"

#include "case/yaml/message.h"
#include "core/error.h"

#include <math.h>
#include <string.h>

/* One number in every direction, three along e1, e2, e3, or {plane, axis} with the axis along e3. */
static OstStatus read_normal(const OstYaml *yaml, const OstYamlNode *node, double strength[3])
{
    OstYamlKey keys[] = {{.name = "plane", .needed = 1}, {.name = "axis", .needed = 1}};
    if (ost_yaml_is(yaml, node, OST_YAML_SEQUENCE))
        return ost_yaml_positives(yaml, node, 3, strength);
    if (ost_yaml_is(yaml, node, OST_YAML_MAPPING)) {
        OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
        OST_TRY(ost_yaml_positive(yaml, keys[0].value, &strength[0]));
        strength[1] = strength[0];
        return ost_yaml_positive(yaml, keys[1].value, &strength[2]);
    }
    OST_TRY(ost_yaml_positive(yaml, node, &strength[0]));
    strength[1] = strength[2] = strength[0];
    return OST_SUCCESS;
}

static OstStatus read_named_shear(const OstYaml *yaml, const OstYamlNode *node, double shear[3])
{
    enum { NAMED = 6, PLANE = NAMED, AXIS };
    OstYamlKey keys[] = {
        {.name = "S12"},
        {.name = "S21"},
        {.name = "S23"},
        {.name = "S32"},
        {.name = "S31"},
        {.name = "S13"},
        [PLANE] = {.name = "plane"},
        [AXIS] = {.name = "axis"},
    };
    int named = 0;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    for (int k = 0; k < NAMED; k++) {
        named += keys[k].value != NULL;
        if (keys[k].value && keys[k ^ 1].value)
            return ost_yaml_raise(yaml, keys[k ^ 1].value, "'%s' and '%s' are the same strength; state one of them",
                                  keys[k].name, keys[k ^ 1].name);
        if (keys[k].value)
            OST_TRY(ost_yaml_positive(yaml, keys[k].value, &shear[k / 2]));
    }
    if (named == 3 && !keys[PLANE].value && !keys[AXIS].value)
        return OST_SUCCESS;
    if (named > 0 || !keys[PLANE].value || !keys[AXIS].value)
        return ost_yaml_raise(yaml, node,
                              "expected either S12, S23 and S31 (or S13), or plane (S12) and axis (S23 and S31)");
    OST_TRY(ost_yaml_positive(yaml, keys[PLANE].value, &shear[0]));
    OST_TRY(ost_yaml_positive(yaml, keys[AXIS].value, &shear[1]));
    shear[2] = shear[1];
    return OST_SUCCESS;
}

static int is_one_number(const double x[3])
{
    return x[0] == x[1] && x[1] == x[2];
}

/* Left out, that of an isotropic material, whose strength is the same in all directions: Tsai and Wu's form is then von
 * Mises's where tension and compression are alike. */
static OstStatus read_shear(const OstYaml *yaml, const OstYamlNode *node, const OstYamlNode *shear,
                            OstStrength *strength)
{
    if (shear && ost_yaml_is(yaml, shear, OST_YAML_MAPPING))
        return read_named_shear(yaml, shear, strength->shear);
    if (shear)
        OST_TRY(ost_yaml_positive(yaml, shear, &strength->shear[0]));
    else if (is_one_number(strength->tension) && is_one_number(strength->compression))
        strength->shear[0] = sqrt(strength->tension[0] * strength->compression[0] / 3.0);
    else
        return ost_yaml_raise(yaml, node,
                              "the strengths have directions, and 'shear' is missing; give it, as in shear: {S12: 8e6, "
                              "S23: 3e6, S31: 8e6}");
    strength->shear[1] = strength->shear[2] = strength->shear[0];
    return OST_SUCCESS;
}

static OstStatus read_interaction(const OstYaml *yaml, const OstYamlNode *node, double interaction[3])
{
    OstYamlKey keys[] = {{.name = "f12", .needed = 1}, {.name = "f23", .needed = 1}, {.name = "f31", .needed = 1}};
    if (!ost_yaml_is(yaml, node, OST_YAML_MAPPING)) {
        OST_TRY(ost_yaml_number(yaml, node, &interaction[0]));
        interaction[1] = interaction[2] = interaction[0];
        return OST_SUCCESS;
    }
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    for (int k = 0; k < OST_COUNT_OF(keys); k++)
        OST_TRY(ost_yaml_number(yaml, keys[k].value, &interaction[k]));
    return OST_SUCCESS;
}

OstStatus ost_read_strength(const OstYaml *yaml, const OstYamlNode *node, OstStrength *strength)
{
    enum { TENSION, COMPRESSION, SHEAR, INTERACTION };
    OstYamlKey keys[] = {[TENSION] = {.name = "tension", .needed = 1},
                         [COMPRESSION] = {.name = "compression"},
                         [SHEAR] = {.name = "shear"},
                         [INTERACTION] = {.name = "interaction"}};
    *strength = (OstStrength){.known = 1, .interaction = {-0.5, -0.5, -0.5}};
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(read_normal(yaml, keys[TENSION].value, strength->tension));
    memcpy(strength->compression, strength->tension, sizeof strength->tension);
    if (keys[COMPRESSION].value)
        OST_TRY(read_normal(yaml, keys[COMPRESSION].value, strength->compression));
    OST_TRY(read_shear(yaml, node, keys[SHEAR].value, strength));
    if (keys[INTERACTION].value)
        OST_TRY(read_interaction(yaml, keys[INTERACTION].value, strength->interaction));
    if (ost_criterion_is_open(strength, OST_TSAI_WU))
        return ost_yaml_raise(yaml, keys[INTERACTION].value,
                              "with these interactions Tsai and Wu's criterion lets some stresses grow without end; "
                              "take smaller ones (-0.5 is usual), or leave 'interaction' out");
    if (ost_criterion_is_open(strength, OST_HILL))
        ost_warn(yaml->ctx,
                 "%s:%d: the strengths along the axes differ so much that Hill's criterion lets some stresses grow "
                 "without end; go by tsai_wu_load_factor and maximum_stress_load_factor",
                 yaml->path, ost_yaml_line(node));
    return OST_SUCCESS;
}
