/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "mesh/mesh_data.h"

#include <stdio.h>
#include <string.h>

void ost_names_clear(OstNames *names)
{
    OST_FREE_EACH(names->count, names->name);
    names->count = 0;
}

void ost_boundaries_destroy(int count, OstBoundary **boundaries)
{
    for (int b = 0; *boundaries && b < count; b++) {
        OST_FREE((*boundaries)[b].name, (*boundaries)[b].nodes);
    }
    OST_FREE(*boundaries);
}

int ost_names_find(const OstNames *names, const char *name)
{
    for (int i = 0; i < names->count; i++)
        if (strcmp(names->name[i], name) == 0)
            return i;
    return -1;
}

OstStatus ost_names_add(OstContext *ctx, OstNames *names, const char *text)
{
    OST_TRY(OST_RESIZE(ctx, &names->name, names->count + 1));
    OST_TRY(ost_copy_string(ctx, text, &names->name[names->count]));
    names->count++;
    return OST_SUCCESS;
}

OstStatus ost_names_add_unique(OstContext *ctx, OstNames *names, const char *text)
{
    char numbered[64];
    snprintf(numbered, sizeof numbered, "%s", text);
    for (int number = 2; ost_names_find(names, numbered) >= 0; number++)
        snprintf(numbered, sizeof numbered, "%.40s-%d", text, number);
    return ost_names_add(ctx, names, numbered);
}

/* Bytes of the UTF-8 character at the start of a text; 0 if there is none. */
static size_t utf8_length(const unsigned char *text)
{
    const size_t length = text[0] < 0x80                      ? 1
                          : text[0] >= 0xc2 && text[0] < 0xe0 ? 2
                          : text[0] >= 0xe0 && text[0] < 0xf0 ? 3
                          : text[0] >= 0xf0 && text[0] < 0xf5 ? 4
                                                              : 0;
    for (size_t i = 1; i < length; i++)
        if ((text[i] & 0xc0) != 0x80)
            return 0;
    const int low = text[1] < 0x90, is_long = (text[0] == 0xe0 && text[1] < 0xa0) || (text[0] == 0xf0 && low);
    const int is_none = (text[0] == 0xed && text[1] >= 0xa0) || (text[0] == 0xf4 && !low);
    return length > 2 && (is_long || is_none) ? 0 : length;
}

static int is_control(unsigned char letter)
{
    return letter < ' ' || letter == 0x7f;
}

int ost_name_is_plain(const char *name)
{
    const unsigned char *from = (const unsigned char *)name;
    for (size_t length; *from; from += length) {
        length = utf8_length(from);
        if (length == 0 || is_control(*from))
            return 0;
    }
    return 1;
}

OstStatus ost_name_plain(OstContext *ctx, char **name)
{
    const size_t size = strlen(*name);
    char *plain = NULL, *to;
    if (ost_name_is_plain(*name))
        return OST_SUCCESS;
    OST_TRY(OST_NEW(ctx, &plain, 2 * size + 1));
    to = plain;
    for (const unsigned char *from = (const unsigned char *)*name; *from;) {
        const size_t length = utf8_length(from);
        if (length == 0) {
            *to++ = (char)(0xc0 | *from >> 6);
            *to++ = (char)(0x80 | (*from++ & 0x3f));
            continue;
        }
        memcpy(to, from, length);
        *to = is_control(*from) ? ' ' : *to;
        to += length;
        from += length;
    }
    OST_FREE(*name);
    *name = plain;
    return OST_SUCCESS;
}

int ost_mesh_find_region(const OstMesh *mesh, const char *name)
{
    return ost_names_find(&mesh->regions, name);
}

int ost_mesh_find_boundary(const OstMesh *mesh, const char *name)
{
    for (int b = 0; b < mesh->boundary_count; b++)
        if (strcmp(mesh->boundaries[b].name, name) == 0)
            return b;
    return -1;
}

/* Appends a name to a list in `text`; what does not fit becomes dots. */
static void append(char *text, size_t size, const char *name)
{
    const size_t used = strlen(text);
    const int length = snprintf(text + used, size - used, "%s%s", used > 0 ? ", " : "", name);
    if (length >= 0 && (size_t)length >= size - used && size > 3)
        strcpy(text + size - 4, "...");
}

void ost_names_list(const OstNames *names, char *text, size_t size)
{
    if (size == 0)
        return;
    text[0] = '\0';
    for (int i = 0; i < names->count; i++)
        append(text, size, names->name[i]);
}

void ost_mesh_list_boundaries(const OstMesh *mesh, char *text, size_t size)
{
    if (size == 0)
        return;
    text[0] = '\0';
    for (int b = 0; b < mesh->boundary_count; b++)
        append(text, size, mesh->boundaries[b].name);
}
