/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/number_set.h"
#include "formats/exchange/abaqus.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Sets and surfaces of Abaqus's and CalculiX's input. */

/* The nodes of the elements of a set. */
static OstStatus put_nodes_of(OstInp *inp, int from)
{
    OstCells *cells = &inp->cells;
    ost_cells_keep_once(cells, from);
    const OstCellSet *set = &cells->set[from];
    for (int k = 0; k < OST_CELL_KINDS && set->count > 0; k++) {
        const OstCellList *list = &cells->list[k];
        const size_t width = (size_t)ost_cell_facts[k].nodes;
        for (size_t i = 0; i < (size_t)list->count; i++)
            for (size_t n = 0; n < width && ost_numbers_find(set->count, set->item, list->label[i]) >= 0; n++)
                OST_TRY(ost_cells_put(cells, inp->set, list->nodes[i * width + n]));
    }
    ost_cells_keep_once(cells, inp->set);
    return OST_SUCCESS;
}

/* *NSET, NSET=..., ELSET=... */
static OstStatus take_elements(OstInp *inp, const OstInpKeyword *keyword)
{
    char name[OST_INP_WORD];
    if (!ost_inp_set_name(keyword, "ELSET", name))
        return OST_SUCCESS;
    const int from = ost_inp_find_set(inp, OST_SET_OF_CELLS, name);
    return from >= 0 ? put_nodes_of(inp, from)
                     : OST_RAISE_LINE(inp->lines, "there is no element set '%s' before this line", name);
}

OstStatus ost_inp_begin_set(OstInp *inp, const OstInpKeyword *keyword, OstSetKind kind)
{
    char text[OST_INP_WORD];
    const char *name = ost_inp_set_name(keyword, kind == OST_SET_OF_NODES ? "NSET" : "ELSET", text);
    if (!name || !name[0])
        return OST_RAISE_LINE(inp->lines, "*%s without its name, such as *%s, %s=TOP", keyword->name, keyword->name,
                              keyword->name);
    inp->block = OST_INP_SET;
    inp->generate = ost_inp_value(keyword, "GENERATE") != NULL;
    inp->by_line = 0;
    OST_TRY(ost_inp_set_instance(inp, keyword));
    OST_TRY(ost_cells_set(&inp->cells, kind, name, &inp->set));
    /* CAE keeps the tets of a surface in sets of its own. */
    if (ost_inp_value(keyword, "INTERNAL"))
        inp->cells.set[inp->set].is_region = 0;
    return kind == OST_SET_OF_NODES ? take_elements(inp, keyword) : OST_SUCCESS;
}

static OstStatus read_range(OstInp *inp)
{
    OstGlobal first = 0, last = 0, step = 1;
    OST_TRY(ost_lines_integer(inp->lines, "the first number of a range", &first));
    OST_TRY(ost_lines_integer(inp->lines, "the last number of a range", &last));
    if (!ost_lines_ended(inp->lines))
        OST_TRY(ost_lines_integer(inp->lines, "the step of a range", &step));
    if (first < 0 || last < first || last > OST_LARGEST_LABEL || step < 1)
        return OST_RAISE_LINE(
            inp->lines, "the range %" PRId64 " to %" PRId64 " in steps of %" PRId64 " found, expected it to ascend",
            first, last, step);
    const OstSetKind kind = inp->cells.set[inp->set].kind;
    return ost_cells_put_range(&inp->cells, inp->set, ost_inp_number(inp, kind, "", first),
                               ost_inp_number(inp, kind, "", last), step);
}

/* A number, or the name of a set before. A number may come with its instance: Part-1-1.17. */
static OstStatus put_word(OstInp *inp, const char *word)
{
    const OstSetKind kind = inp->cells.set[inp->set].kind == OST_SET_OF_NODES ? OST_SET_OF_NODES : OST_SET_OF_CELLS;
    const int from = ost_inp_find_set(inp, kind, word);
    const char *dot = strrchr(word, '.');
    const char *digits = dot ? dot + 1 : word;
    char *end = NULL;
    const OstGlobal label = strtoll(digits, &end, 10);
    if (isdigit((unsigned char)digits[0]) && *end == '\0' && label <= OST_LARGEST_LABEL)
        return ost_cells_put(&inp->cells, inp->set, ost_inp_number(inp, kind, word, label));
    if (from < 0)
        return OST_RAISE_LINE(inp->lines, "'%s' found, expected a number or the name of a set before this one", word);
    return ost_cells_put_set(&inp->cells, inp->set, from);
}

OstStatus ost_inp_set_line(OstInp *inp)
{
    char word[OST_INP_WORD];
    if (inp->generate)
        return read_range(inp);
    while (!ost_lines_ended(inp->lines)) {
        ost_inp_word(inp->lines, word);
        OST_TRY(put_word(inp, word));
        if (inp->by_line)
            break;
    }
    return OST_SUCCESS;
}

/* Is a surface made of others in a way that is not read? Warns then, and of faces that Abaqus would take away. */
static int warn_of_surface(const OstInp *inp, const OstInpKeyword *keyword)
{
    const char *combine = ost_inp_value(keyword, "COMBINE"), *trim = ost_inp_value(keyword, "TRIM");
    const char *path = inp->lines->path;
    const OstGlobal line = inp->lines->line;
    const int refused = combine && strcasecmp(combine, "UNION") != 0;
    if (refused)
        ost_warn(inp->ctx,
                 "%s:%" PRId64
                 ": a surface made of others by COMBINE=%s is not read, and left out; write its faces, as "
                 "CAE does",
                 path, line, combine);
    else if (trim && strcasecmp(trim, "YES") == 0)
        ost_warn(inp->ctx,
                 "%s:%" PRId64
                 ": TRIM=YES is not read: where it ends a free surface keeps the faces around the corner; "
                 "if they matter, write the faces, as CAE does",
                 path, line);
    return refused;
}

OstStatus ost_inp_begin_surface(OstInp *inp, const OstInpKeyword *keyword)
{
    char text[OST_INP_WORD];
    const char *name = ost_inp_set_name(keyword, "NAME", text), *type = ost_inp_value(keyword, "TYPE");
    const int of_nodes = type && strcasecmp(type, "NODE") == 0;
    if (!name || !name[0])
        return OST_RAISE_LINE(inp->lines, "*SURFACE without its name, such as *SURFACE, NAME=TOP");
    if (type && !of_nodes && strcasecmp(type, "ELEMENT") != 0)
        return OST_SUCCESS; /* one that is no part of the mesh */
    if (warn_of_surface(inp, keyword))
        return OST_SUCCESS;
    inp->block = ost_inp_value(keyword, "COMBINE") ? OST_INP_UNION : of_nodes ? OST_INP_SET : OST_INP_SURFACE;
    inp->generate = 0;
    inp->by_line = 1; /* of a surface of nodes: their set, or a node, and its area */
    inp->of = -1;
    return ost_cells_set(&inp->cells, of_nodes ? OST_SET_OF_NODES : OST_SET_OF_FACES, name, &inp->set);
}

/* Another set of the surface's name, of cells that are put as they are: shells have a side of their own name, and a
 * free surface has no side. */
static OstStatus open_whole(OstInp *inp, OstSetKind kind, int *set)
{
    const char *name = inp->cells.set[inp->set].name;
    const int known = ost_cells_find_set(&inp->cells, kind, name) >= 0;
    OST_TRY(ost_cells_set(&inp->cells, kind, name, set));
    if (!known)
        inp->cells.set[*set].is_region = 0;
    return OST_SUCCESS;
}

static OstStatus put_whole(OstInp *inp, OstSetKind kind, const char *word)
{
    const int set = inp->set;
    OST_TRY(open_whole(inp, kind, &inp->set));
    const OstStatus status = put_word(inp, word);
    inp->set = set;
    return status;
}

static OstStatus put_face(OstInp *inp, OstGlobal label, int side)
{
    return label < 0 || label > OST_LARGEST_LABEL ? OST_SUCCESS
                                                  : ost_cells_put(&inp->cells, inp->set, ost_cell_face(label, side));
}

/* The faces of an element, or of all of a set. */
static OstStatus put_faces(OstInp *inp, const char *word, int side)
{
    const int from = ost_inp_find_set(inp, OST_SET_OF_CELLS, word);
    const char *dot = strrchr(word, '.');
    const char *digits = dot ? dot + 1 : word;
    char *end = NULL;
    const OstGlobal label = strtoll(digits, &end, 10);
    if (isdigit((unsigned char)digits[0]) && *end == '\0')
        return put_face(inp, ost_inp_number(inp, OST_SET_OF_CELLS, word, label), side);
    if (from < 0)
        return OST_RAISE_LINE(inp->lines, "'%s' found, expected the number of an element or the name of a set before",
                              word);
    for (OstLocal i = 0; i < inp->cells.set[from].count; i++)
        OST_TRY(put_face(inp, inp->cells.set[from].item[i], side));
    ost_cells_keep_once(&inp->cells, inp->set);
    return OST_SUCCESS;
}

/* Elements or a set of them, and which face: S1 to S6 of solids, SPOS and SNEG of shells; none: the free surface. */
OstStatus ost_inp_surface_line(OstInp *inp)
{
    char word[OST_INP_WORD], face[OST_INP_WORD];
    ost_inp_word(inp->lines, word);
    ost_inp_word(inp->lines, face);
    if (face[0] == '\0')
        return put_whole(inp, OST_SET_OF_FREE, word);
    if (strcasecmp(face, "SPOS") == 0 || strcasecmp(face, "SNEG") == 0)
        return put_whole(inp, OST_SET_OF_CELLS, word);
    if ((face[0] == 'S' || face[0] == 's') && face[1] >= '1' && face[1] <= '6' && face[2] == '\0')
        return put_faces(inp, word, face[1] - '1');
    inp->left_out++;
    return OST_SUCCESS;
}

/* All that the reader may have put under a surface's name. */
static OstStatus put_surface(OstInp *inp, const char *word)
{
    static const OstSetKind kinds[] = {OST_SET_OF_FACES, OST_SET_OF_FREE, OST_SET_OF_CELLS, OST_SET_OF_NODES};
    int known = 0;
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        const int from = ost_inp_find_set(inp, kinds[k], word);
        int into = -1;
        if (from < 0)
            continue;
        OST_TRY(open_whole(inp, kinds[k], &into));
        OST_TRY(ost_cells_put_set(&inp->cells, into, from));
        known = 1;
    }
    return known ? OST_SUCCESS : OST_RAISE_LINE(inp->lines, "there is no surface '%s' before this line", word);
}

OstStatus ost_inp_union_line(OstInp *inp)
{
    char word[OST_INP_WORD];
    while (!ost_lines_ended(inp->lines)) {
        ost_inp_word(inp->lines, word);
        OST_TRY(put_surface(inp, word));
    }
    return OST_SUCCESS;
}
