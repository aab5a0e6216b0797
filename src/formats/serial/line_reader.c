/* SPDX-License-Identifier: BSD-3-Clause */
#include "formats/serial/line_reader.h"

#include "core/error.h"
#include "core/memory.h"
#include "formats/serial/input_file.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_CAPACITY = 256, SHOWN_WORD = 40, PLACE_SIZE = 4200 };

static const char separators[] = " \t,";
static const char word_ends[] = " \t,:#";

/* Windows' editors put a mark of three bytes before a text in UTF-8. */
static void skip_mark(FILE *file)
{
    unsigned char mark[3] = {0};
    if (fread(mark, 1, sizeof mark, file) != sizeof mark || memcmp(mark, "\xEF\xBB\xBF", sizeof mark) != 0)
        rewind(file);
}

OstStatus ost_lines_open(OstContext *ctx, const char *path, OstLineReader *reader)
{
    *reader = (OstLineReader){.ctx = ctx};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_file_open(ctx, path, &reader->file, &reader->bytes));
    skip_mark(reader->file);
    OST_TRY_DONE(ost_copy_string(ctx, path, &reader->path));
    OST_TRY_DONE(OST_NEW(ctx, &reader->text, FIRST_CAPACITY));
    reader->capacity = FIRST_CAPACITY;
    reader->next = reader->text;
done:
    if (status != OST_SUCCESS)
        ost_lines_close(reader);
    return status;
}

void ost_lines_close(OstLineReader *reader)
{
    if (reader->file)
        fclose(reader->file);
    reader->file = NULL;
    OST_FREE(reader->path, reader->text);
}

OstStatus ost_lines_raise(const OstLineReader *reader, const char *file, int line, const char *format, ...)
{
    char place[PLACE_SIZE];
    va_list arguments;
    snprintf(place, sizeof place, "%s:%" PRId64, reader->path, reader->line);
    va_start(arguments, format);
    const OstStatus status = ost_file_raise(reader->ctx, file, line, place, format, arguments);
    va_end(arguments);
    return status;
}

/* Reads a line; *found is 0 at the end of the file. */
static OstStatus read_line(OstLineReader *reader, int *found)
{
    size_t length = 0;
    int c = getc_unlocked(reader->file);
    *found = c != EOF;
    reader->line += c != EOF;
    for (; c != EOF && c != '\n'; c = getc_unlocked(reader->file)) {
        if (c == '\0')
            return OST_RAISE_LINE(reader, "holds a zero byte: not a text file");
        if (length + 1 == reader->capacity) {
            OST_TRY(OST_RESIZE(reader->ctx, &reader->text, 2 * reader->capacity));
            reader->capacity *= 2;
        }
        reader->text[length++] = (char)c;
    }
    if (ferror(reader->file))
        return OST_RAISE(reader->ctx, OST_FILE_FAILED, "%s: reading failed after line %" PRId64 ": %s", reader->path,
                         reader->line, strerror(errno));
    while (length > 0 && strchr(" \t\r", reader->text[length - 1]))
        length--;
    reader->text[length] = '\0';
    reader->next = reader->text;
    return OST_SUCCESS;
}

static const char *skip_separators(OstLineReader *reader)
{
    reader->next += strspn(reader->next, separators);
    return reader->next;
}

int ost_lines_ended(OstLineReader *reader)
{
    const char next = *skip_separators(reader);
    return next == '\0' || next == '#';
}

int ost_lines_field(OstLineReader *reader)
{
    reader->next += strspn(reader->next, " \t");
    reader->next += *reader->next == ',';
    reader->next += strspn(reader->next, " \t");
    return !strchr(",#", *reader->next); /* nor the end */
}

OstStatus ost_lines_next(OstLineReader *reader, int *found)
{
    do {
        OST_TRY(read_line(reader, found));
    } while (*found && ost_lines_ended(reader));
    reader->next = reader->text;
    return OST_SUCCESS;
}

int ost_lines_take(OstLineReader *reader, char character)
{
    if (*skip_separators(reader) != character)
        return 0;
    reader->next++;
    return 1;
}

static OstStatus raise_not_a_number(OstLineReader *reader, const char *what, const char *kind)
{
    if (ost_lines_ended(reader))
        return OST_RAISE_LINE(reader, "the line ends where %s is expected", what);
    char word[SHOWN_WORD];
    ost_lines_word(reader, word, sizeof word);
    return OST_RAISE_LINE(reader, "%s is '%s', expected %s", what, word, kind);
}

OstStatus ost_lines_integer(OstLineReader *reader, const char *what, OstGlobal *value)
{
    const char *start = skip_separators(reader);
    char *end = NULL;
    errno = 0;
    const long long number = strtoll(start, &end, 10);
    if (end == start || !strchr(word_ends, *end) || errno != 0)
        return raise_not_a_number(reader, what, "a whole number");
    reader->next = end;
    *value = number;
    return OST_SUCCESS;
}

/* The exponent's letter becomes one that strtod knows. */
static double strtod_of_fortran(char *text, const char *start, char **end)
{
    text[*end - text] = 'e';
    return strtod(start, end);
}

OstStatus ost_lines_number(OstLineReader *reader, const char *what, double *value)
{
    const char *start = skip_separators(reader);
    char *end = NULL;
    double number = strtod(start, &end);
    if (end > start && (*end == 'D' || *end == 'd')) /* Fortran's 1.5D+3: the line is the reader's own */
        number = strtod_of_fortran(reader->text, start, &end);
    if (end == start || !strchr(word_ends, *end))
        return raise_not_a_number(reader, what, "a number");
    if (!isfinite(number))
        return raise_not_a_number(reader, what, "a finite number");
    reader->next = end;
    *value = number;
    return OST_SUCCESS;
}

OstStatus ost_lines_finish(OstLineReader *reader, const char *what)
{
    if (ost_lines_ended(reader))
        return OST_SUCCESS;
    return OST_RAISE_LINE(reader, "'%.*s' follows %s, expected the end of the line", (int)SHOWN_WORD, reader->next,
                          what);
}

void ost_lines_word(OstLineReader *reader, char *word, size_t size)
{
    const char *start = skip_separators(reader);
    const size_t length = strcspn(start, separators);
    const size_t kept = length < size ? length : size - 1;
    memcpy(word, start, kept);
    word[kept] = '\0';
    reader->next = start + length;
}
