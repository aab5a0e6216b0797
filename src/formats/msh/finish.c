/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/msh/msh.h"
#include "formats/serial/chunk_tidy.h"
#include "mesh/mesh_data.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

/* Turns what was read into a chunk. */

static const char *const entity[] = {"point", "curve", "surface", "volume"};

static OstStatus check_volume_elements(const OstMsh *msh)
{
    OstContext *ctx = msh->cursor.ctx;
    OstGlobal linear = 0, quadratic = 0;
    for (int type = 1; type < OST_MSH_TYPES; type++) {
        const int tets = ost_msh_tet_type(type);
        linear += tets == OST_MSH_TET4 ? msh->read[type] : 0;
        quadratic += tets == OST_MSH_TET10 ? msh->read[type] : 0;
        if (msh->read[type] > 0 && ost_msh_types[type].dimension == 3 && tets == 0)
            return OST_RAISE(ctx, OST_INVALID_INPUT,
                             "%s: holds %" PRId64
                             " elements of Gmsh's type '%s %d', expected linear or quadratic ones; "
                             "mesh the body in order 1 or 2 (gmsh -3 MODEL.geo -order 2 -o NEW.msh)",
                             msh->cursor.path, msh->read[type], ost_msh_types[type].shape, ost_msh_types[type].nodes);
    }
    if (linear > 0 && quadratic > 0)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "%s: holds %" PRId64 " linear and %" PRId64
                         " quadratic solid elements, expected one kind; mesh the whole body in one order",
                         msh->cursor.path, linear, quadratic);
    if (msh->tet_type == 0)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "%s: holds no tets among its %" PRId64 " elements; mesh the volume (gmsh -3 MODEL.geo -o "
                         "NEW.msh), and where the model has physical groups, put the volume into one, as Gmsh saves "
                         "nothing else (or set Mesh.SaveAll = 1)",
                         msh->cursor.path, msh->elements);
    return OST_SUCCESS;
}

/* The pieces of element 17 are 171, 172, ..., and an element that was not split is 171. */
static OstStatus label_pieces(OstMsh *msh)
{
    OstMeshChunk *chunk = msh->chunk;
    for (OstLocal t = 0; t < chunk->tet_count; t++) {
        OstGlobal *label = &chunk->tet_label[t];
        if (*label >= OST_LARGEST_LABEL / OST_PIECE_LABELS)
            return OST_RAISE(msh->cursor.ctx, OST_LIMIT_EXCEEDED,
                             "%s: element tag %" PRId64 " is too large to number the tets of an element by",
                             msh->cursor.path, *label);
        *label = *label < 0 ? -*label : OST_PIECE_LABELS * *label + 1;
    }
    chunk->of_cells = 1;
    ost_split_say(&msh->split);
    return OST_SUCCESS;
}

static OstStatus size_tets(OstMsh *msh)
{
    OstMeshChunk *chunk = msh->chunk;
    const OstLocal count = chunk->tet_count;
    chunk->nodes_per_tet = msh->tet_type == OST_MSH_TET4 ? 4 : 10;
    chunk->global_tets = count;
    OST_TRY(OST_RESIZE(chunk->ctx, &chunk->tet_nodes, (size_t)count * (size_t)chunk->nodes_per_tet));
    OST_TRY(OST_RESIZE(chunk->ctx, &chunk->tet_label, count));
    return OST_RESIZE(chunk->ctx, &chunk->tet_region, count);
}

/* The name of a physical group, or a default like "surface-3". */
static OstStatus copy_group_name(const OstMsh *msh, int dimension, int tag, char **name)
{
    char text[256] = "";
    for (const OstMshName *n = msh->name; n < msh->name + msh->name_count; n++)
        if (n->tag == tag && (n->dimension == dimension || n->dimension < 0))
            snprintf(text, sizeof text, "%.*s", n->text.length, n->text.start);
    if (text[0] == '\0')
        snprintf(text, sizeof text, "%s-%d", entity[dimension], tag);
    return ost_copy_string(msh->cursor.ctx, text, name);
}

/* The first group of a region (or boundary), by its number. */
static const OstMshGroup *first_group(const OstMsh *msh, int is_region, int number)
{
    const OstMshGroup *group = msh->group;
    while ((group->dimension == 3) != is_region || group->number != number)
        group++;
    return group;
}

static void warn_of_shared_name(const OstMsh *msh, const OstMshGroup *group, const char *name)
{
    const OstMshGroup *first = first_group(msh, group->dimension == 3, group->number);
    ost_warn(msh->cursor.ctx, "%s: the physical %ss %d and %d have the same name '%s'; they are taken as one",
             msh->cursor.path, entity[group->dimension], first->tag, group->tag, name);
}

/* Physical volumes with the same name are one region. */
static OstStatus name_region(const OstMsh *msh, OstMshGroup *group)
{
    OstNames *regions = &msh->chunk->regions;
    char *name = NULL;
    OST_TRY(copy_group_name(msh, 3, group->tag, &name));
    OstStatus status = OST_SUCCESS;
    group->number = ost_names_find(regions, name);
    if (group->number >= 0) {
        warn_of_shared_name(msh, group, name);
    } else {
        group->number = regions->count;
        status = ost_names_add(msh->cursor.ctx, regions, name);
    }
    OST_FREE(name);
    return status;
}

/* Tets in no physical volume form a region of their own, the last. */
static OstStatus make_regions(OstMsh *msh)
{
    OstMeshChunk *chunk = msh->chunk;
    OstMshGroup *group = msh->group;
    int volumes = 0;
    for (; volumes < msh->group_count && group[volumes].dimension == 3; volumes++)
        if (group[volumes].tag != 0)
            OST_TRY(name_region(msh, &group[volumes]));
    if (group[0].tag == 0) {
        group[0].number = chunk->regions.count;
        OST_TRY(ost_names_add_unique(chunk->ctx, &chunk->regions, volumes > 1 ? "unnamed" : "volume"));
    }
    for (OstLocal t = 0; t < chunk->tet_count; t++) {
        if (group->dimension != 3 || group->tag != chunk->tet_region[t])
            OST_TRY(ost_msh_group(msh, 3, chunk->tet_region[t], &group));
        chunk->tet_region[t] = group->number;
    }
    return OST_SUCCESS;
}

/* Elements of a boundary must be of the type that bounds the tets. */
static OstStatus check_group(const OstMsh *msh, const OstMshGroup *group, const char *name)
{
    static const int types[2][3] = {{OST_MSH_POINT, OST_MSH_LINE2, OST_MSH_TRIANGLE3},
                                    {OST_MSH_POINT, OST_MSH_LINE3, OST_MSH_TRIANGLE6}};
    const int expected = types[msh->tet_type == OST_MSH_TET10][group->dimension];
    const int quad = msh->split.tets == 0 || group->type != expected ? group->quad : 0;
    const int found = quad ? quad : group->type != expected ? group->type : group->other_type;
    if (found == 0)
        return OST_SUCCESS;
    return OST_RAISE(msh->cursor.ctx, OST_INVALID_INPUT,
                     "%s: boundary '%s' holds elements of Gmsh's type '%s %d', expected '%s %d' as on tets of %d nodes",
                     msh->cursor.path, name, ost_msh_types[found].shape, ost_msh_types[found].nodes,
                     ost_msh_types[expected].shape, ost_msh_types[expected].nodes, msh->chunk->nodes_per_tet);
}

static OstStatus merge_group(const OstMsh *msh, const OstMshGroup *group, OstBoundary *boundary)
{
    const size_t width = (size_t)boundary->nodes_per_item;
    if (boundary->dimension != group->dimension)
        return OST_RAISE(msh->cursor.ctx, OST_INVALID_INPUT,
                         "%s: the physical name '%s' stands for %s %d and %s %d; give each its own", msh->cursor.path,
                         boundary->name, entity[boundary->dimension], first_group(msh, 0, group->number)->tag,
                         entity[group->dimension], group->tag);
    if (group->count > INT_MAX - boundary->count)
        return OST_RAISE(msh->cursor.ctx, OST_LIMIT_EXCEEDED, "%s: boundary '%s' has more than %d items",
                         msh->cursor.path, boundary->name, INT_MAX);
    warn_of_shared_name(msh, group, boundary->name);
    OST_TRY(OST_RESIZE(msh->cursor.ctx, &boundary->nodes, (size_t)(boundary->count + group->count) * width));
    memcpy(boundary->nodes + (size_t)boundary->count * width, group->nodes,
           (size_t)group->count * width * sizeof *group->nodes);
    boundary->count += group->count;
    return OST_SUCCESS;
}

/* Moves the group's nodes and its name into the chunk. */
static OstStatus add_boundary(const OstMsh *msh, OstMshGroup *group, char **name)
{
    OstMeshChunk *chunk = msh->chunk;
    OST_TRY(check_group(msh, group, *name));
    for (int b = 0; b < chunk->boundary_count; b++)
        if (strcmp(chunk->boundaries[b].name, *name) == 0) {
            group->number = b;
            return merge_group(msh, group, &chunk->boundaries[b]);
        }
    group->number = chunk->boundary_count;
    OST_TRY(OST_RESIZE(chunk->ctx, &chunk->boundaries, chunk->boundary_count + 1));
    chunk->boundaries[chunk->boundary_count++] =
        (OstBoundary){*name, group->dimension, ost_msh_types[group->type].nodes, group->count, group->nodes};
    *name = NULL;
    group->nodes = NULL;
    return OST_SUCCESS;
}

static OstStatus make_boundaries(const OstMsh *msh)
{
    OST_TRY(OST_NEW(msh->cursor.ctx, &msh->chunk->boundaries, 0));
    for (int g = 0; g < msh->group_count; g++) {
        char *name = NULL;
        OstMshGroup *group = &msh->group[g];
        if (group->dimension == 3)
            continue;
        OstStatus status = copy_group_name(msh, group->dimension, group->tag, &name);
        OST_THEN(add_boundary(msh, group, &name));
        OST_FREE(name);
        OST_TRY(status);
    }
    return OST_SUCCESS;
}

OstStatus ost_msh_finish(OstMsh *msh)
{
    const char *path = msh->cursor.path;
    OST_TRY(check_volume_elements(msh));
    OST_TRY(size_tets(msh));
    if (msh->split.tets > 0)
        OST_TRY(label_pieces(msh));
    OST_TRY(make_regions(msh));
    OST_TRY(make_boundaries(msh));
    OST_TRY(ost_tets_join_same(msh->chunk, path));
    OST_TRY(ost_tets_sort(msh->chunk, path));
    if (msh->tets_out_of_order)
        ost_warn(msh->cursor.ctx,
                 "%s: its tets are not in the order of their tags; they are numbered in that order, and a file of "
                 "axes must have it too",
                 path);
    if (msh->ghosts > 0)
        ost_warn(msh->cursor.ctx, "%s: ghost elements, which other partitions have too, are left out: %" PRId64, path,
                 msh->ghosts);
    if (msh->borders)
        ost_warn(msh->cursor.ctx, "%s: the faces, curves and points between partitions are left out of boundaries",
                 path);
    ost_tets_turn(msh->chunk, path);
    return ost_nodes_leave_out(msh->chunk, path);
}
