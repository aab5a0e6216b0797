/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/msh/msh.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

/* The sections of .msh files of version 4. Version 4.0 writes the tag of an entity before its dimension, nodes one by
 * one, points with a box, and tags of nodes and elements as int. */

enum { SMALLEST_TAG = 2, SMALLEST_NODE = 8, SMALLEST_ELEMENT = 4, SMALLEST_BLOCK = 8 };
enum { GHOST = 4 }; /* stands for the dimension of ghost entities */

/* The head of a block: an entity, a number of its own, and how many nodes or elements follow. */
typedef struct Block {
    int dimension, tag, number;
    OstGlobal count;
} Block;

static OstGlobal entity_key(int dimension, int tag)
{
    return (OstGlobal)dimension * ((OstGlobal)UINT32_MAX + 1) + (OstGlobal)(uint32_t)tag;
}

static OstStatus read_count(OstMshCursor *cursor, const char *what, OstGlobal bytes_each, OstGlobal *count)
{
    char message[64];
    snprintf(message, sizeof message, "the number of %s", what);
    OST_TRY(ost_msh_size(cursor, message, count));
    return ost_msh_check_count(cursor, what, *count, bytes_each);
}

static OstStatus reserve_entities(OstMsh *msh, OstGlobal count)
{
    OST_TRY(OST_RESIZE(msh->cursor.ctx, &msh->entity, msh->entity_count + count));
    return OST_RESIZE(msh->cursor.ctx, &msh->entity_start, msh->entity_count + count + 1);
}

static void add_entity(OstMsh *msh, int dimension, int tag, OstGlobal group_count)
{
    msh->entity[msh->entity_count] = entity_key(dimension, tag);
    msh->entity_start[msh->entity_count + 1] = msh->entity_start[msh->entity_count] + group_count;
    msh->entity_count++;
}

/* A count, and as many tags. Physical groups are kept, after those of earlier entities. */
static OstStatus read_tags(OstMsh *msh, const char *what, int kept, OstGlobal *count)
{
    const OstGlobal first = msh->entity_start[msh->entity_count];
    int tag = 0;
    OST_TRY(read_count(&msh->cursor, what, SMALLEST_TAG, count));
    if (kept)
        OST_TRY(OST_RESIZE(msh->cursor.ctx, &msh->entity_group, first + *count));
    for (OstGlobal i = 0; i < *count; i++)
        OST_TRY(ost_msh_int(&msh->cursor, what, kept ? &msh->entity_group[first + i] : &tag));
    return OST_SUCCESS;
}

/* A partitioned entity of lower dimension than its parent is a border between partitions. Gmsh lists it with its
 * parent's physical groups, to which it does not belong. */
static OstStatus read_entity(OstMsh *msh, int dimension, int partitioned)
{
    OstMshCursor *cursor = &msh->cursor;
    int tag = 0, parent_dimension = dimension, parent = 0;
    OstGlobal count = 0, group_count = 0;
    OST_TRY(ost_msh_int(cursor, "an entity's tag", &tag));
    if (partitioned) {
        OST_TRY(ost_msh_int(cursor, "the dimension of an entity's parent", &parent_dimension));
        OST_TRY(ost_msh_int(cursor, "the tag of an entity's parent", &parent));
        OST_TRY(read_tags(msh, "partitions of an entity", 0, &count));
    }
    OST_TRY(ost_msh_skip_doubles(cursor, "the box of an entity", dimension == 0 && msh->version > 40 ? 3 : 6));
    OST_TRY(read_tags(msh, "physical groups of an entity", 1, &group_count));
    add_entity(msh, dimension, tag, parent_dimension == dimension ? group_count : 0);
    return dimension == 0 ? OST_SUCCESS : read_tags(msh, "bounds of an entity", 0, &count);
}

static OstStatus read_entities(OstMsh *msh, int partitioned)
{
    OstGlobal count[4] = {0}, total = 0;
    for (int dimension = 0; dimension < 4; dimension++) {
        OST_TRY(read_count(&msh->cursor, "entities", SMALLEST_BLOCK, &count[dimension]));
        total += count[dimension];
    }
    OST_TRY(reserve_entities(msh, total));
    for (int dimension = 0; dimension < 4; dimension++)
        for (OstGlobal i = 0; i < count[dimension]; i++)
            OST_TRY(read_entity(msh, dimension, partitioned));
    return OST_SUCCESS;
}

OstStatus ost_msh4_entities(OstMsh *msh)
{
    return read_entities(msh, 0);
}

/* These begin with the number of partitions, and with ghost entities: volumes that hold elements of other partitions.
 */
OstStatus ost_msh4_partitioned_entities(OstMsh *msh)
{
    OstMshCursor *cursor = &msh->cursor;
    OstGlobal partitions = 0, count = 0;
    int tag = 0, partition = 0;
    OST_TRY(ost_msh_size(cursor, "the number of partitions", &partitions));
    OST_TRY(read_count(cursor, "ghost entities", 2 * SMALLEST_TAG, &count));
    OST_TRY(reserve_entities(msh, count));
    for (OstGlobal i = 0; i < count; i++) {
        OST_TRY(ost_msh_int(cursor, "the tag of a ghost entity", &tag));
        OST_TRY(ost_msh_int(cursor, "the partition of a ghost entity", &partition));
        add_entity(msh, GHOST, tag, 0);
    }
    return read_entities(msh, 1);
}

static OstStatus read_block(OstMsh *msh, const char *what, OstGlobal left, Block *block)
{
    OstMshCursor *cursor = &msh->cursor;
    const int old = msh->version == 40;
    OST_TRY(ost_msh_int(cursor, "an entity", old ? &block->tag : &block->dimension));
    OST_TRY(ost_msh_int(cursor, "an entity", old ? &block->dimension : &block->tag));
    OST_TRY(ost_msh_int(cursor, "0, 1 or an element's type", &block->number));
    if (block->dimension < 0 || block->dimension > 3)
        return OST_RAISE_MSH(cursor, "%s of an entity of dimension %d, expected 0 to 3", what, block->dimension);
    OST_TRY(read_count(cursor, what, SMALLEST_ELEMENT, &block->count));
    if (block->count > left)
        return OST_RAISE_MSH(cursor, "a block of %" PRId64 " %s found where %" PRId64 " are left", block->count, what,
                             left);
    return OST_SUCCESS;
}

/* A section of nodes or elements: its head, then its blocks. */
static OstStatus read_blocks(OstMsh *msh, const char *what, OstGlobal bytes_each,
                             OstStatus (*begin)(OstMsh *msh, OstGlobal count),
                             OstStatus (*read)(OstMsh *msh, const Block *block))
{
    OstMshCursor *cursor = &msh->cursor;
    OstGlobal blocks = 0, left = 0, tag = 0;
    Block block = {0};
    OST_TRY(read_count(cursor, "blocks", SMALLEST_BLOCK, &blocks));
    OST_TRY(read_count(cursor, what, bytes_each, &left));
    for (int i = 0; i < 2 && msh->version > 40; i++)
        OST_TRY(ost_msh_size(cursor, "the lowest or highest tag", &tag));
    OST_TRY(begin(msh, left));
    for (OstGlobal b = 0; b < blocks; b++) {
        OST_TRY(read_block(msh, what, left, &block));
        OST_TRY(read(msh, &block));
        left -= block.count;
    }
    if (left > 0)
        return OST_RAISE_MSH(cursor, "the blocks hold %" PRId64 " %s fewer than the head of the section states", left,
                             what);
    return OST_SUCCESS;
}

static OstStatus read_tag(OstMshCursor *cursor, int version, const char *what, OstGlobal *tag)
{
    int number = 0;
    if (version > 40 || !cursor->binary)
        return ost_msh_size(cursor, what, tag);
    OST_TRY(ost_msh_int(cursor, what, &number));
    *tag = number;
    return OST_SUCCESS;
}

/* In version 4.1 a block has all tags before all coordinates: a second cursor reads the tags. */
static OstStatus read_nodes(OstMsh *msh, const Block *block)
{
    OstMshCursor *cursor = &msh->cursor, behind = *cursor;
    OstMshCursor *const tags = msh->version > 40 ? &behind : cursor;
    OstGlobal tag = 0;
    double x[3];
    for (OstGlobal i = 0; msh->version > 40 && i < block->count; i++)
        OST_TRY(ost_msh_size(cursor, "a node's tag", &tag));
    for (OstGlobal i = 0; i < block->count; i++) {
        OST_TRY(read_tag(tags, msh->version, "a node's tag", &tag));
        for (int c = 0; c < 3; c++)
            OST_TRY(ost_msh_double(cursor, "a coordinate", &x[c]));
        OST_TRY(ost_msh_skip_doubles(cursor, "a parameter of a node", block->number ? block->dimension : 0));
        OST_TRY(ost_msh_add_node(msh, tag, x));
    }
    return OST_SUCCESS;
}

OstStatus ost_msh4_nodes(OstMsh *msh)
{
    OST_TRY(read_blocks(msh, "nodes", SMALLEST_NODE, ost_msh_reserve_nodes, read_nodes));
    return ost_msh_index_nodes(msh);
}

/* The physical groups of a block's entity. */
static OstStatus find_groups(const OstMsh *msh, const Block *block, OstGlobal *count, const int **groups)
{
    const OstGlobal at = ost_label_index_find(&msh->entities, entity_key(block->dimension, block->tag));
    *count = at < 0 ? 0 : msh->entity_start[at + 1] - msh->entity_start[at];
    *groups = at < 0 ? NULL : msh->entity_group + msh->entity_start[at];
    for (OstGlobal i = 1; i < *count && block->dimension == 3; i++)
        if (abs((*groups)[i]) != abs((*groups)[0]))
            return OST_RAISE_MSH(&msh->cursor,
                                 "volume %d belongs to the physical volumes %d and %d; a tet can be in one region only",
                                 block->tag, abs((*groups)[0]), abs((*groups)[i]));
    return OST_SUCCESS;
}

/* Gmsh ignores what follows an element's nodes in its line, and so is it here. */
static OstStatus read_elements(OstMsh *msh, const Block *block)
{
    OstMshCursor *cursor = &msh->cursor;
    const int *groups = NULL;
    OstGlobal tag = 0, nodes[OST_MSH_MOST_NODES], group_count = 0;
    OST_TRY(ost_msh_check_type(msh, block->number));
    const OstMshType *facts = &ost_msh_types[block->number];
    if (facts->dimension != block->dimension)
        return OST_RAISE_MSH(cursor, "elements of type %d on an entity of dimension %d, expected dimension %d",
                             block->number, block->dimension, facts->dimension);
    OST_TRY(find_groups(msh, block, &group_count, &groups));
    const int ghosts =
        block->dimension == 3 && ost_label_index_find(&msh->entities, entity_key(GHOST, block->tag)) >= 0;
    for (OstGlobal i = 0; i < block->count; i++) {
        OST_TRY(read_tag(cursor, msh->version, "an element's tag", &tag));
        for (int n = 0; n < facts->nodes; n++)
            OST_TRY(read_tag(cursor, msh->version, "a node of an element", &nodes[n]));
        msh->ghosts += ghosts;
        if (!ghosts)
            OST_TRY(ost_msh_add_element(msh, block->number, tag, nodes, group_count, groups));
        if (!cursor->binary)
            ost_msh_rest_of_line(cursor);
    }
    return OST_SUCCESS;
}

static OstStatus begin_elements(OstMsh *msh, OstGlobal count)
{
    msh->elements = count;
    return ost_label_index_create(msh->cursor.ctx, msh->entity_count, msh->entity, &msh->entities);
}

OstStatus ost_msh4_elements(OstMsh *msh)
{
    return read_blocks(msh, "elements", SMALLEST_ELEMENT, begin_elements, read_elements);
}
