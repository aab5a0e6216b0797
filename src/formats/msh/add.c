/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/msh/msh.h"

#include <inttypes.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* Adds nodes and elements to the mesh while they are read. */

/* An element may be in several groups. Limits groups times elements by the size of the file: SMALLEST_SHARE bytes for
 * each. */
enum { MOST_ELEMENTS = INT_MAX / 3 * 2, SMALLEST_SHARE = 4 };

static const char point[] = "Point", line[] = "Line", triangle[] = "Triangle", quad[] = "Quadrilateral",
                  tet[] = "Tetrahedron", hex[] = "Hexahedron", prism[] = "Prism", pyramid[] = "Pyramid";

const OstMshType ost_msh_types[OST_MSH_TYPES] = {
    {0, 0, ""},        {1, 2, line},      {2, 3, triangle}, {2, 4, quad},      {3, 4, tet},       {3, 8, hex},
    {3, 6, prism},     {3, 5, pyramid},   {1, 3, line},     {2, 6, triangle},  {2, 9, quad},      {3, 10, tet},
    {3, 27, hex},      {3, 18, prism},    {3, 14, pyramid}, {0, 1, point},     {2, 8, quad},      {3, 20, hex},
    {3, 15, prism},    {3, 13, pyramid},  {2, 9, triangle}, {2, 10, triangle}, {2, 12, triangle}, {2, 15, triangle},
    {2, 15, triangle}, {2, 21, triangle}, {1, 4, line},     {1, 5, line},      {1, 6, line},      {3, 20, tet},
    {3, 35, tet},      {3, 56, tet}};

OstStatus ost_msh_check_type(const OstMsh *msh, int type)
{
    if (type >= 1 && type < OST_MSH_TYPES)
        return OST_SUCCESS;
    return OST_RAISE_MSH(&msh->cursor, "element of type %d found, expected linear or quadratic ones (types 1 to 19)",
                         type);
}

OstStatus ost_msh_reserve_nodes(OstMsh *msh, OstGlobal count)
{
    OstMeshChunk *chunk = msh->chunk;
    if (count > INT_MAX)
        return OST_RAISE(chunk->ctx, OST_LIMIT_EXCEEDED,
                         "%s: %" PRId64 " nodes, at most %d can be read from a .msh file", msh->cursor.path, count,
                         INT_MAX);
    OST_TRY(OST_NEW(chunk->ctx, &chunk->node_label, count));
    return OST_NEW(chunk->ctx, &chunk->coordinates, 3 * count);
}

OstStatus ost_msh_add_node(OstMsh *msh, OstGlobal tag, const double x[3])
{
    OstMeshChunk *chunk = msh->chunk;
    if (tag < 0)
        return OST_RAISE_MSH(&msh->cursor, "node tag %" PRId64 " found, expected 0 or more", tag);
    chunk->node_label[chunk->node_count] = tag;
    memcpy(chunk->coordinates + 3 * (size_t)chunk->node_count++, x, 3 * sizeof *x);
    return OST_SUCCESS;
}

OstStatus ost_msh_index_nodes(OstMsh *msh)
{
    const OstMeshChunk *chunk = msh->chunk;
    OST_TRY(ost_label_index_create(chunk->ctx, chunk->node_count, chunk->node_label, &msh->nodes));
    if (!msh->nodes.repeated)
        return OST_SUCCESS;
    return OST_RAISE(chunk->ctx, OST_INVALID_INPUT, "%s: node tag %" PRId64 " is given to two nodes", msh->cursor.path,
                     msh->nodes.repeated_label);
}

/* Is there a number for one more? */
static OstStatus check_count(const OstMsh *msh, OstLocal count)
{
    if (count >= MOST_ELEMENTS)
        return OST_RAISE(msh->cursor.ctx, OST_LIMIT_EXCEEDED,
                         "%s: more than %d elements of a kind, too many to be read from a .msh file", msh->cursor.path,
                         MOST_ELEMENTS);
    return OST_SUCCESS;
}

static OstStatus find_nodes(const OstMsh *msh, int count, const OstGlobal *tags, OstGlobal *positions)
{
    for (int i = 0; i < count; i++) {
        positions[i] = ost_label_index_find(&msh->nodes, tags[i]);
        if (positions[i] < 0)
            return OST_RAISE_MSH(&msh->cursor, "an element uses node %" PRId64 ", which the file does not define",
                                 tags[i]);
    }
    return OST_SUCCESS;
}

/* Order of groups: volumes first, points last; by tag. */
static int comes_before(const OstMshGroup *group, int dimension, int tag)
{
    return group->dimension > dimension || (group->dimension == dimension && group->tag < tag);
}

OstStatus ost_msh_group(OstMsh *msh, int dimension, int tag, OstMshGroup **group)
{
    int low = 0, high = msh->group_count;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (comes_before(&msh->group[middle], dimension, tag))
            low = middle + 1;
        else
            high = middle;
    }
    *group = msh->group + low;
    if (low < msh->group_count && (*group)->dimension == dimension && (*group)->tag == tag)
        return OST_SUCCESS;
    OST_TRY(OST_RESIZE(msh->cursor.ctx, &msh->group, msh->group_count + 1));
    *group = msh->group + low;
    memmove(*group + 1, *group, (size_t)(msh->group_count++ - low) * sizeof **group);
    **group = (OstMshGroup){.dimension = dimension, .tag = tag, .number = -1};
    return OST_SUCCESS;
}

/* Room for one more tet; its nodes are to be filled in. */
static OstStatus add_tet(OstMsh *msh, int width, OstGlobal label, int group, OstGlobal **nodes)
{
    OstMeshChunk *chunk = msh->chunk;
    const OstLocal t = chunk->tet_count;
    OstMshGroup *region = NULL;
    OST_TRY(check_count(msh, t));
    OST_TRY(OST_GROW(chunk->ctx, &chunk->tet_nodes, (size_t)(t + 1) * (size_t)width));
    OST_TRY(OST_GROW(chunk->ctx, &chunk->tet_label, t + 1));
    OST_TRY(OST_GROW(chunk->ctx, &chunk->tet_region, t + 1));
    if (t == 0 || group != chunk->tet_region[t - 1])
        OST_TRY(ost_msh_group(msh, 3, group, &region));
    chunk->tet_label[t] = label;
    chunk->tet_region[t] = group;
    chunk->tet_count++;
    *nodes = chunk->tet_nodes + (size_t)t * (size_t)width;
    return OST_SUCCESS;
}

/* Gmsh has the last two mid-edge nodes of a tet in the opposite order. */
static OstStatus find_tet(const OstMsh *msh, int width, const OstGlobal *tags, OstGlobal *own)
{
    OST_TRY(find_nodes(msh, width, tags, own));
    if (width == 10) {
        const OstGlobal ninth = own[8];
        own[8] = own[9];
        own[9] = ninth;
    }
    return OST_SUCCESS;
}

/* Counts an element once for each of its groups but the first of a tet. */
static OstStatus count_item(OstMsh *msh)
{
    if (++msh->items <= (msh->cursor.end - msh->cursor.bytes) / SMALLEST_SHARE)
        return OST_SUCCESS;
    return OST_RAISE_MSH(&msh->cursor, "elements are in too many physical groups at once; give each fewer");
}

/* A tet in several physical volumes is added once for each. Its nodes by their tags, or, of a piece, their positions.
 */
static OstStatus add_tets(OstMsh *msh, int width, OstGlobal label, const OstGlobal *tags, const OstGlobal *positions,
                          OstGlobal group_count, const int *groups)
{
    OstGlobal *own = NULL;
    for (OstGlobal i = 0; i == 0 || i < group_count; i++) {
        if (i > 0)
            OST_TRY(count_item(msh));
        OST_TRY(add_tet(msh, width, label, group_count > 0 ? abs(groups[i]) : 0, &own));
        if (positions)
            memcpy(own, positions, (size_t)width * sizeof *own);
        else
            OST_TRY(find_tet(msh, width, tags, own));
    }
    return OST_SUCCESS;
}

/* The pieces of a cell, which is then counted as split. */
static OstStatus split(OstMsh *msh, const OstMshCell *cell, OstGlobal tag, const OstGlobal *nodes, OstPieces *pieces)
{
    const int count = ost_cell_facts[cell->kind].nodes;
    OstGlobal in_order[OST_MSH_MOST_NODES], positions[OST_MSH_MOST_NODES];
    if (tag >= OST_LARGEST_LABEL / OST_PIECE_LABELS)
        return OST_RAISE_MSH(&msh->cursor, "element tag %" PRId64 " is too large to number the tets of an element by",
                             tag);
    for (int n = 0; n < count; n++)
        in_order[n] = nodes[cell->place[n]];
    OST_TRY(find_nodes(msh, count, in_order, positions));
    if (!msh->split.chunk)
        ost_split_open(msh->chunk, msh->cursor.path, &msh->split);
    return ost_split_cell(&msh->split, cell->kind, tag, positions, pieces);
}

static OstStatus add_pieces(OstMsh *msh, const OstMshCell *cell, OstGlobal tag, const OstGlobal *nodes,
                            OstGlobal group_count, const int *groups)
{
    OstPieces pieces;
    OST_TRY(split(msh, cell, tag, nodes, &pieces));
    for (int p = 0; p < pieces.count; p++)
        OST_TRY(add_tets(msh, msh->tet_type == OST_MSH_TET4 ? 4 : 10, -(OST_PIECE_LABELS * tag + p + 1), NULL,
                         pieces.nodes[p], group_count, groups));
    return OST_SUCCESS;
}

/* A group of several element types is an error: the first type, and one that differs, are remembered for the message.
 */
static OstStatus add_item(OstMsh *msh, int type, int shape, const OstGlobal *positions, int tag)
{
    const OstMshType *facts = &ost_msh_types[type];
    OstMshGroup *group = NULL;
    OST_TRY(count_item(msh));
    OST_TRY(ost_msh_group(msh, facts->dimension, tag, &group));
    if (group->count == 0)
        group->type = type;
    group->quad = shape ? shape : group->quad;
    if (group->type != type) {
        group->other_type = type;
        return OST_SUCCESS;
    }
    OST_TRY(check_count(msh, group->count));
    OST_TRY(OST_GROW(msh->cursor.ctx, &group->nodes, (size_t)(group->count + 1) * (size_t)facts->nodes));
    memcpy(group->nodes + (size_t)group->count++ * (size_t)facts->nodes, positions,
           (size_t)facts->nodes * sizeof *positions);
    return OST_SUCCESS;
}

static OstStatus add_to_groups(OstMsh *msh, int type, int shape, const OstGlobal *positions, OstGlobal group_count,
                               const int *groups)
{
    for (OstGlobal i = 0; i < group_count; i++)
        if (groups[i] != 0)
            OST_TRY(add_item(msh, type, shape, positions, abs(groups[i])));
    return OST_SUCCESS;
}

/* What bounds the body, if it is in a group. */
static OstStatus add_items(OstMsh *msh, int type, OstGlobal tag, const OstGlobal *nodes, OstGlobal group_count,
                           const int *groups)
{
    const OstMshCell *cell = ost_msh_cell(type);
    OstGlobal positions[OST_MSH_MOST_NODES];
    OstPieces pieces;
    int wanted = 0;
    for (OstGlobal i = 0; i < group_count; i++)
        wanted |= groups[i] != 0;
    if (!wanted)
        return OST_SUCCESS;
    if (!cell) {
        OST_TRY(find_nodes(msh, ost_msh_types[type].nodes, nodes, positions));
        return add_to_groups(msh, type, 0, positions, group_count, groups);
    }
    OST_TRY(split(msh, cell, tag, nodes, &pieces));
    for (int p = 0; p < pieces.count; p++)
        OST_TRY(add_to_groups(msh, ost_msh_types[type].nodes == 4 ? OST_MSH_TRIANGLE3 : OST_MSH_TRIANGLE6, type,
                              pieces.nodes[p], group_count, groups));
    return OST_SUCCESS;
}

int ost_msh_tet_type(int type)
{
    if (type == OST_MSH_TET4 || type == OST_MSH_TET10)
        return type;
    if (!ost_msh_cell(type) || ost_msh_types[type].dimension < 3)
        return 0;
    return ost_msh_types[type].nodes <= 8 ? OST_MSH_TET4 : OST_MSH_TET10;
}

OstStatus ost_msh_add_element(OstMsh *msh, int type, OstGlobal tag, const OstGlobal *nodes, OstGlobal group_count,
                              const int *groups)
{
    const OstMshType *facts = &ost_msh_types[type];
    if (tag < 0)
        return OST_RAISE_MSH(&msh->cursor, "element tag %" PRId64 " found, expected 0 or more", tag);
    msh->read[type]++;
    if (facts->dimension < 3)
        return add_items(msh, type, tag, nodes, group_count, groups);
    const int tet_type = ost_msh_tet_type(type);
    if (msh->tet_type == 0)
        msh->tet_type = tet_type;
    if (tet_type == 0 || tet_type != msh->tet_type)
        return OST_SUCCESS; /* refused later */
    msh->tets_out_of_order |= tag < msh->last_tag;
    msh->last_tag = tag;
    return type == tet_type ? add_tets(msh, facts->nodes, tag, nodes, NULL, group_count, groups)
                            : add_pieces(msh, ost_msh_cell(type), tag, nodes, group_count, groups);
}
