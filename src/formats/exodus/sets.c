/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/exodus/file.h"

#include <inttypes.h>
#include <stdio.h>

/* Sides of elements are numbered from 1, by the figures of the Exodus manual: first those beside the base, which follow
 * its edges. Of each, its number from 0 in Abaqus's order. */
static const struct Sides {
    OstCellKind first, last;
    int count, face[6];
} sides_of_solids[] = {
    {OST_CELL_TET4, OST_CELL_TET10, 4, {1, 2, 3, 0}},
    {OST_CELL_PYRAMID5, OST_CELL_PYRAMID14, 5, {1, 2, 3, 4, 0}},
    {OST_CELL_WEDGE6, OST_CELL_WEDGE18, 5, {2, 3, 4, 0, 1}},
    {OST_CELL_HEX8, OST_CELL_HEX27, 6, {2, 3, 4, 5, 0, 1}},
};

enum { SHELL_SIDES = 2 }; /* front and back; further ones are its edges */

static const char *const nodes_of = "node_ns%d", *const elements_of = "elem_ss%d", *const sides_of = "side_ss%d";

/* The set of a name, or of its id if it has none. */
static OstStatus open_set(const OstExodus *exodus, OstCells *cells, OstSetKind kind, const char *names, OstLocal s,
                          OstGlobal id, int *set)
{
    char name[OST_NETCDF_NAME];
    OST_TRY(ost_netcdf_text(&exodus->nc, names, s, name));
    if (!name[0])
        snprintf(name, sizeof name, "%s-%" PRId64, kind == OST_SET_OF_NODES ? "nodeset" : "sideset", id);
    return exodus->nc.dry ? OST_SUCCESS : ost_cells_set(cells, kind, name, set);
}

static OstStatus open_list(const OstExodus *exodus, const char *form, OstLocal s, OstNetcdfRows *rows)
{
    char name[64];
    snprintf(name, sizeof name, form, s + 1);
    OST_TRY(ost_netcdf_rows(&exodus->nc, name, 0, 0, rows));
    return rows->total == 0 || rows->width == 1
               ? OST_SUCCESS
               : OST_RAISE(exodus->nc.ctx, OST_INVALID_INPUT, "%s: %s has two dimensions, expected one",
                           exodus->nc.path, name);
}

static OstStatus read_node_set(const OstExodus *exodus, OstCells *cells, OstLocal s, OstGlobal id)
{
    OstNetcdfRows rows;
    int set = 0;
    OST_TRY(open_set(exodus, cells, OST_SET_OF_NODES, "ns_names", s, id, &set));
    OST_TRY(open_list(exodus, nodes_of, s, &rows));
    do {
        OST_TRY(ost_netcdf_integers(&rows));
        for (OstLocal i = 0; i < rows.count && !exodus->nc.dry; i++) {
            const OstGlobal node = ost_exodus_node(exodus, rows.integer[i]);
            cells->missing += node < 0;
            if (node >= 0)
                OST_TRY(ost_cells_put(cells, set, node));
        }
    } while (rows.count > 0);
    return OST_SUCCESS;
}

/* The block of an element, whose place is from 1. */
static const OstExodusBlock *find_block(const OstExodus *exodus, OstGlobal place)
{
    OstLocal low = 0, high = exodus->block_count;
    while (high - low > 1) {
        const OstLocal middle = low + (high - low) / 2;
        if (exodus->block[middle].first < place)
            low = middle;
        else
            high = middle;
    }
    return &exodus->block[low];
}

static const struct Sides *sides_of_kind(OstCellKind kind)
{
    for (size_t k = 0; k < sizeof sides_of_solids / sizeof *sides_of_solids; k++)
        if (kind >= sides_of_solids[k].first && kind <= sides_of_solids[k].last)
            return &sides_of_solids[k];
    return NULL;
}

/* Shells are put whole: into the set of cells of the same name, which bounds together with that of faces. */
static OstStatus put_side(const OstExodus *exodus, OstCells *cells, int faces, OstGlobal place, OstGlobal side)
{
    const OstGlobal label = ost_exodus_element(exodus, place);
    const OstCellKind kind = label < 0 ? OST_CELL_POINT : find_block(exodus, place)->type->kind;
    const struct Sides *solid = sides_of_kind(kind);
    int set = 0;
    if (solid && side >= 1 && side <= solid->count)
        return ost_cells_put(cells, faces, ost_cell_face(label, solid->face[side - 1]));
    if (kind == OST_CELL_KINDS || ost_cell_facts[kind].dimension != 2 || side < 1 || side > SHELL_SIDES) {
        cells->missing++;
        return OST_SUCCESS;
    }
    OST_TRY(ost_cells_set(cells, OST_SET_OF_CELLS, cells->set[faces].name, &set));
    return ost_cells_put(cells, set, label);
}

static OstStatus read_side_set(const OstExodus *exodus, OstCells *cells, OstLocal s, OstGlobal id)
{
    OstNetcdfRows elements, sides;
    int set = 0;
    OST_TRY(open_set(exodus, cells, OST_SET_OF_FACES, "ss_names", s, id, &set));
    OST_TRY(open_list(exodus, elements_of, s, &elements));
    OST_TRY(open_list(exodus, sides_of, s, &sides));
    if (elements.total != sides.total)
        return OST_RAISE(exodus->nc.ctx, OST_INVALID_INPUT, "%s: %s has %d numbers and %s %d, expected as many",
                         exodus->nc.path, elements.name, elements.total, sides.name, sides.total);
    do {
        OST_TRY(ost_netcdf_integers(&elements));
        OST_TRY(ost_netcdf_integers(&sides));
        for (OstLocal i = 0; i < elements.count && !exodus->nc.dry; i++)
            OST_TRY(put_side(exodus, cells, set, elements.integer[i], sides.integer[i]));
    } while (elements.count > 0);
    return OST_SUCCESS;
}

OstStatus ost_exodus_read_sets(const OstExodus *exodus, OstCells *cells)
{
    static const struct {
        const char *count, *property;
        OstStatus (*read)(const OstExodus *exodus, OstCells *cells, OstLocal s, OstGlobal id);
    } kinds[] = {{"num_node_sets", "ns_prop1", read_node_set}, {"num_side_sets", "ss_prop1", read_side_set}};
    OstStatus status = OST_SUCCESS;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds && status == OST_SUCCESS; k++) {
        OstGlobal *ids = NULL;
        OstLocal count = 0;
        status = ost_exodus_ids(exodus, kinds[k].count, kinds[k].property, &count, &ids);
        for (OstLocal s = 0; s < count && status == OST_SUCCESS; s++)
            status = kinds[k].read(exodus, cells, s, ids[s]);
        OST_FREE(ids);
    }
    return status;
}
