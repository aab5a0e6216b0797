/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/msh/msh.h"

/* The entities of versions 3 and 4, to whose physical groups elements belong. Version 4.0 writes points with a box,
 * version 3 all without, and bounds before groups. */

enum { SMALLEST_TAG = 2, SMALLEST_ENTITY = 4 };
enum { GHOST = 4 }; /* stands for the dimension of ghost entities */

static OstGlobal entity_key(int dimension, int tag)
{
    return (OstGlobal)dimension * ((OstGlobal)UINT32_MAX + 1) + (OstGlobal)(uint32_t)tag;
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
    OST_TRY(ost_msh_count(&msh->cursor, what, SMALLEST_TAG, count));
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
    if (msh->version < 40 && dimension > 0)
        OST_TRY(read_tags(msh, "bounds of an entity", 0, &count));
    if (msh->version >= 40)
        OST_TRY(ost_msh_skip_doubles(cursor, "the box of an entity", dimension == 0 && msh->version > 40 ? 3 : 6));
    OST_TRY(read_tags(msh, "physical groups of an entity", 1, &group_count));
    msh->borders |= parent_dimension != dimension && group_count > 0;
    add_entity(msh, dimension, tag, parent_dimension == dimension ? group_count : 0);
    return dimension == 0 || msh->version < 40 ? OST_SUCCESS : read_tags(msh, "bounds of an entity", 0, &count);
}

static OstStatus read_entities(OstMsh *msh, int partitioned)
{
    OstGlobal count[4] = {0}, total = 0;
    for (int dimension = 0; dimension < 4; dimension++) {
        OST_TRY(ost_msh_count(&msh->cursor, "entities", SMALLEST_ENTITY, &count[dimension]));
        total += count[dimension];
    }
    OST_TRY(reserve_entities(msh, total));
    for (int dimension = 0; dimension < 4; dimension++)
        for (OstGlobal i = 0; i < count[dimension]; i++)
            OST_TRY(read_entity(msh, dimension, partitioned));
    return OST_SUCCESS;
}

/* Text, in binary files too. */
OstStatus ost_msh3_entities(OstMsh *msh)
{
    const int binary = msh->cursor.binary;
    msh->cursor.binary = 0;
    OST_TRY(read_entities(msh, 0));
    msh->cursor.binary = binary;
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
    OST_TRY(ost_msh_count(cursor, "ghost entities", 2 * SMALLEST_TAG, &count));
    OST_TRY(reserve_entities(msh, count));
    for (OstGlobal i = 0; i < count; i++) {
        OST_TRY(ost_msh_int(cursor, "the tag of a ghost entity", &tag));
        OST_TRY(ost_msh_int(cursor, "the partition of a ghost entity", &partition));
        add_entity(msh, GHOST, tag, 0);
    }
    return read_entities(msh, 1);
}

OstStatus ost_msh_index_entities(OstMsh *msh)
{
    return ost_label_index_create(msh->cursor.ctx, msh->entity_count, msh->entity, &msh->entities);
}

int ost_msh_is_ghost(const OstMsh *msh, int tag)
{
    return ost_label_index_find(&msh->entities, entity_key(GHOST, tag)) >= 0;
}

void ost_msh_find_groups(const OstMsh *msh, int dimension, int tag, OstGlobal *count, const int **groups)
{
    const OstGlobal at = ost_label_index_find(&msh->entities, entity_key(dimension, tag));
    *count = at < 0 ? 0 : msh->entity_start[at + 1] - msh->entity_start[at];
    *groups = at < 0 ? NULL : msh->entity_group + msh->entity_start[at];
}
