/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/msh_cursor.h"

#include "core/error.h"

#include <ctype.h>
#include <errno.h>
#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { WORD_SIZE = 64, MESSAGE_SIZE = 1024 };

OstStatus ost_msh_raise(const OstMshCursor *cursor, const char *file, int line, const char *format, ...)
{
    char text[MESSAGE_SIZE];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (char *c = text; *c; c++)
        if ((unsigned char)*c < ' ')
            *c = '?';
    if (cursor->binary)
        return ost_error_set(cursor->ctx, OST_INVALID_INPUT, file, line, "%s, near byte %ld: %s", cursor->path,
                             ftell(cursor->file), text);
    return ost_error_set(cursor->ctx, OST_INVALID_INPUT, file, line, "%s:%" PRId64 ": %s", cursor->path, cursor->line,
                         text);
}

static OstStatus raise_ended(const OstMshCursor *cursor, const char *what)
{
    return OST_RAISE_MSH(cursor, "the file ends where %s is expected; it is incomplete, write it again", what);
}

OstStatus ost_msh_line(OstMshCursor *cursor, char line[OST_MSH_LINE_SIZE], int *found)
{
    size_t length = 0;
    int c = getc_unlocked(cursor->file);
    *found = c != EOF;
    cursor->line = cursor->line_ends + 1;
    for (; c != EOF && c != '\n'; c = getc_unlocked(cursor->file)) {
        if (c == '\0' || length + 1 == OST_MSH_LINE_SIZE)
            return OST_RAISE_MSH(cursor, "expected a line of text of less than %d characters", OST_MSH_LINE_SIZE);
        line[length++] = (char)c;
    }
    cursor->line_ends += c == '\n';
    while (length > 0 && isspace((unsigned char)line[length - 1]))
        length--;
    line[length] = '\0';
    return OST_SUCCESS;
}

/* The next word of text. The blank behind it is left where it is, so that a line can be read up to its end. */
static OstStatus read_word(OstMshCursor *cursor, const char *what, char word[WORD_SIZE])
{
    size_t length = 0;
    int c = getc_unlocked(cursor->file);
    while (c != EOF && isspace(c)) {
        cursor->line_ends += c == '\n';
        c = getc_unlocked(cursor->file);
    }
    cursor->line = cursor->line_ends + 1;
    for (; c != EOF && !isspace(c); c = getc_unlocked(cursor->file)) {
        word[length++] = (char)c;
        if (length == WORD_SIZE)
            break;
    }
    if (length == WORD_SIZE) {
        word[WORD_SIZE - 1] = '\0';
        return OST_RAISE_MSH(cursor, "'%s...' found, expected %s", word, what);
    }
    word[length] = '\0';
    if (c != EOF)
        ungetc(c, cursor->file);
    return length == 0 ? raise_ended(cursor, what) : OST_SUCCESS;
}

static OstStatus read_text_integer(OstMshCursor *cursor, const char *what, OstGlobal smallest, OstGlobal largest,
                                   OstGlobal *value)
{
    char word[WORD_SIZE];
    char *end = NULL;
    OST_TRY(read_word(cursor, what, word));
    errno = 0;
    *value = strtoll(word, &end, 10);
    if (*end != '\0' || errno != 0 || *value < smallest || *value > largest)
        return OST_RAISE_MSH(cursor, "'%s' found, expected %s", word, what);
    return OST_SUCCESS;
}

static OstStatus read_bytes(OstMshCursor *cursor, const char *what, size_t size, void *value)
{
    unsigned char bytes[8];
    if (fread(bytes, 1, size, cursor->file) != size)
        return raise_ended(cursor, what);
    for (size_t i = 0; i < size; i++)
        ((unsigned char *)value)[i] = bytes[cursor->swapped ? size - 1 - i : i];
    return OST_SUCCESS;
}

OstStatus ost_msh_int(OstMshCursor *cursor, const char *what, int *value)
{
    OstGlobal number = 0;
    if (cursor->binary)
        return read_bytes(cursor, what, sizeof *value, value);
    OST_TRY(read_text_integer(cursor, what, INT_MIN, INT_MAX, &number));
    *value = (int)number;
    return OST_SUCCESS;
}

OstStatus ost_msh_size(OstMshCursor *cursor, const char *what, OstGlobal *value)
{
    if (!cursor->binary)
        return read_text_integer(cursor, what, 0, INT64_MAX, value);
    OST_TRY(read_bytes(cursor, what, sizeof *value, value));
    if (*value < 0)
        return OST_RAISE_MSH(cursor, "%" PRIu64 " found, expected %s", (uint64_t)*value, what);
    return OST_SUCCESS;
}

OstStatus ost_msh_double(OstMshCursor *cursor, const char *what, double *value)
{
    char word[WORD_SIZE];
    if (cursor->binary) {
        OST_TRY(read_bytes(cursor, what, sizeof *value, value));
        snprintf(word, sizeof word, "%g", *value);
    } else {
        char *end = NULL;
        OST_TRY(read_word(cursor, what, word));
        *value = strtod(word, &end);
        if (*end != '\0')
            return OST_RAISE_MSH(cursor, "'%s' found, expected %s", word, what);
    }
    if (!isfinite(*value))
        return OST_RAISE_MSH(cursor, "'%s' found, expected %s that is finite", word, what);
    return OST_SUCCESS;
}

OstStatus ost_msh_count(const OstMshCursor *cursor, const char *what, OstGlobal count, OstGlobal bytes_each)
{
    if (count < 0 || count > cursor->bytes / bytes_each)
        return OST_RAISE_MSH(cursor, "%" PRId64 " %s stated, which do not fit into a file of %" PRId64 " bytes", count,
                             what, cursor->bytes);
    return OST_SUCCESS;
}

OstStatus ost_msh_count_line(OstMshCursor *cursor, const char *what, OstGlobal bytes_each, int *count)
{
    char line[OST_MSH_LINE_SIZE] = "";
    char *end = NULL;
    int found = 0;
    OST_TRY(ost_msh_line(cursor, line, &found));
    if (!found)
        return raise_ended(cursor, what);
    errno = 0;
    const long number = strtol(line, &end, 10);
    if (end == line || *end != '\0' || errno != 0 || number < 0 || number > INT_MAX)
        return OST_RAISE_MSH(cursor, "'%.60s' found, expected the number of %s", line, what);
    *count = (int)number;
    return ost_msh_count(cursor, what, *count, bytes_each);
}
