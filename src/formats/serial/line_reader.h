/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_SERIAL_LINE_READER_H
#define ORTHOSTAT_FORMATS_SERIAL_LINE_READER_H

#include "orthostat/context.h"

#include <stdio.h>

/* Reads a text file line by line and number by number; its messages name file and line. Blanks, tabs and commas
 * separate numbers and words. */
typedef struct OstLineReader {
    OstContext *ctx;
    char *path;
    FILE *file;
    OstGlobal bytes; /* size of the file, which limits all counts in it */
    OstGlobal line;  /* number of the current line, from 1 */
    char *text;      /* the current line without its end */
    size_t capacity;
    const char *next; /* where in it the next word is sought */
} OstLineReader;

/* Local. */
OstStatus ost_lines_open(OstContext *ctx, const char *path, OstLineReader *reader);
void ost_lines_close(OstLineReader *reader);

/* Local. Goes to the next line that is neither blank nor a comment (#); *found is 0 at the end of the file. */
OstStatus ost_lines_next(OstLineReader *reader, int *found);

/* Local. Has the line ended (but for a comment)? */
int ost_lines_ended(OstLineReader *reader);

/* Local. Goes past the comma before the next field, if there is one. Is there something in the field? */
int ost_lines_field(OstLineReader *reader);

/* Local. Skips the character if it is the next one; returns whether it was. */
int ost_lines_take(OstLineReader *reader, char character);

/* Local. The next number of the line; `what` is its name in messages. */
OstStatus ost_lines_integer(OstLineReader *reader, const char *what, OstGlobal *value);
OstStatus ost_lines_number(OstLineReader *reader, const char *what, double *value);

/* Local. Raises if more than a comment is left of the line; `what` is what the line should hold. */
OstStatus ost_lines_finish(OstLineReader *reader, const char *what);

/* Local. Copies the next word into `word`: empty at the end of the line, truncated if too long. */
void ost_lines_word(OstLineReader *reader, char *word, size_t size);

/* Local. Raises OST_INVALID_INPUT as "file:line: text". */
OstStatus ost_lines_raise(const OstLineReader *reader, const char *file, int line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
#define OST_RAISE_LINE(reader, ...) ost_lines_raise((reader), __FILE__, __LINE__, __VA_ARGS__)

#endif
