/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/msh/cursor.h"

#include "core/error.h"
#include "core/memory.h"
#include "formats/serial/input_file.h"
#include "mesh/mesh_data.h"

#include <inttypes.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

/* gzip packs meshes to a fifth, regular ones to a twentieth. A damaged file may claim a thousandth. */
enum {
    LARGEST_RATIO = 50,
    FIRST_ROOM = 1 << 16,
    LARGEST_PIECE = 1 << 30,
    WORD_SHOWN = 60,
    PLACE_SIZE = 4200,
    LONGEST_FORMAT = 512
};

static OstStatus raise_unpacking(const OstMshCursor *cursor, gzFile file)
{
    int error = 0;
    const char *text = gzerror(file, &error);
    return OST_RAISE(cursor->ctx, error == Z_ERRNO ? OST_FILE_FAILED : OST_INVALID_INPUT,
                     "%s: could not be read to its end: %s; write or copy it again", cursor->path, text);
}

/* zlib passes uncompressed files through. */
static OstStatus read_all(OstMshCursor *cursor, gzFile file, size_t packed)
{
    size_t room = packed + FIRST_ROOM, length = 0;
    int piece = 0;
    gzbuffer(file, FIRST_ROOM);
    OST_TRY(OST_NEW(cursor->ctx, &cursor->bytes, room));
    do {
        if (length + 1 >= room)
            OST_TRY(OST_RESIZE(cursor->ctx, &cursor->bytes, room *= 2));
        const size_t wanted = room - 1 - length;
        piece = gzread(file, cursor->bytes + length, wanted > LARGEST_PIECE ? LARGEST_PIECE : (unsigned)wanted);
        length += piece > 0 ? (size_t)piece : 0;
        if (length > FIRST_ROOM && length / LARGEST_RATIO > packed)
            return OST_RAISE(cursor->ctx, OST_INVALID_INPUT,
                             "%s: unpacks to more than %d times its size, as no mesh does; if it is one, unpack it "
                             "with gunzip",
                             cursor->path, LARGEST_RATIO);
    } while (piece > 0);
    cursor->end = cursor->bytes + length;
    int error = 0;
    gzerror(file, &error);
    return piece < 0 || error != Z_OK ? raise_unpacking(cursor, file) : OST_SUCCESS;
}

OstStatus ost_msh_open(OstContext *ctx, const char *path, OstMshCursor *cursor)
{
    FILE *plain = NULL;
    OstGlobal packed = 0;
    *cursor = (OstMshCursor){.ctx = ctx, .path = path};
    OST_TRY(ost_file_open(ctx, path, &plain, &packed));
    gzFile file = gzdopen(dup(fileno(plain)), "rb");
    OstStatus status = file ? read_all(cursor, file, (size_t)packed)
                            : OST_RAISE(ctx, OST_FILE_FAILED, "%s: zlib could not open it", path);
    if (file)
        gzclose(file);
    fclose(plain);
    cursor->next = cursor->place = cursor->bytes;
    if (status == OST_SUCCESS && cursor->end - cursor->bytes >= 3 && memcmp(cursor->bytes, "\xEF\xBB\xBF", 3) == 0)
        cursor->next += 3; /* the mark that Windows' editors put before a text */
    if (status != OST_SUCCESS)
        ost_msh_close(cursor);
    return status;
}

void ost_msh_close(OstMshCursor *cursor)
{
    OST_FREE(cursor->bytes);
    *cursor = (OstMshCursor){0};
}

/* A text that was cut off ends without a line end; some messages say so themselves. */
static int is_cut_off(const OstMshCursor *cursor, const char *message)
{
    return !cursor->binary && cursor->end > cursor->bytes && cursor->end[-1] != '\n' &&
           !memchr(cursor->place, '\n', (size_t)(cursor->end - cursor->place)) && !strstr(message, "the file ends");
}

OstStatus ost_msh_raise(const OstMshCursor *cursor, const char *file, int line, const char *format, ...)
{
    char place[PLACE_SIZE], longer[LONGEST_FORMAT];
    OstGlobal lines = 1;
    va_list arguments;
    for (const char *c = cursor->bytes; c < cursor->place; c++)
        lines += *c == '\n';
    if (cursor->binary)
        snprintf(place, sizeof place, "%s, near byte %td", cursor->path, cursor->place - cursor->bytes);
    else
        snprintf(place, sizeof place, "%s:%" PRId64, cursor->path, lines);
    snprintf(longer, sizeof longer, "%s; the file ends in this line: is it complete?", format);
    va_start(arguments, format);
    const OstStatus status =
        ost_file_raise(cursor->ctx, file, line, place, is_cut_off(cursor, format) ? longer : format, arguments);
    va_end(arguments);
    return status;
}

static int is_blank(char c)
{
    return c == ' ' || (c >= '\t' && c <= '\r');
}

static OstStatus raise_word(const OstMshCursor *cursor, const char *what)
{
    int length = 0;
    if (cursor->place == cursor->end)
        return OST_RAISE_MSH(cursor, "the file ends where %s is expected; it is incomplete, write it again", what);
    while (cursor->place + length < cursor->end && length < WORD_SHOWN && !is_blank(cursor->place[length]))
        length++;
    return OST_RAISE_MSH(cursor, "'%.*s' found, expected %s", length, cursor->place, what);
}

static void skip_blanks(OstMshCursor *cursor)
{
    while (cursor->next < cursor->end && is_blank(*cursor->next))
        cursor->next++;
    cursor->place = cursor->next;
}

static int word_ends(const OstMshCursor *cursor, const char *at)
{
    return at == cursor->end || is_blank(*at);
}

/* Reads digits until the number exceeds the largest label; the zero byte after the file ends the last one. */
static OstStatus read_text_integer(OstMshCursor *cursor, const char *what, OstGlobal smallest, OstGlobal largest,
                                   OstGlobal *value)
{
    skip_blanks(cursor);
    const char *c = cursor->next;
    const int negative = *c == '-';
    c += negative || *c == '+';
    const char *digits = c;
    OstGlobal number = 0;
    for (; *c >= '0' && *c <= '9' && number <= OST_LARGEST_LABEL / 10; c++)
        number = 10 * number + (*c - '0');
    *value = negative ? -number : number;
    if (c == digits || !word_ends(cursor, c) || *value < smallest || *value > largest)
        return raise_word(cursor, what);
    cursor->next = c;
    return OST_SUCCESS;
}

static OstStatus read_bytes(OstMshCursor *cursor, const char *what, size_t size, void *value)
{
    cursor->place = cursor->next;
    if ((size_t)(cursor->end - cursor->next) < size) {
        cursor->place = cursor->end;
        return raise_word(cursor, what);
    }
    for (size_t i = 0; i < size; i++)
        ((char *)value)[i] = cursor->next[cursor->swapped ? size - 1 - i : i];
    cursor->next += size;
    return OST_SUCCESS;
}

OstStatus ost_msh_int(OstMshCursor *cursor, const char *what, int *value)
{
    OstGlobal number = 0;
    if (!cursor->binary)
        OST_TRY(read_text_integer(cursor, what, -INT_MAX, INT_MAX, &number));
    *value = (int)number;
    if (cursor->binary)
        OST_TRY(read_bytes(cursor, what, sizeof *value, value));
    if (*value == INT_MIN)
        return OST_RAISE_MSH(cursor, "%d found, expected %s", *value, what);
    return OST_SUCCESS;
}

OstStatus ost_msh_size(OstMshCursor *cursor, const char *what, OstGlobal *value)
{
    if (!cursor->binary)
        return read_text_integer(cursor, what, 0, OST_LARGEST_LABEL, value);
    OST_TRY(read_bytes(cursor, what, sizeof *value, value));
    if (*value < 0 || *value > OST_LARGEST_LABEL)
        return OST_RAISE_MSH(cursor, "%" PRIu64 " found, expected %s", (uint64_t)*value, what);
    return OST_SUCCESS;
}

OstStatus ost_msh_long(OstMshCursor *cursor, const char *what, OstGlobal *value)
{
    if (!cursor->binary)
        return read_text_integer(cursor, what, -OST_LARGEST_LABEL, OST_LARGEST_LABEL, value);
    OST_TRY(read_bytes(cursor, what, sizeof *value, value));
    if (*value < -OST_LARGEST_LABEL || *value > OST_LARGEST_LABEL)
        return OST_RAISE_MSH(cursor, "%" PRId64 " found, expected %s", *value, what);
    return OST_SUCCESS;
}

OstStatus ost_msh_tag(OstMshCursor *cursor, const char *what, OstGlobal *tag)
{
    int number = 0;
    if (!cursor->binary)
        return ost_msh_long(cursor, what, tag);
    OST_TRY(ost_msh_int(cursor, what, &number));
    *tag = number;
    return OST_SUCCESS;
}

static OstStatus read_double(OstMshCursor *cursor, const char *what, double *value)
{
    char *end = NULL;
    if (cursor->binary)
        return read_bytes(cursor, what, sizeof *value, value);
    skip_blanks(cursor);
    *value = strtod(cursor->next, &end);
    if (end == cursor->next || !word_ends(cursor, end))
        return raise_word(cursor, what);
    cursor->next = end;
    return OST_SUCCESS;
}

OstStatus ost_msh_double(OstMshCursor *cursor, const char *what, double *value)
{
    OST_TRY(read_double(cursor, what, value));
    if (!isfinite(*value))
        return OST_RAISE_MSH(cursor, "%g found, expected %s that is finite", *value, what);
    return OST_SUCCESS;
}

OstStatus ost_msh_skip_doubles(OstMshCursor *cursor, const char *what, OstGlobal count)
{
    double value = 0.0;
    for (OstGlobal i = 0; i < count; i++)
        OST_TRY(read_double(cursor, what, &value));
    return OST_SUCCESS;
}

OstStatus ost_msh_check_count(const OstMshCursor *cursor, const char *what, OstGlobal count, OstGlobal bytes_each)
{
    const OstGlobal left = cursor->end - cursor->next;
    if (count > left / bytes_each)
        return OST_RAISE_MSH(cursor, "%" PRId64 " %s stated, which do not fit into the %" PRId64 " bytes left", count,
                             what, left);
    return OST_SUCCESS;
}

OstStatus ost_msh_count(OstMshCursor *cursor, const char *what, OstGlobal bytes_each, OstGlobal *count)
{
    char message[64];
    snprintf(message, sizeof message, "the number of %s", what);
    OST_TRY(ost_msh_size(cursor, message, count));
    return ost_msh_check_count(cursor, what, *count, bytes_each);
}

OstStatus ost_msh_count_line(OstMshCursor *cursor, const char *what, OstGlobal *count)
{
    const int binary = cursor->binary;
    OstMshCursor line = *cursor;
    OstMshText text = ost_msh_rest_of_line(&line);
    OstStatus status = OST_SUCCESS;
    cursor->binary = 0;
    if (text.length > 0)
        status = read_text_integer(cursor, what, 0, INT_MAX, count);
    else
        status = OST_RAISE_MSH(&line, "'' found, expected %s", what);
    cursor->next = line.next;
    cursor->binary = binary;
    return status;
}

OstMshText ost_msh_rest_of_line(OstMshCursor *cursor)
{
    const size_t left = (size_t)(cursor->end - cursor->next);
    const char *line_end = memchr(cursor->next, '\n', left);
    const char *start = cursor->next, *end = line_end ? line_end : cursor->end;
    cursor->next = line_end ? line_end + 1 : cursor->end;
    while (start < end && is_blank(*start))
        start++;
    while (end > start && is_blank(end[-1]))
        end--;
    cursor->place = start;
    return (OstMshText){start, end - start > INT_MAX ? INT_MAX : (int)(end - start)};
}
