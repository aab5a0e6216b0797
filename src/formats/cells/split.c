/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/cells/split.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "formats/cells/shapes.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* An edge counts as straight if its middle is no farther from that of its ends than this share of its length. */
static const double straight_share = 1e-5;

void ost_split_open(OstMeshChunk *chunk, const char *path, OstSplit *split)
{
    *split = (OstSplit){.chunk = chunk, .path = path};
}

void ost_split_close(OstSplit *split)
{
    ost_index_destroy(&split->diagonals);
    OST_FREE(split->middle);
}

/* --- vertices --- */

/* The different corners of a face in their order, and how many they are. */
static int corners_of(const OstCellShape *shape, int face, const OstGlobal *nodes, OstGlobal corner[4])
{
    const int places = shape->face[face][3] < 0 ? 3 : 4;
    int count = 0;
    for (int c = 0; c < places; c++) {
        const OstGlobal node = nodes[shape->face[face][c]];
        if (count == 0 || corner[count - 1] != node)
            corner[count++] = node;
    }
    while (count > 1 && corner[count - 1] == corner[0])
        count--;
    return count;
}

static int is_among(int count, const OstGlobal *nodes, OstGlobal node)
{
    for (int i = 0; i < count; i++)
        if (nodes[i] == node)
            return 1;
    return 0;
}

/* Vertices are ordered along a direction in which hardly two corners of a cell are level, so that cells fit that have
 * vertices of their own at the same places, too: once they are merged, or on the sides of a crack. */
static const double order_direction[3] = {1.0, 0.41421356237309505, 0.73205080756887729};

/* The place of the first vertex in that order; of level ones, of the smallest label. */
static int first_of(const OstMeshChunk *chunk, int count, const OstGlobal *nodes)
{
    int place = 0;
    double least = HUGE_VAL;
    for (int i = 0; i < count; i++) {
        const double height = ost_dot3(order_direction, chunk->coordinates + 3 * (size_t)nodes[i]);
        if (!(height < least) && !(height == least && chunk->node_label[nodes[i]] < chunk->node_label[nodes[place]]))
            continue;
        place = i;
        least = height;
    }
    return place;
}

/* Adds the triangle abc, or the tet of it and the apex. */
static void add_piece(OstGlobal a, OstGlobal b, OstGlobal c, OstGlobal apex, OstPieces *pieces)
{
    const OstGlobal nodes[4] = {a, b, c, apex};
    if (a != b && b != c && c != a)
        memcpy(pieces->nodes[pieces->count++], nodes, sizeof nodes);
}

static void add_face(const OstMeshChunk *chunk, int count, const OstGlobal corner[4], OstGlobal apex, OstPieces *pieces)
{
    if (count < 3)
        return;
    const int s = count == 4 ? first_of(chunk, 4, corner) : 0;
    add_piece(corner[s], corner[(s + 1) % count], corner[(s + 2) % count], apex, pieces);
    if (count == 4)
        add_piece(corner[s], corner[(s + 2) % 4], corner[(s + 3) % 4], apex, pieces);
}

/* If no diagonal goes through the vertex opposite the apex, its corner of the hexahedron is cut off: five tets, and a
 * better shape than six. */
static void cut_corner_off(OstGlobal opposite, OstPieces *tets)
{
    int with[OST_MOST_PIECES], place[OST_MOST_PIECES], count = 0;
    for (int t = 0; t < tets->count; t++)
        for (int i = 0; i < 3; i++)
            if (tets->nodes[t][i] == opposite) {
                place[count] = i;
                with[count++] = t;
            }
    if (tets->count != 6 || count != 3)
        return;
    OstGlobal *first = tets->nodes[with[0]], *second = tets->nodes[with[1]];
    const OstGlobal p = first[(place[0] + 1) % 3], q = first[(place[0] + 2) % 3], apex = first[3];
    OstGlobal r = second[(place[1] + 1) % 3];
    if (r == p || r == q)
        r = second[(place[1] + 2) % 3];
    memcpy(first, (OstGlobal[]){opposite, p, q, r}, 4 * sizeof *first);
    memcpy(second, (OstGlobal[]){p, q, r, apex}, 4 * sizeof *second);
    memcpy(tets->nodes[with[2]], tets->nodes[--tets->count], sizeof tets->nodes[0]);
}

static double volume(const OstMeshChunk *chunk, const OstGlobal *tet)
{
    double edge[9];
    for (int e = 0; e < 3; e++)
        for (int d = 0; d < 3; d++)
            edge[3 * e + d] = chunk->coordinates[3 * tet[e + 1] + d] - chunk->coordinates[3 * tet[0] + d];
    return ost_determinant3(edge);
}

/* VTK has the first triangle of a linear wedge seen from outside; its quadratic wedge, and most programs, from inside.
 */
static void turn_wedge(const OstMeshChunk *chunk, OstPieces *tets)
{
    int inverted = 0;
    for (int t = 0; t < tets->count; t++) {
        const double signed_volume = volume(chunk, tets->nodes[t]);
        if (!(signed_volume <= 0.0))
            return;
        inverted |= signed_volume < 0.0;
    }
    for (int t = 0; inverted && t < tets->count; t++) {
        const OstGlobal kept = tets->nodes[t][0];
        tets->nodes[t][0] = tets->nodes[t][1];
        tets->nodes[t][1] = kept;
    }
}

/* Tets from the first vertex to the triangles of the faces that it is not on: their faces on the others then have
 * their diagonals through it too. */
void ost_split_vertices(const OstMeshChunk *chunk, OstCellKind kind, const OstGlobal *nodes, OstPieces *pieces)
{
    const OstCellShape *shape = ost_cell_shape(kind);
    const int solid = kind < OST_CELL_QUAD4, apex = first_of(chunk, shape->vertices, nodes);
    OstGlobal corner[4];
    pieces->count = 0;
    for (int f = 0; f < shape->faces; f++) {
        const int count = corners_of(shape, f, nodes, corner);
        if (!solid || !is_among(count, corner, nodes[apex]))
            add_face(chunk, count, corner, nodes[apex], pieces);
    }
    if (kind == OST_CELL_HEX8 || kind == OST_CELL_HEX20) /* the node in the middle of a HEX27 is on its diagonal */
        cut_corner_off(nodes[apex ^ 6], pieces);
    if (kind >= OST_CELL_WEDGE6 && kind < OST_CELL_HEX8)
        turn_wedge(chunk, pieces);
}

/* --- mid-edge nodes --- */

/* A cell while it is split. */
typedef struct Cell {
    const OstCellShape *shape;
    int count;
    const OstGlobal *nodes;
} Cell;

static double *place_of(const OstSplit *split, OstGlobal node)
{
    return split->chunk->coordinates + 3 * (size_t)node;
}

static int joins(const OstGlobal *nodes, int i, int j, OstGlobal a, OstGlobal b)
{
    return (nodes[i] == a && nodes[j] == b) || (nodes[i] == b && nodes[j] == a);
}

/* The mid-edge node of the cell between two nodes; -1: they are not the ends of an edge. */
static OstGlobal edge_middle(const Cell *cell, OstGlobal a, OstGlobal b)
{
    for (int e = 0; e < cell->shape->edges; e++)
        if (joins(cell->nodes, cell->shape->edge[e][0], cell->shape->edge[e][1], a, b))
            return cell->nodes[cell->shape->vertices + e];
    return -1;
}

/* The face that two nodes are opposite corners of; -1: none. */
static int face_across(const Cell *cell, OstGlobal a, OstGlobal b)
{
    OstGlobal corner[4];
    for (int f = 0; f < cell->shape->faces; f++)
        if (corners_of(cell->shape, f, cell->nodes, corner) == 4 &&
            (joins(corner, 0, 2, a, b) || joins(corner, 1, 3, a, b)))
            return f;
    return -1;
}

static int is_straight(const OstSplit *split, OstGlobal a, OstGlobal b, OstGlobal middle)
{
    double along[3], off[3];
    for (int d = 0; d < 3; d++) {
        along[d] = place_of(split, b)[d] - place_of(split, a)[d];
        off[d] = place_of(split, middle)[d] - 0.5 * place_of(split, a)[d] - 0.5 * place_of(split, b)[d];
    }
    return ost_norm3(off) <= straight_share * ost_norm3(along);
}

static int is_corner(const OstCellShape *shape, int face, int vertex)
{
    const int *corner = shape->face[face];
    return corner[0] == vertex || corner[1] == vertex || corner[2] == vertex || corner[3] == vertex;
}

/* Is a face of four straight edges plane? Its diagonals then meet. */
static int is_plane(const OstSplit *split, const Cell *cell, int face)
{
    double diagonal[2][3], normal[3], between = 0.0;
    const double *corner[4];
    for (int c = 0; c < 4; c++)
        corner[c] = place_of(split, cell->nodes[cell->shape->face[face][c]]);
    for (int d = 0; d < 3; d++) {
        diagonal[0][d] = corner[2][d] - corner[0][d];
        diagonal[1][d] = corner[3][d] - corner[1][d];
    }
    ost_cross3(diagonal[0], diagonal[1], normal);
    for (int d = 0; d < 3; d++)
        between += normal[d] * (corner[1][d] - corner[0][d]);
    return fabs(between) <= straight_share * ost_norm3(normal) * ost_norm3(diagonal[0]);
}

/* The centre of a face, or (-1) of the hexahedron, by its shape functions: corners count -1/4, and middles of edges 1/2
 * or, of the hexahedron, 1/4. Where all these edges are straight, and the face plane, x stays: the middle of the
 * diagonal.
 */
static void find_centre(const OstSplit *split, const Cell *cell, int face, double x[3])
{
    const OstCellShape *shape = cell->shape;
    const double of_middle = face < 0 ? 0.25 : 0.5, of_end = face < 0 ? -0.25 / 3.0 : -0.25 / 2.0;
    double sum[3] = {0.0};
    int straight = 1;
    for (int e = 0; e < shape->edges; e++) {
        const int *end = shape->edge[e];
        if (face >= 0 && !(is_corner(shape, face, end[0]) && is_corner(shape, face, end[1])))
            continue;
        const OstGlobal a = cell->nodes[end[0]], b = cell->nodes[end[1]], middle = cell->nodes[shape->vertices + e];
        straight &= is_straight(split, a, b, middle);
        for (int d = 0; d < 3; d++)
            sum[d] += of_middle * place_of(split, middle)[d] + of_end * (place_of(split, a)[d] + place_of(split, b)[d]);
    }
    if (!straight || (face >= 0 && !is_plane(split, cell, face)))
        memcpy(x, sum, sizeof sum);
}

static OstStatus add_node(OstSplit *split, const double x[3], OstGlobal *node)
{
    OstMeshChunk *chunk = split->chunk;
    if (split->next_label == 0)
        for (OstLocal n = 0; n < chunk->node_count; n++)
            if (chunk->node_label[n] >= split->next_label)
                split->next_label = chunk->node_label[n] + 1;
    if (chunk->node_count >= INT32_MAX / 3 * 2 || split->next_label > OST_LARGEST_LABEL)
        return OST_RAISE(chunk->ctx, OST_LIMIT_EXCEEDED,
                         "%s: its nodes are too many, or their numbers too large, for nodes in the middle of diagonals",
                         split->path);
    OST_TRY(OST_GROW(chunk->ctx, &chunk->node_label, chunk->node_count + 1));
    OST_TRY(OST_GROW(chunk->ctx, &chunk->coordinates, 3 * (size_t)(chunk->node_count + 1)));
    chunk->node_label[chunk->node_count] = split->next_label++;
    memcpy(chunk->coordinates + 3 * (size_t)chunk->node_count, x, 3 * sizeof *x);
    *node = chunk->node_count++;
    return OST_SUCCESS;
}

/* The node in the middle of a diagonal that is new: the cell's own in the middle of the face (-1: of the body), or one
 * that is added. */
static OstStatus new_middle(OstSplit *split, const Cell *cell, int face, OstGlobal a, OstGlobal b, OstGlobal *node)
{
    const int own = face < 0 ? cell->shape->centre : cell->shape->middle[face];
    double x[3];
    if (own > 0 && own < cell->count) {
        *node = cell->nodes[own];
        return OST_SUCCESS;
    }
    for (int d = 0; d < 3; d++)
        x[d] = 0.5 * place_of(split, a)[d] + 0.5 * place_of(split, b)[d];
    find_centre(split, cell, face, x);
    return add_node(split, x, node);
}

/* Diagonals are shared with the cells beside. */
static OstStatus diagonal_middle(OstSplit *split, const Cell *cell, OstGlobal a, OstGlobal b, OstGlobal *node)
{
    OstContext *ctx = split->chunk->ctx;
    OstLocal place = 0;
    if (!split->diagonals)
        OST_TRY(ost_index_create(ctx, 2, &split->diagonals));
    const OstLocal before = split->diagonals->count;
    OST_TRY(ost_index_place(split->diagonals, (OstGlobal[]){a < b ? a : b, a < b ? b : a}, &place));
    OST_TRY(OST_GROW(ctx, &split->middle, (size_t)place + 1));
    if (place == before) {
        OST_TRY(new_middle(split, cell, face_across(cell, a, b), a, b, node));
        split->middle[place] = (OstLocal)*node;
    }
    *node = split->middle[place];
    return OST_SUCCESS;
}

/* In the order of a tet's mid-edge nodes, or of a triangle's. */
static OstStatus add_middles(OstSplit *split, const Cell *cell, int vertices, OstGlobal *piece)
{
    static const int ends[2][6][2] = {{{0, 1}, {1, 2}, {2, 0}}, {{0, 1}, {1, 2}, {0, 2}, {0, 3}, {1, 3}, {2, 3}}};
    for (int e = 0; e < (vertices == 3 ? 3 : 6); e++) {
        const int *end = ends[vertices == 4][e];
        OstGlobal *middle = &piece[vertices + e];
        *middle = edge_middle(cell, piece[end[0]], piece[end[1]]);
        if (*middle < 0)
            OST_TRY(diagonal_middle(split, cell, piece[end[0]], piece[end[1]], middle));
    }
    return OST_SUCCESS;
}

OstStatus ost_split_cell(OstSplit *split, OstCellKind kind, OstGlobal label, const OstGlobal *nodes, OstPieces *pieces)
{
    const Cell cell = {ost_cell_shape(kind), ost_cell_facts[kind].nodes, nodes};
    const int vertices = ost_cell_facts[kind].dimension + 1;
    ost_split_vertices(split->chunk, kind, nodes, pieces);
    if (pieces->count == 0)
        return OST_RAISE(split->chunk->ctx, OST_INVALID_INPUT,
                         "%s: element %" PRId64 " is a %s with too few different nodes; remove it", split->path, label,
                         cell.shape->name[0]);
    for (int p = 0; p < pieces->count && cell.count > cell.shape->vertices; p++)
        OST_TRY(add_middles(split, &cell, vertices, pieces->nodes[p]));
    split->cells[kind]++;
    split->tets += vertices == 4 ? pieces->count : 0;
    return OST_SUCCESS;
}

/* "1200 hexahedra and 3 wedges". */
void ost_split_say(const OstSplit *split)
{
    static const OstCellKind first[] = {OST_CELL_HEX8, OST_CELL_WEDGE6, OST_CELL_PYRAMID5};
    OstGlobal count[3];
    char text[128] = "";
    int used = 0, left = 0;
    for (int s = 0; s < 3; s++) {
        count[s] = split->cells[first[s]] + split->cells[first[s] + 1] + split->cells[first[s] + 2];
        left += count[s] > 0;
    }
    for (int s = 0; s < 3; s++)
        if (count[s] > 0)
            used += snprintf(text + used, sizeof text - (size_t)used, "%s%" PRId64 " %s",
                             used == 0     ? ""
                             : --left == 1 ? " and "
                                           : ", ",
                             count[s], ost_cell_shape(first[s])->name[count[s] > 1]);
    ost_log(split->chunk->ctx, OST_LOG_NORMAL, "%s: split %s into %" PRId64 " %s", split->path, text, split->tets,
            split->tets == 1 ? "tet" : "tets");
}
