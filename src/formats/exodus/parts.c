/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/exodus/parts.h"

#include "core/error.h"
#include "core/memory.h"

#include <ctype.h>
#include <dirent.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_PARTS = 100000, MOST_DIGITS = 6 };

/* The digits at the end of a text of `length`, after a dot: their number, or 0. */
static size_t count_digits(const char *text, size_t length)
{
    size_t digits = 0;
    while (digits < length && isdigit((unsigned char)text[length - 1 - digits]))
        digits++;
    return digits > 0 && digits <= MOST_DIGITS && digits < length && text[length - 1 - digits] == '.' ? digits : 0;
}

/* Takes x.e.4.0 apart: the length of x.e, and how many parts there are; 0: it is no such name. */
static size_t find_stem(const char *path, int *parts)
{
    const size_t length = strlen(path), last = count_digits(path, length);
    const size_t all = last > 0 ? count_digits(path, length - last - 1) : 0;
    if (all == 0)
        return 0;
    const size_t stem = length - last - all - 2;
    *parts = atoi(path + stem + 1);
    return *parts > 0 && *parts <= MOST_PARTS && atoi(path + length - last) < *parts ? stem : 0;
}

/* A part beside the whole that is not there: x.e.4.0, of the fewest parts if several runs wrote some. */
static int find_first(const char *whole, char path[PATH_MAX])
{
    const char *slash = strrchr(whole, '/'), *name = slash ? slash + 1 : whole;
    char folder[PATH_MAX] = ".";
    int fewest = INT_MAX, parts = 0;
    if (slash)
        snprintf(folder, sizeof folder, "%.*s", (int)(slash - whole) + (slash == whole), whole);
    DIR *open = opendir(folder);
    for (struct dirent *entry = open ? readdir(open) : NULL; entry; entry = readdir(open))
        if (strncmp(entry->d_name, name, strlen(name)) == 0 && find_stem(entry->d_name, &parts) == strlen(name) &&
            parts < fewest) {
            const int used = snprintf(path, PATH_MAX, "%.*s%s", (int)(name - whole), whole, entry->d_name);
            fewest = used > 0 && used < PATH_MAX ? parts : fewest;
        }
    if (open)
        closedir(open);
    return fewest < INT_MAX;
}

/* Numbers of parts have as many digits as the last of them, or no zeros before. */
static OstStatus add_part(OstContext *ctx, const char *any, size_t stem, int number, OstExodusParts *parts)
{
    char path[PATH_MAX], whole[32];
    snprintf(whole, sizeof whole, "%d", parts->count);
    const int digits = (int)strlen(whole), given = parts->count;
    for (int padded = digits; padded >= 1; padded--) {
        const int used = snprintf(path, sizeof path, "%.*s.%d.%0*d", (int)stem, any, given, padded, number);
        if (used > 0 && (size_t)used < sizeof path && access(path, F_OK) == 0)
            return ost_copy_string(ctx, path, &parts->path[number]);
    }
    return OST_RAISE(ctx, OST_INVALID_INPUT,
                     "%s: is missing; the mesh is in %d files of as many ranks, all of which are needed in one folder",
                     path, given);
}

OstStatus ost_exodus_parts_find(OstContext *ctx, const char *path, OstExodusParts *parts)
{
    char first[PATH_MAX];
    int count = 0;
    *parts = (OstExodusParts){0};
    size_t stem = find_stem(path, &count);
    if (stem == 0 && access(path, F_OK) != 0 && find_first(path, first)) {
        path = first;
        stem = find_stem(path, &count);
    }
    const int several = stem > 0;
    OST_TRY(OST_NEW(ctx, &parts->path, several ? count : 1));
    parts->count = several ? count : 1;
    for (int p = 0; p < count && several; p++)
        OST_TRY(add_part(ctx, path, stem, p, parts));
    return several ? OST_SUCCESS : ost_copy_string(ctx, path, &parts->path[0]);
}

void ost_exodus_parts_free(OstExodusParts *parts)
{
    OST_FREE_EACH(parts->count, parts->path);
}
