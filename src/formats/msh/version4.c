/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "formats/msh/msh.h"

#include <inttypes.h>

/* Nodes and elements of .msh files of version 4. Version 4.0 writes the tag of an entity before its dimension, nodes
 * one by one, and tags of nodes and elements as int. */

enum { SMALLEST_NODE = 8, SMALLEST_ELEMENT = 4, SMALLEST_BLOCK = 8 };

/* The head of a block: an entity, a number of its own, and how many nodes or elements follow. */
typedef struct Block {
    int dimension, tag, number;
    OstGlobal count;
} Block;

static OstStatus read_block(OstMsh *msh, const char *what, OstGlobal left, Block *block)
{
    OstMshCursor *cursor = &msh->cursor;
    const int old = msh->version == 40;
    OST_TRY(ost_msh_int(cursor, "an entity", old ? &block->tag : &block->dimension));
    OST_TRY(ost_msh_int(cursor, "an entity", old ? &block->dimension : &block->tag));
    OST_TRY(ost_msh_int(cursor, "0, 1 or an element's type", &block->number));
    if (block->dimension < 0 || block->dimension > 3)
        return OST_RAISE_MSH(cursor, "%s of an entity of dimension %d, expected 0 to 3", what, block->dimension);
    OST_TRY(ost_msh_count(cursor, what, SMALLEST_ELEMENT, &block->count));
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
    OST_TRY(ost_msh_count(cursor, "blocks", SMALLEST_BLOCK, &blocks));
    OST_TRY(ost_msh_count(cursor, what, bytes_each, &left));
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
    return version > 40 ? ost_msh_size(cursor, what, tag) : ost_msh_tag(cursor, what, tag);
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
    ost_msh_find_groups(msh, block->dimension, block->tag, &group_count, &groups);
    const int ghosts = block->dimension == 3 && ost_msh_is_ghost(msh, block->tag);
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
    return ost_msh_index_entities(msh);
}

OstStatus ost_msh4_elements(OstMsh *msh)
{
    return read_blocks(msh, "elements", SMALLEST_ELEMENT, begin_elements, read_elements);
}
