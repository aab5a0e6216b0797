/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/cells/cells.h"
#include "formats/exchange/exchange.h"
#include "formats/exchange/nastran_card.h"
#include "formats/exchange/nastran_names.h"
#include "formats/exchange/nastran_systems.h"
#include "formats/exchange/numbers.h"
#include "formats/exchange/passed.h"
#include "formats/msh/cursor.h"

#include <ctype.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Nastran's bulk data. Each property becomes a region or a boundary, and so does each set of nodes or constraints. */

enum { MOST_NODES = 20, MOST_INCLUDES = 8, MOST_RIGID = 100 };

typedef struct Placed {
    OstGlobal label, system;
    double x[3];
} Placed;

/* An RBE2 or RBE3: the point whose motion, or mean motion, its set of nodes has. */
typedef struct Rigid {
    int set, in_the_mean;
    char directions[8];
    OstGlobal point;
} Rigid;

typedef struct Nastran {
    OstNastranCard card;
    OstCells cells;
    OstNastranSystems systems;
    OstLocal placed; /* nodes that wait for their coordinate system, which may stand behind them */
    Placed *place;
    int depth;                /* of INCLUDE */
    OstGlobal default_system; /* of GRDSET */
    OstLocal in_default;      /* nodes that state none, so far */
    OstNastranName comment_name;
    OstPassed passed;
    int rigid_count;
    Rigid rigid[MOST_RIGID];
} Nastran;

/* --- what is read of cards --- */

static OstStatus read_system(Nastran *nastran)
{
    OstNastranSystem *system = NULL;
    OST_TRY(ost_nastran_system_add(&nastran->card.cursor, &nastran->systems, &system));
    system->kind = nastran->card.name[5];
    OST_TRY(ost_nastran_integer(&nastran->card, "the number of a coordinate system", 0, &system->label));
    if (ost_nastran_field(&nastran->card, 1)[0])
        OST_TRY(ost_nastran_integer(&nastran->card, "a coordinate system", 1, &system->base));
    return ost_nastran_reals(&nastran->card, "a coordinate", 2, 9, system->points);
}

static OstStatus read_grid(Nastran *nastran)
{
    OstGlobal label = 0, system = nastran->default_system;
    double x[3] = {0.0};
    if (ost_nastran_field(&nastran->card, 5)[0]) /* of its displacement; a coordinate that is out of place ends here */
        OST_TRY(ost_nastran_integer(&nastran->card, "a coordinate system, or the columns are shifted", 5, &label));
    OST_TRY(ost_nastran_integer(&nastran->card, "the number of a node", 0, &label));
    if (ost_nastran_field(&nastran->card, 1)[0])
        OST_TRY(ost_nastran_integer(&nastran->card, "a coordinate system", 1, &system));
    else
        nastran->in_default++;
    OST_TRY(ost_nastran_reals(&nastran->card, "a coordinate", 2, 3, x));
    if (system == 0)
        return ost_cells_add_node(&nastran->cells, label, x);
    OST_TRY(OST_GROW(nastran->card.cursor.ctx, &nastran->place, nastran->placed + 1));
    nastran->place[nastran->placed++] = (Placed){label, system, {x[0], x[1], x[2]}};
    return OST_SUCCESS;
}

/* What GRIDs have that state no coordinate system. */
static OstStatus read_defaults(Nastran *nastran)
{
    if (ost_nastran_field(&nastran->card, 1)[0])
        OST_TRY(ost_nastran_integer(&nastran->card, "a coordinate system", 1, &nastran->default_system));
    return nastran->default_system == 0 || nastran->in_default == 0
               ? OST_SUCCESS
               : OST_RAISE_MSH(&nastran->card.cursor, "GRDSET follows GRIDs that it is for; put it before them");
}

static OstStatus place_nodes(Nastran *nastran)
{
    for (OstLocal n = 0; n < nastran->placed; n++) {
        Placed *node = &nastran->place[n];
        OST_TRY(ost_nastran_to_basic(&nastran->card.cursor, &nastran->systems, node->system, node->x));
        OST_TRY(ost_cells_add_node(&nastran->cells, node->label, node->x));
    }
    return OST_SUCCESS;
}

/* Cards of elements. Those of vertical edges come before the upper ones: from the place `moved` on, `from` has VTK's
 * order. */
typedef struct Card {
    const char *name;
    OstCellKind linear, quadratic; /* the same: it has no mid-edge nodes */
    int moved, from[8];
} Card;
static const Card cards[] = {{"CTETRA", OST_CELL_TET4, OST_CELL_TET10, 0, {0}},
                             {"CHEXA", OST_CELL_HEX8, OST_CELL_HEX20, 12, {16, 17, 18, 19, 12, 13, 14, 15}},
                             {"CHEXA8", OST_CELL_HEX8, OST_CELL_HEX8, 0, {0}},
                             {"CHEXA20", OST_CELL_HEX8, OST_CELL_HEX20, 12, {16, 17, 18, 19, 12, 13, 14, 15}},
                             {"CPENTA", OST_CELL_WEDGE6, OST_CELL_WEDGE15, 9, {12, 13, 14, 9, 10, 11}},
                             {"CPYRAM", OST_CELL_PYRAMID5, OST_CELL_PYRAMID13, 0, {0}},
                             {"CPYRA", OST_CELL_PYRAMID5, OST_CELL_PYRAMID13, 0, {0}}, /* OptiStruct's */
                             {"CTRIA3", OST_CELL_TRIANGLE3, OST_CELL_TRIANGLE3, 0, {0}},
                             {"CTRIAR", OST_CELL_TRIANGLE3, OST_CELL_TRIANGLE3, 0, {0}},
                             {"CTRIA6", OST_CELL_TRIANGLE3, OST_CELL_TRIANGLE6, 0, {0}},
                             {"CQUAD4", OST_CELL_QUAD4, OST_CELL_QUAD4, 0, {0}},
                             {"CQUADR", OST_CELL_QUAD4, OST_CELL_QUAD4, 0, {0}},
                             {"CQUAD8", OST_CELL_QUAD4, OST_CELL_QUAD8, 0, {0}},
                             {"CQUAD", OST_CELL_QUAD4, OST_CELL_QUAD9, 0, {0}},
                             {"CQUAD9", OST_CELL_QUAD4, OST_CELL_QUAD9, 0, {0}}}; /* Gmsh's */

/* Mid-edge nodes are all there, or none. meshio leaves out the property: faces without one become one boundary. */
static OstStatus read_cell(Nastran *nastran, const Card *card)
{
    const OstCellKind linear = card->linear, quadratic = card->quadratic;
    const int vertices = ost_cell_facts[linear].nodes, all = ost_cell_facts[quadratic].nodes;
    OstGlobal label = 0, property = ost_cell_facts[linear].dimension == 3 ? OST_NO_GROUP : 0, nodes[MOST_NODES] = {0},
              in_order[MOST_NODES];
    int middles = 0;
    OST_TRY(ost_nastran_integer(&nastran->card, "the number of an element", 0, &label));
    if (ost_nastran_field(&nastran->card, 1)[0])
        OST_TRY(ost_nastran_integer(&nastran->card, "a property", 1, &property));
    for (int n = vertices; n < all; n++)
        middles += ost_nastran_field(&nastran->card, 2 + n)[0] != '\0' &&
                   strcmp(ost_nastran_field(&nastran->card, 2 + n), "0") != 0;
    if (middles > 0 && middles < all - vertices) {
        nastran->card.cursor.place = nastran->card.line;
        return OST_RAISE_MSH(&nastran->card.cursor,
                             "element %" PRId64 " has %d of %d mid-edge nodes, expected all or none", label, middles,
                             all - vertices);
    }
    if (ost_cell_facts[linear].dimension == 3 && ost_nastran_field(&nastran->card, 2 + all)[0]) {
        nastran->card.cursor.place = nastran->card.line;
        return OST_RAISE_MSH(&nastran->card.cursor,
                             "element %" PRId64
                             " has more nodes than the %d of a %s (in Gmsh: Mesh.SecondOrderIncomplete = 1)",
                             label, all, nastran->card.name);
    }
    for (int n = 0; n < (middles > 0 ? all : vertices); n++)
        OST_TRY(ost_nastran_integer(&nastran->card, "a node", 2 + n, &nodes[n]));
    for (int n = 0; n < all; n++)
        in_order[n] = nodes[card->moved && n >= card->moved ? card->from[n - card->moved] : n];
    return ost_cells_add(&nastran->cells, middles > 0 ? quadratic : linear, label, property, in_order);
}

static OstStatus constraint_set(Nastran *nastran, int *set)
{
    OstGlobal number = 0;
    char name[32];
    OST_TRY(ost_nastran_integer(&nastran->card, "the number of a set", 0, &number));
    snprintf(name, sizeof name, "spc-%" PRId64, number);
    return ost_cells_set(&nastran->cells, OST_SET_OF_NODES, name, set);
}

/* Puts the node of a field into a set, or a node, THRU and another; goes to the last of these fields. */
static OstStatus put_nodes(Nastran *nastran, int set, int *field)
{
    OstGlobal node = 0, last = 0;
    OST_TRY(ost_nastran_integer(&nastran->card, "a node", *field, &node));
    if (strcasecmp(ost_nastran_field(&nastran->card, *field + 1), "THRU") != 0)
        return ost_cells_put(&nastran->cells, set, node);
    OST_TRY(ost_nastran_integer(&nastran->card, "a node", *field + 2, &last));
    if (node < 0 || last < node || last > OST_LARGEST_LABEL)
        return OST_RAISE_MSH(&nastran->card.cursor, "nodes %" PRId64 " THRU %" PRId64, node, last);
    *field += 2;
    OST_TRY(ost_cells_put_range(&nastran->cells, set, node, last, 1));
    ost_cells_keep_once(&nastran->cells, set);
    return OST_SUCCESS;
}

/* SPC1: set, components, then nodes. */
static OstStatus read_constraints(Nastran *nastran)
{
    int set = -1;
    OST_TRY(constraint_set(nastran, &set));
    for (int f = 2; f < nastran->card.fields; f++)
        if (ost_nastran_field(&nastran->card, f)[0])
            OST_TRY(put_nodes(nastran, set, &f));
    return OST_SUCCESS;
}

/* OptiStruct's SET: number, type, whether it is a list, then nodes. The comment before it may have named it. */
static OstStatus read_set(Nastran *nastran)
{
    OstGlobal number = 0;
    char name[64];
    int set = -1;
    const char *type = ost_nastran_field(&nastran->card, 1), *form = ost_nastran_field(&nastran->card, 2);
    if (strcasecmp(type, "GRID") != 0 || (form[0] && strcasecmp(form, "LIST") != 0))
        return OST_SUCCESS;
    OST_TRY(ost_nastran_integer(&nastran->card, "the number of a set", 0, &number));
    snprintf(name, sizeof name, "set-%" PRId64, number);
    const OstNastranName *named = &nastran->comment_name;
    OST_TRY(ost_cells_set(&nastran->cells, OST_SET_OF_NODES, named->set == number ? named->text : name, &set));
    for (int f = 3; f < nastran->card.fields; f++)
        if (ost_nastran_field(&nastran->card, f)[0])
            OST_TRY(put_nodes(nastran, set, &f));
    return OST_SUCCESS;
}

/* --- what is passed over --- */

static const OstPassedWay ways[] = {
    {"RBE2", ""},
    {"RBE3", ""},
    {"RBE1", ost_way_joined},
    {"RBAR", ost_way_joined},
    {"RBAR1", ost_way_joined},
    {"RROD", ost_way_joined},
    {"RTRPLT", ost_way_joined},
    {"RSSCON", ost_way_joined},
    {"RSPLINE", ost_way_joined},
    {"MPC", ost_way_joined},
    {"TIE", ost_way_joined},
    {"BGSET", ost_way_joined},
    {"CWELD", ost_way_joined},
    {"CFAST", ost_way_joined},
    {"CONTACT", ost_way_contact},
    {"BCTABLE", ost_way_contact},
    {"BCTABL1", ost_way_contact},
    {"BCONECT", ost_way_contact},
    {"BCTSET", ost_way_contact},
    {"CGAP", ost_way_contact},
    {"PSHELL", ost_way_thin},
    {"PCOMP", ost_way_thin},
    {"PCOMPG", ost_way_thin},
    {"CBUSH", ost_way_spring},
    {"CELAS1", ost_way_spring},
    {"CELAS2", ost_way_spring},
    {"CELAS3", ost_way_spring},
    {"CELAS4", ost_way_spring},
    {"MAT9", ost_way_axes},
    {"MAT11", ost_way_axes},
    {"MATORT", ost_way_axes},
};

/* RBE2: number, point, components, nodes. RBE3: number, nothing, point, components, then a weight, components and
 * nodes, again and again. A real number at the end of one is a thermal expansion. */
static OstStatus read_rigid(Nastran *nastran, int in_the_mean)
{
    OstGlobal label = 0;
    char name[32];
    Rigid rigid = {.in_the_mean = in_the_mean};
    if (nastran->rigid_count == MOST_RIGID)
        return OST_SUCCESS;
    OST_TRY(ost_nastran_integer(&nastran->card, "the number of an element", 0, &label));
    OST_TRY(ost_nastran_integer(&nastran->card, "a node", in_the_mean ? 2 : 1, &rigid.point));
    snprintf(name, sizeof name, "%s-%" PRId64, in_the_mean ? "rbe3" : "rbe2", label);
    OST_TRY(ost_cells_set(&nastran->cells, OST_SET_OF_NODES, name, &rigid.set));
    if (!in_the_mean)
        snprintf(rigid.directions, sizeof rigid.directions, "%.7s", ost_nastran_field(&nastran->card, 2));
    for (int f = in_the_mean ? 4 : 3; f < nastran->card.fields; f++) {
        const char *text = ost_nastran_field(&nastran->card, f);
        if (isalpha((unsigned char)text[0])) /* UM, ALPHA */
            break;
        if (strchr(text, '.'))
            f += in_the_mean;
        else if (text[0])
            OST_TRY(put_nodes(nastran, rigid.set, &f));
    }
    nastran->rigid[nastran->rigid_count++] = rigid;
    return OST_SUCCESS;
}

/* Is it a node of a solid? */
static int is_in_body(const OstCells *cells, OstGlobal node)
{
    for (int k = 0; k < OST_CELL_KINDS; k++) {
        const OstCellList *list = &cells->list[k];
        const size_t count =
            ost_cell_facts[k].dimension == 3 ? (size_t)list->count * (size_t)ost_cell_facts[k].nodes : 0;
        for (size_t n = 0; n < count; n++)
            if (list->nodes[n] == node)
                return 1;
    }
    return 0;
}

/* A rigid element moves its point too, which may be a node of the body. */
static OstStatus add_points(Nastran *nastran)
{
    for (int r = 0; r < nastran->rigid_count; r++) {
        const Rigid *rigid = &nastran->rigid[r];
        if (!rigid->in_the_mean && is_in_body(&nastran->cells, rigid->point))
            OST_TRY(ost_cells_put(&nastran->cells, rigid->set, rigid->point));
    }
    return OST_SUCCESS;
}

static void warn_passed(Nastran *nastran)
{
    const OstMeshChunk *chunk = nastran->cells.chunk;
    for (int r = 0; r < nastran->rigid_count; r++) {
        const Rigid *rigid = &nastran->rigid[r];
        const char *on = nastran->cells.set[rigid->set].name;
        char at[96] = "[x, y, z]";
        for (OstLocal n = 0; n < chunk->node_count; n++)
            if (chunk->node_label[n] == rigid->point) {
                const double *x = chunk->coordinates + 3 * (size_t)n;
                snprintf(at, sizeof at, "[%.7g, %.7g, %.7g]", x[0], x[1], x[2]);
            }
        ost_passed_point(&nastran->passed, on, at, rigid->in_the_mean, rigid->directions);
    }
    ost_passed_warn(nastran->card.cursor.ctx, nastran->cells.path, &nastran->passed);
}

/* SPC: set, then a node, components and a displacement, twice. */
static OstStatus read_constraint(Nastran *nastran)
{
    OstGlobal node = 0;
    int set = -1;
    OST_TRY(constraint_set(nastran, &set));
    for (int f = 1; f <= 4; f += 3)
        if (ost_nastran_field(&nastran->card, f)[0]) {
            OST_TRY(ost_nastran_integer(&nastran->card, "a node", f, &node));
            OST_TRY(ost_cells_put(&nastran->cells, set, node));
        }
    return OST_SUCCESS;
}

static OstStatus read_comment(Nastran *nastran, const char *line, const char *end)
{
    OstNastranName *name = &nastran->comment_name;
    ost_nastran_take_comment(name, line, end);
    if (name->property < 0 || !name->text[0])
        return OST_SUCCESS;
    const OstGlobal property = name->property;
    name->property = OST_NASTRAN_NO_PROPERTY;
    return ost_cells_name(&nastran->cells, -1, property, name->text);
}

/* PSOLID, PSHELL and the like: the comment before it may have named it. */
static OstStatus read_property(Nastran *nastran)
{
    OstGlobal property = 0;
    OstNastranName *name = &nastran->comment_name;
    if (name->property != OST_NASTRAN_NEXT_PROPERTY)
        return OST_SUCCESS;
    name->property = OST_NASTRAN_NO_PROPERTY;
    OST_TRY(ost_nastran_integer(&nastran->card, "the number of a property", 0, &property));
    return ost_cells_name(&nastran->cells, -1, property, name->text);
}

/* Counts an element that is not read, by the beginning of its name. */
static void skip_element(Nastran *nastran)
{
    static const struct {
        const char *begins;
        int dimension;
    } others[] = {{"CTET", 3},   {"CHEX", 3}, {"CPEN", 3},  {"CPYR", 3},   {"CIHEX", 3}, {"CIFHEX", 3},
                  {"CIFPEN", 3}, {"CTRI", 2}, {"CQUAD", 2}, {"CSHEAR", 2}, {"CBAR", 1},  {"CBEAM", 1},
                  {"CBEND", 1},  {"CROD", 1}, {"CTUBE", 1}, {"CONROD", 1}};
    for (size_t o = 0; o < sizeof others / sizeof *others; o++)
        if (strncmp(nastran->card.name, others[o].begins, strlen(others[o].begins)) == 0) {
            ost_cells_skip(&nastran->cells, others[o].dimension, nastran->card.name);
            return;
        }
}

static OstStatus end_card(Nastran *nastran)
{
    const char *name = nastran->card.name;
    if (strcmp(name, "GRID") == 0)
        return read_grid(nastran);
    if (strcmp(name, "GRDSET") == 0)
        return read_defaults(nastran);
    if (strcmp(name, "CORD2R") == 0 || strcmp(name, "CORD2C") == 0 || strcmp(name, "CORD2S") == 0)
        return read_system(nastran);
    for (size_t k = 0; k < sizeof cards / sizeof *cards; k++)
        if (strcmp(name, cards[k].name) == 0)
            return read_cell(nastran, &cards[k]);
    if (strcmp(name, "SPC1") == 0)
        return read_constraints(nastran);
    if (strcmp(name, "SPC") == 0)
        return read_constraint(nastran);
    if (strcmp(name, "SET") == 0)
        return read_set(nastran);
    if (name[0] == 'P' && strcmp(name, "PARAM") != 0 && strncmp(name, "PLOAD", 5) != 0)
        OST_TRY(read_property(nastran));
    skip_element(nastran);
    if (strcmp(name, "RBE2") == 0 || strcmp(name, "RBE3") == 0)
        OST_TRY(read_rigid(nastran, name[3] == '3'));
    return ost_passed_take(nastran->card.cursor.ctx, ways, sizeof ways / sizeof *ways, name, &nastran->passed);
}

/* Where the data of a line end: at a comment, which begins with $ outside quotes, without the blanks before it. */
static const char *end_of_data(const char *line, const char *end)
{
    int quoted = 0;
    const char *at = line;
    for (; at < end && (quoted || *at != '$'); at++)
        quoted ^= *at == '\'';
    while (at > line && strchr(" \t", at[-1]))
        at--;
    return at;
}

static OstStatus include(Nastran *nastran, const char *line, const char *end);

static OstStatus read_line(Nastran *nastran, const char *line, const char *end)
{
    if (line < end && *line == '$')
        return read_comment(nastran, line, end);
    end = end_of_data(line, end);
    if (line == end)
        return OST_SUCCESS;
    if (end - line > 7 && strncasecmp(line, "INCLUDE", 7) == 0)
        return include(nastran, line, end);
    if (!strchr("+* ,\t", *line)) {
        OST_TRY(end_card(nastran));
        ost_nastran_begin_card(&nastran->card, line, end);
    } else if (!nastran->card.name[0])
        return OST_SUCCESS;
    return ost_nastran_take_line(&nastran->card, line, end);
}

static OstStatus read_cards(Nastran *nastran, int *ended)
{
    OstMshCursor *cursor = &nastran->card.cursor;
    while (!*ended && cursor->next < cursor->end) {
        const char *line = cursor->next;
        const OstMshText text = ost_msh_rest_of_line(cursor);
        cursor->place = line;
        *ended = text.length >= 7 && strncasecmp(text.start, "ENDDATA", 7) == 0;
        if (!*ended)
            OST_TRY(read_line(nastran, text.length > 0 ? line : text.start, text.start + text.length));
    }
    OST_TRY(end_card(nastran));
    nastran->card.name[0] = '\0';
    return OST_SUCCESS;
}

/* The name of a file is in quotes, perhaps over several lines, or ends with the line; it is relative to the file that
 * it is in. */
static void included_path(OstMshCursor *cursor, const char *line, const char *end, char path[PATH_MAX])
{
    const char *name = line + 7, *slash = strrchr(cursor->path, '/');
    while (name < end && strchr(" \t", *name))
        name++;
    const char quote = name < end && (*name == '\'' || *name == '"') ? *name++ : '\0';
    const int folder = slash && name < end && *name != '/' ? (int)(slash + 1 - cursor->path) : 0;
    int length = snprintf(path, PATH_MAX, "%.*s", folder, cursor->path);
    while (length < PATH_MAX) {
        const char *close = quote ? memchr(name, quote, (size_t)(end - name)) : end;
        const ptrdiff_t more_of_it = (close ? close : end) - name;
        length += snprintf(path + length, (size_t)(PATH_MAX - length), "%.*s",
                           more_of_it < PATH_MAX ? (int)more_of_it : PATH_MAX, name);
        if (close || cursor->next >= cursor->end)
            return;
        const OstMshText more = ost_msh_rest_of_line(cursor);
        name = more.start;
        end = more.start + more.length;
    }
}

static OstStatus include(Nastran *nastran, const char *line, const char *end)
{
    char path[PATH_MAX];
    int ended = 0;
    OstMshCursor inner;
    OST_TRY(end_card(nastran));
    nastran->card.name[0] = '\0';
    if (nastran->depth == MOST_INCLUDES)
        return OST_RAISE_MSH(&nastran->card.cursor, "files include each other more than %d deep", MOST_INCLUDES);
    included_path(&nastran->card.cursor, line, end, path);
    const OstMshCursor outer = nastran->card.cursor;
    if (ost_msh_open(outer.ctx, path, &inner) != OST_SUCCESS) {
        char reason[PATH_MAX + 128];
        snprintf(reason, sizeof reason, "%s", ost_error_text(outer.ctx));
        return OST_RAISE_MSH(&nastran->card.cursor, "names a file that is to be read here: %s", reason);
    }
    nastran->card.cursor = inner;
    nastran->depth++;
    const OstStatus status = read_cards(nastran, &ended);
    nastran->depth--;
    ost_msh_close(&nastran->card.cursor);
    nastran->card.cursor = outer;
    return status;
}

/* What stands before says how to solve: SPC = 1 is no card there. A file may hold the cards alone. */
static int go_to_bulk_data(OstMshCursor *cursor)
{
    const char *first = cursor->next;
    while (cursor->next < cursor->end) {
        const OstMshText text = ost_msh_rest_of_line(cursor);
        if (text.length >= 5 && strncasecmp(text.start, "BEGIN", 5) == 0)
            return 1;
    }
    cursor->next = first;
    return 0;
}

static OstStatus read_lines(Nastran *nastran)
{
    OstMshCursor *cursor = &nastran->card.cursor;
    const int begun = go_to_bulk_data(cursor);
    int ended = 0;
    OST_TRY(read_cards(nastran, &ended));
    if (begun && !ended)
        ost_warn(cursor->ctx, "%s: BEGIN BULK has no ENDDATA: is the file complete?", cursor->path);
    return OST_SUCCESS;
}

OstStatus ost_nastran_read(OstContext *ctx, const char *path, OstMeshChunk **chunk)
{
    Nastran nastran = {.comment_name = {.property = OST_NASTRAN_NO_PROPERTY}};
    OstStatus status = ost_cells_open(ctx, path, &nastran.cells);
    OST_THEN(ost_msh_open(ctx, path, &nastran.card.cursor));
    OST_THEN(read_lines(&nastran));
    OST_THEN(place_nodes(&nastran));
    OST_THEN(add_points(&nastran));
    if (status == OST_SUCCESS)
        warn_passed(&nastran);
    OST_FREE(nastran.card.field, nastran.systems.system, nastran.place, nastran.passed.word);
    ost_msh_close(&nastran.card.cursor);
    OST_THEN(ost_cells_finish(&nastran.cells, chunk));
    ost_cells_close(&nastran.cells);
    return status;
}
