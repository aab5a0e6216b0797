/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/serial/input_file.h"

#include "core/error.h"

#include <errno.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

enum { MESSAGE_SIZE = 2048 };

OstStatus ost_file_open(OstContext *ctx, const char *path, FILE **file, OstGlobal *bytes)
{
    struct stat facts;
    *file = NULL;
    if (stat(path, &facts) != 0)
        return OST_RAISE(ctx, OST_FILE_FAILED, "%s: cannot be read: %s", path, strerror(errno));
    if (!S_ISREG(facts.st_mode))
        return OST_RAISE(ctx, OST_FILE_FAILED, "%s: is %s, expected a file", path,
                         S_ISDIR(facts.st_mode) ? "a folder" : "no regular file");
    if (facts.st_size == 0)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: is empty; write it again", path);
    *file = fopen(path, "rb");
    if (!*file)
        return OST_RAISE(ctx, OST_FILE_FAILED, "%s: cannot be opened: %s", path, strerror(errno));
    *bytes = (OstGlobal)facts.st_size;
    return OST_SUCCESS;
}

void ost_file_beside(const char *path, const char *name, char beside[PATH_MAX])
{
    const char *slash = strrchr(path, '/');
    if (name[0] == '/' || !slash)
        snprintf(beside, PATH_MAX, "%s", name);
    else
        snprintf(beside, PATH_MAX, "%.*s/%s", (int)(slash - path), path, name);
}

int ost_has_ending(const char *path, const char *ending)
{
    const size_t length = strlen(path), tail = strlen(ending);
    return length > tail && strcasecmp(path + length - tail, ending) == 0;
}

OstStatus ost_file_raise(OstContext *ctx, const char *file, int line, const char *place, const char *format,
                         va_list arguments)
{
    char text[MESSAGE_SIZE];
    vsnprintf(text, sizeof text, format, arguments);
    for (char *c = text; *c; c++)
        if ((unsigned char)*c < ' ')
            *c = '?';
    return ost_error_set(ctx, OST_INVALID_INPUT, file, line, "%s: %s", place, text);
}
