/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "core/number_set.h"
#include "formats/cells/cells.h"
#include "formats/exchange/exchange.h"
#include "formats/exchange/numbers.h"
#include "formats/msh/cursor.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* I-deas's universal files: data sets between lines of -1, the first line of each its number. Read are nodes (15, 781,
 * 2411), elements (780, 2412) and groups (2417 to 2477), and of coordinate systems (18, 2420) whether they are the
 * global one. */

enum { MOST_NUMBERS = 10, LONGEST_NAME = 80, OF_NODES = 7, OF_ELEMENTS = 8, MOST_NODES = 27 };

typedef struct Unv {
    OstMshCursor cursor;
    OstCells cells;
    OstGlobal number[MOST_NUMBERS]; /* of the present line */
    int numbers;
    int ended; /* was it the -1 that ends the data set? */
    OstLocal other_count, used_count;
    OstGlobal *other; /* coordinate systems that are not the global one */
    OstGlobal *used;  /* by nodes */
} Unv;

/* Elements by their descriptor; `place` is where VTK has each node. */
static const struct {
    int descriptor;
    OstCellKind kind;
    int place[MOST_NODES];
} shapes[] = {
    {111, OST_CELL_TET4, {0, 1, 2, 3}},
    {118, OST_CELL_TET10, {0, 4, 1, 5, 2, 6, 7, 8, 9, 3}},
    {112, OST_CELL_WEDGE6, {0, 1, 2, 3, 4, 5}},
    {113, OST_CELL_WEDGE15, {0, 6, 1, 7, 2, 8, 12, 13, 14, 3, 9, 4, 10, 5, 11}},
    {115, OST_CELL_HEX8, {0, 1, 2, 3, 4, 5, 6, 7}},
    {116, OST_CELL_HEX20, {0, 8, 1, 9, 2, 10, 3, 11, 16, 17, 18, 19, 4, 12, 5, 13, 6, 14, 7, 15}},
    /* Gmsh's, in its own order. */
    {112, OST_CELL_WEDGE18, {0, 1, 2, 3, 4, 5, 6, 8, 12, 7, 13, 14, 9, 11, 10, 15, 17, 16}},
    {115, OST_CELL_HEX27, {0,  1,  2,  3,  4,  5,  6,  7,  8,  11, 16, 9,  17, 10,
                           18, 19, 12, 15, 13, 14, 24, 22, 20, 21, 23, 25, 26}},
    {94, OST_CELL_QUAD9, {0, 1, 2, 3, 4, 5, 6, 7, 8}},
    {44, OST_CELL_QUAD4, {0, 1, 2, 3}},
    {54, OST_CELL_QUAD4, {0, 1, 2, 3}},
    {64, OST_CELL_QUAD4, {0, 1, 2, 3}},
    {71, OST_CELL_QUAD4, {0, 1, 2, 3}},
    {94, OST_CELL_QUAD4, {0, 1, 2, 3}},
    {45, OST_CELL_QUAD8, {0, 4, 1, 5, 2, 6, 3, 7}},
    {55, OST_CELL_QUAD8, {0, 4, 1, 5, 2, 6, 3, 7}},
    {65, OST_CELL_QUAD8, {0, 4, 1, 5, 2, 6, 3, 7}},
    {75, OST_CELL_QUAD8, {0, 4, 1, 5, 2, 6, 3, 7}},
    {95, OST_CELL_QUAD8, {0, 4, 1, 5, 2, 6, 3, 7}},
    {41, OST_CELL_TRIANGLE3, {0, 1, 2}},
    {51, OST_CELL_TRIANGLE3, {0, 1, 2}},
    {61, OST_CELL_TRIANGLE3, {0, 1, 2}},
    {74, OST_CELL_TRIANGLE3, {0, 1, 2}},
    {91, OST_CELL_TRIANGLE3, {0, 1, 2}},
    {42, OST_CELL_TRIANGLE6, {0, 3, 1, 4, 2, 5}},
    {52, OST_CELL_TRIANGLE6, {0, 3, 1, 4, 2, 5}},
    {62, OST_CELL_TRIANGLE6, {0, 3, 1, 4, 2, 5}},
    {72, OST_CELL_TRIANGLE6, {0, 3, 1, 4, 2, 5}},
    {92, OST_CELL_TRIANGLE6, {0, 3, 1, 4, 2, 5}},
    {11, OST_CELL_LINE2, {0, 1}},
    {21, OST_CELL_LINE2, {0, 1}},
    {22, OST_CELL_LINE3, {0, 2, 1}},
    {24, OST_CELL_LINE3, {0, 2, 1}},
};
enum { SHAPES = sizeof shapes / sizeof *shapes };

/* Beams (11 to 32) have a line of their own before their nodes. */
static int is_beam(OstGlobal descriptor)
{
    return descriptor >= 11 && descriptor <= 32;
}

/* --- lines --- */

/* Whole numbers between blanks, up to the first that is none. */
static void split(Unv *unv, OstMshText line)
{
    const char *at = line.start, *end = line.start + line.length;
    unv->numbers = 0;
    while (at < end && unv->numbers < MOST_NUMBERS) {
        const char *stop = at;
        while (stop < end && *stop != ' ' && *stop != '\t')
            stop++;
        if (stop > at && !ost_fortran_integer(at, (size_t)(stop - at), &unv->number[unv->numbers++])) {
            unv->numbers--;
            return;
        }
        for (at = stop; at < end && (*at == ' ' || *at == '\t');)
            at++;
    }
}

static OstMshText next_line(Unv *unv)
{
    const OstMshText line = ost_msh_rest_of_line(&unv->cursor);
    split(unv, line);
    unv->ended = (unv->numbers == 1 && unv->number[0] == -1 && line.length == 2) ||
                 (line.length == 0 && unv->cursor.next >= unv->cursor.end);
    return line;
}

static OstStatus want_numbers(Unv *unv, int count, const char *what)
{
    if (unv->numbers >= count && !unv->ended)
        return OST_SUCCESS;
    return OST_RAISE_MSH(&unv->cursor, "%d whole numbers found, expected %d of %s", unv->ended ? 0 : unv->numbers,
                         count, what);
}

/* --- nodes --- */

/* Three reals between blanks. */
static OstStatus read_reals(Unv *unv, OstMshText line, double x[3])
{
    const char *at = line.start, *end = line.start + line.length;
    for (int d = 0; d < 3; d++) {
        while (at < end && (*at == ' ' || *at == '\t'))
            at++;
        const char *stop = at;
        while (stop < end && *stop != ' ' && *stop != '\t')
            stop++;
        if (!ost_fortran_real(at, (size_t)(stop - at), &x[d]))
            return OST_RAISE_MSH(&unv->cursor, "'%.*s' found, expected a coordinate", (int)(stop - at) & 63, at);
        at = stop;
    }
    return OST_SUCCESS;
}

/* Notes the system that a node states, the second number of its line. */
static OstStatus use_system(Unv *unv)
{
    const OstGlobal system = unv->numbers > 1 ? unv->number[1] : 0;
    if (unv->used_count > 0 && unv->used[unv->used_count - 1] == system)
        return OST_SUCCESS;
    OST_TRY(OST_GROW(unv->cursor.ctx, &unv->used, unv->used_count + 1));
    unv->used[unv->used_count++] = system;
    return OST_SUCCESS;
}

static OstStatus read_nodes(Unv *unv)
{
    for (next_line(unv); !unv->ended; next_line(unv)) {
        double x[3];
        OST_TRY(want_numbers(unv, 1, "a node"));
        OST_TRY(use_system(unv));
        const OstGlobal label = unv->number[0];
        OST_TRY(read_reals(unv, next_line(unv), x));
        OST_TRY(ost_cells_add_node(&unv->cells, label, x));
    }
    return OST_SUCCESS;
}

/* Data set 15 has all in one line: label, two systems, colour, coordinates. */
static OstStatus read_old_nodes(Unv *unv)
{
    for (OstMshText line = next_line(unv); !unv->ended; line = next_line(unv)) {
        double x[3];
        OST_TRY(want_numbers(unv, 4, "a node"));
        OST_TRY(use_system(unv));
        const OstGlobal label = unv->number[0];
        const char *at = line.start, *end = line.start + line.length;
        for (int skipped = 0; skipped < 4; skipped++) {
            while (at < end && *at != ' ' && *at != '\t')
                at++;
            while (at < end && (*at == ' ' || *at == '\t'))
                at++;
        }
        OST_TRY(read_reals(unv, (OstMshText){at, (int)(end - at)}, x));
        OST_TRY(ost_cells_add_node(&unv->cells, label, x));
    }
    return OST_SUCCESS;
}

/* --- coordinate systems --- */

static OstStatus add_system(Unv *unv, OstGlobal label, int is_global)
{
    if (is_global)
        return OST_SUCCESS;
    OST_TRY(OST_GROW(unv->cursor.ctx, &unv->other, unv->other_count + 1));
    unv->other[unv->other_count++] = label;
    return OST_SUCCESS;
}

/* The part and its name; then of each system label, type (0: Cartesian) and colour, its name, and four rows: its axes
 * and its origin. */
static OstStatus read_systems(Unv *unv)
{
    static const double rounding = 1e-12;
    next_line(unv);
    if (!unv->ended)
        next_line(unv);
    for (next_line(unv); !unv->ended; next_line(unv)) {
        OST_TRY(want_numbers(unv, 2, "a coordinate system"));
        const OstGlobal label = unv->number[0];
        int is_global = unv->number[1] == 0;
        next_line(unv);
        for (int row = 0; row < 4; row++) {
            double x[3];
            OST_TRY(read_reals(unv, next_line(unv), x));
            for (int d = 0; d < 3; d++)
                is_global &= fabs(x[d] - (row == d ? 1.0 : 0.0)) < rounding;
        }
        OST_TRY(add_system(unv, label, is_global));
    }
    return OST_SUCCESS;
}

/* Old ones are only noted: label, type and more; a name; nine coordinates in two lines. */
static OstStatus read_old_systems(Unv *unv)
{
    for (next_line(unv); !unv->ended; next_line(unv)) {
        OST_TRY(want_numbers(unv, 2, "a coordinate system"));
        OST_TRY(add_system(unv, unv->number[0], 0));
        for (int skipped = 0; skipped < 3 && !unv->ended; skipped++)
            next_line(unv);
    }
    return OST_SUCCESS;
}

/* They may stand before the nodes or behind them. */
static OstStatus check_systems(Unv *unv)
{
    if (unv->other_count > 0)
        qsort(unv->other, (size_t)unv->other_count, sizeof *unv->other, ost_compare_numbers);
    for (OstLocal u = 0; u < unv->used_count; u++)
        if (ost_numbers_find(unv->other_count, unv->other, unv->used[u]) >= 0)
            return OST_RAISE(unv->cursor.ctx, OST_INVALID_INPUT,
                             "%s: nodes in the coordinate system %" PRId64 ", which is not the global Cartesian one; "
                             "systems are not read: write all nodes in the global one",
                             unv->cursor.path, unv->used[u]);
    return OST_SUCCESS;
}

/* --- elements --- */

/* An element's nodes, over as many lines as they take; those after the last that any shape has are passed over. */
static OstStatus read_nodes_of(Unv *unv, OstGlobal count, OstGlobal nodes[MOST_NODES])
{
    OstGlobal done = 0;
    while (done < count) {
        next_line(unv);
        OST_TRY(want_numbers(unv, 1, "nodes of an element"));
        for (int i = 0; i < unv->numbers && done < count; i++, done++)
            if (done < MOST_NODES)
                nodes[done] = unv->number[i];
    }
    return OST_SUCCESS;
}

static OstStatus add_element(Unv *unv, OstGlobal label, OstGlobal descriptor, OstGlobal count, const OstGlobal *read)
{
    OstGlobal nodes[MOST_NODES];
    char what[48];
    for (int s = 0; s < SHAPES; s++) {
        if (shapes[s].descriptor != descriptor || ost_cell_facts[shapes[s].kind].nodes != count)
            continue;
        for (int n = 0; n < count; n++)
            nodes[shapes[s].place[n]] = read[n];
        return ost_cells_add(&unv->cells, shapes[s].kind, label, OST_NO_GROUP, nodes);
    }
    snprintf(what, sizeof what, "of descriptor %" PRId64 " with %" PRId64 " nodes", descriptor, count);
    ost_cells_skip(&unv->cells, descriptor >= 101 && descriptor <= 118 ? 3 : is_beam(descriptor) ? 1 : 2, what);
    return OST_SUCCESS;
}

/* Label, descriptor, ..., number of nodes. */
static OstStatus read_elements(Unv *unv, int numbers)
{
    for (next_line(unv); !unv->ended; next_line(unv)) {
        OstGlobal nodes[MOST_NODES] = {0};
        OST_TRY(want_numbers(unv, numbers, "an element"));
        const OstGlobal label = unv->number[0], descriptor = unv->number[1], count = unv->number[numbers - 1];
        if (is_beam(descriptor))
            next_line(unv);
        OST_TRY(read_nodes_of(unv, count, nodes));
        OST_TRY(add_element(unv, label, descriptor, count, nodes));
    }
    return OST_SUCCESS;
}

/* --- groups --- */

static OstStatus put(Unv *unv, const char *name, OstGlobal type, OstGlobal label)
{
    int set = -1;
    if (type != OF_NODES && type != OF_ELEMENTS)
        return OST_SUCCESS;
    OST_TRY(ost_cells_set(&unv->cells, type == OF_NODES ? OST_SET_OF_NODES : OST_SET_OF_CELLS, name, &set));
    return ost_cells_put(&unv->cells, set, label);
}

/* Members of a group, as many to a line as fit: `each` numbers, the first the type and the second the label. Where
 * there should be no more, zeros may follow. */
static OstStatus read_members(Unv *unv, const char *name, OstGlobal count, int each)
{
    for (OstGlobal done = 0; done < count;) {
        next_line(unv);
        OST_TRY(want_numbers(unv, each, "a member of a group"));
        for (int i = 0; i + each <= unv->numbers && done < count; i += each) {
            OST_TRY(put(unv, name, unv->number[i], unv->number[i + 1]));
            done += unv->number[i] != 0;
        }
    }
    return OST_SUCCESS;
}

/* The first line of a group ends with the number of its members, the second is its name. */
static OstStatus read_groups(Unv *unv, int each)
{
    for (next_line(unv); !unv->ended; next_line(unv)) {
        char name[LONGEST_NAME];
        OST_TRY(want_numbers(unv, each == 4 ? 8 : 7, "a group"));
        const OstGlobal group = unv->number[0], count = unv->number[each == 4 ? 7 : unv->numbers - 1];
        const OstMshText line = next_line(unv);
        snprintf(name, sizeof name, "%.*s", line.length < LONGEST_NAME ? line.length : LONGEST_NAME - 1, line.start);
        if (!name[0])
            snprintf(name, sizeof name, "group-%" PRId64, group);
        OST_TRY(read_members(unv, name, count, each));
    }
    return OST_SUCCESS;
}

/* --- the file --- */

static OstStatus read_data_set(Unv *unv, OstGlobal number)
{
    switch (number) {
    case 15:
        return read_old_nodes(unv);
    case 781:
    case 2411:
        return read_nodes(unv);
    case 18:
        return read_old_systems(unv);
    case 2420:
        return read_systems(unv);
    case 780:
        return read_elements(unv, 8);
    case 2412:
        return read_elements(unv, 6);
    case 2417:
    case 2429:
    case 2430:
    case 2432:
        return read_groups(unv, 2);
    case 2435:
    case 2452:
    case 2467:
    case 2477:
        return read_groups(unv, 4);
    default:
        do {
            next_line(unv);
        } while (!unv->ended);
        return OST_SUCCESS;
    }
}

static OstStatus read_all(Unv *unv)
{
    while (unv->cursor.next < unv->cursor.end) {
        next_line(unv);
        if (!unv->ended)
            continue;
        next_line(unv);
        if (unv->numbers >= 1 && unv->number[0] > 0)
            OST_TRY(read_data_set(unv, unv->number[0]));
    }
    return OST_SUCCESS;
}

OstStatus ost_unv_read(OstContext *ctx, const char *path, OstMeshChunk **chunk)
{
    Unv unv = {.numbers = 0};
    OstStatus status = ost_cells_open(ctx, path, &unv.cells);
    OST_THEN(ost_msh_open(ctx, path, &unv.cursor));
    OST_THEN(read_all(&unv));
    OST_THEN(check_systems(&unv));
    OST_FREE(unv.other, unv.used);
    ost_msh_close(&unv.cursor);
    OST_THEN(ost_cells_finish(&unv.cells, chunk));
    ost_cells_close(&unv.cells);
    return status;
}
