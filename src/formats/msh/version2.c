/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "formats/msh/msh.h"

#include <inttypes.h>

/* The sections of .msh files of versions 1 and 2. Counts are lines of text in the binary form too. */

enum { BINARY_NODE = 28, TEXT_NODE = 8, SMALLEST_ELEMENT = 8 };

/* Parametric nodes have more behind their coordinates: dimension and tag of an entity, and parameters. */
static OstStatus read_nodes(OstMsh *msh, int parametric)
{
    OstMshCursor *cursor = &msh->cursor;
    OstGlobal count = 0;
    OST_TRY(ost_msh_count_line(cursor, "the number of nodes", &count));
    OST_TRY(ost_msh_check_count(cursor, "nodes", count, cursor->binary ? BINARY_NODE : TEXT_NODE));
    OST_TRY(ost_msh_reserve_nodes(msh, count));
    for (OstGlobal i = 0; i < count; i++) {
        OstGlobal tag = 0;
        int dimension = 0, entity = 0;
        double x[3];
        OST_TRY(ost_msh_tag(cursor, "a node's tag", &tag));
        for (int c = 0; c < 3; c++)
            OST_TRY(ost_msh_double(cursor, "a coordinate", &x[c]));
        if (parametric) {
            OST_TRY(ost_msh_int(cursor, "the dimension of a node's entity", &dimension));
            OST_TRY(ost_msh_int(cursor, "the tag of a node's entity", &entity));
            const int parameters = dimension == 1 || dimension == 2 ? dimension : 0;
            OST_TRY(ost_msh_skip_doubles(cursor, "a parameter of a node", parameters));
        }
        OST_TRY(ost_msh_add_node(msh, tag, x));
    }
    return ost_msh_index_nodes(msh);
}

OstStatus ost_msh2_nodes(OstMsh *msh)
{
    return read_nodes(msh, 0);
}

OstStatus ost_msh2_parametric_nodes(OstMsh *msh)
{
    return read_nodes(msh, 1);
}

/* The first of an element's tags is its physical tag; then come its entity and its partitions. */
static OstStatus read_tags(OstMshCursor *cursor, int count, int *group)
{
    int tag = 0;
    *group = 0;
    if (count < 0)
        return OST_RAISE_MSH(cursor, "an element has %d tags, expected 0 or more", count);
    for (int i = 0; i < count; i++)
        OST_TRY(ost_msh_int(cursor, "an element's tag", i == 0 ? group : &tag));
    return OST_SUCCESS;
}

static OstStatus add_element(OstMsh *msh, int type, OstGlobal number, int group)
{
    OstGlobal nodes[OST_MSH_MOST_NODES];
    OST_TRY(ost_msh_check_type(msh, type));
    for (int i = 0; i < ost_msh_types[type].nodes; i++)
        OST_TRY(ost_msh_tag(&msh->cursor, "a node of an element", &nodes[i]));
    return ost_msh_add_element(msh, type, number, nodes, 1, &group);
}

/* Number, type, count of tags, tags, nodes; in version 1 number, type, two tags, count of nodes, nodes. */
static OstStatus read_element(OstMsh *msh)
{
    OstMshCursor *cursor = &msh->cursor;
    const int first = msh->version < 20;
    OstGlobal number = 0;
    int type = 0, tags = 2, group = 0, nodes = 0;
    OST_TRY(ost_msh_tag(cursor, "an element's number", &number));
    OST_TRY(ost_msh_int(cursor, "an element's type", &type));
    OST_TRY(ost_msh_check_type(msh, type));
    if (!first)
        OST_TRY(ost_msh_int(cursor, "the number of an element's tags", &tags));
    OST_TRY(read_tags(cursor, tags, &group));
    if (first)
        OST_TRY(ost_msh_int(cursor, "the number of an element's nodes", &nodes));
    if (first && nodes != ost_msh_types[type].nodes)
        return OST_RAISE_MSH(cursor, "an element of type %d with %d nodes found, expected %d", type, nodes,
                             ost_msh_types[type].nodes);
    return add_element(msh, type, number, group);
}

/* Binary elements come in blocks of one type. */
static OstStatus read_block(OstMsh *msh, OstGlobal left, int *count)
{
    OstMshCursor *cursor = &msh->cursor;
    OstGlobal number = 0;
    int type = 0, tags = 0, group = 0;
    OST_TRY(ost_msh_int(cursor, "an element's type", &type));
    OST_TRY(ost_msh_int(cursor, "the number of elements that follow", count));
    OST_TRY(ost_msh_int(cursor, "the number of an element's tags", &tags));
    if (*count < 0 || *count > left)
        return OST_RAISE_MSH(cursor, "a block of %d elements found where %" PRId64 " are left", *count, left);
    for (int i = 0; i < *count; i++) {
        OST_TRY(ost_msh_tag(cursor, "an element's number", &number));
        OST_TRY(read_tags(cursor, tags, &group));
        OST_TRY(add_element(msh, type, number, group));
    }
    return OST_SUCCESS;
}

OstStatus ost_msh2_elements(OstMsh *msh)
{
    OST_TRY(ost_msh_count_line(&msh->cursor, "the number of elements", &msh->elements));
    OST_TRY(ost_msh_check_count(&msh->cursor, "elements", msh->elements, SMALLEST_ELEMENT));
    for (OstGlobal read = 0; read < msh->elements;) {
        int count = 1;
        if (msh->cursor.binary)
            OST_TRY(read_block(msh, msh->elements - read, &count));
        else
            OST_TRY(read_element(msh));
        read += count;
    }
    return OST_SUCCESS;
}
