/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/cells/cells.h"

#include "core/error.h"
#include "core/memory.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>

enum { MOST_ITEMS = INT_MAX / 3 * 2 };

const OstCellFacts ost_cell_facts[OST_CELL_KINDS] = {
    [OST_CELL_POINT] = {0, 1},      [OST_CELL_LINE2] = {1, 2},     [OST_CELL_LINE3] = {1, 3},
    [OST_CELL_TRIANGLE3] = {2, 3},  [OST_CELL_TRIANGLE6] = {2, 6}, [OST_CELL_TET4] = {3, 4},
    [OST_CELL_TET10] = {3, 10},     [OST_CELL_PYRAMID5] = {3, 5},  [OST_CELL_PYRAMID13] = {3, 13},
    [OST_CELL_PYRAMID14] = {3, 14}, [OST_CELL_WEDGE6] = {3, 6},    [OST_CELL_WEDGE15] = {3, 15},
    [OST_CELL_WEDGE18] = {3, 18},   [OST_CELL_HEX8] = {3, 8},      [OST_CELL_HEX20] = {3, 20},
    [OST_CELL_HEX27] = {3, 27},     [OST_CELL_QUAD4] = {2, 4},     [OST_CELL_QUAD8] = {2, 8},
    [OST_CELL_QUAD9] = {2, 9},
};

OstStatus ost_cells_open(OstContext *ctx, const char *path, OstCells *cells)
{
    *cells = (OstCells){.ctx = ctx, .path = path};
    OST_TRY(OST_NEW(ctx, &cells->chunk, 1));
    cells->chunk->ctx = ctx;
    return OST_SUCCESS;
}

void ost_cells_close(OstCells *cells)
{
    for (int k = 0; k < OST_CELL_KINDS; k++) {
        OST_FREE(cells->list[k].nodes, cells->list[k].label, cells->list[k].group);
    }
    for (int n = 0; n < cells->name_count; n++)
        OST_FREE(cells->name[n].name);
    for (int s = 0; s < cells->set_count; s++) {
        OST_FREE(cells->set[s].name, cells->set[s].item);
    }
    OST_FREE(cells->name, cells->set);
    ost_label_index_clear(&cells->nodes);
    ost_label_index_clear(&cells->labels);
    ost_chunk_destroy(&cells->chunk);
}

/* Is there a number for one more? */
static OstStatus check_count(const OstCells *cells, OstLocal count)
{
    if (count >= MOST_ITEMS)
        return OST_RAISE(cells->ctx, OST_LIMIT_EXCEEDED,
                         "%s: more than %d nodes or elements, too many for a serial file", cells->path, MOST_ITEMS);
    return OST_SUCCESS;
}

static OstStatus check_label(const OstCells *cells, const char *what, OstGlobal label)
{
    if (label >= 0 && label <= OST_LARGEST_LABEL)
        return OST_SUCCESS;
    return OST_RAISE(cells->ctx, OST_INVALID_INPUT, "%s: %s number %" PRId64 " found, expected 0 to %" PRId64,
                     cells->path, what, label, OST_LARGEST_LABEL);
}

OstStatus ost_cells_add_node(OstCells *cells, OstGlobal label, const double x[3])
{
    OstMeshChunk *chunk = cells->chunk;
    OST_TRY(check_label(cells, "node", label));
    OST_TRY(check_count(cells, chunk->node_count));
    OST_TRY(OST_GROW(cells->ctx, &chunk->node_label, chunk->node_count + 1));
    OST_TRY(OST_GROW(cells->ctx, &chunk->coordinates, 3 * (size_t)(chunk->node_count + 1)));
    chunk->node_label[chunk->node_count] = label;
    memcpy(chunk->coordinates + 3 * (size_t)chunk->node_count++, x, 3 * sizeof *x);
    return OST_SUCCESS;
}

OstStatus ost_cells_add(OstCells *cells, OstCellKind kind, OstGlobal label, OstGlobal group, const OstGlobal *nodes)
{
    OstCellList *list = &cells->list[kind];
    const size_t width = (size_t)ost_cell_facts[kind].nodes;
    OST_TRY(check_label(cells, "element", label));
    OST_TRY(check_count(cells, list->count));
    OST_TRY(OST_GROW(cells->ctx, &list->nodes, (size_t)(list->count + 1) * width));
    OST_TRY(OST_GROW(cells->ctx, &list->label, list->count + 1));
    OST_TRY(OST_GROW(cells->ctx, &list->group, list->count + 1));
    memcpy(list->nodes + (size_t)list->count * width, nodes, width * sizeof *nodes);
    list->label[list->count] = label;
    list->group[list->count++] = group;
    return OST_SUCCESS;
}

void ost_cells_skip(OstCells *cells, int dimension, const char *shape)
{
    char *first = dimension == 3 ? cells->solid : cells->other;
    OstGlobal *count = dimension == 3 ? &cells->solids : &cells->others;
    if ((*count)++ == 0)
        snprintf(first, sizeof cells->solid, "%s", shape);
}

OstStatus ost_cells_name(OstCells *cells, int dimension, OstGlobal group, const char *name)
{
    OST_TRY(OST_RESIZE(cells->ctx, &cells->name, cells->name_count + 1));
    OstCellName *last = &cells->name[cells->name_count++];
    *last = (OstCellName){.dimension = dimension, .group = group};
    return ost_copy_string(cells->ctx, name, &last->name);
}

int ost_cells_find_set(const OstCells *cells, OstSetKind kind, const char *name)
{
    for (int s = 0; s < cells->set_count; s++) {
        const char *other = cells->set[s].name;
        if (cells->set[s].kind == kind && (cells->same_names ? cells->same_names(other, name) : !strcmp(other, name)))
            return s;
    }
    return -1;
}

OstStatus ost_cells_set(OstCells *cells, OstSetKind kind, const char *name, int *set)
{
    *set = ost_cells_find_set(cells, kind, name);
    if (*set >= 0)
        return OST_SUCCESS;
    OST_TRY(OST_RESIZE(cells->ctx, &cells->set, cells->set_count + 1));
    *set = cells->set_count++;
    cells->set[*set] = (OstCellSet){.kind = kind, .is_region = kind == OST_SET_OF_CELLS};
    return ost_copy_string(cells->ctx, name, &cells->set[*set].name);
}

OstStatus ost_cells_put(OstCells *cells, int set, OstGlobal item)
{
    OstCellSet *into = &cells->set[set];
    OST_TRY(check_count(cells, into->count));
    OST_TRY(OST_GROW(cells->ctx, &into->item, into->count + 1));
    into->item[into->count++] = item;
    return OST_SUCCESS;
}
