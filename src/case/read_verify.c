/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/verify.h"

#include "case/sections.h"
#include "case/yaml/message.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

/* The pairs of a mapping, names and values, in the order of the file. */
static int pair_count(const OstYaml *yaml, const OstYamlNode *node)
{
    return (int)ost_yaml_follow(yaml, node)->value;
}

static OstStatus read_parameters(const OstYaml *yaml, const OstYamlNode *node, OstVerify *verify)
{
    if (!ost_yaml_is(yaml, node, OST_YAML_MAPPING))
        return ost_yaml_raise_type(yaml, node, "the formula's parameters by name, as in {force: 1}", "");
    const int count = pair_count(yaml, node);
    if (count > OST_MOST_FORMULA_PARAMETERS)
        return ost_yaml_raise(yaml, node, "found %d parameters, expected at most %d", count,
                              OST_MOST_FORMULA_PARAMETERS);
    const OstYamlNode *key = ost_yaml_first(yaml, node);
    for (int p = 0; p < count; p++) {
        const OstYamlNode *value = ost_yaml_next(yaml, key);
        OST_TRY(ost_read_string(yaml, key, &verify->parameter_name[p]));
        verify->parameter_count = p + 1;
        OST_TRY(ost_yaml_number(yaml, value, &verify->parameter[p]));
        key = ost_yaml_next(yaml, value);
    }
    return OST_SUCCESS;
}

static OstStatus read_levels(const OstYaml *yaml, const OstYamlNode *node, OstVerifyStep *step)
{
    OST_TRY(ost_yaml_list(yaml, node, "a list of refinements, as in [0, 1, 2]", &step->level_count));
    if (step->level_count < 1 || step->level_count > OST_MOST_VERIFY_LEVELS)
        return ost_yaml_raise(yaml, node, "found %d refinements, expected 1 to %d", step->level_count,
                              OST_MOST_VERIFY_LEVELS);
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < step->level_count; i++, item = ost_yaml_next(yaml, item)) {
        int64_t refinement;
        OST_TRY(ost_yaml_integer(yaml, item, 0, 8, &refinement));
        step->refinement[i] = (int)refinement;
        if (i > 0 && step->refinement[i] != step->refinement[i - 1] + 1)
            return ost_yaml_raise(yaml, item, "found refinement %d after %d, expected %d: each mesh halves the last",
                                  step->refinement[i], step->refinement[i - 1], step->refinement[i - 1] + 1);
    }
    return OST_SUCCESS;
}

static OstStatus read_step(const OstYaml *yaml, const OstYamlNode *node, OstVerifyStep *step)
{
    enum { ORDER, REFINEMENTS, QUICK };
    OstYamlKey keys[] = {
        [ORDER] = {.name = "order", .needed = 1},
        [REFINEMENTS] = {.name = "refinements", .needed = 1},
        [QUICK] = {.name = "quick"},
    };
    int64_t number;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_integer(yaml, keys[ORDER].value, 1, 2, &number));
    step->order = (int)number;
    OST_TRY(read_levels(yaml, keys[REFINEMENTS].value, step));
    step->quick_count = step->level_count;
    if (!keys[QUICK].value)
        return OST_SUCCESS;
    OST_TRY(ost_yaml_integer(yaml, keys[QUICK].value, 0, step->level_count, &number));
    step->quick_count = (int)number;
    return OST_SUCCESS;
}

static OstStatus read_ladder(const OstYaml *yaml, const OstYamlNode *node, OstVerify *verify)
{
    int count;
    OST_TRY(ost_yaml_list(yaml, node, "a list of steps, as in - {order: 1, refinements: [0, 1, 2]}", &count));
    if (count < 1 || count > OST_MOST_VERIFY_STEPS)
        return ost_yaml_raise(yaml, node, "found %d steps, expected 1 to %d", count, OST_MOST_VERIFY_STEPS);
    verify->step_count = count;
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item))
        OST_TRY(read_step(yaml, item, &verify->step[i]));
    return OST_SUCCESS;
}

static OstStatus read_along(const OstYaml *yaml, const OstYamlNode *node, OstVerifyQuantity *quantity)
{
    static const char *const words[] = {
        [OST_ALONG_CYLINDER_RADIUS - 1] = "cylinder_radius",
        [OST_ALONG_SPHERE_RADIUS - 1] = "sphere_radius",
    };
    int word;
    if (ost_yaml_is(yaml, node, OST_YAML_SEQUENCE))
        return ost_yaml_direction(yaml, node, quantity->direction);
    OST_TRY(ost_yaml_word(yaml, node, "direction", words, OST_COUNT_OF(words), &word));
    quantity->along = (OstAlong)(word + 1);
    return OST_SUCCESS;
}

static OstStatus read_component(const OstYaml *yaml, const OstYamlNode *node, OstVerifyQuantity *quantity)
{
    static const char *const words[] = {
        [OST_STRESS_XX] = "xx", [OST_STRESS_YY] = "yy", [OST_STRESS_ZZ] = "zz",         [OST_STRESS_XY] = "xy",
        [OST_STRESS_YZ] = "yz", [OST_STRESS_ZX] = "zx", [OST_STRESS_RADIAL] = "radial", [OST_STRESS_HOOP] = "hoop",
    };
    int word;
    OST_TRY(ost_yaml_word(yaml, node, "component of stress", words, OST_COUNT_OF(words), &word));
    quantity->component = (OstStressComponent)word;
    return OST_SUCCESS;
}

static OstStatus read_energy(const OstYaml *yaml, const OstYamlNode *node, OstVerifyQuantity *quantity)
{
    static const char *const words[] = {"strain"};
    int word;
    (void)quantity;
    return ost_yaml_word(yaml, node, "energy", words, 1, &word);
}

static OstStatus read_norm(const OstYaml *yaml, const OstYamlNode *node, OstVerifyQuantity *quantity)
{
    static const char *const words[] = {
        [OST_NORM_DISPLACEMENT] = "displacement", [OST_NORM_ENERGY] = "energy", [OST_NORM_PRESSURE] = "pressure"};
    int word;
    OST_TRY(ost_yaml_word(yaml, node, "norm", words, OST_COUNT_OF(words), &word));
    quantity->norm = (OstFieldNorm)word;
    return OST_SUCCESS;
}

/* One positive number for each step. If words are allowed, `exact` is read as NAN (the elements contain
 * the solution) and `locks` as OST_RATE_LOCKED. */
static OstStatus read_limits(const OstYaml *yaml, const OstYamlNode *node, const OstVerify *verify, int words_allowed,
                             double *limits)
{
    int count;
    OST_TRY(ost_yaml_list(yaml, node, "a list with one limit for each step of the ladder", &count));
    if (count != verify->step_count)
        return ost_yaml_raise(yaml, node, "found %d limits, expected %d: one for each step of the ladder", count,
                              verify->step_count);
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item)) {
        const char *text = "";
        if (words_allowed && ost_yaml_is(yaml, item, OST_YAML_SCALAR))
            OST_TRY(ost_yaml_text(yaml, item, &text));
        limits[i] = strcmp(text, "exact") == 0 ? NAN : OST_RATE_LOCKED;
        if (strcmp(text, "exact") != 0 && strcmp(text, "locks") != 0)
            OST_TRY(ost_yaml_positive(yaml, item, &limits[i]));
    }
    return OST_SUCCESS;
}

static OstStatus read_expected(const OstYaml *yaml, const OstYamlNode *node, OstVerifyQuantity *quantity)
{
    const char *text;
    OST_TRY(ost_yaml_text(yaml, node, &text));
    return strspn(text, "0123456789+-.") > 0 ? ost_yaml_number(yaml, node, &quantity->expected)
                                             : ost_read_string(yaml, node, &quantity->expected_name);
}

enum { MEASURES = OST_MEASURE_FIELD + 1, ON = MEASURES, EXPECTED, SCALE, ERROR, RATE, QUANTITY_KEYS };

/* Refuses keys that the measure does not have, and asks for those it needs. */
static OstStatus check_keys(const OstYaml *yaml, const OstYamlNode *node, const OstYamlKey *keys, OstMeasureKind kind)
{
    const int whole = kind == OST_MEASURE_FIELD || kind == OST_MEASURE_ENERGY;
    if (whole && keys[ON].value)
        return ost_yaml_raise(yaml, keys[ON].value, "'%s' is measured over the whole body and has no 'on'",
                              keys[kind].name);
    if (!whole && !keys[ON].value)
        return ost_yaml_raise(yaml, node, "'%s' needs 'on': where it is measured", keys[kind].name);
    if (kind == OST_MEASURE_FIELD && (keys[EXPECTED].value || keys[SCALE].value))
        return ost_yaml_raise(yaml, node,
                              "'field' is compared with the formula's field, and has no 'expected' or 'scale'");
    if (kind != OST_MEASURE_FIELD && !keys[EXPECTED].value)
        return ost_yaml_raise(yaml, node, "'%s' needs 'expected': a value of the formula by name, or a number",
                              keys[kind].name);
    return OST_SUCCESS;
}

static OstStatus read_quantity(const OstYaml *yaml, const OstYamlNode *node, const OstVerify *verify,
                               OstVerifyQuantity *quantity)
{
    OstYamlKey keys[QUANTITY_KEYS] = {
        [OST_MEASURE_DISPLACEMENT] = {.name = "displacement"},
        [OST_MEASURE_STRESS] = {.name = "stress"},
        [OST_MEASURE_REACTION] = {.name = "reaction"},
        [OST_MEASURE_ENERGY] = {.name = "energy"},
        [OST_MEASURE_FIELD] = {.name = "field"},
        [ON] = {.name = "on"},
        [EXPECTED] = {.name = "expected"},
        [SCALE] = {.name = "scale"},
        [ERROR] = {.name = "error", .needed = 1},
        [RATE] = {.name = "rate", .needed = 1},
    };
    OstStatus (*const read[MEASURES])(const OstYaml *, const OstYamlNode *, OstVerifyQuantity *) = {
        read_along, read_component, read_along, read_energy, read_norm};
    int kind;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, QUANTITY_KEYS));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, MEASURES, &kind));
    quantity->kind = (OstMeasureKind)kind;
    quantity->line = ost_yaml_line(node);
    quantity->scale = 1.0;
    OST_TRY(check_keys(yaml, node, keys, quantity->kind));
    OST_TRY(read[kind](yaml, keys[kind].value, quantity));
    if (keys[ON].value)
        OST_TRY(ost_read_selection(yaml, keys[ON].value, &quantity->on));
    if (keys[SCALE].value)
        OST_TRY(ost_yaml_number(yaml, keys[SCALE].value, &quantity->scale));
    if (keys[EXPECTED].value)
        OST_TRY(read_expected(yaml, keys[EXPECTED].value, quantity));
    OST_TRY(read_limits(yaml, keys[ERROR].value, verify, 0, quantity->error));
    return read_limits(yaml, keys[RATE].value, verify, 1, quantity->rate);
}

static OstStatus read_quantities(const OstYaml *yaml, const OstYamlNode *node, OstVerify *verify)
{
    if (!ost_yaml_is(yaml, node, OST_YAML_MAPPING) || pair_count(yaml, node) < 1)
        return ost_yaml_raise_type(yaml, node, "a name for each quantity, as in tip: {displacement: [0, 0, 1], ...}",
                                   "");
    const int count = pair_count(yaml, node);
    OST_TRY(OST_NEW(yaml->ctx, &verify->quantity, count));
    verify->quantity_count = count;
    const OstYamlNode *key = ost_yaml_first(yaml, node);
    for (int q = 0; q < count; q++) {
        const OstYamlNode *value = ost_yaml_next(yaml, key);
        OST_TRY(ost_read_string(yaml, key, &verify->quantity[q].name));
        OST_TRY(read_quantity(yaml, value, verify, &verify->quantity[q]));
        key = ost_yaml_next(yaml, value);
    }
    return OST_SUCCESS;
}

OstStatus ost_read_verify(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    enum { FORMULA, SOURCE, PARAMETERS, LADDER, QUANTITIES };
    OstYamlKey keys[] = {
        [FORMULA] = {.name = "formula", .needed = 1},
        [SOURCE] = {.name = "source", .needed = 1},
        [PARAMETERS] = {.name = "parameters"},
        [LADDER] = {.name = "ladder", .needed = 1},
        [QUANTITIES] = {.name = "quantities", .needed = 1},
    };
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(OST_NEW(yaml->ctx, &c->verify, 1));
    OstVerify *verify = c->verify;
    verify->line = ost_yaml_line(node);
    OST_TRY(ost_read_string(yaml, keys[FORMULA].value, &verify->formula));
    OST_TRY(ost_read_string(yaml, keys[SOURCE].value, &verify->source));
    if (keys[PARAMETERS].value)
        OST_TRY(read_parameters(yaml, keys[PARAMETERS].value, verify));
    OST_TRY(read_ladder(yaml, keys[LADDER].value, verify));
    return read_quantities(yaml, keys[QUANTITIES].value, verify);
}

void ost_verify_release(OstVerify **verify)
{
    if (!*verify)
        return;
    OST_FREE((*verify)->formula, (*verify)->source);
    for (int p = 0; p < OST_MOST_FORMULA_PARAMETERS; p++)
        OST_FREE((*verify)->parameter_name[p]);
    for (int q = 0; q < (*verify)->quantity_count; q++) {
        OST_FREE((*verify)->quantity[q].name, (*verify)->quantity[q].expected_name);
        ost_selection_release(&(*verify)->quantity[q].on);
    }
    OST_FREE((*verify)->quantity);
    OST_FREE(*verify);
}
