/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "case/yaml/message.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>

static OstStatus read_stiffness(const OstYaml *yaml, const OstYamlNode *node, double *stiffness)
{
    OST_TRY(ost_yaml_number(yaml, node, stiffness));
    return *stiffness >= 0.0 && isfinite(*stiffness) ? OST_SUCCESS
                                                     : ost_yaml_raise_type(yaml, node, "a stiffness, 0 or above", "");
}

/* One number for every direction, or {normal, tangential}. */
static OstStatus read_foundation(const OstYaml *yaml, const OstYamlNode *node, OstSpring *spring)
{
    OstYamlKey keys[] = {{.name = "normal", .read = read_stiffness, .into = &spring->along},
                         {.name = "tangential", .read = read_stiffness, .into = &spring->across}};
    if (ost_yaml_is(yaml, node, OST_YAML_MAPPING))
        return ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys));
    OST_TRY(read_stiffness(yaml, node, &spring->along));
    spring->across = spring->along;
    return OST_SUCCESS;
}

static OstStatus read_spring(const OstYaml *yaml, const OstYamlNode *node, OstSpring *spring)
{
    enum { KINDS = 2, ON = KINDS, DIRECTION };
    OstYamlKey keys[] = {
        [OST_SPRING_FOUNDATION] = {.name = "foundation"},
        [OST_SPRING_POINT] = {.name = "spring"},
        [ON] = {.name = "on", .needed = 1},
        [DIRECTION] = {.name = "direction"},
    };
    int kind;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, KINDS, &kind));
    spring->kind = (OstSpringKind)kind;
    spring->line = ost_yaml_line(node);
    OST_TRY(ost_read_selection(yaml, keys[ON].value, &spring->on));
    if (kind == OST_SPRING_FOUNDATION)
        OST_TRY(read_foundation(yaml, keys[kind].value, spring));
    else
        OST_TRY(read_stiffness(yaml, keys[kind].value, &spring->along));
    if (spring->along == 0.0 && spring->across == 0.0)
        return ost_yaml_raise(yaml, keys[kind].value, "the stiffness is 0, so this spring holds nothing; leave it out");
    if (!keys[DIRECTION].value) {
        if (kind == OST_SPRING_POINT)
            spring->across = spring->along;
        return OST_SUCCESS;
    }
    if (ost_yaml_is(yaml, keys[kind].value, OST_YAML_MAPPING))
        return ost_yaml_raise(yaml, keys[DIRECTION].value,
                              "'direction' and {normal, tangential} exclude each other; give one number with it");
    spring->across = 0.0;
    return ost_yaml_direction(yaml, keys[DIRECTION].value, spring->direction);
}

OstStatus ost_read_springs(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    int count;
    OST_TRY(ost_yaml_short_list(yaml, node, "a list of springs (- {on: ..., foundation: ...})", &count));
    const int before = c->spring_count;
    OST_TRY(OST_RESIZE(yaml->ctx, &c->springs, before + count));
    c->spring_count += count;
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item))
        OST_TRY(read_spring(yaml, item, &c->springs[before + i]));
    return OST_SUCCESS;
}
