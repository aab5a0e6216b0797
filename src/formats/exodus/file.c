/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/exodus/file.h"

#include "core/error.h"
#include "core/memory.h"

#include <stdio.h>
#include <strings.h>

/* Where Exodus' nodes of quadratic hexahedra and wedges go: it has the middles of upright edges before those of the
 * top. */
static const int hexahedron[] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10, 11, 16, 17,
                                 18, 19, 12, 13, 14, 15, 26, 24, 25, 20, 21, 22, 23};
static const int wedge[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 12, 13, 14, 9, 10, 11, 15, 16, 17};

/* Types are told by their first three letters, as Exodus' own library does it, in any capitals. */
static const OstExodusType types[] = {
    {"TET", 4, 3, OST_CELL_TET4, NULL},         {"TET", 10, 3, OST_CELL_TET10, NULL},
    {"HEX", 8, 3, OST_CELL_HEX8, NULL},         {"HEX", 20, 3, OST_CELL_HEX20, hexahedron},
    {"HEX", 27, 3, OST_CELL_HEX27, hexahedron}, {"WED", 6, 3, OST_CELL_WEDGE6, NULL},
    {"WED", 15, 3, OST_CELL_WEDGE15, wedge},    {"WED", 18, 3, OST_CELL_WEDGE18, wedge},
    {"PYR", 5, 3, OST_CELL_PYRAMID5, NULL},     {"PYR", 13, 3, OST_CELL_PYRAMID13, NULL},
    {"PYR", 14, 3, OST_CELL_PYRAMID14, NULL},   {"TRI", 3, 2, OST_CELL_TRIANGLE3, NULL},
    {"TRI", 6, 2, OST_CELL_TRIANGLE6, NULL},    {"SHE", 3, 2, OST_CELL_TRIANGLE3, NULL},
    {"SHE", 6, 2, OST_CELL_TRIANGLE6, NULL},    {"SHE", 4, 2, OST_CELL_QUAD4, NULL},
    {"SHE", 8, 2, OST_CELL_QUAD8, NULL},        {"SHE", 9, 2, OST_CELL_QUAD9, NULL},
    {"QUA", 4, 2, OST_CELL_QUAD4, NULL},        {"QUA", 8, 2, OST_CELL_QUAD8, NULL},
    {"QUA", 9, 2, OST_CELL_QUAD9, NULL},        {"BAR", 2, 1, OST_CELL_LINE2, NULL},
    {"BAR", 3, 1, OST_CELL_LINE3, NULL},        {"BEA", 2, 1, OST_CELL_LINE2, NULL},
    {"BEA", 3, 1, OST_CELL_LINE3, NULL},        {"TRU", 2, 1, OST_CELL_LINE2, NULL},
    {"TRU", 3, 1, OST_CELL_LINE3, NULL},        {"EDG", 2, 1, OST_CELL_LINE2, NULL},
    {"EDG", 3, 1, OST_CELL_LINE3, NULL},        {"SPH", 1, 0, OST_CELL_POINT, NULL},
    {"TRI", 0, 2, OST_CELL_KINDS, NULL},        {"SHE", 0, 2, OST_CELL_KINDS, NULL},
    {"QUA", 0, 2, OST_CELL_KINDS, NULL},        {"NSI", 0, 2, OST_CELL_KINDS, NULL},
    {"BAR", 0, 1, OST_CELL_KINDS, NULL},        {"BEA", 0, 1, OST_CELL_KINDS, NULL},
    {"TRU", 0, 1, OST_CELL_KINDS, NULL},        {"EDG", 0, 1, OST_CELL_KINDS, NULL},
    {"SPH", 0, 0, OST_CELL_KINDS, NULL},        {"CIR", 0, 0, OST_CELL_KINDS, NULL},
    {"NUL", 0, 0, OST_CELL_KINDS, NULL},
};
/* NFACED and whatever else. */
static const OstExodusType a_solid = {"", 0, 3, OST_CELL_KINDS, NULL};

enum { MOST_BLOCKS = 10000, NAME = 64 };

static const OstExodusType *find_type(const char *word, OstLocal nodes)
{
    for (size_t t = 0; t < sizeof types / sizeof *types; t++)
        if (strncasecmp(word, types[t].begins, 3) == 0 && (types[t].nodes == nodes || types[t].nodes == 0))
            return &types[t];
    return &a_solid;
}

/* --- ids and maps --- */

OstStatus ost_exodus_ids(const OstExodus *exodus, const char *count, const char *property, OstLocal *found,
                         OstGlobal **ids)
{
    const OstNetcdf *nc = &exodus->nc;
    OstNetcdfRows rows;
    OST_TRY(ost_netcdf_dimension(nc, count, found));
    if (*found > MOST_BLOCKS)
        return OST_RAISE(nc->ctx, OST_LIMIT_EXCEEDED, "%s: %s is %d, at most %d are read", nc->path, count, *found,
                         MOST_BLOCKS);
    OST_TRY(OST_NEW(nc->ctx, ids, *found));
    for (OstLocal i = 0; i < *found; i++)
        (*ids)[i] = i + 1;
    OST_TRY(ost_netcdf_rows(nc, property, 0, 0, &rows));
    if (rows.total != *found || rows.width != 1)
        return OST_SUCCESS;
    do {
        OST_TRY(ost_netcdf_integers(&rows));
        for (OstLocal i = 0; i < rows.count; i++)
            if (rows.integer[i] >= 0 && rows.integer[i] <= OST_LARGEST_LABEL)
                (*ids)[rows.first + i] = rows.integer[i];
    } while (rows.count > 0);
    return OST_SUCCESS;
}

/* A map that gives a number twice, or one below 0, numbers nothing: the places are taken then. */
static OstStatus check_map(OstContext *ctx, const char *path, const char *what, OstLocal count, OstGlobal **labels)
{
    OstLabelIndex index = {0};
    int in_range = 1;
    for (OstLocal i = 0; i < count; i++)
        in_range &= (*labels)[i] >= 0 && (*labels)[i] <= OST_LARGEST_LABEL;
    const OstStatus status = ost_label_index_create(ctx, count, *labels, &index);
    const int repeated = index.repeated;
    ost_label_index_clear(&index);
    if (status == OST_SUCCESS && (repeated || !in_range)) {
        OST_FREE(*labels);
        ost_warn(ctx, "%s: the map of %s numbers has %s; they are numbered as they stand in the file", path, what,
                 repeated ? "one number twice" : "numbers below 0");
    }
    return status;
}

static OstStatus read_map(const OstNetcdf *nc, const char *map, const char *what, OstLocal count, OstGlobal **labels)
{
    OstNetcdfRows rows;
    OST_TRY(ost_netcdf_rows(nc, map, 0, 0, &rows));
    if (!rows.found)
        return OST_SUCCESS;
    if (rows.total != count || rows.width != 1)
        return OST_RAISE(nc->ctx, OST_INVALID_INPUT, "%s: %s has %d numbers, expected %d", nc->path, map,
                         rows.total * rows.width, count);
    if (!nc->dry)
        OST_TRY(OST_NEW(nc->ctx, labels, count));
    do {
        OST_TRY(ost_netcdf_integers(&rows));
        for (OstLocal i = 0; i < rows.count && !nc->dry; i++)
            (*labels)[rows.first + i] = rows.integer[i];
    } while (rows.count > 0);
    return nc->dry ? OST_SUCCESS : check_map(nc->ctx, nc->path, what, count, labels);
}

static OstGlobal label_at(const OstGlobal *labels, OstLocal count, OstGlobal place)
{
    if (place < 1 || place > count)
        return -1;
    return labels ? labels[place - 1] : place;
}

OstGlobal ost_exodus_node(const OstExodus *exodus, OstGlobal place)
{
    return label_at(exodus->node_label, exodus->nodes, place);
}

OstGlobal ost_exodus_element(const OstExodus *exodus, OstGlobal place)
{
    return label_at(exodus->element_label, exodus->elements, place);
}

/* --- blocks --- */

/* Polyhedra list their nodes one after the other; blocks on other ranks of a parallel run are empty, and have none. */
static OstStatus find_block(OstExodus *exodus, OstLocal b)
{
    const OstNetcdf *nc = &exodus->nc;
    OstExodusBlock *block = &exodus->block[b];
    OstNetcdfRows rows;
    char name[NAME], word[OST_NETCDF_NAME];
    snprintf(name, sizeof name, "num_el_in_blk%d", b + 1);
    OST_TRY(ost_netcdf_dimension(nc, name, &block->count));
    snprintf(name, sizeof name, "connect%d", b + 1);
    ost_netcdf_attribute(nc, name, "elem_type", word);
    OST_TRY(ost_netcdf_rows(nc, name, 0, 0, &rows));
    block->type = find_type(word, rows.width);
    block->first = exodus->elements;
    if (block->type->kind != OST_CELL_KINDS && rows.total != block->count)
        return OST_RAISE(nc->ctx, OST_INVALID_INPUT, "%s: %s has %d elements, expected %d", nc->path, name, rows.total,
                         block->count);
    if (block->count > INT32_MAX - exodus->elements)
        return OST_RAISE(nc->ctx, OST_LIMIT_EXCEEDED, "%s: more than %d elements, too many for a serial file", nc->path,
                         INT32_MAX);
    exodus->elements += block->count;
    return OST_SUCCESS;
}

static OstStatus find_blocks(OstExodus *exodus)
{
    OstGlobal *ids = NULL;
    OstStatus status = ost_exodus_ids(exodus, "num_el_blk", "eb_prop1", &exodus->block_count, &ids);
    OST_THEN(OST_NEW(exodus->nc.ctx, &exodus->block, exodus->block_count));
    for (OstLocal b = 0; b < exodus->block_count && status == OST_SUCCESS; b++) {
        exodus->block[b].id = ids[b];
        status = find_block(exodus, b);
    }
    OST_FREE(ids);
    return status;
}

/* The parts of a mesh are joined by the numbers of nodes in all of it. */
static OstStatus check_maps(const OstExodus *exodus)
{
    const char *path = exodus->nc.path;
    if (exodus->nc.dry || exodus->parts == 1 || (exodus->nodes == 0 && exodus->elements == 0))
        return OST_SUCCESS;
    if (exodus->node_label && (exodus->element_label || exodus->elements == 0))
        return OST_SUCCESS;
    return OST_RAISE(exodus->nc.ctx, OST_INVALID_INPUT,
                     "%s: one of %d files of a mesh, without usable numbers of %s in all of it (%s); join the files: "
                     "epu -auto %s",
                     path, exodus->parts, exodus->node_label ? "elements" : "nodes",
                     exodus->node_label ? "elem_num_map" : "node_num_map", path);
}

OstStatus ost_exodus_open(OstContext *ctx, const char *path, int parts, int dry, OstExodus *exodus)
{
    OstLocal dimension = 0;
    *exodus = (OstExodus){.parts = parts};
    OST_TRY(ost_netcdf_open(ctx, path, dry, &exodus->nc));
    OST_TRY(ost_netcdf_dimension(&exodus->nc, "num_dim", &dimension));
    if (dimension != 3)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         dimension == 0 ? "%s: a netCDF file without num_dim; expected a mesh in Exodus II"
                                        : "%s: a mesh in the plane or on a line (num_dim is %d), expected a body in "
                                          "three dimensions",
                         path, dimension);
    OST_TRY(ost_netcdf_dimension(&exodus->nc, "num_nodes", &exodus->nodes));
    OST_TRY(find_blocks(exodus));
    OST_TRY(read_map(&exodus->nc, "node_num_map", "node", exodus->nodes, &exodus->node_label));
    OST_TRY(read_map(&exodus->nc, "elem_num_map", "element", exodus->elements, &exodus->element_label));
    return check_maps(exodus);
}

void ost_exodus_close(OstExodus *exodus)
{
    ost_netcdf_close(&exodus->nc);
    OST_FREE(exodus->node_label, exodus->element_label, exodus->block);
}
