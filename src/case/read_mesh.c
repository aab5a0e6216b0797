/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "core/error.h"

#include <string.h>

/* 6 × this³ tets can still be numbered in 64 bits. */
static const int64_t most_divisions = 1000000;

/* 8 to this power is 16 million. */
static const int64_t most_refinements = 8;

static OstStatus read_divisions(const OstYaml *yaml, const OstYamlNode *node, int64_t least, OstLocal *divisions)
{
    int64_t number;
    OST_TRY(ost_yaml_integer(yaml, node, least, most_divisions, &number));
    *divisions = (OstLocal)number;
    return OST_SUCCESS;
}

static OstStatus read_tube_divisions(const OstYaml *yaml, const OstYamlNode *node, int64_t least_around,
                                     OstLocal *around, OstLocal *radial, OstLocal *axial)
{
    enum { AROUND, RADIAL, AXIAL };
    OstYamlKey keys[] = {
        [AROUND] = {"around", OST_NEEDED, NULL},
        [RADIAL] = {"radial", OST_NEEDED, NULL},
        [AXIAL] = {"axial", OST_NEEDED, NULL},
    };
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(read_divisions(yaml, keys[AROUND].value, least_around, around));
    OST_TRY(read_divisions(yaml, keys[RADIAL].value, 1, radial));
    return read_divisions(yaml, keys[AXIAL].value, 1, axial);
}

static OstStatus read_radii(const OstYaml *yaml, const OstYamlNode *node, double radii[2])
{
    OST_TRY(ost_yaml_positives(yaml, node, 2, radii));
    return radii[0] < radii[1]
               ? OST_SUCCESS
               : ost_yaml_raise(yaml, node, "found radii %g and %g, expected the inner one first and smaller", radii[0],
                                radii[1]);
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
    OST_TRY(read_radii(yaml, keys[RADII].value, tube->radii));
    if (keys[ORIGIN].value)
        OST_TRY(ost_yaml_numbers(yaml, keys[ORIGIN].value, 3, tube->origin));
    return read_tube_divisions(yaml, keys[DIVISIONS].value, 3, &tube->around, &tube->radial, &tube->axial);
}

static OstStatus read_sector(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    static const char *const axis_words[] = {"x", "y", "z"};
    enum { AXIS, LENGTH, RADII, ANGLE, DIVISIONS, ORIGIN };
    OstYamlKey keys[] = {
        [AXIS] = {"axis", OST_NEEDED, NULL},           [LENGTH] = {"length", OST_NEEDED, NULL},
        [RADII] = {"radii", OST_NEEDED, NULL},         [ANGLE] = {"angle", OST_NEEDED, NULL},
        [DIVISIONS] = {"divisions", OST_NEEDED, NULL}, [ORIGIN] = {"origin", OST_OPTIONAL, NULL},
    };
    OstSectorShape *sector = &c->sector;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_word(yaml, keys[AXIS].value, "axis", axis_words, 3, &sector->axis));
    OST_TRY(ost_yaml_positive(yaml, keys[LENGTH].value, &sector->length));
    OST_TRY(read_radii(yaml, keys[RADII].value, sector->radii));
    OST_TRY(ost_yaml_positive(yaml, keys[ANGLE].value, &sector->angle));
    if (!(sector->angle < 360.0))
        return ost_yaml_raise(yaml, keys[ANGLE].value,
                              "found an angle of %g degrees, expected one below 360; all "
                              "the way round is a tube",
                              sector->angle);
    if (keys[ORIGIN].value)
        OST_TRY(ost_yaml_numbers(yaml, keys[ORIGIN].value, 3, sector->origin));
    return read_tube_divisions(yaml, keys[DIVISIONS].value, 1, &sector->around, &sector->radial, &sector->axial);
}

static OstStatus read_octant(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    enum { RADII, DIVISIONS, CENTRE };
    OstYamlKey keys[] = {
        [RADII] = {"radii", OST_NEEDED, NULL},
        [DIVISIONS] = {"divisions", OST_NEEDED, NULL},
        [CENTRE] = {"centre", OST_OPTIONAL, NULL},
    };
    OstYamlKey divisions[] = {{"around", OST_NEEDED, NULL}, {"radial", OST_NEEDED, NULL}};
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(read_radii(yaml, keys[RADII].value, c->octant.radii));
    if (keys[CENTRE].value)
        OST_TRY(ost_yaml_numbers(yaml, keys[CENTRE].value, 3, c->octant.centre));
    OST_TRY(ost_yaml_mapping(yaml, keys[DIVISIONS].value, divisions, 2));
    OST_TRY(read_divisions(yaml, divisions[0].value, 1, &c->octant.around));
    return read_divisions(yaml, divisions[1].value, 1, &c->octant.radial);
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
    c->mesh_place = ost_yaml_at(node);
    static const char *const endings[] = {".msh", ".msh.gz", ".veg", ".vtkhdf"};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++)
        if (ost_has_ending(c->mesh_file, endings[i]))
            return OST_SUCCESS;
    return ost_yaml_raise(yaml, node,
                          "found the mesh file '%s', expected a name that ends with .msh, .msh.gz, .veg or .vtkhdf",
                          c->mesh_file);
}

static int is_from_program(const OstYaml *yaml, const OstYamlNode *node)
{
    const char *text;
    return ost_yaml_is(yaml, node, OST_YAML_SCALAR) && ost_yaml_text(yaml, node, &text) == OST_SUCCESS &&
           strcmp(text, "from_program") == 0;
}

OstStatus ost_read_mesh(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    OstStatus (*const read[])(const OstYaml *, const OstYamlNode *, OstCase *) = {
        [OST_MESH_TUBE] = read_tube,     [OST_MESH_BLOCK] = read_block, [OST_MESH_SECTOR] = read_sector,
        [OST_MESH_OCTANT] = read_octant, [OST_MESH_FILE] = read_file,
    };
    enum { REFINE = OST_MESH_FILE + 1, KIND_COUNT = REFINE, MERGE };
    OstYamlKey keys[] = {
        [OST_MESH_TUBE] = {"tube", OST_OPTIONAL, NULL},
        [OST_MESH_BLOCK] = {"block", OST_OPTIONAL, NULL},
        [OST_MESH_SECTOR] = {"sector", OST_OPTIONAL, NULL},
        [OST_MESH_OCTANT] = {"octant", OST_OPTIONAL, NULL},
        [OST_MESH_FILE] = {"file", OST_OPTIONAL, NULL},
        [REFINE] = {"refine", OST_OPTIONAL, NULL},
        [MERGE] = {"merge", OST_OPTIONAL, NULL},
    };
    int kind;
    c->mesh_place = ost_yaml_at(node);
    c->mesh_kind = OST_MESH_FROM_PROGRAM;
    if (is_from_program(yaml, node))
        return OST_SUCCESS;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_one_of(yaml, node, keys, KIND_COUNT, &kind));
    if (keys[REFINE].value) {
        int64_t refinement;
        OST_TRY(ost_yaml_integer(yaml, keys[REFINE].value, 0, most_refinements, &refinement));
        c->refinement = (int)refinement;
    }
    if (keys[MERGE].value && kind != OST_MESH_FILE)
        return ost_yaml_raise(yaml, keys[MERGE].value,
                              "merge joins coincident vertices of a mesh file; shapes have none");
    if (keys[MERGE].value)
        OST_TRY(ost_yaml_positive(yaml, keys[MERGE].value, &c->merge));
    c->mesh_kind = (OstMeshKind)kind;
    return read[kind](yaml, keys[kind].value, c);
}
