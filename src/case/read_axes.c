/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "core/error.h"
#include "core/memory.h"

#include <stdio.h>
#include <string.h>

static OstStatus read_fixed(const OstYaml *yaml, const OstYamlNode *node, OstAxesSpec *axes)
{
    int count;
    OST_TRY(ost_yaml_list(yaml, node, "three rows e1, e2, e3 of three numbers", &count));
    if (count != 3)
        return ost_yaml_raise(yaml, node, "found %d rows, expected three: e1, e2, e3", count);
    const OstYamlNode *row = ost_yaml_first(yaml, node);
    for (int i = 0; i < 3; i++, row = ost_yaml_next(yaml, row))
        OST_TRY(ost_yaml_numbers(yaml, row, 3, axes->fixed + 3 * (size_t)i));
    return OST_SUCCESS;
}

static OstStatus read_euler(const OstYaml *yaml, const OstYamlNode *node, OstAxesSpec *axes)
{
    const char *sequence = "zxz";
    double degrees[3];
    OstYamlKey keys[] = {{.name = "degrees", .needed = 1, .read = ost_yaml_vector, .into = degrees},
                         {.name = "sequence"}};
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    const OstYamlNode *at = keys[1].value ? keys[1].value : node;
    if (keys[1].value)
        OST_TRY(ost_yaml_text(yaml, at, &sequence));
    return ost_yaml_located(yaml, at, ost_axes_from_euler(yaml->ctx, sequence, degrees, axes->fixed));
}

static OstStatus read_quaternion(const OstYaml *yaml, const OstYamlNode *node, OstAxesSpec *axes)
{
    double quaternion[4];
    OST_TRY(ost_yaml_numbers(yaml, node, 4, quaternion));
    return ost_yaml_located(yaml, node, ost_axes_from_quaternion(yaml->ctx, quaternion, axes->fixed));
}

/* Which direction of the cylindrical frame each of e1, e2 and e3 is; every direction once. */
static OstStatus read_order(const OstYaml *yaml, const OstYamlNode *node, OstCylindricalDirection order[3])
{
    static const char *const words[] = {
        [OST_AXIAL] = "axial",
        [OST_RADIAL] = "radial",
        [OST_TANGENTIAL] = "tangential",
    };
    int count;
    unsigned seen = 0;
    OST_TRY(ost_yaml_list(yaml, node, "a list of axial, radial and tangential", &count));
    if (count != 3)
        return ost_yaml_raise(yaml, node,
                              "found %d directions, expected three: axial, radial and tangential in the "
                              "order of e1, e2, e3",
                              count);
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < 3; i++, item = ost_yaml_next(yaml, item)) {
        int which;
        OST_TRY(ost_yaml_word(yaml, item, "direction", words, 3, &which));
        if (seen & (1U << which))
            return ost_yaml_raise(yaml, item, "direction '%s' occurs twice; e1, e2 and e3 need a different one each",
                                  words[which]);
        seen |= 1U << which;
        order[i] = (OstCylindricalDirection)which;
    }
    return OST_SUCCESS;
}

static OstStatus read_cylindrical(const OstYaml *yaml, const OstYamlNode *node, OstAxesSpec *axes)
{
    OstYamlKey keys[] = {
        {.name = "origin", .needed = 1, .read = ost_yaml_vector, .into = axes->origin},
        {.name = "axis", .needed = 1, .read = ost_yaml_direction, .into = axes->axis},
        {.name = "order", .needed = 1},
    };
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    return read_order(yaml, keys[2].value, axes->order);
}

static OstStatus read_points(const OstYaml *yaml, const OstYamlNode *node, OstAxesSpec *axes)
{
    int count;
    OST_TRY(ost_yaml_list(yaml, node, "a list of points, three numbers each", &count));
    if (count < 2)
        return ost_yaml_raise(yaml, node, "found %d points, expected two at least", count);
    OST_TRY(OST_NEW(yaml->ctx, &axes->points, (size_t)count * 3));
    axes->point_count = count;
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item)) {
        double *point = axes->points + 3 * (size_t)i;
        OST_TRY(ost_yaml_numbers(yaml, item, 3, point));
        if (i > 0 && memcmp(point, point - 3, 3 * sizeof *point) == 0)
            return ost_yaml_raise(yaml, item,
                                  "this point repeats the one before it; neighbouring points of a curve must differ");
    }
    return OST_SUCCESS;
}

static OstStatus read_curve(const OstYaml *yaml, const OstYamlNode *node, OstAxesSpec *axes)
{
    OstYamlKey keys[] = {
        {.name = "points", .needed = 1},
        {.name = "up", .read = ost_yaml_direction, .into = axes->up},
        {.name = "order"},
    };
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(read_points(yaml, keys[0].value, axes));
    return keys[2].value ? read_order(yaml, keys[2].value, axes->order) : OST_SUCCESS;
}

static OstStatus read_cells(const OstYaml *yaml, const OstYamlNode *node, OstAxesSpec *axes)
{
    return ost_yaml_says(yaml, node, "mesh") ? OST_SUCCESS : ost_read_path(yaml, node, &axes->cells_file);
}

static OstStatus read_gradient(const OstYaml *yaml, const OstYamlNode *node, OstAxesSpec *axes)
{
    OstYamlKey keys[] = {{.name = "e1", .needed = 1}, {.name = "e2", .needed = 1}};
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    for (int i = 0; i < 2; i++) {
        OstYamlKey ends[] = {{.name = "from", .needed = 1}, {.name = "to", .needed = 1}};
        OST_TRY(ost_yaml_mapping(yaml, keys[i].value, ends, OST_COUNT_OF(ends)));
        OST_TRY(ost_read_string(yaml, ends[0].value, &axes->from[i]));
        OST_TRY(ost_read_string(yaml, ends[1].value, &axes->to[i]));
        if (strcmp(axes->from[i], axes->to[i]) == 0)
            return ost_yaml_raise(yaml, ends[1].value, "'%s' is both from and to; a gradient needs two boundaries",
                                  axes->to[i]);
    }
    return OST_SUCCESS;
}

OstStatus ost_read_axes(const OstYaml *yaml, const OstYamlNode *node, const char *region, OstAxesSpec *axes)
{
    static const struct {
        OstAxesKind kind;
        const char *word;
        OstStatus (*read)(const OstYaml *, const OstYamlNode *, OstAxesSpec *);
    } forms[] = {
        {OST_AXES_FIXED, "fixed", read_fixed},
        {OST_AXES_CYLINDRICAL, "cylindrical", read_cylindrical},
        {OST_AXES_CURVE, "curve", read_curve},
        {OST_AXES_EULER, "euler", read_euler},
        {OST_AXES_QUATERNION, "quaternion", read_quaternion},
        {OST_AXES_CELLS, "cells", read_cells},
        {OST_AXES_GRADIENT, "gradient", read_gradient},
    };
    enum { FORMS = sizeof forms / sizeof *forms };
    OstYamlKey keys[FORMS] = {{.name = NULL}};
    char what[128];
    int form;
    for (int f = 0; f < FORMS; f++)
        keys[f].name = forms[f].word;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, FORMS));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, FORMS, &form));
    axes->kind = forms[form].kind;
    OST_TRY(forms[form].read(yaml, keys[form].value, axes));
    if (axes->kind != OST_AXES_FIXED)
        return OST_SUCCESS;
    snprintf(what, sizeof what, "axes of region '%.80s'", region);
    return ost_yaml_located(yaml, keys[form].value, ost_axes_check(yaml->ctx, what, axes->fixed));
}

void ost_axes_spec_release(OstAxesSpec *axes)
{
    OST_FREE(axes->points);
    OST_FREE(axes->cells_file);
    for (int i = 0; i < 2; i++) {
        OST_FREE(axes->from[i]);
        OST_FREE(axes->to[i]);
    }
}
