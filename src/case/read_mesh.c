/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/sections.h"
#include "core/error.h"
#include "formats/serial/formats.h"

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

static OstStatus read_radii(const OstYaml *yaml, const OstYamlNode *node, double radii[2])
{
    OST_TRY(ost_yaml_positives(yaml, node, 2, radii));
    return radii[0] < radii[1]
               ? OST_SUCCESS
               : ost_yaml_raise(yaml, node, "found radii %g and %g, expected the inner one first and smaller", radii[0],
                                radii[1]);
}

static OstStatus read_angle(const OstYaml *yaml, const OstYamlNode *node, double *angle)
{
    OST_TRY(ost_yaml_positive(yaml, node, angle));
    return *angle < 360.0 ? OST_SUCCESS
                          : ost_yaml_raise(yaml, node,
                                           "found an angle of %g degrees, expected one below 360; all the way round is "
                                           "a tube",
                                           *angle);
}

/* A tube, or a sector of one, which has an angle too. */
static OstStatus read_round(const OstYaml *yaml, const OstYamlNode *node, int is_sector, OstSectorShape *shape)
{
    static const char *const axis_words[] = {"x", "y", "z"};
    OstYamlKey keys[] = {
        {.name = "axis", .needed = 1},
        {.name = "length", .needed = 1, .read = ost_yaml_positive, .into = &shape->length},
        {.name = "radii", .needed = 1, .read = read_radii, .into = shape->radii},
        {.name = "divisions", .needed = 1},
        {.name = "origin", .read = ost_yaml_vector, .into = shape->origin},
        {.name = "angle", .needed = 1, .read = read_angle, .into = &shape->angle},
    };
    OstYamlKey counts[] = {
        {.name = "around", .needed = 1}, {.name = "radial", .needed = 1}, {.name = "axial", .needed = 1}};
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys) - !is_sector));
    OST_TRY(ost_yaml_word(yaml, keys[0].value, "axis", axis_words, 3, &shape->axis));
    OST_TRY(ost_yaml_mapping(yaml, keys[3].value, counts, OST_COUNT_OF(counts)));
    OST_TRY(read_divisions(yaml, counts[0].value, is_sector ? 1 : 3, &shape->around));
    OST_TRY(read_divisions(yaml, counts[1].value, 1, &shape->radial));
    return read_divisions(yaml, counts[2].value, 1, &shape->axial);
}

static OstStatus read_tube(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    OstSectorShape whole = {0};
    OST_TRY(read_round(yaml, node, 0, &whole));
    c->tube = (OstTubeShape){.axis = whole.axis,
                             .length = whole.length,
                             .around = whole.around,
                             .radial = whole.radial,
                             .axial = whole.axial};
    memcpy(c->tube.radii, whole.radii, sizeof whole.radii);
    memcpy(c->tube.origin, whole.origin, sizeof whole.origin);
    return OST_SUCCESS;
}

static OstStatus read_sector(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    return read_round(yaml, node, 1, &c->sector);
}

static OstStatus read_octant(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    OstYamlKey keys[] = {
        {.name = "radii", .needed = 1, .read = read_radii, .into = c->octant.radii},
        {.name = "divisions", .needed = 1},
        {.name = "centre", .read = ost_yaml_vector, .into = c->octant.centre},
    };
    OstYamlKey divisions[] = {{.name = "around", .needed = 1}, {.name = "radial", .needed = 1}};
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_mapping(yaml, keys[1].value, divisions, 2));
    OST_TRY(read_divisions(yaml, divisions[0].value, 1, &c->octant.around));
    return read_divisions(yaml, divisions[1].value, 1, &c->octant.radial);
}

static OstStatus read_sides(const OstYaml *yaml, const OstYamlNode *node, double sides[3])
{
    return ost_yaml_positives(yaml, node, 3, sides);
}

static OstStatus read_block(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    OstBlockShape *block = &c->block;
    OstYamlKey keys[] = {
        {.name = "size", .needed = 1, .read = read_sides, .into = block->size},
        {.name = "divisions", .needed = 1},
        {.name = "origin", .read = ost_yaml_vector, .into = block->origin},
    };
    int count;
    OST_TRY(ost_yaml_mapping(yaml, node, keys, OST_COUNT_OF(keys)));
    OST_TRY(ost_yaml_list(yaml, keys[1].value, "a list of 3 whole numbers", &count));
    if (count != 3)
        return ost_yaml_raise(yaml, keys[1].value, "found %d divisions, expected 3: along x, y and z", count);
    const OstYamlNode *item = ost_yaml_first(yaml, keys[1].value);
    for (int i = 0; i < 3; i++, item = ost_yaml_next(yaml, item))
        OST_TRY(read_divisions(yaml, item, 1, &block->divisions[i]));
    return OST_SUCCESS;
}

static OstStatus read_file(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    OST_TRY(ost_read_path(yaml, node, &c->mesh_file));
    c->mesh_place = ost_yaml_at(node);
    return ost_yaml_located(yaml, node, ost_mesh_file_check_name(yaml->ctx, c->mesh_file));
}

OstStatus ost_read_mesh(const OstYaml *yaml, const OstYamlNode *node, OstCase *c)
{
    OstStatus (*const read[])(const OstYaml *, const OstYamlNode *, OstCase *) = {
        [OST_MESH_TUBE] = read_tube,     [OST_MESH_BLOCK] = read_block, [OST_MESH_SECTOR] = read_sector,
        [OST_MESH_OCTANT] = read_octant, [OST_MESH_FILE] = read_file,
    };
    enum { REFINE = OST_MESH_FILE + 1, KIND_COUNT = REFINE, MERGE };
    OstYamlKey keys[] = {
        [OST_MESH_TUBE] = {.name = "tube"},
        [OST_MESH_BLOCK] = {.name = "block"},
        [OST_MESH_SECTOR] = {.name = "sector"},
        [OST_MESH_OCTANT] = {.name = "octant"},
        [OST_MESH_FILE] = {.name = "file"},
        [REFINE] = {.name = "refine"},
        [MERGE] = {.name = "merge", .read = ost_yaml_positive, .into = &c->merge},
    };
    int kind;
    c->mesh_place = ost_yaml_at(node);
    c->mesh_kind = OST_MESH_FROM_PROGRAM;
    if (ost_yaml_says(yaml, node, "from_program"))
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
    c->mesh_kind = (OstMeshKind)kind;
    return read[kind](yaml, keys[kind].value, c);
}
