/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "case/yaml/message.h"
#include "core/error.h"
#include "core/memory.h"
#include "formats/serial/input_file.h"
#include "mesh/label_ranges.h"

#include <string.h>

static OstStatus read_all(const OstYaml *yaml, const OstYamlNode *node, OstSelection *selection)
{
    const char *text;
    (void)selection;
    OST_TRY(ost_yaml_text(yaml, node, &text));
    return strcmp(text, "true") == 0 ? OST_SUCCESS : ost_yaml_raise_type(yaml, node, "true", "");
}

static OstStatus read_boundary(const OstYaml *yaml, const OstYamlNode *node, OstSelection *selection)
{
    OstNames *names = &selection->boundaries;
    int count = 1;
    const int one = ost_yaml_is(yaml, node, OST_YAML_SCALAR);
    if (!one)
        OST_TRY(ost_yaml_short_list(yaml, node, "a boundary's name or a list of names", &count));
    if (count == 0)
        return ost_yaml_raise(yaml, node, "found an empty list, expected the names of boundaries");
    OST_TRY(OST_NEW(yaml->ctx, &names->name, count));
    names->count = count;
    const OstYamlNode *item = one ? node : ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item))
        OST_TRY(ost_read_string(yaml, item, &names->name[i]));
    return OST_SUCCESS;
}

OstStatus ost_read_tolerance(const OstYaml *yaml, const OstYamlNode *node, double *tolerance)
{
    OST_TRY(ost_yaml_number(yaml, node, tolerance));
    return *tolerance >= 0.0 ? OST_SUCCESS : ost_yaml_raise_type(yaml, node, "a distance, 0 or above", "");
}

static OstStatus read_plane(const OstYaml *yaml, const OstYamlNode *node, OstSelection *selection)
{
    OstYamlKey keys[] = {
        {.name = "point", .needed = 1, .read = ost_yaml_vector, .into = selection->point},
        {.name = "normal", .needed = 1, .read = ost_yaml_direction, .into = selection->direction},
        {.name = "tolerance", .read = ost_read_tolerance, .into = &selection->tolerance},
    };
    return ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys));
}

static OstStatus read_box(const OstYaml *yaml, const OstYamlNode *node, OstSelection *selection)
{
    OstYamlKey keys[] = {
        {.name = "min", .needed = 1, .read = ost_yaml_vector, .into = selection->point},
        {.name = "max", .needed = 1, .read = ost_yaml_vector, .into = selection->direction},
        {.name = "tolerance", .read = ost_read_tolerance, .into = &selection->tolerance},
    };
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    for (int i = 0; i < 3; i++)
        if (selection->point[i] > selection->direction[i])
            return ost_yaml_raise(yaml, keys[0].value, "min is above max along %c (%g > %g); exchange them", "xyz"[i],
                                  selection -> point[i], selection -> direction[i]);
    return OST_SUCCESS;
}

static OstStatus read_sphere(const OstYaml *yaml, const OstYamlNode *node, OstSelection *selection)
{
    OstYamlKey keys[] = {
        {.name = "center", .needed = 1, .read = ost_yaml_vector, .into = selection->point},
        {.name = "radius", .needed = 1, .read = ost_yaml_positive, .into = &selection->radii[1]},
        {.name = "tolerance", .read = ost_read_tolerance, .into = &selection->tolerance},
    };
    return ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys));
}

static OstStatus read_cylinder(const OstYaml *yaml, const OstYamlNode *node, OstSelection *selection)
{
    enum { RADIUS, RADII };
    OstYamlKey keys[] = {
        [RADIUS] = {.name = "radius"},
        [RADII] = {.name = "radii"},
        {.name = "origin", .needed = 1, .read = ost_yaml_vector, .into = selection->point},
        {.name = "axis", .needed = 1, .read = ost_yaml_direction, .into = selection->direction},
        {.name = "tolerance", .read = ost_read_tolerance, .into = &selection->tolerance},
    };
    int which;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, 2, &which));
    if (which == RADIUS)
        return ost_yaml_positive(yaml, keys[RADIUS].value, &selection->radii[1]);
    OST_TRY(ost_yaml_numbers(yaml, keys[RADII].value, 2, selection->radii));
    if (!(selection->radii[0] >= 0.0 && selection->radii[0] <= selection->radii[1]))
        return ost_yaml_raise(yaml, keys[RADII].value,
                              "found radii %g and %g, expected the inner one first and smaller", selection->radii[0],
                              selection->radii[1]);
    return OST_SUCCESS;
}

static OstStatus read_vertices(const OstYaml *yaml, const OstYamlNode *node, OstSelection *selection)
{
    int count;
    if (ost_yaml_is(yaml, node, OST_YAML_SCALAR)) {
        OST_TRY(ost_read_path(yaml, node, &selection->vertices_file));
        return ost_has_ending(selection->vertices_file, ".bou")
                   ? OST_SUCCESS
                   : ost_yaml_raise_type(yaml, node, "a list of vertex labels, or the name of a .bou file", "");
    }
    OST_TRY(ost_yaml_list(yaml, node, "a list of vertex labels, or the name of a .bou file", &count));
    if (count == 0)
        return ost_yaml_raise(yaml, node, "found an empty list, expected vertex labels");
    OST_TRY(OST_NEW(yaml->ctx, &selection->ranges, count));
    OstLabelRange *ranges = selection->ranges;
    const OstYamlNode *item = ost_yaml_first(yaml, node);
    for (int i = 0; i < count; i++, item = ost_yaml_next(yaml, item)) {
        OST_TRY(ost_yaml_integer(yaml, item, 0, OST_LARGEST_LABEL, &ranges[i].first));
        ranges[i].last = ranges[i].first;
    }
    ost_ranges_sort(count, ranges);
    for (int i = 1; i < count; i++)
        if (ranges[i].first == ranges[i - 1].first)
            return ost_yaml_raise(yaml, node, "vertex %lld occurs twice in the list", (long long)ranges[i].first);
    selection->range_count = ost_ranges_join(count, ranges);
    return OST_SUCCESS;
}

static OstStatus read_nearest(const OstYaml *yaml, const OstYamlNode *node, OstSelection *selection)
{
    return ost_yaml_numbers(yaml, node, 3, selection->point);
}

OstStatus ost_read_selection(const OstYaml *yaml, const OstYamlNode *node, OstSelection *selection)
{
    static const struct {
        OstSelectionKind kind;
        const char *word;
        OstStatus (*read)(const OstYaml *, const OstYamlNode *, OstSelection *);
    } forms[] = {
        {OST_SELECT_BOUNDARY, "boundary", read_boundary},
        {OST_SELECT_PLANE, "plane", read_plane},
        {OST_SELECT_BOX, "box", read_box},
        {OST_SELECT_SPHERE, "sphere", read_sphere},
        {OST_SELECT_CYLINDER, "cylinder", read_cylinder},
        {OST_SELECT_VERTICES, "vertices", read_vertices},
        {OST_SELECT_NEAREST, "nearest", read_nearest},
        {OST_SELECT_ALL, "all", read_all},
    };
    enum { FORMS = sizeof forms / sizeof *forms };
    OstYamlKey keys[FORMS] = {{.name = NULL}};
    int form;
    for (int f = 0; f < FORMS; f++)
        keys[f].name = forms[f].word;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, FORMS));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, FORMS, &form));
    selection->kind = forms[form].kind;
    selection->place = ost_yaml_at(keys[form].value);
    selection->tolerance = -1.0;
    return forms[form].read(yaml, keys[form].value, selection);
}

void ost_selection_release(OstSelection *selection)
{
    ost_names_clear(&selection->boundaries);
    OST_FREE(selection->ranges, selection->vertices_file);
}

static int names_agree(const OstNames *one, const OstNames *other)
{
    int agree = one->count == other->count;
    for (int n = 0; n < one->count && agree; n++)
        agree = strcmp(one->name[n], other->name[n]) == 0;
    return agree;
}

int ost_selections_agree(const OstSelection *one, const OstSelection *other)
{
    const char *file = one->vertices_file ? one->vertices_file : "";
    const char *other_file = other->vertices_file ? other->vertices_file : "";
    return one->kind == other->kind && names_agree(&one->boundaries, &other->boundaries) &&
           memcmp(one->point, other->point, sizeof one->point) == 0 &&
           memcmp(one->direction, other->direction, sizeof one->direction) == 0 &&
           memcmp(one->radii, other->radii, sizeof one->radii) == 0 && one->tolerance == other->tolerance &&
           strcmp(file, other_file) == 0 && one->range_count == other->range_count &&
           (one->range_count == 0 ||
            memcmp(one->ranges, other->ranges, (size_t)one->range_count * sizeof *one->ranges) == 0);
}
