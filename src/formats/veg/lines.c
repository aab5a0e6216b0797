/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "formats/serial/input_file.h"
#include "formats/veg/veg.h"

#include <string.h>
#include <sys/stat.h>

/* The lines of a .veg file and of those it includes, as one sequence. */

enum { MOST_INCLUDES = 1000 };

static const char include_keyword[] = "*INCLUDE";

OstLineReader *ost_veg_reader(OstVeg *veg)
{
    return &veg->reader[veg->depth - 1];
}

static int same_inode(const struct stat *a, const struct stat *b)
{
    return a->st_dev == b->st_dev && a->st_ino == b->st_ino;
}

static int lies_at(const OstLineReader *reader, const char *path)
{
    struct stat x, y;
    return fstat(fileno(reader->file), &x) == 0 && stat(path, &y) == 0 && same_inode(&x, &y);
}

static int same_file(const OstLineReader *a, const OstLineReader *b)
{
    struct stat x, y;
    return fstat(fileno(a->file), &x) == 0 && fstat(fileno(b->file), &y) == 0 && same_inode(&x, &y);
}

OstStatus ost_veg_open(OstContext *ctx, const char *path, OstVeg *veg)
{
    *veg = (OstVeg){.ctx = ctx};
    OST_TRY(ost_lines_open(ctx, path, &veg->reader[0]));
    veg->depth = 1;
    return OST_SUCCESS;
}

static OstStatus check_include(OstVeg *veg, const OstLineReader *opened)
{
    for (int i = 0; i < veg->depth; i++)
        if (same_file(&veg->reader[i], opened))
            return OST_RAISE_LINE(ost_veg_reader(veg),
                                  "*INCLUDE of '%s', which is being read already: it would never "
                                  "end",
                                  opened->path);
    return OST_SUCCESS;
}

/* Opens the file at `path`; a failure names the *INCLUDE that asked for it. */
static OstStatus enter(OstVeg *veg, const char *path)
{
    OstLineReader opened;
    OstStatus status = ost_lines_open(veg->ctx, path, &opened);
    if (status == OST_FILE_FAILED) {
        char reason[512];
        strncpy(reason, ost_error_text(veg->ctx), sizeof reason - 1);
        reason[sizeof reason - 1] = '\0';
        OST_RAISE_LINE(ost_veg_reader(veg), "*INCLUDE of %s", reason);
        return OST_FILE_FAILED;
    }
    OST_TRY(status);
    if (veg->sought && lies_at(&opened, veg->sought))
        veg->met = 1;
    status = check_include(veg, &opened);
    if (status == OST_SUCCESS)
        veg->reader[veg->depth++] = opened;
    else
        ost_lines_close(&opened);
    return status;
}

/* The rest of the line names a file, relative to the folder of the file it stands in. */
static OstStatus include(OstVeg *veg)
{
    const OstLineReader *reader = ost_veg_reader(veg);
    const char *name = reader->next + strspn(reader->next, " \t");
    char path[PATH_MAX];
    if (*name == '\0')
        return OST_RAISE_LINE(reader, "*INCLUDE without the name of a file");
    if (veg->depth == OST_VEG_DEPTH || veg->included == MOST_INCLUDES)
        return OST_RAISE_LINE(reader, "files include files more than %d deep, or more than %d in all",
                              (int)OST_VEG_DEPTH, (int)MOST_INCLUDES);
    veg->included++;
    ost_file_beside(reader->path, name, path);
    return enter(veg, path);
}

static int is_include(const OstLineReader *reader)
{
    const size_t length = sizeof include_keyword - 1;
    return strncmp(reader->text, include_keyword, length) == 0 && strchr(" \t", reader->text[length]);
}

OstStatus ost_veg_next(OstVeg *veg, int *found)
{
    for (;;) {
        OstLineReader *reader = ost_veg_reader(veg);
        OST_TRY(ost_lines_next(reader, found));
        if (*found && is_include(reader)) {
            reader->next = reader->text + sizeof include_keyword - 1;
            OST_TRY(include(veg));
        } else if (*found || veg->depth == 1) {
            return OST_SUCCESS;
        } else {
            ost_lines_close(reader);
            veg->depth--;
        }
    }
}

int ost_veg_reads(OstContext *ctx, const char *path, const char *sought)
{
    OstVeg veg;
    int more = ost_veg_open(ctx, path, &veg) == OST_SUCCESS;
    if (more)
        veg.met = lies_at(&veg.reader[0], sought);
    veg.sought = sought;
    while (more && !veg.met)
        more = ost_veg_next(&veg, &more) == OST_SUCCESS && more;
    ost_veg_close(&veg);
    return veg.met;
}

OstStatus ost_veg_expect(OstVeg *veg, const char *what)
{
    int found = 0;
    OST_TRY(ost_veg_next(veg, &found));
    OstLineReader *reader = ost_veg_reader(veg);
    if (!found)
        return OST_RAISE_LINE(reader, "the file ends where %s expected", what);
    if (reader->text[0] == '*')
        return OST_RAISE_LINE(reader, "'%.40s' found where %s expected", reader->text, what);
    return OST_SUCCESS;
}

OstStatus ost_veg_name(OstVeg *veg, const char *what, char name[OST_VEG_NAME_SIZE])
{
    OstLineReader *reader = ost_veg_reader(veg);
    size_t length = 0;
    for (; *reader->next; reader->next++) {
        if (*reader->next == ' ' || *reader->next == '\t')
            continue;
        if (*reader->next == ',')
            return OST_RAISE_LINE(reader, "the name of %s holds a comma; *REGION could not name it", what);
        if (length == OST_VEG_NAME_SIZE - 1)
            return OST_RAISE_LINE(reader, "the name of %s has more than %d characters", what, OST_VEG_NAME_SIZE - 1);
        name[length++] = *reader->next;
    }
    name[length] = '\0';
    return length > 0 ? OST_SUCCESS : OST_RAISE_LINE(reader, "%s without a name", what);
}
