/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "case/yaml/message.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <string.h>

static OstStatus read_component(const OstYaml *yaml, const OstYamlKey *key, OstWatch *watch)
{
    static const char *const words[] = {"x", "y", "z", [OST_WATCH_LENGTH] = "length"};
    return key->value ? ost_yaml_word(yaml, key->value, "component", words, OST_COUNT_OF(words), &watch->component)
                      : OST_SUCCESS;
}

/* At a point, or of the tets of a region. */
static OstStatus read_stress(const OstYaml *yaml, const OstYamlNode *node, OstWatch *watch)
{
    enum { AT, REGION };
    OstYamlKey keys[] = {[AT] = {.name = "at"}, [REGION] = {.name = "region"}};
    int form;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, OST_COUNT_OF(keys), &form));
    if (form == AT)
        return ost_yaml_vector(yaml, keys[AT].value, watch->at);
    watch->region_place = ost_yaml_at(keys[REGION].value);
    return ost_read_string(yaml, keys[REGION].value, &watch->region);
}

static OstStatus read_stress_keys(const OstYaml *yaml, const OstYamlNode *node, const OstYamlNode *stress,
                                  const OstYamlNode *component, const OstYamlNode *take, OstWatch *watch)
{
#define MEASURE_WORD(name, word) [name] = word,
    static const char *const words[] = {OST_STRESS_MEASURE_TABLE(MEASURE_WORD)};
#undef MEASURE_WORD
    static const char *const takes[] = {
        [OST_TAKE_MEAN] = "mean", [OST_TAKE_LEAST] = "least", [OST_TAKE_LARGEST] = "largest"};
    int which = OST_TAKE_MEAN;
    if (!component)
        return ost_yaml_raise(yaml, node, "a stress has many numbers; say which, as in component: von_mises");
    OST_TRY(ost_yaml_word(yaml, component, "component", words, OST_STRESS_MEASURES, &watch->component));
    OST_TRY(read_stress(yaml, stress, watch));
    if (take && !watch->region)
        return ost_yaml_raise(yaml, take, "'take' is of the tets of a region; at a point there is one stress");
    if (take)
        OST_TRY(ost_yaml_word(yaml, take, "value", takes, OST_COUNT_OF(takes), &which));
    watch->take = (OstTake)which;
    return OST_SUCCESS;
}

/* The least of a region. */
static OstStatus read_load_factor(const OstYaml *yaml, const OstYamlNode *node, const OstYamlNode *criterion,
                                  OstWatch *watch)
{
    static const char *const words[] = {[OST_TSAI_WU] = "tsai_wu",
                                        [OST_HILL] = "hill",
                                        [OST_MAXIMUM_STRESS] = "maximum_stress",
                                        [OST_CRITERIA] = "least"};
    OstYamlKey keys[] = {{.name = "region", .needed = 1}};
    watch->component = OST_CRITERIA;
    watch->take = OST_TAKE_LEAST;
    if (criterion)
        OST_TRY(ost_yaml_word(yaml, criterion, "criterion", words, OST_COUNT_OF(words), &watch->component));
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    watch->region_place = ost_yaml_at(keys[0].value);
    return ost_read_string(yaml, keys[0].value, &watch->region);
}

/* Keys that belong to one kind alone. */
static OstStatus check_keys(const OstYaml *yaml, const OstYamlNode *take, const OstYamlNode *criterion,
                            const OstYamlNode *component, const OstWatch *watch)
{
    if (take && watch->kind != OST_WATCH_STRESS)
        return ost_yaml_raise(yaml, take, "'take' belongs to the stress of a region");
    if (criterion && watch->kind != OST_WATCH_LOAD_FACTOR)
        return ost_yaml_raise(yaml, criterion, "'criterion' belongs to a load factor");
    if (component && watch->kind == OST_WATCH_LOAD_FACTOR)
        return ost_yaml_raise(yaml, component, "a load factor has no component; it may have a 'criterion'");
    return OST_SUCCESS;
}

/* A quantity must be the same at every refinement: a vertex is, the mean over selected vertices is not. */
static OstStatus read_displacement(const OstYaml *yaml, const OstYamlNode *node, OstWatch *watch)
{
    OST_TRY(ost_read_selection(yaml, node, &watch->on));
    return watch->on.kind == OST_SELECT_NEAREST
               ? OST_SUCCESS
               : ost_yaml_raise(yaml, node,
                                "a displacement is taken at one vertex, as in {nearest: [1, 0, 0]}; found another "
                                "selection");
}

/* The short form of a quantity: one word. */
static OstStatus read_word(const OstYaml *yaml, const OstYamlNode *node, OstWatch *watch)
{
    const char *word;
    OST_TRY(ost_yaml_text(yaml, node, &word));
    if (strcmp(word, "strain_energy") != 0)
        return ost_yaml_raise_type(
            yaml, node, "strain_energy, {displacement: {nearest: [x, y, z]}} or {reaction: {boundary: name}}", "");
    watch->kind = OST_WATCH_STRAIN_ENERGY;
    return OST_SUCCESS;
}

/* The strain energy has no component, and is of the whole body. */
static OstStatus read_energy(const OstYaml *yaml, const OstYamlNode *node, const OstYamlNode *component)
{
    static const char *const words[] = {"all"};
    int which;
    if (component)
        return ost_yaml_raise(yaml, component, "the strain energy has no component; leave it out");
    return ost_yaml_word(yaml, node, "strain_energy", words, OST_COUNT_OF(words), &which);
}

static OstStatus read_expected(const OstYaml *yaml, const OstYamlNode *expected, const OstYamlNode *source,
                               OstWatch *watch)
{
    if (expected)
        OST_TRY(ost_yaml_number(yaml, expected, &watch->expected));
    else if (source)
        return ost_yaml_raise(yaml, source, "found a source but no value; give it too, as expected: 0.25");
    return source ? ost_read_string(yaml, source, &watch->source) : OST_SUCCESS;
}

/* With a point, the moment of the reactions about it is watched in place of their sum. */
static OstStatus read_about(const OstYaml *yaml, const OstYamlNode *about, OstWatch *watch)
{
    if (about && watch->kind != OST_WATCH_REACTION)
        return ost_yaml_raise(yaml, about, "'about' belongs to a reaction, of which it asks for the moment");
    watch->of_moment = about != NULL;
    return about ? ost_yaml_numbers(yaml, about, 3, watch->about) : OST_SUCCESS;
}

static OstStatus read_watch(const OstYaml *yaml, const OstYamlNode *node, OstWatch *watch)
{
    enum { FORMS = OST_WATCH_LOAD_FACTOR + 1, COMPONENT = FORMS, TAKE, CRITERION, ABOUT, EXPECTED, SOURCE };
    OstYamlKey keys[] = {
        [OST_WATCH_DISPLACEMENT] = {.name = "displacement"},
        [OST_WATCH_REACTION] = {.name = "reaction"},
        [OST_WATCH_STRAIN_ENERGY] = {.name = "strain_energy"},
        [OST_WATCH_STRESS] = {.name = "stress"},
        [OST_WATCH_LOAD_FACTOR] = {.name = "load_factor"},
        [COMPONENT] = {.name = "component"},
        [TAKE] = {.name = "take"},
        [CRITERION] = {.name = "criterion"},
        [ABOUT] = {.name = "about"},
        [EXPECTED] = {.name = "expected"},
        [SOURCE] = {.name = "source"},
    };
    int form;
    watch->line = ost_yaml_line(node);
    watch->component = OST_WATCH_LENGTH;
    watch->expected = NAN;
    if (ost_yaml_is(yaml, node, OST_YAML_SCALAR))
        return read_word(yaml, node, watch);
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, FORMS, &form));
    OST_TRY(read_expected(yaml, keys[EXPECTED].value, keys[SOURCE].value, watch));
    watch->kind = (OstWatchKind)form;
    OST_TRY(read_about(yaml, keys[ABOUT].value, watch));
    OST_TRY(check_keys(yaml, keys[TAKE].value, keys[CRITERION].value, keys[COMPONENT].value, watch));
    if (watch->kind == OST_WATCH_LOAD_FACTOR)
        return read_load_factor(yaml, keys[form].value, keys[CRITERION].value, watch);
    if (watch->kind == OST_WATCH_STRESS)
        return read_stress_keys(yaml, node, keys[form].value, keys[COMPONENT].value, keys[TAKE].value, watch);
    OST_TRY(read_component(yaml, &keys[COMPONENT], watch));
    if (watch->kind == OST_WATCH_STRAIN_ENERGY)
        return read_energy(yaml, keys[form].value, keys[COMPONENT].value);
    return watch->kind == OST_WATCH_DISPLACEMENT ? read_displacement(yaml, keys[form].value, watch)
                                                 : ost_read_selection(yaml, keys[form].value, &watch->on);
}

static OstStatus check_new_name(const OstYaml *yaml, const OstYamlNode *key, const OstCase *c, const char *name)
{
    for (int w = 0; w < c->watch_count; w++)
        if (c->watches[w].name && strcmp(c->watches[w].name, name) == 0)
            return ost_yaml_raise(yaml, key, "quantity '%.80s' occurs twice, the first time in line %d; keep one", name,
                                  c->watches[w].line);
    return OST_SUCCESS;
}

OstStatus ost_read_watches(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    if (!ost_yaml_is(yaml, node, OST_YAML_MAPPING))
        return ost_yaml_raise_type(yaml, node,
                                   "a name for each quantity, as in tip: {displacement: {nearest: [1, 0, 0]}}", "");
    const int count = (int)ost_yaml_follow(yaml, node)->value;
    if (count < 1)
        return ost_yaml_raise(yaml, node,
                              "'watch' names no quantity; leave it out, or name one, as in tip: "
                              "{displacement: {nearest: [1, 0, 0]}}");
    const int before = c->watch_count;
    if (before + count > OST_MOST_WATCHES)
        return ost_yaml_raise(yaml, node, "found %d quantities to watch, expected at most %d", before + count,
                              OST_MOST_WATCHES);
    OST_TRY(OST_RESIZE(yaml->ctx, &c->watches, before + count));
    const OstYamlNode *key = ost_yaml_first(yaml, node);
    for (int w = before; w < before + count; w++) {
        const OstYamlNode *value = ost_yaml_next(yaml, key);
        OstWatch *watch = &c->watches[w];
        const char *name;
        OST_TRY(ost_yaml_text(yaml, key, &name));
        OST_TRY(check_new_name(yaml, key, c, name));
        c->watch_count = w + 1;
        OST_TRY(ost_copy_string(yaml->ctx, name, &watch->name));
        OST_TRY(read_watch(yaml, value, watch));
        key = ost_yaml_next(yaml, value);
    }
    return OST_SUCCESS;
}
