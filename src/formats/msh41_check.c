/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "formats/msh_check.h"

#include <inttypes.h>

/* The sections of a .msh file of version 4.1. */

enum { SMALLEST_TAG = 2, SMALLEST_NODE = 8, SMALLEST_ELEMENT = 4, SMALLEST_BLOCK = 8 };

static OstStatus skip_doubles(OstMshCursor *cursor, const char *what, OstGlobal count)
{
    double value = 0.0;
    for (OstGlobal i = 0; i < count; i++)
        OST_TRY(ost_msh_double(cursor, what, &value));
    return OST_SUCCESS;
}

/* A count and as many tags: of the groups an entity belongs to, or of the entities that bound it. */
static OstStatus skip_tags(OstMshCursor *cursor, const char *what)
{
    OstGlobal count = 0;
    int tag = 0;
    OST_TRY(ost_msh_size(cursor, what, &count));
    OST_TRY(ost_msh_count(cursor, what, count, SMALLEST_TAG));
    for (OstGlobal i = 0; i < count; i++)
        OST_TRY(ost_msh_int(cursor, what, &tag));
    return OST_SUCCESS;
}

/* Gmsh takes a negative tag for "all entities". */
static OstStatus read_entity_tag(OstMshCursor *cursor)
{
    int tag = 0;
    OST_TRY(ost_msh_int(cursor, "an entity's tag", &tag));
    return tag >= 0 ? OST_SUCCESS : OST_RAISE_MSH(cursor, "entity tag %d found, expected 0 or more", tag);
}

static OstStatus check_entity(OstMshCursor *cursor, int dimension)
{
    OST_TRY(read_entity_tag(cursor));
    OST_TRY(skip_doubles(cursor, "the box of an entity", dimension == 0 ? 3 : 6));
    OST_TRY(skip_tags(cursor, "physical groups of an entity"));
    return dimension == 0 ? OST_SUCCESS : skip_tags(cursor, "bounds of an entity");
}

OstStatus ost_msh41_entities(OstMshCursor *cursor)
{
    OstGlobal count[4] = {0};
    for (int dimension = 0; dimension < 4; dimension++) {
        OST_TRY(ost_msh_size(cursor, "the number of entities", &count[dimension]));
        OST_TRY(ost_msh_count(cursor, "entities", count[dimension], SMALLEST_BLOCK));
    }
    for (int dimension = 0; dimension < 4; dimension++)
        for (OstGlobal i = 0; i < count[dimension]; i++)
            OST_TRY(check_entity(cursor, dimension));
    return OST_SUCCESS;
}

/* The head of the nodes' and of the elements' section. */
static OstStatus read_head(OstMshCursor *cursor, const char *what, OstGlobal bytes_each, OstGlobal *blocks,
                           OstGlobal *total)
{
    OstGlobal ignored = 0;
    OST_TRY(ost_msh_size(cursor, "a number of blocks", blocks));
    OST_TRY(ost_msh_count(cursor, "blocks", *blocks, SMALLEST_BLOCK));
    OST_TRY(ost_msh_size(cursor, "a total number", total));
    OST_TRY(ost_msh_count(cursor, what, *total, bytes_each));
    OST_TRY(ost_msh_size(cursor, "the lowest tag", &ignored));
    return ost_msh_size(cursor, "the highest tag", &ignored);
}

static OstStatus check_total(const OstMshCursor *cursor, const char *what, OstGlobal found, OstGlobal total, int ended)
{
    if (ended ? found == total : found <= total)
        return OST_SUCCESS;
    return OST_RAISE_MSH(cursor, "the blocks hold %" PRId64 " %s, the head of the section states %" PRId64, found, what,
                         total);
}

static OstStatus check_node_block(OstMshCursor *cursor, OstMshContents *contents, OstGlobal total)
{
    int dimension = 0, parametric = 0;
    OstGlobal count = 0, tag = 0;
    OST_TRY(ost_msh_int(cursor, "the dimension of an entity", &dimension));
    OST_TRY(read_entity_tag(cursor));
    OST_TRY(ost_msh_int(cursor, "0 or 1 for parametric nodes", &parametric));
    OST_TRY(ost_msh_size(cursor, "a number of nodes", &count));
    if (dimension < 0 || dimension > 3 || parametric < 0 || parametric > (dimension < 3))
        return OST_RAISE_MSH(
            cursor, "nodes of an entity of dimension %d, parametric %d, expected 0 to 3 and 0, or 1 below dimension 3",
            dimension, parametric);
    OST_TRY(ost_msh_count(cursor, "nodes", count, SMALLEST_NODE));
    OST_TRY(check_total(cursor, "nodes", contents->nodes + count, total, 0));
    for (OstGlobal i = 0; i < count; i++) {
        OST_TRY(ost_msh_size(cursor, "a node's tag", &tag));
        OST_TRY(ost_msh_define_node(cursor, contents, tag));
    }
    return skip_doubles(cursor, "a coordinate", count * (3 + (parametric ? dimension : 0)));
}

OstStatus ost_msh41_nodes(OstMshCursor *cursor, OstMshContents *contents)
{
    OstGlobal blocks = 0, total = 0;
    OST_TRY(read_head(cursor, "nodes", SMALLEST_NODE, &blocks, &total));
    for (OstGlobal b = 0; b < blocks; b++)
        OST_TRY(check_node_block(cursor, contents, total));
    return check_total(cursor, "nodes", contents->nodes, total, 1);
}

static OstStatus check_element_block(OstMshCursor *cursor, OstMshContents *contents, OstGlobal total)
{
    int dimension = 0, type = 0, own_dimension = 0, nodes = 0;
    OstGlobal count = 0, tag = 0;
    OST_TRY(ost_msh_int(cursor, "the dimension of an entity", &dimension));
    OST_TRY(read_entity_tag(cursor));
    OST_TRY(ost_msh_int(cursor, "an element's type", &type));
    OST_TRY(ost_msh_size(cursor, "a number of elements", &count));
    OST_TRY(ost_msh_element_type(cursor, type, &own_dimension, &nodes));
    if (dimension != own_dimension)
        return OST_RAISE_MSH(cursor, "elements of type %d on an entity of dimension %d, expected dimension %d", type,
                             dimension, own_dimension);
    OST_TRY(ost_msh_count(cursor, "elements", count, SMALLEST_ELEMENT));
    OST_TRY(check_total(cursor, "elements", contents->elements + count, total, 0));
    for (OstGlobal i = 0; i < count; i++) {
        OST_TRY(ost_msh_size(cursor, "an element's tag", &tag));
        OST_TRY(ost_msh_define_element(cursor, contents, type, tag));
        for (int n = 0; n < nodes; n++) {
            OST_TRY(ost_msh_size(cursor, "a node of an element", &tag));
            OST_TRY(ost_msh_use_node(cursor, contents, tag));
        }
    }
    return OST_SUCCESS;
}

OstStatus ost_msh41_elements(OstMshCursor *cursor, OstMshContents *contents)
{
    OstGlobal blocks = 0, total = 0;
    OST_TRY(read_head(cursor, "elements", SMALLEST_ELEMENT, &blocks, &total));
    for (OstGlobal b = 0; b < blocks; b++)
        OST_TRY(check_element_block(cursor, contents, total));
    return check_total(cursor, "elements", contents->elements, total, 1);
}
