/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/msh_check.h"

#include "core/error.h"
#include "formats/line_reader.h"

#include <inttypes.h>
#include <limits.h>
#include <string.h>

enum { TET4 = 4, TET10 = 11, SMALLEST_NAME = 6 };

/* Dimension and nodes of element types 1 to 31, in Gmsh's numbering. */
static const struct {
    int dimension, nodes;
} element_type[] = {{0, 0},  {1, 2},  {2, 3},  {2, 4},  {3, 4}, {3, 8}, {3, 6},  {3, 5},  {1, 3},  {2, 6}, {2, 9},
                    {3, 10}, {3, 27}, {3, 18}, {3, 14}, {0, 1}, {2, 8}, {3, 20}, {3, 15}, {3, 13}, {2, 9}, {2, 10},
                    {2, 12}, {2, 15}, {2, 15}, {2, 21}, {1, 4}, {1, 5}, {1, 6},  {3, 20}, {3, 35}, {3, 56}};

OstStatus ost_msh_element_type(const OstMshCursor *cursor, int type, int *dimension, int *nodes)
{
    if (type < 1 || type >= (int)(sizeof element_type / sizeof *element_type))
        return OST_RAISE_MSH(cursor, "element of type %d found, expected tets (types 4 and 11) and what bounds them",
                             type);
    *dimension = element_type[type].dimension;
    *nodes = element_type[type].nodes;
    return OST_SUCCESS;
}

int ost_msh_type_dimension(int type)
{
    return element_type[type].dimension;
}

OstStatus ost_msh_define_node(const OstMshCursor *cursor, OstMshContents *contents, OstGlobal tag)
{
    if (tag < 1 || tag > INT_MAX)
        return OST_RAISE_MSH(cursor, "node tag %" PRId64 " found, expected 1 to %d", tag, INT_MAX);
    if (contents->nodes == 0 || tag < contents->first_node_tag)
        contents->first_node_tag = tag;
    if (contents->nodes == 0 || tag > contents->last_node_tag)
        contents->last_node_tag = tag;
    contents->nodes++;
    return OST_SUCCESS;
}

/* Lines 1, triangles 2, quadrangles 3, tets 4, hexahedra 5, prisms 6, pyramids 7; 0: points and what else there is. */
static int shape_of(int type)
{
    static const int shape[] = {0, 1, 2, 3, 4, 5, 6, 7, 1, 2, 3, 4, 5, 6, 7, 0,
                                3, 5, 6, 7, 2, 2, 2, 2, 2, 2, 1, 1, 1, 4, 4, 4};
    return type >= 0 && type < (int)(sizeof shape / sizeof shape[0]) ? shape[type] : 0;
}

/* Gmsh 4.8 writes past its arrays where elements of one shape stand in two orders. */
static OstStatus check_order(const OstMshCursor *cursor, OstMshContents *contents, int type)
{
    int *first = &contents->type_of_shape[shape_of(type)];
    if (shape_of(type) != 0 && *first != 0 && *first != type)
        return OST_RAISE_MSH(cursor,
                             "an element of type %d found after others of the same shape and of type %d, expected one "
                             "order; mesh the whole body in one order",
                             type, *first);
    *first = type;
    return OST_SUCCESS;
}

OstStatus ost_msh_define_element(const OstMshCursor *cursor, OstMshContents *contents, int type, OstGlobal tag)
{
    if (tag < 1 || tag > INT_MAX)
        return OST_RAISE_MSH(cursor, "element tag %" PRId64 " found, expected 1 to %d", tag, INT_MAX);
    OST_TRY(check_order(cursor, contents, type));
    contents->elements++;
    if (type == TET4 || type == TET10) {
        contents->tets_out_of_order |= tag < contents->last_tet_tag;
        contents->last_tet_tag = tag;
    }
    return OST_SUCCESS;
}

OstStatus ost_msh_use_node(const OstMshCursor *cursor, const OstMshContents *contents, OstGlobal tag)
{
    if (contents->nodes == 0 || tag < contents->first_node_tag || tag > contents->last_node_tag)
        return OST_RAISE_MSH(cursor, "an element uses node %" PRId64 ", which the file does not define before it", tag);
    return OST_SUCCESS;
}

static OstStatus read_format(OstMshCursor *cursor, OstMshContents *contents)
{
    char line[OST_MSH_LINE_SIZE];
    char version[8] = "";
    int binary = 0, size = 0, found = 0, end = 0, one = 0;
    OST_TRY(ost_msh_line(cursor, line, &found));
    if (sscanf(line, "%7s %d %d%n", version, &binary, &size, &end) != 3 || line[end] != '\0' || binary < 0 ||
        binary > 1)
        return OST_RAISE_MSH(cursor, "'%s' found, expected the format's version, 0 or 1, and 8", line);
    contents->version = strcmp(version, "2.2") == 0 ? 22 : strcmp(version, "4.1") == 0 ? 41 : 0;
    if (contents->version == 0)
        return OST_RAISE_MSH(cursor,
                             "format version %s found, expected 2.2 or 4.1; convert the file with gmsh -3 -format "
                             "msh41",
                             version);
    if (size != 8)
        return OST_RAISE_MSH(cursor, "numbers of %d bytes found, expected 8", size);
    cursor->binary = binary;
    if (!binary)
        return OST_SUCCESS;
    OST_TRY(ost_msh_int(cursor, "the number one", &one));
    cursor->swapped = one == 1 << 24;
    if (one != 1 && one != 1 << 24)
        return OST_RAISE_MSH(cursor, "%d found where the number one shows the order of bytes", one);
    return OST_SUCCESS;
}

static OstStatus check_names(OstMshCursor *cursor)
{
    char line[OST_MSH_LINE_SIZE];
    int count = 0, found = 0;
    OST_TRY(ost_msh_count_line(cursor, "physical names", SMALLEST_NAME, &count));
    for (int i = 0; i < count; i++) {
        char name[OST_MSH_LINE_SIZE] = "";
        int dimension = 0, tag = 0, end = 0;
        OST_TRY(ost_msh_line(cursor, line, &found));
        if (sscanf(line, "%d %d \"%[^\"]\"%n", &dimension, &tag, name, &end) != 3 || end == 0 || line[end] != '\0' ||
            dimension < 0 || dimension > 3 || tag < 1)
            return OST_RAISE_MSH(cursor,
                                 "'%.80s' found, expected a physical name: dimension 0 to 3, positive tag, name "
                                 "in double quotes",
                                 line);
    }
    return OST_SUCCESS;
}

static OstStatus skip_comments(OstMshCursor *cursor)
{
    char line[OST_MSH_LINE_SIZE] = "";
    int found = 1;
    OstMshCursor before = *cursor;
    long start = 0;
    while (found && line[0] != '$') {
        before = *cursor;
        start = ftell(cursor->file);
        OST_TRY(ost_msh_line(cursor, line, &found));
    }
    *cursor = before;
    if (fseek(cursor->file, start, SEEK_SET) != 0)
        return OST_RAISE(cursor->ctx, OST_FILE_FAILED, "%s: could not go back in the file", cursor->path);
    return OST_SUCCESS;
}

/* What lies between a section's two marks. */
static OstStatus check_section(OstMshCursor *cursor, const char *name, OstMshContents *contents)
{
    const int old = contents->version == 22;
    if (strcmp(name, "PhysicalNames") == 0)
        return check_names(cursor);
    if (strcmp(name, "Comments") == 0)
        return skip_comments(cursor);
    if (strcmp(name, "Entities") == 0 && !old)
        return ost_msh41_entities(cursor);
    if (strcmp(name, "Nodes") == 0)
        return old ? ost_msh22_nodes(cursor, contents) : ost_msh41_nodes(cursor, contents);
    if (strcmp(name, "Elements") == 0)
        return old ? ost_msh22_elements(cursor, contents) : ost_msh41_elements(cursor, contents);
    return OST_RAISE_MSH(cursor,
                         "section $%s found; a mesh is made of $MeshFormat, $PhysicalNames, %s$Nodes, $Elements "
                         "and $Comments: save it without partitions, periodicity, parametrisations and results",
                         name, old ? "" : "$Entities, ");
}

/* Goes to the next line that is not blank. */
static OstStatus next_mark(OstMshCursor *cursor, char line[OST_MSH_LINE_SIZE], int *found)
{
    do {
        OST_TRY(ost_msh_line(cursor, line, found));
    } while (*found && line[0] == '\0');
    return OST_SUCCESS;
}

static OstStatus expect_end(OstMshCursor *cursor, const char *name)
{
    char line[OST_MSH_LINE_SIZE] = "";
    int found = 0;
    OST_TRY(next_mark(cursor, line, &found));
    if (!found)
        return OST_RAISE_MSH(cursor, "the file ends where $End%s is expected; it is incomplete, write it again", name);
    if (strncmp(line, "$End", 4) != 0 || strcmp(line + 4, name) != 0)
        return OST_RAISE_MSH(cursor, "'%.60s' found, expected $End%s", line, name);
    return OST_SUCCESS;
}

static OstStatus check_sections(OstMshCursor *cursor, OstMshContents *contents)
{
    char line[OST_MSH_LINE_SIZE] = "";
    int found = 0, has_nodes = 0, has_elements = 0;
    OST_TRY(ost_msh_line(cursor, line, &found));
    if (!found || strcmp(line, "$MeshFormat") != 0)
        return OST_RAISE_MSH(cursor, "'%.60s' found, expected $MeshFormat: not a Gmsh mesh", line);
    OST_TRY(read_format(cursor, contents));
    OST_TRY(expect_end(cursor, "MeshFormat"));
    OST_TRY(next_mark(cursor, line, &found));
    while (found) {
        const char *name = line + 1;
        int *seen = strcmp(name, "Nodes") == 0 ? &has_nodes : strcmp(name, "Elements") == 0 ? &has_elements : &(int){0};
        if (line[0] != '$')
            return OST_RAISE_MSH(cursor, "'%.60s' found between sections, expected $ and a section's name", line);
        if ((*seen)++ > 0)
            return OST_RAISE_MSH(cursor, "a second section %s", line);
        OST_TRY(check_section(cursor, name, contents));
        OST_TRY(expect_end(cursor, name));
        OST_TRY(next_mark(cursor, line, &found));
    }
    if (!has_nodes || !has_elements)
        return OST_RAISE_MSH(cursor, "the file ends without a section $%s; it is incomplete, write it again",
                             has_nodes ? "Elements" : "Nodes");
    return OST_SUCCESS;
}

OstStatus ost_msh_check(OstContext *ctx, const char *path, OstMshContents *contents)
{
    OstMshCursor cursor = {.ctx = ctx, .path = path};
    *contents = (OstMshContents){0};
    OST_TRY(ost_file_open(ctx, path, &cursor.file, &cursor.bytes));
    OstStatus status = check_sections(&cursor, contents);
    if (status == OST_SUCCESS && ferror(cursor.file))
        status = OST_RAISE(ctx, OST_FILE_FAILED, "%s: could not be read to its end", path);
    fclose(cursor.file);
    return status;
}
