/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/veg/veg.h"

#include <inttypes.h>
#include <limits.h>
#include <string.h>

/* *VERTICES and *ELEMENTS. */

enum { SHORTEST_VERTEX = 8, SHORTEST_ELEMENT = 10 };

/* A section's header line; only its first number, the count, is needed. */
static OstStatus read_count(OstVeg *veg, const char *what, OstGlobal *count)
{
    char message[64];
    snprintf(message, sizeof message, "the number of %s is", what);
    OST_TRY(ost_veg_expect(veg, message));
    OST_TRY(ost_lines_integer(ost_veg_reader(veg), message, count));
    if (*count < 1)
        return OST_RAISE_LINE(ost_veg_reader(veg), "%" PRId64 " %s stated, expected at least one", *count, what);
    if (*count > INT_MAX)
        return OST_RAISE_LINE(ost_veg_reader(veg), "%" PRId64 " %s stated, at most %d can be read from a .veg file",
                              *count, what, INT_MAX);
    return OST_SUCCESS;
}

/* The line of the next vertex or element. */
static OstStatus next_item(OstVeg *veg, const char *what, OstGlobal stated, OstGlobal read)
{
    int found = 0;
    OST_TRY(ost_veg_next(veg, &found));
    if (found && ost_veg_reader(veg)->text[0] != '*')
        return OST_SUCCESS;
    return OST_RAISE_LINE(ost_veg_reader(veg), "%" PRId64 " %s stated, but only %" PRId64 " follow", stated, what,
                          read);
}

/* How many items to allocate: as many as stated, but no more than fit into this file; more if included files bring
 * them. */
static OstGlobal room_for(const OstVeg *veg, OstGlobal stated, OstGlobal room, OstGlobal shortest)
{
    const OstGlobal possible = veg->reader[0].bytes / shortest + 1;
    const OstGlobal larger = room == 0 ? possible : room + room / 2 + 1;
    return larger < stated ? larger : stated;
}

static OstStatus check_id(OstVeg *veg, const char *what, OstGlobal id)
{
    if (id >= 0)
        return OST_SUCCESS;
    return OST_RAISE_LINE(ost_veg_reader(veg), "%s number %" PRId64 " found, expected 0, 1, 2, ...", what, id);
}

/* Vega takes the n-th line for vertex n and ignores its number; here the number counts. */
static OstStatus index_ids(OstVeg *veg, const char *what, OstGlobal count, const OstGlobal *id, OstLabelIndex *index)
{
    OstLineReader *reader = ost_veg_reader(veg);
    OST_TRY(ost_label_index_create(veg->ctx, count, id, index));
    if (index->repeated)
        return OST_RAISE_LINE(reader, "number %" PRId64 " is given to two %s", index->repeated_label, what);
    if (index->sorted || index->first > 1)
        ost_warn(veg->ctx,
                 "%s:%" PRId64 ": the %s are not numbered 0, 1, 2, ... or 1, 2, 3, ... in their order; they "
                 "are taken by their numbers, which Vega FEM ignores",
                 reader->path, reader->line, what);
    return OST_SUCCESS;
}

static OstStatus read_vertex(OstVeg *veg, OstGlobal vertex)
{
    static const char *const name[] = {"x", "y", "z"};
    OstLineReader *reader = ost_veg_reader(veg);
    OST_TRY(ost_lines_integer(reader, "the vertex number", &veg->vertex_id[vertex]));
    OST_TRY(check_id(veg, "vertex", veg->vertex_id[vertex]));
    for (int c = 0; c < 3; c++)
        OST_TRY(ost_lines_number(reader, name[c], &veg->coordinates[3 * vertex + c]));
    return ost_lines_finish(reader, "a vertex's number and three coordinates");
}

OstStatus ost_veg_vertices(OstVeg *veg)
{
    OstGlobal stated = 0, room = 0;
    if (veg->vertex_count > 0)
        return OST_RAISE_LINE(ost_veg_reader(veg), "a second *VERTICES");
    OST_TRY(read_count(veg, "vertices", &stated));
    for (OstGlobal v = 0; v < stated; v++) {
        OST_TRY(next_item(veg, "vertices", stated, v));
        if (v == room) {
            room = room_for(veg, stated, room, SHORTEST_VERTEX);
            OST_TRY(OST_RESIZE(veg->ctx, &veg->vertex_id, room));
            OST_TRY(OST_RESIZE(veg->ctx, &veg->coordinates, 3 * room));
        }
        OST_TRY(read_vertex(veg, v));
    }
    veg->vertex_count = stated;
    return index_ids(veg, "vertices", stated, veg->vertex_id, &veg->vertices);
}

static OstStatus read_element(OstVeg *veg, OstGlobal element)
{
    OstLineReader *reader = ost_veg_reader(veg);
    OST_TRY(ost_lines_integer(reader, "the element number", &veg->element_id[element]));
    OST_TRY(check_id(veg, "element", veg->element_id[element]));
    for (int i = 0; i < 4; i++) {
        OstGlobal vertex = 0;
        OST_TRY(ost_lines_integer(reader, "a vertex of the element", &vertex));
        const OstGlobal position = ost_label_index_find(&veg->vertices, vertex);
        if (position < 0)
            return OST_RAISE_LINE(
                reader, "element %" PRId64 " uses vertex %" PRId64 ", which is not among the %" PRId64 " of *VERTICES",
                veg->element_id[element], vertex, veg->vertex_count);
        veg->element_vertices[4 * element + i] = position;
    }
    return ost_lines_finish(reader, "an element's number and four vertices");
}

static OstStatus check_kind(OstVeg *veg)
{
    OST_TRY(ost_veg_expect(veg, "the kind of elements (TET) is"));
    const OstLineReader *reader = ost_veg_reader(veg);
    if (strncmp(reader->text, "TET", 3) == 0)
        return OST_SUCCESS;
    if (strncmp(reader->text, "CUBIC", 5) == 0)
        return OST_RAISE_LINE(reader, "elements are CUBIC; only TET can be read: split the cubes into tets");
    return OST_RAISE_LINE(reader, "elements are '%.40s', expected TET", reader->text);
}

OstStatus ost_veg_elements(OstVeg *veg)
{
    OstGlobal stated = 0, room = 0;
    if (veg->vertex_count == 0)
        return OST_RAISE_LINE(ost_veg_reader(veg), "*ELEMENTS before *VERTICES");
    if (veg->element_count > 0)
        return OST_RAISE_LINE(ost_veg_reader(veg), "a second *ELEMENTS");
    OST_TRY(check_kind(veg));
    OST_TRY(read_count(veg, "elements", &stated));
    for (OstGlobal e = 0; e < stated; e++) {
        OST_TRY(next_item(veg, "elements", stated, e));
        if (e == room) {
            room = room_for(veg, stated, room, SHORTEST_ELEMENT);
            OST_TRY(OST_RESIZE(veg->ctx, &veg->element_id, room));
            OST_TRY(OST_RESIZE(veg->ctx, &veg->element_vertices, 4 * room));
        }
        OST_TRY(read_element(veg, e));
    }
    veg->element_count = stated;
    return index_ids(veg, "elements", stated, veg->element_id, &veg->elements);
}
