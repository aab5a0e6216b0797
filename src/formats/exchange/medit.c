/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "formats/cells/cells.h"
#include "formats/exchange/exchange.h"
#include "formats/msh/msh.h"

#include <ctype.h>
#include <inttypes.h>
#include <string.h>
#include <strings.h>

/* MEDIT's format (.mesh in words, .meshb in bytes): keywords, each followed by a count and that many items. An item of
 * a shape ends with its reference, which says what it belongs to: 0 is nothing. */

typedef struct Keyword {
    const char *word;
    int code; /* in bytes */
    OstCellKind kind;
    int numbers;   /* integers of an item, its reference among them */
    int dimension; /* of a shape; -1: no shape */
} Keyword;

/* Quadratic shapes follow linear ones. */
static const Keyword keywords[] = {
    {"Edges", 5, OST_CELL_LINE2, 3, 1},          {"EdgesP2", 25, OST_CELL_LINE3, 4, 1},
    {"Triangles", 6, OST_CELL_TRIANGLE3, 4, 2},  {"TrianglesP2", 24, OST_CELL_TRIANGLE6, 7, 2},
    {"Tetrahedra", 8, OST_CELL_TET4, 5, 3},      {"TetrahedraP2", 30, OST_CELL_TET10, 11, 3},
    {"Quadrilaterals", 7, OST_CELL_QUAD4, 5, 2}, {"QuadrilateralsQ2", 27, OST_CELL_QUAD9, 10, 2},
    {"Hexahedra", 10, OST_CELL_HEX8, 9, 3},      {"HexahedraQ2", 33, OST_CELL_HEX27, 28, 3},
    {"Hexaedra", 0, OST_CELL_HEX8, 9, 3},        {"Prisms", 9, OST_CELL_WEDGE6, 7, 3},
    {"Pentahedra", 0, OST_CELL_WEDGE6, 7, 3},    {"PrismsP2", 86, OST_CELL_WEDGE18, 19, 3},
    {"Pyramids", 49, OST_CELL_PYRAMID5, 6, 3},   {"PyramidsP2", 87, OST_CELL_PYRAMID14, 15, 3},
};

/* What a line of Gmsh's holds, by its length; the code is that of Gmsh's type, negative. */
static const Keyword of_gmsh[] = {{"Quadrilaterals", -16, OST_CELL_QUAD8, 9, 2},
                                  {"Quadrilaterals", -10, OST_CELL_QUAD9, 10, 2},
                                  {"Hexahedra", -17, OST_CELL_HEX20, 21, 3},
                                  {"Hexahedra", -12, OST_CELL_HEX27, 28, 3}};

enum { DIMENSION = 3, VERTICES = 4, END = 54, MOST_NUMBERS = 28, LONGEST_WORD = 64, FEWEST_BYTES = 2 };

typedef struct Medit {
    OstMshCursor cursor;
    OstCells cells;
    int version; /* 1: single precision; 3: long positions in bytes; 4: long numbers */
    int vertices;
    unsigned unordered; /* kinds (bits) whose nodes may be in any order */
} Medit;

/* Comments go from # to the end of the line. */
static void skip_comments(OstMshCursor *cursor)
{
    while (!cursor->binary && cursor->next < cursor->end) {
        if (*cursor->next == '#')
            ost_msh_rest_of_line(cursor);
        else if (strchr(" \t\r\n\v\f", *cursor->next) && *cursor->next)
            cursor->next++;
        else
            break;
    }
}

/* A number as long as the version has it. */
static OstStatus read_integer(Medit *medit, const char *what, OstGlobal *value)
{
    int number = 0;
    skip_comments(&medit->cursor);
    if (medit->version >= 4 && medit->cursor.binary)
        return ost_msh_long(&medit->cursor, what, value);
    OST_TRY(ost_msh_int(&medit->cursor, what, &number));
    *value = number;
    return OST_SUCCESS;
}

static OstStatus read_coordinate(Medit *medit, double *value)
{
    int bits = 0;
    float single = 0.0F;
    skip_comments(&medit->cursor);
    if (!medit->cursor.binary || medit->version > 1)
        return ost_msh_double(&medit->cursor, "a coordinate", value);
    OST_TRY(ost_msh_int(&medit->cursor, "a coordinate", &bits));
    memcpy(&single, &bits, sizeof single);
    *value = (double)single;
    if (!(single - single == 0.0F))
        return OST_RAISE_MSH(&medit->cursor, "%g found, expected a coordinate that is finite", *value);
    return OST_SUCCESS;
}

static OstStatus read_count(Medit *medit, const char *word, OstGlobal *count)
{
    OST_TRY(read_integer(medit, "the number of items", count));
    if (*count < 0)
        return OST_RAISE_MSH(&medit->cursor, "%" PRId64 " %s stated", *count, word);
    return ost_msh_check_count(&medit->cursor, word, *count, FEWEST_BYTES);
}

/* Vertices are numbered from 1 as they come; their references are not used. */
static OstStatus read_vertices(Medit *medit)
{
    OstGlobal count = 0, reference = 0;
    if (medit->vertices++)
        return OST_RAISE_MSH(&medit->cursor, "a second list of vertices");
    OST_TRY(read_count(medit, "vertices", &count));
    for (OstGlobal i = 0; i < count; i++) {
        double x[3];
        for (int d = 0; d < 3; d++)
            OST_TRY(read_coordinate(medit, &x[d]));
        OST_TRY(read_integer(medit, "the reference of a vertex", &reference));
        OST_TRY(ost_cells_add_node(&medit->cells, i + 1, x));
    }
    return OST_SUCCESS;
}

/* Words up to the end of the line. */
static int words_of_line(Medit *medit)
{
    OstMshCursor line = medit->cursor;
    int words = 0;
    skip_comments(&line);
    const OstMshText text = ost_msh_rest_of_line(&line);
    for (int i = 0; i < text.length && text.start[i] != '#'; i++)
        words += !strchr(" \t\r", text.start[i]) && (i == 0 || strchr(" \t\r", text.start[i - 1]));
    return words;
}

/* Gmsh writes quadratic shapes under the words of linear ones, in its own order of the nodes. */
static const Keyword *quadratic_if_longer(Medit *medit, const Keyword *linear)
{
    const Keyword *next = linear + 1;
    const int may_be =
        linear->kind == OST_CELL_LINE2 || linear->kind == OST_CELL_TRIANGLE3 || linear->kind == OST_CELL_TET4;
    const int words = medit->cursor.binary ? 0 : words_of_line(medit);
    for (size_t k = 0; k < sizeof of_gmsh / sizeof *of_gmsh; k++)
        if (strcmp(of_gmsh[k].word, linear->word) == 0 && words == of_gmsh[k].numbers)
            return &of_gmsh[k];
    return may_be && words == next->numbers ? next : linear;
}

/* Labels go on through the solids, so that no two have the same. */
static OstGlobal first_label(const Medit *medit, const Keyword *keyword)
{
    OstGlobal label = 1;
    for (int k = OST_CELL_TET4; k < OST_CELL_QUAD4 && keyword->dimension == 3; k++)
        label += medit->cells.list[k].count;
    return label;
}

static OstStatus read_cells(Medit *medit, const Keyword *keyword)
{
    OstGlobal count = 0, read[MOST_NUMBERS], numbers[MOST_NUMBERS];
    OST_TRY(read_count(medit, keyword->word, &count));
    keyword = quadratic_if_longer(medit, keyword);
    const OstMshCell *gmsh = keyword->code < 0 ? ost_msh_cell(-keyword->code) : NULL;
    const OstGlobal first = first_label(medit, keyword);
    medit->unordered |= gmsh ? 0U : 1U << keyword->kind;
    for (OstGlobal i = 0; i < count; i++) {
        for (int k = 0; k < keyword->numbers; k++)
            OST_TRY(read_integer(medit, "a vertex or reference", &read[k]));
        const OstGlobal reference = read[keyword->numbers - 1];
        for (int k = 0; k + 1 < keyword->numbers; k++)
            numbers[k] = read[gmsh ? gmsh->place[k] : k];
        OST_TRY(
            ost_cells_add(&medit->cells, keyword->kind, first + i, reference == 0 ? OST_NO_GROUP : reference, numbers));
    }
    return OST_SUCCESS;
}

static OstStatus check_dimension(Medit *medit)
{
    int dimension = 0;
    skip_comments(&medit->cursor);
    OST_TRY(ost_msh_int(&medit->cursor, "the dimension", &dimension));
    return dimension == 3
               ? OST_SUCCESS
               : OST_RAISE_MSH(&medit->cursor, "dimension %d found, expected 3: a mesh of a volume", dimension);
}

/* --- words --- */

/* The next word, if it begins with a letter; what lies between keywords that are read is passed over. */
static void next_word(OstMshCursor *cursor, char word[LONGEST_WORD])
{
    size_t length = 0;
    word[0] = '\0';
    skip_comments(cursor);
    cursor->place = cursor->next;
    while (cursor->next < cursor->end && !strchr(" \t\r\n\v\f#", *cursor->next)) {
        if (length + 1 < LONGEST_WORD)
            word[length++] = *cursor->next;
        cursor->next++;
    }
    if (length == 0 && cursor->next < cursor->end)
        cursor->next++; /* a zero byte */
    word[length] = '\0';
}

/* Other programs' files of the same ending, by their first word. */
static const char *way_of_another(const char *word)
{
    if (strcasecmp(word, "MFEM") == 0)
        return "; MFEM's meshes are not read: mesh.PrintVTU(\"NEW\") in MFEM writes a .vtu";
    if (isdigit((unsigned char)word[0]))
        return "; is it Netgen's neutral format? Export it there as Gmsh2, with the ending .msh";
    return strcasecmp(word, "BEGIN") == 0 ? "; is it of GetFEM? mesh.export_to_vtu(\"NEW.vtu\") there writes a .vtu"
                                          : "";
}

static OstStatus read_words(Medit *medit)
{
    char word[LONGEST_WORD];
    OstMshCursor *cursor = &medit->cursor;
    int format = 0;
    next_word(cursor, word);
    if (strncasecmp(word, "MeshVersionFormatted", 20) != 0)
        return OST_RAISE_MSH(cursor, "'%s' found, expected MeshVersionFormatted%s", word, way_of_another(word));
    OST_TRY(ost_msh_int(cursor, "the version of the format", &format));
    while (cursor->next < cursor->end) {
        next_word(cursor, word);
        if (strcasecmp(word, "End") == 0)
            break;
        if (strcasecmp(word, "Dimension") == 0)
            OST_TRY(check_dimension(medit));
        else if (strcasecmp(word, "Vertices") == 0)
            OST_TRY(read_vertices(medit));
        for (size_t k = 0; k < sizeof keywords / sizeof *keywords; k++)
            if (strcasecmp(word, keywords[k].word) == 0)
                OST_TRY(read_cells(medit, &keywords[k]));
    }
    return OST_SUCCESS;
}

/* --- bytes --- */

/* Where the next keyword begins, in bytes from the file's start: 0 after the last. */
static OstStatus read_position(Medit *medit, OstGlobal *position)
{
    int number = 0;
    OstMshCursor *cursor = &medit->cursor;
    if (medit->version >= 3) {
        OST_TRY(ost_msh_size(cursor, "the position of the next keyword", position));
    } else {
        OST_TRY(ost_msh_int(cursor, "the position of the next keyword", &number));
        *position = number;
    }
    if (*position != 0 && (*position <= cursor->next - cursor->bytes || *position > cursor->end - cursor->bytes))
        return OST_RAISE_MSH(cursor, "the next keyword is said to be at byte %" PRId64 ", of a file of %td", *position,
                             cursor->end - cursor->bytes);
    return OST_SUCCESS;
}

static OstStatus read_keyword(Medit *medit, int code)
{
    if (code == DIMENSION)
        return check_dimension(medit);
    if (code == VERTICES)
        return read_vertices(medit);
    for (size_t k = 0; k < sizeof keywords / sizeof *keywords; k++)
        if (code == keywords[k].code && code > 0)
            return read_cells(medit, &keywords[k]);
    return OST_SUCCESS;
}

static OstStatus read_bytes(Medit *medit)
{
    OstMshCursor *cursor = &medit->cursor;
    int one = 0, code = 0;
    cursor->binary = 1;
    OST_TRY(ost_msh_int(cursor, "the number one", &one));
    cursor->swapped = one == 1 << 24;
    if (one != 1 && one != 1 << 24)
        return OST_RAISE_MSH(cursor, "%d found where the number one shows the order of bytes", one);
    OST_TRY(ost_msh_int(cursor, "the version of the format", &medit->version));
    if (medit->version < 1 || medit->version > 4)
        return OST_RAISE_MSH(cursor, "version %d of the format found, expected 1 to 4", medit->version);
    while (cursor->next < cursor->end) {
        OstGlobal next = 0;
        OST_TRY(ost_msh_int(cursor, "a keyword", &code));
        if (code == END)
            break;
        OST_TRY(read_position(medit, &next));
        OST_TRY(read_keyword(medit, code));
        if (next == 0)
            break;
        cursor->next = cursor->bytes + next;
    }
    return OST_SUCCESS;
}

/* By what the file holds: Gmsh writes words under either ending. A number one stands at the head of bytes. */
static int is_bytes(const OstMshCursor *cursor)
{
    return cursor->end - cursor->bytes >= 4 && (cursor->bytes[0] == 1 || cursor->bytes[3] == 1);
}

/* The format leaves the order of middles to keywords that few programs write (HexahedraQ2Ordering). */
static OstStatus order_middles(Medit *medit)
{
    static const OstCellKind kinds[] = {OST_CELL_HEX27, OST_CELL_WEDGE18, OST_CELL_PYRAMID14, OST_CELL_QUAD9};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        if (medit->unordered >> kinds[k] & 1U)
            OST_TRY(ost_cells_order_middles(&medit->cells, kinds[k]));
    return OST_SUCCESS;
}

OstStatus ost_medit_read(OstContext *ctx, const char *path, OstMeshChunk **chunk)
{
    Medit medit = {.version = 2};
    OstStatus status = ost_cells_open(ctx, path, &medit.cells);
    OST_THEN(ost_msh_open(ctx, path, &medit.cursor));
    OST_THEN(is_bytes(&medit.cursor) ? read_bytes(&medit) : read_words(&medit));
    OST_THEN(order_middles(&medit));
    OST_THEN(ost_cells_finish(&medit.cells, chunk));
    ost_msh_close(&medit.cursor);
    ost_cells_close(&medit.cells);
    return status;
}
