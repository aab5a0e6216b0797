/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/cells/shapes.h"
#include "formats/cells/split.h"

#include <inttypes.h>

/* The pieces of element 17 are numbered 171, 172, ..., as are those that are not split: 171. */

int ost_cells_must_split(const OstCells *cells)
{
    for (int k = OST_CELL_PYRAMID5; k < OST_CELL_QUAD4; k++)
        if (cells->list[k].count > 0)
            return 1;
    return 0;
}

static OstGlobal piece_label(OstGlobal label, int piece)
{
    return OST_PIECE_LABELS * label + piece + 1;
}

static const OstGlobal *nodes_of(const OstCells *cells, OstCellKind kind, OstLocal cell)
{
    return cells->list[kind].nodes + (size_t)cell * (size_t)ost_cell_facts[kind].nodes;
}

/* The pieces' vertices: of a cell that is not split, itself. */
static void vertices_of(const OstCells *cells, OstCellKind kind, OstLocal cell, OstPieces *pieces)
{
    const OstGlobal *nodes = nodes_of(cells, kind, cell);
    if (kind >= OST_CELL_PYRAMID5) {
        ost_split_vertices(cells->chunk, kind, nodes, pieces);
        return;
    }
    pieces->count = 1;
    for (int v = 0; v <= ost_cell_facts[kind].dimension; v++)
        pieces->nodes[0][v] = nodes[v];
}

/* --- sets --- */

static OstStatus put_pieces(OstCells *cells, int set, OstGlobal label)
{
    OstPieces pieces;
    OstLocal cell = 0;
    const OstCellKind kind = ost_cells_find(cells, label, &cell);
    if (kind == OST_CELL_KINDS)
        return OST_SUCCESS;
    vertices_of(cells, kind, cell, &pieces);
    for (int p = 0; p < pieces.count; p++)
        OST_TRY(ost_cells_put(cells, set, piece_label(label, p)));
    return OST_SUCCESS;
}

/* Does the cell's face have all of a piece's face? */
static int is_on_face(const OstCellShape *shape, int face, const OstGlobal *nodes, const int *corner,
                      const OstGlobal *piece)
{
    int found = 0;
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < 4; i++)
            if (shape->face[face][i] >= 0 && nodes[shape->face[face][i]] == piece[corner[c]]) {
                found++;
                break;
            }
    return found == 3;
}

/* Those faces of the tets that lie on a face of their cell. */
static OstStatus put_faces(OstCells *cells, int set, OstGlobal item)
{
    OstPieces tets;
    OstLocal cell = 0;
    const OstGlobal label = item / OST_CELL_FACES;
    const int face = (int)(item % OST_CELL_FACES);
    const OstCellKind kind = ost_cells_find(cells, label, &cell);
    const OstCellShape *shape = ost_cell_shape(kind);
    if (!shape || kind >= OST_CELL_QUAD4 || face >= shape->faces) {
        cells->missing++;
        return OST_SUCCESS;
    }
    vertices_of(cells, kind, cell, &tets);
    for (int t = 0; t < tets.count; t++)
        for (int f = 0; f < 4; f++)
            if (is_on_face(shape, face, nodes_of(cells, kind, cell), ost_cell_shape(OST_CELL_TET4)->face[f],
                           tets.nodes[t]))
                OST_TRY(ost_cells_put(cells, set, ost_cell_face(piece_label(label, t), f)));
    return OST_SUCCESS;
}

/* Cells are found by the labels that they have in the file: sets come before cells. */
static OstStatus split_set(OstCells *cells, int number)
{
    OstCellSet *set = &cells->set[number];
    OstGlobal *item = set->item;
    const OstLocal count = set->count;
    const int faces = set->kind == OST_SET_OF_FACES;
    OstStatus status = OST_SUCCESS;
    set->item = NULL;
    set->count = 0;
    for (OstLocal i = 0; i < count && status == OST_SUCCESS; i++)
        status = faces ? put_faces(cells, number, item[i]) : put_pieces(cells, number, item[i]);
    OST_FREE(item);
    return status;
}

/* --- cells --- */

static OstStatus check_labels(const OstCells *cells)
{
    for (int k = 0; k < OST_CELL_KINDS; k++)
        for (OstLocal i = 0; i < cells->list[k].count; i++)
            if (cells->list[k].label[i] >= OST_LARGEST_LABEL / OST_PIECE_LABELS)
                return OST_RAISE(cells->ctx, OST_LIMIT_EXCEEDED,
                                 "%s: element number %" PRId64 " is too large to number the tets of an element by; "
                                 "number elements from 1",
                                 cells->path, cells->list[k].label[i]);
    return OST_SUCCESS;
}

/* The cells that are not split. */
static void relabel(OstCells *cells)
{
    for (int k = 0; k < OST_CELL_PYRAMID5; k++)
        for (OstLocal i = 0; i < cells->list[k].count; i++)
            cells->list[k].label[i] = piece_label(cells->list[k].label[i], 0);
}

static OstStatus split_list(OstCells *cells, OstSplit *split, OstCellKind kind)
{
    static const OstCellKind piece[2][2] = {{OST_CELL_TRIANGLE3, OST_CELL_TRIANGLE6}, {OST_CELL_TET4, OST_CELL_TET10}};
    OstCellList *list = &cells->list[kind];
    const int quadratic = ost_cell_facts[kind].nodes > ost_cell_shape(kind)->vertices;
    OstPieces pieces;
    for (OstLocal i = 0; i < list->count; i++) {
        OST_TRY(ost_split_cell(split, kind, list->label[i], nodes_of(cells, kind, i), &pieces));
        for (int p = 0; p < pieces.count; p++)
            OST_TRY(ost_cells_add(cells, piece[kind < OST_CELL_QUAD4][quadratic], piece_label(list->label[i], p),
                                  list->group[i], pieces.nodes[p]));
    }
    OST_FREE(list->nodes, list->label, list->group);
    list->count = 0;
    return OST_SUCCESS;
}

/* Solids with nodes of their own in the middle of faces come first. */
static OstStatus split_all(OstCells *cells, OstSplit *split)
{
    OST_TRY(check_labels(cells));
    for (int s = 0; s < cells->set_count; s++)
        if (cells->set[s].kind != OST_SET_OF_NODES)
            OST_TRY(split_set(cells, s));
    relabel(cells);
    for (int k = OST_CELL_QUAD4 - 1; k >= OST_CELL_PYRAMID5; k--)
        OST_TRY(split_list(cells, split, (OstCellKind)k));
    for (int k = OST_CELL_QUAD4; k < OST_CELL_KINDS; k++)
        OST_TRY(split_list(cells, split, (OstCellKind)k));
    ost_split_say(split);
    cells->chunk->of_cells = 1;
    return OST_SUCCESS;
}

OstStatus ost_cells_split(OstCells *cells)
{
    OstSplit split;
    ost_split_open(cells->chunk, cells->path, &split);
    const OstStatus status = split_all(cells, &split);
    ost_split_close(&split);
    return status;
}
