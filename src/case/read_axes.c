/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "core/error.h"
#include "core/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const axis_names[] = {"e1", "e2", "e3"};

/* A mapping of e1, e2 and e3 in which one or two are stated: `read` takes each, the first and the second. */
static OstStatus read_stated(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstAxesSpec *axes,
                             OstStatus (*read)(const OstYaml *, const OstYamlNode *, int, OstCase *, OstAxesSpec *))
{
    OstYamlKey keys[3] = {{.name = axis_names[0]}, {.name = axis_names[1]}, {.name = axis_names[2]}};
    int count = 0;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, 3));
    for (int e = 0; e < 3; e++) {
        if (!keys[e].value)
            continue;
        if (count == 2)
            return ost_yaml_raise(yaml, keys[e].value,
                                  "e3 follows from e1 and e2; give two of the three, or the one "
                                  "about which the material is transversely isotropic");
        axes->along[count] = e;
        OST_TRY(read(yaml, keys[e].value, count++, c, axes));
    }
    if (count == 0)
        return ost_yaml_raise(yaml, node,
                              "expected two of e1, e2 and e3, or one for a transversely isotropic material");
    axes->single = count == 1 ? 1 + axes->along[0] : 0;
    return OST_SUCCESS;
}

static OstStatus read_direction(const OstYaml *yaml, const OstYamlNode *node, int number, OstCase *c, OstAxesSpec *axes)
{
    (void)c;
    return ost_yaml_direction(yaml, node, axes->fixed + 3 * (size_t)number);
}

/* Directions by name, of any length; two must be orthogonal, which ost_axes_check looks at. */
static OstStatus read_named(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstAxesSpec *axes)
{
    double d[9];
    OST_TRY(read_stated(yaml, node, c, axes, read_direction));
    memcpy(d, axes->fixed, sizeof d);
    if (axes->single)
        return ost_yaml_located(yaml, node, ost_axes_from_directions(yaml->ctx, axes->along, d, NULL, axes->fixed));
    const double dot = d[0] * d[3] + d[1] * d[4] + d[2] * d[5];
    const double lengths = sqrt((d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) * (d[3] * d[3] + d[4] * d[4] + d[5] * d[5]));
    if (fabs(dot) > 1e-6 * lengths)
        return ost_yaml_raise(yaml, node, "%s and %s are not orthogonal (%.9g degrees lie between them)",
                              axis_names[axes->along[0]], axis_names[axes->along[1]],
                              acos(dot / lengths) * 180.0 / M_PI);
    return ost_yaml_located(yaml, node, ost_axes_from_directions(yaml->ctx, axes->along, d, d + 3, axes->fixed));
}

static OstStatus read_fixed(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstAxesSpec *axes)
{
    int count;
    if (ost_yaml_is(yaml, node, OST_YAML_MAPPING))
        return read_named(yaml, node, c, axes);
    OST_TRY(ost_yaml_list(yaml, node, "three rows e1, e2, e3 of three numbers", &count));
    if (count != 3)
        return ost_yaml_raise(yaml, node, "found %d rows, expected three: e1, e2, e3", count);
    const OstYamlNode *row = ost_yaml_first(yaml, node);
    for (int i = 0; i < 3; i++, row = ost_yaml_next(yaml, row))
        OST_TRY(ost_yaml_direction(yaml, row, axes->fixed + 3 * (size_t)i));
    return OST_SUCCESS;
}

static OstStatus read_euler(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstAxesSpec *axes)
{
    (void)c;
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

static OstStatus read_quaternion(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstAxesSpec *axes)
{
    (void)c;
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

static OstStatus read_cylindrical(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstAxesSpec *axes)
{
    (void)c;
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

static OstStatus read_curve(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstAxesSpec *axes)
{
    (void)c;
    OstYamlKey keys[] = {
        {.name = "points", .needed = 1},
        {.name = "up", .read = ost_yaml_direction, .into = axes->up},
        {.name = "order"},
    };
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(read_points(yaml, keys[0].value, axes));
    return keys[2].value ? read_order(yaml, keys[2].value, axes->order) : OST_SUCCESS;
}

static OstStatus read_cells(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstAxesSpec *axes)
{
    (void)c;
    return ost_yaml_says(yaml, node, "mesh") ? OST_SUCCESS : ost_read_path(yaml, node, &axes->cells_file);
}

/* An angle that is a multiple of 5 degrees in radians, to four digits, is likely to be meant so. */
static void warn_of_radians(const OstYaml *yaml, const OstYamlNode *node, double angle)
{
    const double meant = angle * 180.0 / M_PI, rounded = 5.0 * round(meant / 5.0);
    if (fabs(angle) < 2.0 * M_PI && rounded != 0.0 && fabs(meant - rounded) < 5e-4 * fabs(rounded) &&
        fabs(angle - round(angle)) > 1e-9)
        ost_warn(yaml->ctx, "%s:%d: %g degrees are nearly none; %g degrees are %g in radians, and degrees are expected",
                 yaml->path, ost_yaml_line(node), angle, rounded, angle);
}

/* {axis: [x, y, z], degrees: a}: the world's axes turned about a line. */
static OstStatus read_rotation(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstAxesSpec *axes)
{
    double axis[3], degrees = 0.0;
    OstYamlKey keys[] = {{.name = "axis", .needed = 1, .read = ost_yaml_direction, .into = axis},
                         {.name = "degrees", .needed = 1}};
    (void)c;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_number(yaml, keys[1].value, &degrees));
    warn_of_radians(yaml, keys[1].value, degrees);
    const double half = degrees * M_PI / 360.0;
    const double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
    const double quaternion[4] = {cos(half), sin(half) * axis[0] / length, sin(half) * axis[1] / length,
                                  sin(half) * axis[2] / length};
    return ost_yaml_located(yaml, node, ost_axes_from_quaternion(yaml->ctx, quaternion, axes->fixed));
}

static OstStatus read_ends(const OstYaml *yaml, const OstYamlNode *node, int number, OstCase *c, OstAxesSpec *axes)
{
    OstYamlKey ends[] = {{.name = "from", .needed = 1}, {.name = "to", .needed = 1}};
    (void)c;
    OST_TRY(ost_yaml_mapping(yaml, node, ends, OST_COUNT_OF(ends)));
    OST_TRY(ost_read_string(yaml, ends[0].value, &axes->from[number]));
    OST_TRY(ost_read_string(yaml, ends[1].value, &axes->to[number]));
    if (strcmp(axes->from[number], axes->to[number]) == 0)
        return ost_yaml_raise(yaml, ends[1].value, "'%s' is both from and to; a gradient needs two boundaries",
                              axes->to[number]);
    return OST_SUCCESS;
}

static OstStatus read_gradient(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstAxesSpec *axes)
{
    return read_stated(yaml, node, c, axes, read_ends);
}

static OstStatus read_field_name(const OstYaml *yaml, const OstYamlNode *node, int number, OstCase *c,
                                 OstAxesSpec *axes)
{
    return ost_read_field(yaml, node, OST_CASE_FIELD_OF_DIRECTIONS, c, &axes->field[number]);
}

/* The name of a field of nine numbers, or {e1: NAME, e2: NAME} of fields of three. */
static OstStatus read_field_axes(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstAxesSpec *axes)
{
    if (ost_yaml_is(yaml, node, OST_YAML_MAPPING))
        return read_stated(yaml, node, c, axes, read_field_name);
    axes->along[0] = -1;
    return ost_read_field(yaml, node, OST_CASE_FIELD_OF_AXES, c, &axes->field[0]);
}

/* --- one direction --- */

/* e3 along one direction of a cylinder. */
static OstStatus read_fibre_cylindrical(const OstYaml *yaml, const OstYamlNode *node, OstAxesSpec *axes)
{
    static const char *const words[] = {
        [OST_AXIAL] = "axial",
        [OST_RADIAL] = "radial",
        [OST_TANGENTIAL] = "tangential",
    };
    OstYamlKey keys[] = {
        {.name = "origin", .needed = 1, .read = ost_yaml_vector, .into = axes->origin},
        {.name = "axis", .needed = 1, .read = ost_yaml_direction, .into = axes->axis},
        {.name = "along", .needed = 1},
    };
    int along;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_word(yaml, keys[2].value, "direction", words, 3, &along));
    axes->kind = OST_AXES_CYLINDRICAL;
    for (int e = 0; e < 3; e++)
        axes->order[e] = (OstCylindricalDirection)((along + 1 + e) % 3);
    return OST_SUCCESS;
}

static OstStatus read_fibre_curve(const OstYaml *yaml, const OstYamlNode *node, OstAxesSpec *axes)
{
    OstYamlKey points = {.name = "points", .needed = 1};
    OST_TRY(ost_yaml_mapping(yaml, node, &points, 1));
    axes->kind = OST_AXES_CURVE;
    for (int e = 0; e < 3; e++)
        axes->order[e] = (OstCylindricalDirection)((OST_AXIAL + 1 + e) % 3);
    return read_points(yaml, points.value, axes);
}

/* The axis e3 of a transversely isotropic material: a direction, or a curve, cylinder, gradient or field that it
 * follows.
 */
OstStatus ost_read_fibre(const OstYaml *yaml, const OstYamlNode *node, OstCase *c, OstAxesSpec *axes)
{
    enum { CURVE, CYLINDRICAL, GRADIENT, FIELD, FORMS };
    OstYamlKey keys[FORMS] = {[CURVE] = {.name = "curve"},
                              [CYLINDRICAL] = {.name = "cylindrical"},
                              [GRADIENT] = {.name = "gradient"},
                              [FIELD] = {.name = "field"}};
    double direction[3];
    int form;
    axes->along[0] = 2;
    axes->single = 3;
    if (!ost_yaml_is(yaml, node, OST_YAML_MAPPING)) {
        axes->kind = OST_AXES_FIXED;
        OST_TRY(ost_yaml_direction(yaml, node, direction));
        return ost_yaml_located(yaml, node,
                                ost_axes_from_directions(yaml->ctx, axes->along, direction, NULL, axes->fixed));
    }
    OST_TRY(ost_yaml_mapping(yaml, node, keys, FORMS));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, FORMS, &form));
    if (form == CURVE)
        return read_fibre_curve(yaml, keys[form].value, axes);
    if (form == CYLINDRICAL)
        return read_fibre_cylindrical(yaml, keys[form].value, axes);
    axes->kind = form == GRADIENT ? OST_AXES_GRADIENT : OST_AXES_FIELD;
    return form == GRADIENT ? read_ends(yaml, keys[form].value, 0, c, axes)
                            : read_field_name(yaml, keys[form].value, 0, c, axes);
}

OstStatus ost_read_axes(const OstYaml *yaml, const OstYamlNode *node, const char *region, OstCase *c, OstAxesSpec *axes)
{
    static const struct {
        OstAxesKind kind;
        const char *word;
        OstStatus (*read)(const OstYaml *, const OstYamlNode *, OstCase *, OstAxesSpec *);
    } forms[] = {
        {OST_AXES_FIXED, "fixed", read_fixed},
        {OST_AXES_CYLINDRICAL, "cylindrical", read_cylindrical},
        {OST_AXES_CURVE, "curve", read_curve},
        {OST_AXES_EULER, "euler", read_euler},
        {OST_AXES_QUATERNION, "quaternion", read_quaternion},
        {OST_AXES_CELLS, "cells", read_cells},
        {OST_AXES_GRADIENT, "gradient", read_gradient},
        {OST_AXES_FIXED, "rotation", read_rotation},
        {OST_AXES_FIELD, "field", read_field_axes},
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
    OST_TRY(forms[form].read(yaml, keys[form].value, c, axes));
    if (axes->kind != OST_AXES_FIXED)
        return OST_SUCCESS;
    snprintf(what, sizeof what, "axes of region '%.80s'", region);
    return ost_yaml_located(yaml, keys[form].value, ost_axes_check(yaml->ctx, what, axes->fixed));
}

void ost_axes_spec_release(OstAxesSpec *axes)
{
    OST_FREE(axes->points, axes->cells_file);
    for (int i = 0; i < 2; i++) {
        OST_FREE(axes->from[i], axes->to[i], axes->field[i]);
    }
}
