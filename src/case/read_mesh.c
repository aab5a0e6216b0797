/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "core/error.h"

/* 6 × this³ tets still have 64-bit numbers. */
static const int64_t most_divisions = 1000000;

static OstStatus read_divisions(const OstYaml *yaml, const OstYamlNode *node, int64_t least, OstLocal *divisions)
{
    int64_t number;
    OST_TRY(ost_yaml_integer(yaml, node, least, most_divisions, &number));
    *divisions = (OstLocal)number;
    return OST_SUCCESS;
}

static OstStatus read_tube_divisions(const OstYaml *yaml, const OstYamlNode *node, OstTubeShape *tube)
{
    enum { AROUND, RADIAL, AXIAL };
    OstYamlKey keys[] = {
        [AROUND] = {"around", OST_NEEDED, NULL},
        [RADIAL] = {"radial", OST_NEEDED, NULL},
        [AXIAL] = {"axial", OST_NEEDED, NULL},
    };
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(read_divisions(yaml, keys[AROUND].value, 3, &tube->around));
    OST_TRY(read_divisions(yaml, keys[RADIAL].value, 1, &tube->radial));
    return read_divisions(yaml, keys[AXIAL].value, 1, &tube->axial);
}

static OstStatus read_tube(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    static const char *const axis_words[] = {"x", "y", "z"};
    enum { AXIS, LENGTH, RADII, DIVISIONS, ORIGIN };
    OstYamlKey keys[] = {
        [AXIS] = {"axis", OST_NEEDED, NULL},       [LENGTH] = {"length", OST_NEEDED, NULL},
        [RADII] = {"radii", OST_NEEDED, NULL},     [DIVISIONS] = {"divisions", OST_NEEDED, NULL},
        [ORIGIN] = {"origin", OST_OPTIONAL, NULL},
    };
    OstTubeShape *tube = &c->tube;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_word(yaml, keys[AXIS].value, "axis", axis_words, 3, &tube->axis));
    OST_TRY(ost_yaml_positive(yaml, keys[LENGTH].value, &tube->length));
    OST_TRY(ost_yaml_positives(yaml, keys[RADII].value, 2, tube->radii));
    if (!(tube->radii[0] < tube->radii[1]))
        return ost_yaml_raise(yaml, keys[RADII].value,
                              "found radii %g and %g, expected the inner one first and smaller", tube->radii[0],
                              tube->radii[1]);
    if (keys[ORIGIN].value)
        OST_TRY(ost_yaml_numbers(yaml, keys[ORIGIN].value, 3, tube->origin));
    return read_tube_divisions(yaml, keys[DIVISIONS].value, tube);
}

static OstStatus read_block(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    enum { SIZE, DIVISIONS, ORIGIN };
    OstYamlKey keys[] = {
        [SIZE] = {"size", OST_NEEDED, NULL},
        [DIVISIONS] = {"divisions", OST_NEEDED, NULL},
        [ORIGIN] = {"origin", OST_OPTIONAL, NULL},
    };
    OstBlockShape *block = &c->block;
    int count;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_positives(yaml, keys[SIZE].value, 3, block->size));
    if (keys[ORIGIN].value)
        OST_TRY(ost_yaml_numbers(yaml, keys[ORIGIN].value, 3, block->origin));
    OST_TRY(ost_yaml_list(yaml, keys[DIVISIONS].value, "a list of 3 whole numbers", &count));
    if (count != 3)
        return ost_yaml_raise(yaml, keys[DIVISIONS].value, "found %d divisions, expected 3: along x, y and z", count);
    const OstYamlNode *item = ost_yaml_first(yaml, keys[DIVISIONS].value);
    for (int i = 0; i < 3; i++, item = ost_yaml_next(yaml, item))
        OST_TRY(read_divisions(yaml, item, 1, &block->divisions[i]));
    return OST_SUCCESS;
}

static OstStatus read_file(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    OST_TRY(ost_read_path(yaml, node, &c->mesh_file));
    if (ost_has_ending(c->mesh_file, ".msh") || ost_has_ending(c->mesh_file, ".veg") ||
        ost_has_ending(c->mesh_file, ".vtkhdf"))
        return OST_SUCCESS;
    return ost_yaml_raise(yaml, node, "found the mesh file '%s', expected a name that ends with .msh, .veg or .vtkhdf",
                          c->mesh_file);
}

OstStatus ost_read_mesh(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    OstStatus (*const read[])(const OstYaml *, const OstYamlNode *, OstCase *) = {
        [OST_MESH_TUBE] = read_tube,
        [OST_MESH_BLOCK] = read_block,
        [OST_MESH_FILE] = read_file,
    };
    OstYamlKey keys[] = {
        [OST_MESH_TUBE] = {"tube", OST_OPTIONAL, NULL},
        [OST_MESH_BLOCK] = {"block", OST_OPTIONAL, NULL},
        [OST_MESH_FILE] = {"file", OST_OPTIONAL, NULL},
    };
    int kind;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, OST_COUNT_OF(keys), &kind));
    c->mesh_kind = (OstMeshKind)kind;
    return read[kind](yaml, keys[kind].value, c);
}
