/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/cells/cells.h"
#include "formats/serial/chunk_tidy.h"

#include <inttypes.h>
#include <string.h>

static int is_linear(OstCellKind kind)
{
    return kind == OST_CELL_TET4 || kind == OST_CELL_PYRAMID5 || kind == OST_CELL_WEDGE6 || kind == OST_CELL_HEX8;
}

static OstGlobal count_quads(const OstCells *cells)
{
    return (OstGlobal)cells->list[OST_CELL_QUAD4].count + cells->list[OST_CELL_QUAD8].count +
           cells->list[OST_CELL_QUAD9].count;
}

/* Quadrilaterals bound no tets of the file. */
static void leave_out_quads(OstCells *cells)
{
    for (int k = OST_CELL_QUAD4; k < OST_CELL_KINDS; k++) {
        for (OstLocal i = 0; i < cells->list[k].count; i++)
            ost_cells_skip(cells, 2, "a quadrilateral");
        cells->list[k].count = 0;
    }
}

/* Faces must be of the solids' order. */
static OstStatus check_faces(const OstCells *cells, int quadratic)
{
    const OstCellList *list = cells->list;
    const int split = ost_cells_must_split(cells); /* else quadrilaterals are left out */
    const OstLocal triangles = list[quadratic ? OST_CELL_TRIANGLE3 : OST_CELL_TRIANGLE6].count;
    const OstLocal quads = !split      ? 0
                           : quadratic ? list[OST_CELL_QUAD4].count
                                       : list[OST_CELL_QUAD8].count + list[OST_CELL_QUAD9].count;
    if (triangles == 0 && quads == 0)
        return OST_SUCCESS;
    return OST_RAISE(cells->ctx, OST_INVALID_INPUT,
                     "%s: holds %d triangles and %d quadrilaterals %s nodes in the middle of their edges beside solids "
                     "%s them; mesh the whole body in one order, or leave these shells out",
                     cells->path, triangles, quads, quadratic ? "without" : "with", quadratic ? "with" : "without");
}

static OstStatus check_kinds(const OstCells *cells)
{
    OstGlobal linear = 0, quadratic = 0;
    for (int k = OST_CELL_TET4; k < OST_CELL_QUAD4; k++)
        *(is_linear((OstCellKind)k) ? &linear : &quadratic) += cells->list[k].count;
    if (cells->solids > 0)
        return OST_RAISE(
            cells->ctx, OST_INVALID_INPUT,
            "%s: holds %" PRId64
            " solid elements that are no linear or quadratic tets, hexahedra, wedges or pyramids, the "
            "first of them %s; remesh the body with tets, or split them (in ParaView: Tetrahedralize, then File, Save "
            "Data as .vtu)",
            cells->path, cells->solids, cells->solid);
    if (linear > 0 && quadratic > 0)
        return OST_RAISE(cells->ctx, OST_INVALID_INPUT,
                         "%s: holds %" PRId64 " linear and %" PRId64
                         " quadratic solid elements, expected one kind; mesh the whole body in one order",
                         cells->path, linear, quadratic);
    if (cells->chunk->node_count == 0)
        return OST_RAISE(
            cells->ctx, OST_INVALID_INPUT,
            "%s: holds no nodes as its ending would have them; is it of another program, or a list of what "
            "to do with a mesh in another file?",
            cells->path);
    if (linear + quadratic == 0)
        return OST_RAISE(
            cells->ctx, OST_INVALID_INPUT,
            "%s: holds no tets (%" PRId64 " triangles, %" PRId64 " quadrilaterals, %" PRId64 " nodes); mesh "
            "the volume with tets, as gmsh -3 does",
            cells->path, (OstGlobal)cells->list[OST_CELL_TRIANGLE3].count + cells->list[OST_CELL_TRIANGLE6].count,
            count_quads(cells), (OstGlobal)cells->chunk->node_count);
    return check_faces(cells, quadratic > 0);
}

static OstStatus index_nodes(OstCells *cells)
{
    const OstMeshChunk *chunk = cells->chunk;
    OST_TRY(ost_label_index_create(cells->ctx, chunk->node_count, chunk->node_label, &cells->nodes));
    if (!cells->nodes.repeated)
        return OST_SUCCESS;
    return OST_RAISE(cells->ctx, OST_INVALID_INPUT, "%s: node number %" PRId64 " is given to two nodes", cells->path,
                     cells->nodes.repeated_label);
}

/* Labels become positions. */
static OstStatus find_nodes(const OstCells *cells, const OstCellList *list, size_t width)
{
    for (size_t i = 0; i < (size_t)list->count * width; i++) {
        const OstGlobal position = ost_label_index_find(&cells->nodes, list->nodes[i]);
        if (position < 0)
            return OST_RAISE(cells->ctx, OST_INVALID_INPUT,
                             "%s: element %" PRId64 " uses node %" PRId64 ", which the file does not define",
                             cells->path, list->label[i / width], list->nodes[i]);
        list->nodes[i] = position;
    }
    return OST_SUCCESS;
}

/* Sets name cells by their labels, which no two may share then. */
static OstStatus index_labels(OstCells *cells)
{
    int wanted = 0;
    OstGlobal count = 0, *label = NULL;
    for (int s = 0; s < cells->set_count; s++)
        wanted |= cells->set[s].kind != OST_SET_OF_NODES && cells->set[s].count > 0;
    ost_label_index_clear(&cells->labels);
    if (!wanted)
        return OST_SUCCESS;
    for (int k = 0; k < OST_CELL_KINDS; k++)
        count += cells->list[k].count;
    OST_TRY(OST_NEW(cells->ctx, &label, count));
    count = 0;
    for (int k = 0; k < OST_CELL_KINDS; k++) {
        const OstCellList *list = &cells->list[k];
        if (list->count > 0)
            memcpy(label + count, list->label, (size_t)list->count * sizeof *label);
        count += list->count;
    }
    OstStatus status = ost_label_index_create(cells->ctx, count, label, &cells->labels);
    if (status == OST_SUCCESS && cells->labels.repeated)
        status = OST_RAISE(cells->ctx, OST_INVALID_INPUT,
                           "%s: element number %" PRId64 " is given to two elements, and there are sets of elements; "
                           "give each its own",
                           cells->path, cells->labels.repeated_label);
    OST_FREE(label);
    return status;
}

OstCellKind ost_cells_find(const OstCells *cells, OstGlobal label, OstLocal *position)
{
    OstGlobal at = ost_label_index_find(&cells->labels, label);
    int kind = at < 0 ? OST_CELL_KINDS : 0;
    while (kind < OST_CELL_KINDS && at >= cells->list[kind].count)
        at -= cells->list[kind++].count;
    *position = (OstLocal)at;
    return (OstCellKind)kind;
}

static void take_tets(OstCells *cells, OstCellKind kind)
{
    OstMeshChunk *chunk = cells->chunk;
    OstCellList *list = &cells->list[kind];
    chunk->nodes_per_tet = ost_cell_facts[kind].nodes;
    chunk->global_tets = chunk->tet_count = list->count;
    chunk->global_nodes = chunk->node_count;
    chunk->tet_nodes = list->nodes;
    chunk->tet_label = list->label;
    list->nodes = NULL;
    list->label = NULL;
}

static OstStatus build(OstCells *cells)
{
    const int split = ost_cells_must_split(cells);
    OST_TRY(check_kinds(cells));
    if (!split)
        leave_out_quads(cells);
    OST_TRY(index_nodes(cells));
    for (int k = 0; k < OST_CELL_KINDS; k++)
        OST_TRY(find_nodes(cells, &cells->list[k], (size_t)ost_cell_facts[k].nodes));
    OST_TRY(index_labels(cells));
    if (split)
        OST_TRY(ost_cells_split(cells));
    if (split)
        OST_TRY(index_labels(cells));
    const OstCellKind tets = cells->list[OST_CELL_TET4].count > 0 ? OST_CELL_TET4 : OST_CELL_TET10;
    OST_TRY(ost_cells_make_regions(cells, tets));
    OST_TRY(ost_cells_make_boundaries(cells, tets));
    take_tets(cells, tets);
    if (cells->others > 0)
        ost_warn(cells->ctx,
                 "%s: %" PRId64 " elements that neither are tets nor bound them are left out, the first of them %s",
                 cells->path, cells->others, cells->other);
    if (cells->missing > 0)
        ost_warn(cells->ctx, "%s: sets name %" PRId64 " nodes or elements that are no part of the body; left out",
                 cells->path, cells->missing);
    OST_TRY(ost_tets_join_same(cells->chunk, cells->path));
    OST_TRY(ost_tets_sort(cells->chunk, cells->path));
    ost_tets_turn(cells->chunk, cells->path);
    return ost_nodes_leave_out(cells->chunk, cells->path);
}

OstStatus ost_cells_finish(OstCells *cells, OstMeshChunk **chunk)
{
    OST_TRY(build(cells));
    *chunk = cells->chunk;
    cells->chunk = NULL;
    return OST_SUCCESS;
}
