/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/msh/msh.h"
#include "formats/serial/formats.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Gmsh's format, by its manual (sections "MSH file format" and "legacy formats"): sections between $Name and $EndName,
 * in version 1 $NAM and $ENDNAM. Other sections, and text between sections, are skipped. */

enum { NAME_SIZE = OST_MSH_LONGEST_NAME, SMALLEST_NAME = 4 };

/* Length of a line that messages quote. */
static int shown(OstMshText line)
{
    return line.length < NAME_SIZE ? line.length : NAME_SIZE;
}

/* The version, from a number such as 2.2. */
OstStatus ost_msh_format(OstMsh *msh)
{
    OstMshCursor *cursor = &msh->cursor;
    double number = 0.0;
    int binary = 0, size = 0, one = 0;
    OST_TRY(ost_msh_double(cursor, "the version of the format", &number));
    OST_TRY(ost_msh_int(cursor, "0 for text or 1 for bytes", &binary));
    OST_TRY(ost_msh_int(cursor, "8, the bytes of a number", &size));
    ost_msh_rest_of_line(cursor);
    msh->version = number >= 1.0 && number < 5.0 ? (int)(10.0 * number + 1e-6) : 0;
    if (msh->version < 10)
        return OST_RAISE_MSH(cursor,
                             "version %g of the format found, expected 1 to 4.1; convert the file with gmsh -save "
                             "FILE.msh -format msh41 -o NEW.msh",
                             number);
    if (binary != 0 && size != 8)
        return OST_RAISE_MSH(
            cursor,
            "numbers of %d bytes found, expected 8; write the file as text, or with Gmsh on a machine of 64 bits",
            size);
    cursor->binary = binary != 0;
    if (!binary)
        return OST_SUCCESS;
    OST_TRY(ost_msh_int(cursor, "the number one", &one));
    cursor->swapped = one == 1 << 24;
    if (one != 1 && one != 1 << 24)
        return OST_RAISE_MSH(cursor, "%d found where the number one shows the order of bytes", one);
    return OST_SUCCESS;
}

/* A name is in quotes; without them it is the rest of the line. */
static OstStatus add_name(OstMsh *msh, int dimension, int tag, OstMshText text)
{
    const char *quote = memchr(text.start, '"', (size_t)text.length);
    if (quote) {
        const char *start = quote + 1, *end = text.start + text.length;
        const char *other = memchr(start, '"', (size_t)(end - start));
        if (!other)
            return OST_RAISE_MSH(&msh->cursor, "'%.*s' found, expected a physical name in double quotes", shown(text),
                                 text.start);
        text = (OstMshText){start, (int)(other - start)};
    }
    OST_TRY(OST_RESIZE(msh->cursor.ctx, &msh->name, msh->name_count + 1));
    msh->name[msh->name_count++] = (OstMshName){dimension, tag, text};
    return OST_SUCCESS;
}

/* Names are text, in binary files too. */
static OstStatus read_names(OstMsh *msh)
{
    OstMshCursor *cursor = &msh->cursor;
    const int binary = cursor->binary;
    OstGlobal count = 0;
    cursor->binary = 0;
    OST_TRY(ost_msh_count_line(cursor, "the number of physical names", &count));
    OST_TRY(ost_msh_check_count(cursor, "physical names", count, SMALLEST_NAME));
    for (OstGlobal i = 0; i < count; i++) {
        int dimension = -1, tag = 0;
        if (msh->version > 20)
            OST_TRY(ost_msh_int(cursor, "the dimension of a physical name", &dimension));
        OST_TRY(ost_msh_int(cursor, "the tag of a physical name", &tag));
        if (msh->version > 20 && (dimension < 0 || dimension > 3))
            return OST_RAISE_MSH(cursor, "a physical name of dimension %d found, expected 0 to 3", dimension);
        OST_TRY(add_name(msh, dimension, abs(tag), ost_msh_rest_of_line(cursor)));
    }
    cursor->binary = binary;
    return OST_SUCCESS;
}

/* Sections in the order they must have; those of stage 0 may be anywhere. */
enum { ENTITIES = 1, NODES = 2, ELEMENTS = 3 };
static const struct {
    const char *name;
    int stage;
    OstStatus (*read[5])(OstMsh *msh); /* by the version's whole number, from 1 */
} section[OST_MSH_SECTIONS] = {
    {"PhysicalNames", 0, {NULL, read_names, read_names, read_names, read_names}},
    {"Entities", ENTITIES, {NULL, NULL, NULL, ost_msh3_entities, ost_msh4_entities}},
    {"PartitionedEntities", ENTITIES, {NULL, NULL, NULL, NULL, ost_msh4_partitioned_entities}},
    {"NOD", NODES, {NULL, ost_msh2_nodes, ost_msh2_nodes}},
    {"Nodes", NODES, {NULL, ost_msh2_nodes, ost_msh2_nodes, ost_msh3_nodes, ost_msh4_nodes}},
    {"ParametricNodes", NODES, {NULL, ost_msh2_parametric_nodes, ost_msh2_parametric_nodes}},
    {"ELM", ELEMENTS, {NULL, ost_msh2_elements, ost_msh2_elements}},
    {"Elements", ELEMENTS, {NULL, ost_msh2_elements, ost_msh2_elements, ost_msh3_elements, ost_msh4_elements}},
};

/* Goes to the $End line of a section, which follows a line end or, in a binary file, any byte. */
OstStatus ost_msh_skip_section(OstMshCursor *cursor, const char *name)
{
    char mark[NAME_SIZE + 8];
    const int start = cursor->binary ? 1 : 0;
    const int length = snprintf(mark, sizeof mark, "\n$End%s", name);
    const char *from = cursor->next - 1; /* the end of the line that names the section */
    const char *found = memmem(from, (size_t)(cursor->end - from), mark + start, (size_t)(length - start));
    if (!found)
        return OST_RAISE_MSH(cursor, "the section $%s has no end $End%s; the file is incomplete, write it again", name,
                             name);
    cursor->next = found + (1 - start);
    return OST_SUCCESS;
}

/* Gmsh repeats the whole mesh in files to which it appends views. */
static int repeats(OstMsh *msh, OstMshBytes before)
{
    OstMshCursor *cursor = &msh->cursor;
    if (!before.start || cursor->end - cursor->next < before.length ||
        memcmp(cursor->next, before.start, (size_t)before.length) != 0)
        return 0;
    cursor->next += before.length;
    return 1;
}

static OstStatus read_section(OstMsh *msh, const char *name)
{
    int i = 0;
    while (i < OST_MSH_SECTIONS && (strcmp(name, section[i].name) != 0 || !section[i].read[msh->version / 10]))
        i++;
    if (i == OST_MSH_SECTIONS)
        return ost_msh_skip_section(&msh->cursor, name);
    if (repeats(msh, msh->text[i]))
        return OST_SUCCESS;
    const int stage = section[i].stage;
    if (stage > 0 && (stage < msh->stage || (stage == msh->stage && stage != ENTITIES) ||
                      (stage == ELEMENTS && msh->stage != NODES)))
        return OST_RAISE_MSH(&msh->cursor,
                             "a section $%s found, expected $Entities, one $Nodes and one $Elements in "
                             "this order",
                             name);
    msh->stage = stage > 0 ? stage : msh->stage;
    msh->text[i].start = msh->cursor.next;
    OST_TRY(section[i].read[msh->version / 10](msh));
    msh->text[i].length = msh->cursor.next - msh->text[i].start;
    return OST_SUCCESS;
}

/* The first word of a line, without the $. */
void ost_msh_section_name(OstMshText line, char name[OST_MSH_LONGEST_NAME])
{
    int length = 0;
    while (length < line.length - 1 && length < NAME_SIZE - 1 && line.start[length + 1] > ' ')
        length++;
    memcpy(name, line.start + (line.length > 0), (size_t)length);
    name[length] = '\0';
}

static OstStatus expect_end(OstMshCursor *cursor, const char *name)
{
    OstMshText line = {cursor->next, 0};
    char found[NAME_SIZE] = "";
    while (line.length == 0 && cursor->next < cursor->end)
        line = ost_msh_rest_of_line(cursor);
    ost_msh_section_name(line, found);
    if (line.length == 0)
        return OST_RAISE_MSH(cursor, "the file ends where $End%s is expected; it is incomplete, write it again", name);
    if (line.start[0] != '$' || strncasecmp(found, "End", 3) != 0 || strcmp(found + 3, name) != 0)
        return OST_RAISE_MSH(cursor, "'%.*s' found, expected $End%s", shown(line), line.start, name);
    return OST_SUCCESS;
}

/* The format comes first, except for comments; version 1 has none. */
static OstStatus read_format_or_section(OstMsh *msh, const char *name)
{
    if (strcmp(name, "MeshFormat") == 0)
        return ost_msh_format(msh);
    if (strcmp(name, "NOD") == 0 || strcmp(name, "ELM") == 0)
        msh->version = 10;
    else if (strcmp(name, "Comments") != 0)
        return OST_RAISE_MSH(&msh->cursor, "'$%s' found, expected $MeshFormat: not a Gmsh mesh", name);
    return read_section(msh, name);
}

/* Other programs' files of the same ending, by their first letter. */
static const char *way_of_another(char first)
{
    if (first == '(')
        return "; is it of Fluent? python3 -c \"import meshio; meshio.ansys.read('FILE').write('NEW.vtu')\" converts "
               "it";
    if (first == '*')
        return "; is it of CalculiX (cgx) or Abaqus? Name it .inp";
    if (first == 'M' || first == 'm')
        return "; is it of GiD? Export it there for Abaqus, as .inp";
    return isdigit((unsigned char)first) ? "; is it of FreeFEM? savemesh(Th, \"NEW.mesh\") writes a mesh that is read"
                                         : "";
}

static OstStatus read_sections(OstMsh *msh)
{
    OstMshCursor *cursor = &msh->cursor;
    char name[NAME_SIZE];
    while (cursor->next < cursor->end) {
        const OstMshText line = ost_msh_rest_of_line(cursor);
        if (line.length > 0 && line.start[0] != '$' && msh->version == 0)
            return OST_RAISE_MSH(cursor, "'%.*s' found, expected $MeshFormat: not a Gmsh mesh%s", shown(line),
                                 line.start, way_of_another(line.start[0]));
        if (line.length == 0 || line.start[0] != '$')
            continue;
        ost_msh_section_name(line, name);
        OST_TRY(msh->version == 0 ? read_format_or_section(msh, name) : read_section(msh, name));
        OST_TRY(expect_end(cursor, name));
    }
    cursor->place = cursor->end;
    if (msh->version == 0)
        return OST_RAISE_MSH(cursor, "the file ends without $MeshFormat: not a Gmsh mesh");
    if (msh->stage < ELEMENTS)
        return OST_RAISE_MSH(cursor, "the file ends without a section $%s; it is incomplete, write it again",
                             msh->stage == NODES ? "Elements" : "Nodes");
    return OST_SUCCESS;
}

static void close_msh(OstMsh *msh)
{
    for (int g = 0; g < msh->group_count; g++)
        OST_FREE(msh->group[g].nodes);
    OST_FREE(msh->name, msh->group, msh->entity, msh->entity_start, msh->entity_group);
    ost_split_close(&msh->split);
    ost_label_index_clear(&msh->nodes);
    ost_label_index_clear(&msh->entities);
    ost_msh_close(&msh->cursor);
}

OstStatus ost_msh_read(OstContext *ctx, const char *path, OstMeshChunk **chunk)
{
    OstMsh msh = {0};
    OstStatus status = OST_SUCCESS;
    *chunk = NULL;
    OST_TRY_DONE(ost_msh_open(ctx, path, &msh.cursor));
    OST_TRY_DONE(OST_NEW(ctx, &msh.chunk, 1));
    msh.chunk->ctx = ctx;
    OST_TRY_DONE(OST_NEW(ctx, &msh.name, 0));
    OST_TRY_DONE(OST_NEW(ctx, &msh.group, 0));
    OST_TRY_DONE(read_sections(&msh));
    OST_TRY_DONE(ost_msh_finish(&msh));
done:
    close_msh(&msh);
    if (status != OST_SUCCESS)
        ost_chunk_destroy(&msh.chunk);
    *chunk = msh.chunk;
    return status;
}
