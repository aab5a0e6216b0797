/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/msh.h"
#include "formats/serial.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* Gmsh's format, after its manual (sections "MSH file format" and "legacy formats"): sections between $Name and
 * $EndName, in version 1 $NAM and $ENDNAM. What lies between sections, and sections of other names, are skipped. */

enum { NAME_SIZE = 64, SMALLEST_NAME = 4 };

/* Takes the version from a number such as 2.2. */
static OstStatus read_format(OstMsh *msh)
{
    OstMshCursor *cursor = &msh->cursor;
    double number = 0.0;
    int binary = 0, size = 0, one = 0;
    OST_TRY(ost_msh_double(cursor, "the version of the format", &number));
    OST_TRY(ost_msh_int(cursor, "0 for text or 1 for bytes", &binary));
    OST_TRY(ost_msh_int(cursor, "8, the bytes of a number", &size));
    ost_msh_rest_of_line(cursor);
    msh->version = number >= 1.0 && number < 5.0 ? (int)(10.0 * number + 1e-6) : 0;
    if (msh->version < 10 || msh->version / 10 == 3)
        return OST_RAISE_MSH(cursor,
                             "version %g of the format found, expected 1, 2.0 to 2.2, 4.0 or 4.1; convert the file "
                             "with gmsh -save FILE.msh -format msh41 -o NEW.msh",
                             number);
    if (binary != 0 && size != 8)
        return OST_RAISE_MSH(cursor, "numbers of %d bytes found, expected 8", size);
    cursor->binary = binary != 0;
    if (!binary)
        return OST_SUCCESS;
    OST_TRY(ost_msh_int(cursor, "the number one", &one));
    cursor->swapped = one == 1 << 24;
    if (one != 1 && one != 1 << 24)
        return OST_RAISE_MSH(cursor, "%d found where the number one shows the order of bytes", one);
    return OST_SUCCESS;
}

/* A name stands in quotes; without them, as nobody should write it, it is one word. */
static OstStatus add_name(OstMsh *msh, int dimension, int tag, OstMshText line)
{
    OstMshCursor *cursor = &msh->cursor;
    const char *start = line.start, *end = start + line.length;
    const char *quote = memchr(start, '"', (size_t)line.length);
    const char *other = quote ? memchr(quote + 1, '"', (size_t)(end - quote - 1)) : NULL;
    if (quote && !other)
        return OST_RAISE_MSH(cursor, "'%.*s' found, expected a physical name in double quotes",
                             line.length < NAME_SIZE ? line.length : NAME_SIZE, start);
    if (quote) {
        start = quote + 1;
        end = other;
    }
    if (memchr(start, '\0', (size_t)(end - start)))
        return OST_RAISE_MSH(cursor, "a zero byte found in a physical name");
    OST_TRY(OST_RESIZE(cursor->ctx, &msh->name, msh->name_count + 1));
    OstMshName *name = &msh->name[msh->name_count++];
    *name = (OstMshName){dimension, tag, NULL};
    OST_TRY(OST_NEW(cursor->ctx, &name->text, end - start + 1));
    memcpy(name->text, start, (size_t)(end - start));
    return OST_SUCCESS;
}

/* Names are text in binary files too. */
static OstStatus read_names(OstMsh *msh)
{
    OstMshCursor *cursor = &msh->cursor;
    OstGlobal count = 0;
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
    return OST_SUCCESS;
}

static OstStatus read_names_as_text(OstMsh *msh)
{
    const int binary = msh->cursor.binary;
    msh->cursor.binary = 0;
    const OstStatus status = read_names(msh);
    msh->cursor.binary = binary;
    return status;
}

static OstStatus read_entities(OstMsh *msh, int partitioned)
{
    if (msh->elements >= 0)
        return OST_RAISE_MSH(&msh->cursor, "entities found behind $Elements, expected them before");
    return ost_msh4_entities(msh, partitioned);
}

static OstStatus read_nodes(OstMsh *msh, int parametric)
{
    OstContext *ctx = msh->cursor.ctx;
    if (msh->chunk->node_label)
        return OST_RAISE_MSH(&msh->cursor, "a second section $Nodes");
    OST_TRY(msh->version < 40 ? ost_msh2_nodes(msh, parametric) : ost_msh4_nodes(msh));
    OST_TRY(ost_label_index_create(ctx, msh->chunk->node_count, msh->chunk->node_label, &msh->nodes));
    if (msh->nodes.repeated)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: node tag %lld is given to two nodes", msh->cursor.path,
                         (long long)msh->nodes.repeated_label);
    return OST_SUCCESS;
}

static OstStatus read_elements(OstMsh *msh)
{
    if (!msh->chunk->node_label)
        return OST_RAISE_MSH(&msh->cursor, "$Elements found before $Nodes, expected them behind");
    if (msh->elements >= 0)
        return OST_RAISE_MSH(&msh->cursor, "a second section $Elements");
    return msh->version < 40 ? ost_msh2_elements(msh) : ost_msh4_elements(msh);
}

/* Goes to where the end of a section is: behind a line end, or in a binary file anywhere. */
static OstStatus skip_section(OstMshCursor *cursor, const char *name)
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

static OstStatus read_section(OstMsh *msh, const char *name)
{
    const int second = msh->version < 40;
    if (strcmp(name, "PhysicalNames") == 0)
        return read_names_as_text(msh);
    if (strcmp(name, "Nodes") == 0 || strcmp(name, "NOD") == 0)
        return read_nodes(msh, 0);
    if (strcmp(name, "ParametricNodes") == 0 && second)
        return read_nodes(msh, 1);
    if (strcmp(name, "Elements") == 0 || strcmp(name, "ELM") == 0)
        return read_elements(msh);
    if (strcmp(name, "Entities") == 0 && !second)
        return read_entities(msh, 0);
    if (strcmp(name, "PartitionedEntities") == 0 && !second)
        return read_entities(msh, 1);
    return skip_section(&msh->cursor, name);
}

/* The first word of a line, without the $. */
static void copy_name(OstMshText line, char name[NAME_SIZE])
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
    copy_name(line, found);
    if (line.length == 0)
        return OST_RAISE_MSH(cursor, "the file ends where $End%s is expected; it is incomplete, write it again", name);
    if (line.start[0] != '$' || strncasecmp(found, "End", 3) != 0 || strcmp(found + 3, name) != 0)
        return OST_RAISE_MSH(cursor, "'%.*s' found, expected $End%s", line.length < NAME_SIZE ? line.length : NAME_SIZE,
                             line.start, name);
    return OST_SUCCESS;
}

/* The format comes first, but for comments; version 1 has none. */
static OstStatus read_format_or_section(OstMsh *msh, const char *name)
{
    if (strcmp(name, "MeshFormat") == 0)
        return read_format(msh);
    if (strcmp(name, "NOD") == 0 || strcmp(name, "ELM") == 0)
        msh->version = 10;
    else if (strcmp(name, "Comments") != 0)
        return OST_RAISE_MSH(&msh->cursor, "'$%s' found, expected $MeshFormat: not a Gmsh mesh", name);
    return read_section(msh, name);
}

static OstStatus read_sections(OstMsh *msh)
{
    OstMshCursor *cursor = &msh->cursor;
    char name[NAME_SIZE];
    while (cursor->next < cursor->end) {
        const OstMshText line = ost_msh_rest_of_line(cursor);
        if (line.length > 0 && line.start[0] != '$' && msh->version == 0)
            return OST_RAISE_MSH(cursor, "'%.*s' found, expected $MeshFormat: not a Gmsh mesh",
                                 line.length < NAME_SIZE ? line.length : NAME_SIZE, line.start);
        if (line.length == 0 || line.start[0] != '$')
            continue;
        copy_name(line, name);
        OST_TRY(msh->version == 0 ? read_format_or_section(msh, name) : read_section(msh, name));
        OST_TRY(expect_end(cursor, name));
    }
    cursor->place = cursor->end;
    if (msh->version == 0)
        return OST_RAISE_MSH(cursor, "the file ends without $MeshFormat: not a Gmsh mesh");
    if (!msh->chunk->node_label || msh->elements < 0)
        return OST_RAISE_MSH(cursor, "the file ends without a section $%s; it is incomplete, write it again",
                             msh->chunk->node_label ? "Elements" : "Nodes");
    return OST_SUCCESS;
}

static void close_msh(OstMsh *msh)
{
    for (int i = 0; i < msh->name_count; i++)
        OST_FREE(msh->name[i].text);
    for (int g = 0; g < msh->group_count; g++)
        OST_FREE(msh->group[g].nodes);
    OST_FREE(msh->name);
    OST_FREE(msh->group);
    OST_FREE(msh->entity);
    OST_FREE(msh->entity_start);
    OST_FREE(msh->entity_group);
    ost_label_index_clear(&msh->nodes);
    ost_label_index_clear(&msh->entities);
    ost_msh_close(&msh->cursor);
}

OstStatus ost_msh_read(OstContext *ctx, const char *path, OstMeshChunk **chunk)
{
    OstMsh msh = {.elements = -1};
    OstStatus status = OST_SUCCESS;
    *chunk = NULL;
    OST_TRY_DONE(ost_msh_open(ctx, path, &msh.cursor));
    OST_TRY_DONE(OST_NEW(ctx, &msh.chunk, 1));
    msh.chunk->ctx = ctx;
    OST_TRY_DONE(read_sections(&msh));
    OST_TRY_DONE(ost_msh_finish(&msh));
done:
    close_msh(&msh);
    if (status != OST_SUCCESS)
        ost_chunk_destroy(&msh.chunk);
    *chunk = msh.chunk;
    return status;
}
