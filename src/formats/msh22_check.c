/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "formats/msh_check.h"

/* The sections of a .msh file of version 2.2. Counts are lines of text in the binary form too. */

enum { BINARY_NODE = 28, TEXT_NODE = 8, SMALLEST_ELEMENT = 8, MOST_TAGS = 3 };

OstStatus ost_msh22_nodes(OstMshCursor *cursor, OstMshContents *contents)
{
    int count = 0;
    OST_TRY(ost_msh_count_line(cursor, "nodes", cursor->binary ? BINARY_NODE : TEXT_NODE, &count));
    for (int i = 0; i < count; i++) {
        int tag = 0;
        double coordinate = 0.0;
        OST_TRY(ost_msh_int(cursor, "a node's tag", &tag));
        OST_TRY(ost_msh_define_node(cursor, contents, tag));
        for (int c = 0; c < 3; c++)
            OST_TRY(ost_msh_double(cursor, "a coordinate", &coordinate));
    }
    return OST_SUCCESS;
}

static OstStatus check_tag_count(const OstMshCursor *cursor, int tags)
{
    if (tags >= 0 && tags <= MOST_TAGS)
        return OST_SUCCESS;
    return OST_RAISE_MSH(cursor, "an element has %d tags, expected at most %d; save the mesh without partitions", tags,
                         (int)MOST_TAGS);
}

/* What follows the header of an element: its physical and elementary tags, its nodes. */
static OstStatus check_element(OstMshCursor *cursor, const OstMshContents *contents, int tags, int nodes)
{
    for (int i = 0; i < tags; i++) {
        int tag = 0;
        OST_TRY(ost_msh_int(cursor, "an element's tag", &tag));
        if (tag < 0)
            return OST_RAISE_MSH(cursor, "an element belongs to group or entity %d, expected 0 or more", tag);
    }
    for (int i = 0; i < nodes; i++) {
        int node = 0;
        OST_TRY(ost_msh_int(cursor, "a node of an element", &node));
        OST_TRY(ost_msh_use_node(cursor, contents, node));
    }
    return OST_SUCCESS;
}

static OstStatus check_text_elements(OstMshCursor *cursor, OstMshContents *contents, int count)
{
    for (int i = 0; i < count; i++) {
        int number = 0, type = 0, tags = 0, dimension = 0, nodes = 0;
        OST_TRY(ost_msh_int(cursor, "an element's number", &number));
        OST_TRY(ost_msh_int(cursor, "an element's type", &type));
        OST_TRY(ost_msh_int(cursor, "the number of an element's tags", &tags));
        OST_TRY(ost_msh_element_type(cursor, type, &dimension, &nodes));
        OST_TRY(check_tag_count(cursor, tags));
        OST_TRY(ost_msh_define_element(cursor, contents, type, number));
        OST_TRY(check_element(cursor, contents, tags, nodes));
    }
    return OST_SUCCESS;
}

/* Binary elements come in blocks of one type. */
static OstStatus check_binary_elements(OstMshCursor *cursor, OstMshContents *contents, int count)
{
    for (int read = 0, block = 0; read < count; read += block) {
        int type = 0, tags = 0, dimension = 0, nodes = 0;
        OST_TRY(ost_msh_int(cursor, "an element's type", &type));
        OST_TRY(ost_msh_int(cursor, "the number of elements that follow", &block));
        OST_TRY(ost_msh_int(cursor, "the number of an element's tags", &tags));
        OST_TRY(ost_msh_element_type(cursor, type, &dimension, &nodes));
        OST_TRY(check_tag_count(cursor, tags));
        if (block < 1 || block > count - read)
            return OST_RAISE_MSH(cursor, "a block of %d elements found where %d are left", block, count - read);
        for (int i = 0; i < block; i++) {
            int number = 0;
            OST_TRY(ost_msh_int(cursor, "an element's number", &number));
            OST_TRY(ost_msh_define_element(cursor, contents, type, number));
            OST_TRY(check_element(cursor, contents, tags, nodes));
        }
    }
    return OST_SUCCESS;
}

OstStatus ost_msh22_elements(OstMshCursor *cursor, OstMshContents *contents)
{
    int count = 0;
    OST_TRY(ost_msh_count_line(cursor, "elements", SMALLEST_ELEMENT, &count));
    return cursor->binary ? check_binary_elements(cursor, contents, count)
                          : check_text_elements(cursor, contents, count);
}
