/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "formats/cells/cells.h"
#include "formats/exchange/exchange.h"
#include "formats/serial/line_reader.h"

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* TetGen's files: points in NAME.node, tets in NAME.ele, and, if it is there, faces in NAME.face. Each begins with a
 * line of counts. */

enum { MOST_COLUMNS = 1000 };

typedef struct TetGen {
    OstContext *ctx;
    OstCells cells;
    OstLineReader lines;
    int width;      /* nodes of a tet */
    int node_marks; /* the set of marked points, or -1 */
    OstGlobal flat; /* faces left out: of 3 nodes beside tets of 10 */
} TetGen;

/* --- lines --- */

/* The first line: a count, and up to three more numbers (0 where the line ends). */
static OstStatus read_counts(TetGen *tetgen, const char *what, OstGlobal counts[4])
{
    int found = 0;
    OST_TRY(ost_lines_next(&tetgen->lines, &found));
    if (!found)
        return OST_RAISE_LINE(&tetgen->lines, "the file is empty, expected %s", what);
    for (int i = 0; i < 4; i++) {
        counts[i] = 0;
        if (i == 0 || !ost_lines_ended(&tetgen->lines))
            OST_TRY(ost_lines_integer(&tetgen->lines, what, &counts[i]));
        if (counts[i] < 0 || (i > 0 && counts[i] > MOST_COLUMNS))
            return OST_RAISE_LINE(&tetgen->lines, "%" PRId64 " found, expected %s", counts[i], what);
    }
    return OST_SUCCESS;
}

static OstStatus next_line(TetGen *tetgen, const char *what, OstGlobal done, OstGlobal count)
{
    int found = 0;
    OST_TRY(ost_lines_next(&tetgen->lines, &found));
    return found ? OST_SUCCESS
                 : OST_RAISE_LINE(&tetgen->lines, "the file ends after %" PRId64 " of its %" PRId64 " %s", done, count,
                                  what);
}

static OstStatus read_integers(TetGen *tetgen, const char *what, int count, OstGlobal *numbers)
{
    for (int i = 0; i < count; i++)
        OST_TRY(ost_lines_integer(&tetgen->lines, what, &numbers[i]));
    return OST_SUCCESS;
}

/* The last of `count` numbers of a line, if it is a whole one; else OST_NO_GROUP. */
static OstStatus read_mark(TetGen *tetgen, OstGlobal count, OstGlobal *mark)
{
    double value = NAN;
    *mark = OST_NO_GROUP;
    for (OstGlobal i = 0; i < count && !ost_lines_ended(&tetgen->lines); i++)
        OST_TRY(ost_lines_number(&tetgen->lines, "an attribute", &value));
    if (fabs(value) < 1e15 && value == floor(value))
        *mark = (OstGlobal)value;
    return OST_SUCCESS;
}

/* --- the three files --- */

static OstStatus read_points(TetGen *tetgen)
{
    OstGlobal counts[4], label = 0, mark = 0;
    OST_TRY(read_counts(tetgen, "the number of points", counts));
    if (counts[1] != 3)
        return OST_RAISE_LINE(&tetgen->lines, "points of %" PRId64 " dimensions, expected 3: a mesh of a volume",
                              counts[1]);
    OST_TRY(ost_cells_set(&tetgen->cells, OST_SET_OF_NODES, "marked", &tetgen->node_marks));
    for (OstGlobal i = 0; i < counts[0]; i++) {
        double x[3];
        OST_TRY(next_line(tetgen, "points", i, counts[0]));
        OST_TRY(ost_lines_integer(&tetgen->lines, "the number of a point", &label));
        for (int d = 0; d < 3; d++)
            OST_TRY(ost_lines_number(&tetgen->lines, "a coordinate", &x[d]));
        OST_TRY(ost_cells_add_node(&tetgen->cells, label, x));
        OST_TRY(read_mark(tetgen, counts[2] + counts[3], &mark));
        if (counts[3] > 0 && mark != OST_NO_GROUP && mark != 0)
            OST_TRY(ost_cells_put(&tetgen->cells, tetgen->node_marks, label));
    }
    return OST_SUCCESS;
}

static OstStatus read_tets(TetGen *tetgen)
{
    OstGlobal counts[4], numbers[11], mark = 0;
    OST_TRY(read_counts(tetgen, "the number of tets", counts));
    tetgen->width = (int)counts[1];
    if (counts[1] != 4 && counts[1] != 10)
        return OST_RAISE_LINE(&tetgen->lines, "tets of %" PRId64 " nodes, expected 4 or 10", counts[1]);
    for (OstGlobal i = 0; i < counts[0]; i++) {
        OST_TRY(next_line(tetgen, "tets", i, counts[0]));
        OST_TRY(read_integers(tetgen, "a number of a tet", 1 + tetgen->width, numbers));
        OST_TRY(read_mark(tetgen, counts[2], &mark));
        OST_TRY(ost_cells_add(&tetgen->cells, tetgen->width == 4 ? OST_CELL_TET4 : OST_CELL_TET10, numbers[0], mark,
                              numbers + 1));
    }
    return OST_SUCCESS;
}

/* Numbers on the rest of the line. */
static int count_columns(const OstLineReader *lines)
{
    OstLineReader copy = *lines;
    char word[2];
    int count = 0;
    for (; !ost_lines_ended(&copy); count++)
        ost_lines_word(&copy, word, sizeof word);
    return count;
}

/* Faces of quadratic tets have 6 nodes; after the mark there may be the tets on both sides. */
static OstStatus read_faces(TetGen *tetgen)
{
    OstGlobal counts[4], numbers[7], mark = 0;
    OST_TRY(read_counts(tetgen, "the number of faces", counts));
    for (OstGlobal i = 0; i < counts[0]; i++) {
        OST_TRY(next_line(tetgen, "faces", i, counts[0]));
        const int six = tetgen->width == 10 && count_columns(&tetgen->lines) >= 7 + (int)counts[1];
        OST_TRY(read_integers(tetgen, "a number of a face", six ? 7 : 4, numbers));
        OST_TRY(read_mark(tetgen, counts[1], &mark));
        if (tetgen->width == 10 && !six) {
            tetgen->flat++;
            continue;
        }
        OST_TRY(ost_cells_add(&tetgen->cells, six ? OST_CELL_TRIANGLE6 : OST_CELL_TRIANGLE3, i,
                              mark == 0 ? OST_NO_GROUP : mark, numbers + 1));
    }
    return OST_SUCCESS;
}

/* --- mid-edge nodes --- */

/* Puts each node after the vertices where it is nearest to the middle of an edge: TetGen has an order of its own. */
static void order_middles(const double *x, const OstLabelIndex *index, int vertices, int edges, const int edge[][2],
                          OstGlobal *nodes)
{
    for (int e = 0; e < edges; e++) {
        double least = INFINITY;
        int best = e;
        const OstGlobal a = ost_label_index_find(index, nodes[edge[e][0]]),
                        b = ost_label_index_find(index, nodes[edge[e][1]]);
        for (int k = e; k < edges; k++) {
            const OstGlobal m = ost_label_index_find(index, nodes[vertices + k]);
            double square = 0.0;
            for (int d = 0; d < 3 && a >= 0 && b >= 0 && m >= 0; d++) {
                const double off = x[3 * m + d] - 0.5 * (x[3 * a + d] + x[3 * b + d]);
                square += off * off;
            }
            if (square < least) {
                least = square;
                best = k;
            }
        }
        const OstGlobal kept = nodes[vertices + e];
        nodes[vertices + e] = nodes[vertices + best];
        nodes[vertices + best] = kept;
    }
}

static OstStatus order_quadratic(TetGen *tetgen)
{
    static const int triangle_edge[3][2] = {{0, 1}, {1, 2}, {2, 0}};
    const OstMeshChunk *chunk = tetgen->cells.chunk;
    const OstCellList *tets = &tetgen->cells.list[OST_CELL_TET10], *faces = &tetgen->cells.list[OST_CELL_TRIANGLE6];
    OstLabelIndex index = {0};
    OST_TRY(ost_label_index_create(tetgen->ctx, chunk->node_count, chunk->node_label, &index));
    for (OstLocal t = 0; t < tets->count; t++)
        order_middles(chunk->coordinates, &index, 4, 6, ost_tet_edge, tets->nodes + 10 * (size_t)t);
    for (OstLocal t = 0; t < faces->count; t++)
        order_middles(chunk->coordinates, &index, 3, 3, triangle_edge, faces->nodes + 6 * (size_t)t);
    ost_label_index_clear(&index);
    return OST_SUCCESS;
}

/* --- the mesh --- */

static OstStatus read_one(TetGen *tetgen, const char *base, const char *ending, OstStatus (*read)(TetGen *tetgen))
{
    char path[PATH_MAX];
    if (snprintf(path, sizeof path, "%s%s", base, ending) >= (int)sizeof path)
        return OST_RAISE(tetgen->ctx, OST_INVALID_INPUT, "%s: the path is too long", base);
    OST_TRY(ost_lines_open(tetgen->ctx, path, &tetgen->lines));
    const OstStatus status = read(tetgen);
    ost_lines_close(&tetgen->lines);
    return status;
}

static OstStatus read_all(TetGen *tetgen, const char *path, OstMeshChunk **chunk)
{
    char base[PATH_MAX], faces[PATH_MAX];
    snprintf(base, sizeof base, "%.*s", (int)(strrchr(path, '.') - path), path);
    snprintf(faces, sizeof faces, "%.*s.face", (int)(strrchr(path, '.') - path), path);
    const int has_faces = access(faces, R_OK) == 0;
    OST_TRY(read_one(tetgen, base, ".node", read_points));
    OST_TRY(read_one(tetgen, base, ".ele", read_tets));
    if (has_faces) {
        OST_TRY(read_one(tetgen, base, ".face", read_faces));
        tetgen->cells.set[tetgen->node_marks].count = 0; /* points are marked as their faces are */
    }
    if (tetgen->flat > 0)
        ost_warn(tetgen->ctx, "%s: %" PRId64 " faces of 3 nodes are left out, as tets have 10", faces, tetgen->flat);
    if (tetgen->width == 10)
        OST_TRY(order_quadratic(tetgen));
    return ost_cells_finish(&tetgen->cells, chunk);
}

OstStatus ost_tetgen_read(OstContext *ctx, const char *path, OstMeshChunk **chunk)
{
    TetGen tetgen = {.ctx = ctx};
    OstStatus status = ost_cells_open(ctx, path, &tetgen.cells);
    OST_THEN(read_all(&tetgen, path, chunk));
    ost_cells_close(&tetgen.cells);
    return status;
}
