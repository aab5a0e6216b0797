/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "formats/msh/msh.h"

/* Nodes and elements of .msh files of version 3, which no manual describes: Gmsh writes and reads it (-format msh3).
 * Counts are lines of text in the binary form too. */

enum { SMALLEST_NODE = 10, SMALLEST_ELEMENT = 10 };

/* A node's entity, its dimension and the node's parameters follow if the entity is not 0. */
OstStatus ost_msh3_nodes(OstMsh *msh)
{
    OstMshCursor *cursor = &msh->cursor;
    OstGlobal count = 0;
    OST_TRY(ost_msh_count_line(cursor, "the number of nodes", &count));
    OST_TRY(ost_msh_check_count(cursor, "nodes", count, SMALLEST_NODE));
    OST_TRY(ost_msh_reserve_nodes(msh, count));
    for (OstGlobal i = 0; i < count; i++) {
        OstGlobal tag = 0;
        int entity = 0, dimension = 0;
        double x[3];
        OST_TRY(ost_msh_tag(cursor, "a node's tag", &tag));
        for (int c = 0; c < 3; c++)
            OST_TRY(ost_msh_double(cursor, "a coordinate", &x[c]));
        OST_TRY(ost_msh_int(cursor, "a node's entity", &entity));
        if (entity != 0)
            OST_TRY(ost_msh_int(cursor, "the dimension of a node's entity", &dimension));
        if (dimension < 0 || dimension > 3)
            return OST_RAISE_MSH(cursor, "a node on an entity of dimension %d found, expected 0 to 3", dimension);
        OST_TRY(ost_msh_skip_doubles(cursor, "a parameter of a node", dimension));
        OST_TRY(ost_msh_add_node(msh, tag, x));
    }
    return ost_msh_index_nodes(msh);
}

/* Number, type, entity, count of the numbers that follow: nodes, then partitions. */
static OstStatus read_element(OstMsh *msh)
{
    OstMshCursor *cursor = &msh->cursor;
    OstGlobal nodes[OST_MSH_MOST_NODES], group_count = 0, number = 0, value = 0;
    const int *groups = NULL;
    int type = 0, entity = 0, count = 0;
    OST_TRY(ost_msh_tag(cursor, "an element's number", &number));
    OST_TRY(ost_msh_int(cursor, "an element's type", &type));
    OST_TRY(ost_msh_check_type(msh, type));
    OST_TRY(ost_msh_int(cursor, "an element's entity", &entity));
    OST_TRY(ost_msh_int(cursor, "the number of an element's nodes", &count));
    if (count < ost_msh_types[type].nodes)
        return OST_RAISE_MSH(cursor, "an element of type %d with %d nodes found, expected %d", type, count,
                             ost_msh_types[type].nodes);
    for (int i = 0; i < count; i++) {
        OST_TRY(ost_msh_tag(cursor, "a node of an element", &value));
        if (i < ost_msh_types[type].nodes)
            nodes[i] = value;
    }
    ost_msh_find_groups(msh, ost_msh_types[type].dimension, entity, &group_count, &groups);
    return ost_msh_add_element(msh, type, number, nodes, group_count, groups);
}

OstStatus ost_msh3_elements(OstMsh *msh)
{
    OST_TRY(ost_msh_index_entities(msh));
    OST_TRY(ost_msh_count_line(&msh->cursor, "the number of elements", &msh->elements));
    OST_TRY(ost_msh_check_count(&msh->cursor, "elements", msh->elements, SMALLEST_ELEMENT));
    for (OstGlobal i = 0; i < msh->elements; i++)
        OST_TRY(read_element(msh));
    return OST_SUCCESS;
}
