/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/exchange/abaqus.h"
#include "formats/serial/input_file.h"

#include "core/error.h"
#include "core/memory.h"
#include "formats/exchange/exchange.h"

#include <ctype.h>
#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/* Abaqus's and CalculiX's input: keyword lines begin with *, comments with **, and data lines follow their keyword. Of
 * a model's many keywords those that state the mesh and its sets are read. */

enum { MOST_INCLUDES = 8 };

/* Elements by the beginning of their type. */
static const struct {
    const char *begins;
    OstCellKind kind; /* OST_CELL_KINDS: not a kind that is read */
    int dimension;
} types[] = {
    {"C3D4", OST_CELL_TET4, 3},        {"DC3D4", OST_CELL_TET4, 3},       {"C3D10", OST_CELL_TET10, 3},
    {"DC3D10", OST_CELL_TET10, 3},     {"STRI65", OST_CELL_TRIANGLE6, 2}, {"M3D6", OST_CELL_TRIANGLE6, 2},
    {"SFM3D6", OST_CELL_TRIANGLE6, 2}, {"CPS6", OST_CELL_TRIANGLE6, 2},   {"CPE6", OST_CELL_TRIANGLE6, 2},
    {"S6", OST_CELL_TRIANGLE6, 2},     {"STRI3", OST_CELL_TRIANGLE3, 2},  {"S3", OST_CELL_TRIANGLE3, 2},
    {"M3D3", OST_CELL_TRIANGLE3, 2},   {"SFM3D3", OST_CELL_TRIANGLE3, 2}, {"R3D3", OST_CELL_TRIANGLE3, 2},
    {"CPS3", OST_CELL_TRIANGLE3, 2},   {"CPE3", OST_CELL_TRIANGLE3, 2},   {"DS3", OST_CELL_TRIANGLE3, 2},
    {"C3D15V", OST_CELL_KINDS, 3},     {"C3D8", OST_CELL_HEX8, 3},        {"DC3D8", OST_CELL_HEX8, 3},
    {"C3D20", OST_CELL_HEX20, 3},      {"DC3D20", OST_CELL_HEX20, 3},     {"C3D27", OST_CELL_HEX27, 3},
    {"C3D6", OST_CELL_WEDGE6, 3},      {"DC3D6", OST_CELL_WEDGE6, 3},     {"C3D15", OST_CELL_WEDGE15, 3},
    {"DC3D15", OST_CELL_WEDGE15, 3},   {"C3D18", OST_CELL_WEDGE18, 3},    {"C3D5", OST_CELL_PYRAMID5, 3},
    {"DC3D5", OST_CELL_PYRAMID5, 3},   {"C3D13", OST_CELL_PYRAMID13, 3},  {"S4", OST_CELL_QUAD4, 2},
    {"M3D4", OST_CELL_QUAD4, 2},       {"SFM3D4", OST_CELL_QUAD4, 2},     {"R3D4", OST_CELL_QUAD4, 2},
    {"CPS4", OST_CELL_QUAD4, 2},       {"CPE4", OST_CELL_QUAD4, 2},       {"DS4", OST_CELL_QUAD4, 2},
    {"S8", OST_CELL_QUAD8, 2},         {"M3D8", OST_CELL_QUAD8, 2},       {"SFM3D8", OST_CELL_QUAD8, 2},
    {"CPS8", OST_CELL_QUAD8, 2},       {"CPE8", OST_CELL_QUAD8, 2},       {"DS8", OST_CELL_QUAD8, 2},
    {"S9", OST_CELL_QUAD9, 2},         {"M3D9", OST_CELL_QUAD9, 2},       {"C3D", OST_CELL_KINDS, 3},
    {"DC3D", OST_CELL_KINDS, 3},       {"SC", OST_CELL_KINDS, 3},         {"CSS8", OST_CELL_KINDS, 3},
    {"COH3D", OST_CELL_KINDS, 3},      {"AC3D", OST_CELL_KINDS, 3},       {"Q3D", OST_CELL_KINDS, 3},
    {"EC3D", OST_CELL_KINDS, 3},       {"PC3D", OST_CELL_KINDS, 3},       {"CIN3D", OST_CELL_KINDS, 3},
    {"CCL", OST_CELL_KINDS, 3},        {"DCC3D", OST_CELL_KINDS, 3},      {"GK3D", OST_CELL_KINDS, 3},
};

static void find_type(OstInp *inp, const char *type)
{
    inp->kind = OST_CELL_KINDS;
    inp->dimension = 2;
    snprintf(inp->type, sizeof inp->type, "%s", type);
    for (size_t t = 0; t < sizeof types / sizeof *types; t++) {
        const size_t length = strlen(types[t].begins);
        /* A digit that follows makes it another type: C3D4 is not C3D40. */
        if (strncasecmp(type, types[t].begins, length) == 0 &&
            (types[t].kind == OST_CELL_KINDS || !isdigit((unsigned char)type[length]))) {
            inp->kind = types[t].kind;
            inp->dimension = types[t].dimension;
            return;
        }
    }
}

/* --- keyword lines --- */

const char *ost_inp_value(const OstInpKeyword *keyword, const char *parameter)
{
    for (int p = 0; p < keyword->count; p++)
        if (strcmp(keyword->parameter[p], parameter) == 0)
            return keyword->value[p];
    return NULL;
}

/* Copies without blanks at the ends, which within quotes are kept. Returns whether all of it has room. */
static int copy_word(const char *start, const char *end, char word[OST_INP_WORD])
{
    size_t length = 0;
    while (start < end && strchr(" \t", *start))
        start++;
    while (end > start && strchr(" \t", end[-1]))
        end--;
    if (end > start && *start == '"')
        start++;
    if (end > start && end[-1] == '"')
        end--;
    for (; start < end && length + 2 < OST_INP_WORD; start++)
        word[length++] = *start;
    word[length] = '\0';
    return start == end;
}

/* Copies in capitals, without blanks. */
static void copy_name(const char *start, const char *end, char word[OST_INP_WORD])
{
    size_t length = 0;
    for (; start < end && length + 1 < OST_INP_WORD; start++)
        if (*start != ' ' && *start != '\t')
            word[length++] = (char)toupper((unsigned char)*start);
    word[length] = '\0';
}

/* The comma that ends a word: none within quotes. */
static const char *word_end(const char *text)
{
    for (int quoted = 0; *text && (quoted || *text != ','); text++)
        quoted ^= *text == '"';
    return text;
}

static OstStatus add_parameters(const OstInp *inp, const char *text, OstInpKeyword *keyword)
{
    while (*text && keyword->count < OST_INP_PARAMETERS) {
        const char *end = word_end(text);
        const char *equals = memchr(text, '=', (size_t)(end - text));
        const int p = keyword->count;
        copy_name(text, equals ? equals : end, keyword->parameter[p]);
        if (!copy_word(equals ? equals + 1 : end, end, keyword->value[p]))
            return OST_RAISE_LINE(inp->lines, "%s of *%s is longer than %d letters; shorten it", keyword->parameter[p],
                                  keyword->name, OST_INP_WORD - 2);
        keyword->quoted[p] = equals && memchr(equals, '"', (size_t)(end - equals)) != NULL;
        keyword->count += keyword->parameter[p][0] != '\0';
        text = *end ? end + 1 : end;
    }
    return OST_SUCCESS;
}

static int goes_on(const OstLineReader *lines)
{
    const size_t length = strlen(lines->text);
    return length > 0 && lines->text[length - 1] == ',';
}

/* At the reader's line, with the lines that it goes on in. */
static OstStatus parse_keyword(OstInp *inp, OstInpKeyword *keyword)
{
    const char *text = inp->lines->text + strspn(inp->lines->text, " \t") + 1;
    const char *end = text + strcspn(text, ",");
    memset(keyword, 0, sizeof *keyword);
    copy_name(text, end, keyword->name);
    OST_TRY(add_parameters(inp, *end ? end + 1 : end, keyword));
    while (goes_on(inp->lines)) {
        int found = 0;
        OST_TRY(ost_lines_next(inp->lines, &found));
        if (!found)
            return OST_RAISE_LINE(inp->lines, "the file ends within the keyword *%s", keyword->name);
        OST_TRY(add_parameters(inp, inp->lines->text, keyword));
    }
    return OST_SUCCESS;
}

/* --- names of sets --- */

/* A name in quotes keeps its blanks, and its small letters: it begins with its quote while the file is read. */
static int same_names(const char *a, const char *b)
{
    const int quoted = (a[0] == '"') + (b[0] == '"');
    if (quoted != 1)
        return quoted ? strcmp(a, b) == 0 : strcasecmp(a, b) == 0;
    const char *exact = a[0] == '"' ? a + 1 : b + 1, *other = a[0] == '"' ? b : a;
    while (*exact && *exact == (char)toupper((unsigned char)*other)) {
        exact++;
        other++;
    }
    return !*exact && !*other;
}

const char *ost_inp_set_name(const OstInpKeyword *keyword, const char *parameter, char name[OST_INP_WORD])
{
    for (int p = 0; p < keyword->count; p++)
        if (strcmp(keyword->parameter[p], parameter) == 0) {
            snprintf(name, OST_INP_WORD, "%s%.*s", keyword->quoted[p] ? "\"" : "", OST_INP_WORD - 2, keyword->value[p]);
            return name;
        }
    return NULL;
}

void ost_inp_word(OstLineReader *lines, char word[OST_INP_WORD])
{
    size_t length = 0;
    int quoted = 0;
    word[0] = '\0';
    if (ost_lines_ended(lines))
        return;
    const char *text = lines->next, *end = text;
    while (*end && (quoted || !strchr(" \t,", *end)))
        quoted ^= *end++ == '"';
    if (memchr(text, '"', (size_t)(end - text)))
        word[length++] = '"';
    for (; text < end && length + 1 < OST_INP_WORD; text++)
        if (*text != '"')
            word[length++] = *text;
    word[length] = '\0';
    lines->next = end;
}

static void drop_quotes(OstCells *cells)
{
    for (int s = 0; s < cells->set_count; s++)
        if (cells->set[s].name[0] == '"')
            memmove(cells->set[s].name, cells->set[s].name + 1, strlen(cells->set[s].name));
}

/* --- nodes and elements --- */

static OstStatus read_node(OstInp *inp)
{
    OstGlobal label = 0;
    double x[3] = {0.0};
    OST_TRY(ost_lines_integer(inp->lines, "the number of a node", &label));
    for (int d = 0; d < 3; d++)
        if (ost_lines_field(inp->lines)) /* else it is 0 */
            OST_TRY(ost_lines_number(inp->lines, "a coordinate", &x[d]));
    inp->own_nodes |= inp->instance_count > 0 && !inp->inside;
    label = ost_inp_number(inp, OST_SET_OF_NODES, "", label);
    OST_TRY(ost_cells_add_node(&inp->cells, label, x));
    return inp->set < 0 ? OST_SUCCESS : ost_cells_put(&inp->cells, inp->set, label);
}

/* Of C3D27's last nodes that of the body comes first, then those of the faces S1 to S6. */
static void order_c3d27(OstGlobal *nodes)
{
    static const int from[7] = {26, 24, 23, 25, 21, 22, 20};
    OstGlobal last[7];
    for (int n = 0; n < 7; n++)
        last[n] = nodes[from[n]];
    memcpy(nodes + 20, last, sizeof last);
}

/* A line may end within an element, which the next one then goes on with. */
static OstStatus read_element(OstInp *inp)
{
    const int width = 1 + ost_cell_facts[inp->kind].nodes;
    while (inp->filled < width && !ost_lines_ended(inp->lines)) {
        OST_TRY(ost_lines_integer(inp->lines, inp->filled == 0 ? "the number of an element" : "a node of an element",
                                  &inp->element[inp->filled]));
        inp->filled++;
    }
    if (inp->filled < width)
        return OST_SUCCESS;
    inp->filled = 0;
    if (!ost_lines_ended(inp->lines))
        return OST_RAISE_LINE(inp->lines,
                              "element %" PRId64 " has more nodes than the %d of %s (in Gmsh: "
                              "Mesh.SecondOrderIncomplete = 1)",
                              inp->element[0], width - 1, inp->type);
    if (inp->kind == OST_CELL_HEX27)
        order_c3d27(inp->element + 1);
    OST_TRY(ost_cells_add(&inp->cells, inp->kind, inp->element[0], OST_NO_GROUP, inp->element + 1));
    return inp->set < 0 ? OST_SUCCESS : ost_cells_put(&inp->cells, inp->set, inp->element[0]);
}

static OstStatus begin_nodes(OstInp *inp, const OstInpKeyword *keyword)
{
    char name[OST_INP_WORD];
    const char *set = ost_inp_set_name(keyword, "NSET", name), *system = ost_inp_value(keyword, "SYSTEM");
    if (system && strcasecmp(system, "R") != 0)
        return OST_RAISE_LINE(inp->lines, "nodes in the coordinate system '%s'; only rectangular ones are read",
                              system);
    inp->block = OST_INP_NODES;
    return set ? ost_cells_set(&inp->cells, OST_SET_OF_NODES, set, &inp->set) : OST_SUCCESS;
}

static OstStatus begin_elements(OstInp *inp, const OstInpKeyword *keyword)
{
    char name[OST_INP_WORD];
    const char *set = ost_inp_set_name(keyword, "ELSET", name), *type = ost_inp_value(keyword, "TYPE");
    if (!type)
        return OST_RAISE_LINE(inp->lines, "*ELEMENT without TYPE, such as *ELEMENT, TYPE=C3D4");
    find_type(inp, type);
    inp->block = inp->kind == OST_CELL_KINDS ? OST_INP_SKIPPED : OST_INP_ELEMENTS;
    return set ? ost_cells_set(&inp->cells, OST_SET_OF_CELLS, set, &inp->set) : OST_SUCCESS;
}

/* Keywords that make nodes or elements of others, which are not read. */
static int generates(const char *name)
{
    static const char *const words[] = {
        "NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "SYMMETRICMODELGENERATION"};
    for (size_t w = 0; w < sizeof words / sizeof *words; w++)
        if (strcmp(name, words[w]) == 0)
            return 1;
    return 0;
}

/* --- the file --- */

static OstStatus read_lines(OstInp *inp, OstLineReader *lines, int depth);

static OstStatus include(OstInp *inp, const char *name, int depth)
{
    char path[PATH_MAX];
    OstLineReader *outer = inp->lines, lines;
    if (!name || depth == MOST_INCLUDES)
        return OST_RAISE_LINE(inp->lines,
                              name ? "files include each other more than 8 deep" : "*INCLUDE without INPUT=");
    ost_file_beside(outer->path, name, path);
    if (ost_lines_open(inp->ctx, path, &lines) != OST_SUCCESS) {
        char reason[PATH_MAX + 128];
        snprintf(reason, sizeof reason, "%s", ost_error_text(inp->ctx));
        return OST_RAISE_LINE(inp->lines, "names a file that is to be read here: %s", reason);
    }
    const OstStatus status = read_lines(inp, &lines, depth + 1);
    inp->lines = outer;
    ost_lines_close(&lines);
    return status;
}

static OstStatus mark_section(OstInp *inp, const OstInpKeyword *keyword)
{
    char text[OST_INP_WORD];
    const char *name = ost_inp_set_name(keyword, "ELSET", text);
    int set = -1;
    if (!name)
        return OST_SUCCESS;
    OST_TRY(ost_cells_set(&inp->cells, OST_SET_OF_CELLS, name, &set));
    inp->cells.set[set].is_region = 2;
    inp->sections = 1;
    return ost_inp_oriented(inp, keyword);
}

static OstStatus begin_block(OstInp *inp, const OstInpKeyword *keyword)
{
    const char *name = keyword->name;
    inp->block = OST_INP_NOTHING;
    inp->set = inp->of = -1;
    if (strcmp(name, "NODE") == 0)
        return begin_nodes(inp, keyword);
    if (strcmp(name, "ELEMENT") == 0)
        return begin_elements(inp, keyword);
    if (strcmp(name, "NSET") == 0 || strcmp(name, "ELSET") == 0)
        return ost_inp_begin_set(inp, keyword, name[0] == 'N' ? OST_SET_OF_NODES : OST_SET_OF_CELLS);
    if (strcmp(name, "SURFACE") == 0)
        return ost_inp_begin_surface(inp, keyword);
    if (strcmp(name, "SOLIDSECTION") == 0)
        return mark_section(inp, keyword);
    if (generates(name))
        return OST_RAISE_LINE(inp->lines,
                              "*%s makes nodes or elements of others, which is not read; write the mesh with all of "
                              "them, as CAE does",
                              name);
    if (strcmp(name, "SYSTEM") == 0)
        inp->block = OST_INP_SYSTEM;
    if (strcmp(name, "TIE") == 0)
        return ost_inp_begin_tie(inp, keyword);
    if (strcmp(name, "KINEMATICCOUPLING") == 0)
        inp->block = OST_INP_KINEMATIC_NODES;
    if (strcmp(name, "COUPLING") == 0 || strcmp(name, "KINEMATICCOUPLING") == 0 || strcmp(name, "RIGIDBODY") == 0)
        return ost_inp_coupling(inp, keyword);
    if (strcmp(name, "ORIENTATION") == 0)
        return ost_inp_begin_orientation(inp, keyword);
    if (strcmp(name, "KINEMATIC") == 0)
        inp->block = OST_INP_KINEMATIC;
    if (strcmp(name, "DISTRIBUTING") == 0)
        ost_inp_distribute(inp);
    if (strcmp(name, "PART") == 0)
        return ost_inp_begin_part(inp, keyword);
    if (strcmp(name, "ENDPART") == 0)
        return ost_inp_end_part(inp);
    if (strcmp(name, "INSTANCE") == 0)
        return ost_inp_begin_instance(inp, keyword);
    return strcmp(name, "ENDINSTANCE") == 0 ? ost_inp_end_instance(inp) : ost_inp_pass(inp, keyword);
}

/* Data lines of what is read may lie in a file of their own. */
static OstStatus read_keyword(OstInp *inp, int depth)
{
    OstInpKeyword keyword;
    OST_TRY(parse_keyword(inp, &keyword));
    const char *input = ost_inp_value(&keyword, "INPUT");
    if (inp->filled > 0)
        return OST_RAISE_LINE(inp->lines, "element %" PRId64 " has %d nodes, expected %d", inp->element[0],
                              inp->filled - 1, ost_cell_facts[inp->kind].nodes);
    if (strcmp(keyword.name, "INCLUDE") == 0)
        return include(inp, input, depth);
    OST_TRY(begin_block(inp, &keyword));
    return input && inp->block != OST_INP_NOTHING ? include(inp, input, depth) : OST_SUCCESS;
}

static OstStatus read_data_line(OstInp *inp)
{
    switch (inp->block) {
    case OST_INP_NODES:
        return read_node(inp);
    case OST_INP_ELEMENTS:
        return read_element(inp);
    case OST_INP_SKIPPED:
        ost_cells_skip(&inp->cells, inp->dimension, inp->type);
        return OST_SUCCESS;
    case OST_INP_SET:
        return ost_inp_set_line(inp);
    case OST_INP_SURFACE:
        return ost_inp_surface_line(inp);
    case OST_INP_UNION:
        return ost_inp_union_line(inp);
    case OST_INP_INSTANCE:
        return ost_inp_instance_line(inp);
    case OST_INP_TIE:
        return ost_inp_tie_line(inp);
    case OST_INP_KINEMATIC:
    case OST_INP_KINEMATIC_NODES:
        ost_inp_kinematic_line(inp);
        return OST_SUCCESS;
    case OST_INP_ORIENTATION:
        ost_inp_orientation_line(inp);
        return OST_SUCCESS;
    case OST_INP_SYSTEM:
        return OST_RAISE_LINE(inp->lines,
                              "*SYSTEM turns or shifts the nodes after it, which is not read; write them in "
                              "the global system, as CAE does");
    case OST_INP_NOTHING:
        break;
    }
    return OST_SUCCESS;
}

static OstStatus read_lines(OstInp *inp, OstLineReader *lines, int depth)
{
    int found = 0;
    inp->lines = lines;
    OST_TRY(ost_lines_next(lines, &found));
    if (found && depth == 0 && isdigit((unsigned char)lines->text[strspn(lines->text, " \t")]))
        return OST_RAISE_LINE(lines,
                              "begins with a number, and not with a keyword; is it of AVS? python3 -c \"import meshio; "
                              "meshio.read('%s', file_format='avsucd').write('NEW.vtu')\" converts it",
                              lines->path);
    for (; found; inp->lines = lines) {
        if (!ost_lines_take(lines, '*')) {
            OST_TRY(read_data_line(inp));
        } else if (*lines->next != '*') {
            OST_TRY(read_keyword(inp, depth));
        }
        OST_TRY(ost_lines_next(lines, &found));
    }
    return inp->filled == 0 ? OST_SUCCESS
                            : OST_RAISE_LINE(lines, "the file ends within element %" PRId64, inp->element[0]);
}

/* Sections say which sets are made of a material; without any, all sets of tets may be regions. */
static void choose_regions(OstInp *inp)
{
    for (int s = 0; s < inp->cells.set_count && inp->sections; s++)
        inp->cells.set[s].is_region = inp->cells.set[s].is_region == 2;
    if (inp->left_out > 0)
        ost_warn(inp->ctx,
                 "%s: %" PRId64 " line%s of *SURFACE name%s no face (S1 to S6, SPOS or SNEG) of solids or shells, and "
                 "%s left out; write the faces, as CAE does",
                 inp->cells.path, inp->left_out, inp->left_out == 1 ? "" : "s", inp->left_out == 1 ? "s" : "",
                 inp->left_out == 1 ? "is" : "are");
}

static OstStatus read_file(OstInp *inp, const char *path, OstMeshChunk **chunk)
{
    OstLineReader lines;
    OST_TRY(ost_lines_open(inp->ctx, path, &lines));
    const OstStatus status = read_lines(inp, &lines, 0);
    ost_lines_close(&lines);
    OST_TRY(status);
    OST_TRY(ost_inp_end_parts(inp));
    choose_regions(inp);
    ost_inp_warn_passed(inp);
    drop_quotes(&inp->cells);
    return ost_cells_finish(&inp->cells, chunk);
}

OstStatus ost_abaqus_read(OstContext *ctx, const char *path, OstMeshChunk **chunk)
{
    OstInp inp = {.ctx = ctx, .set = -1, .of = -1};
    OstStatus status = ost_cells_open(ctx, path, &inp.cells);
    inp.cells.same_names = same_names;
    OST_THEN(read_file(&inp, path, chunk));
    ost_inp_close_parts(&inp);
    OST_FREE(inp.passed.word, inp.join, inp.orientation, inp.section);
    ost_cells_close(&inp.cells);
    return status;
}
