/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_SERIAL_LINE_READER_H
#define ORTHOSTAT_FORMATS_SERIAL_LINE_READER_H

#include "orthostat/context.h"

#include <stdio.h>

/* Reads a text file line by line, numbers one by one, and says in every message where it stands. Numbers and words are
 * separated by blanks, tabs and commas. */
typedef struct OstLineReader {
    OstContext *ctx;
    char *path;
    FILE *file;
    OstGlobal bytes; /* of the file: nothing in it can be more than that */
    OstGlobal line;  /* number of the current line, from 1 */
    char *text;      /* the current line without its end */
    size_t capacity;
    const char *next; /* where in it the next word is looked for */
} OstLineReader;

/* Local. Opens a regular file for reading, and gives its size. */
OstStatus ost_file_open(OstContext *ctx, const char *path, FILE **file, OstGlobal *bytes);

/* Local. */
OstStatus ost_lines_open(OstContext *ctx, const char *path, OstLineReader *reader);
void ost_lines_close(OstLineReader *reader);

/* Local. Goes to the next line that is neither blank nor a comment (#); *found is 0 at the end of the file. */
OstStatus ost_lines_next(OstLineReader *reader, int *found);

/* Local. Has the line ended (but for a comment)? */
int ost_lines_ended(OstLineReader *reader);

/* Local. Takes the character if it is the next one, and says so. */
int ost_lines_take(OstLineReader *reader, char character);

/* Local. The next number of the line; `what` is its name in messages. */
OstStatus ost_lines_integer(OstLineReader *reader, const char *what, OstGlobal *value);
OstStatus ost_lines_number(OstLineReader *reader, const char *what, double *value);

/* Local. Raises if anything but a comment is left of the line; `what` is what the line is. */
OstStatus ost_lines_finish(OstLineReader *reader, const char *what);

/* Local. Takes the next word into `word`; an empty one at the end of the line. Longer words are cut. */
void ost_lines_word(OstLineReader *reader, char *word, size_t size);

/* Local. Raises OST_INVALID_INPUT, the text after file:line. */
OstStatus ost_lines_raise(const OstLineReader *reader, const char *file, int line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
#define OST_RAISE_LINE(reader, ...) ost_lines_raise((reader), __FILE__, __LINE__, __VA_ARGS__)

#endif
