/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_MSH_CURSOR_H
#define ORTHOSTAT_FORMATS_MSH_CURSOR_H

#include "orthostat/context.h"

/* A .msh file in memory, and the position in it from which numbers are read, as text or binary. */
typedef struct OstMshCursor {
    OstContext *ctx;
    const char *path;
    char *bytes;       /* of the file, unpacked; a zero follows the last */
    const char *end;   /* one past the last byte */
    const char *next;  /* what is read next */
    const char *place; /* start of what was read last, for messages */
    int binary;
    int swapped; /* byte order differs from this machine's */
} OstMshCursor;

/* Local. Reads a file, packed by gzip or not, into memory; raises OST_FILE_FAILED or OST_INVALID_INPUT. */
OstStatus ost_msh_open(OstContext *ctx, const char *path, OstMshCursor *cursor);
void ost_msh_close(OstMshCursor *cursor);

/* Local. The next number, of the type that the format calls int, size_t and double; `what` is its name in messages.
 * Refused: an int of INT_MIN, a size_t above OST_LARGEST_LABEL. */
OstStatus ost_msh_int(OstMshCursor *cursor, const char *what, int *value);
OstStatus ost_msh_size(OstMshCursor *cursor, const char *what, OstGlobal *value);
OstStatus ost_msh_double(OstMshCursor *cursor, const char *what, double *value);
/* Local. A whole number that may be negative: 64 bits in a binary file. Refused beyond OST_LARGEST_LABEL in size. */
OstStatus ost_msh_long(OstMshCursor *cursor, const char *what, OstGlobal *value);
/* Local. The tag of a node or element, before version 4.1: an int in a binary file, of any size in a text. */
OstStatus ost_msh_tag(OstMshCursor *cursor, const char *what, OstGlobal *tag);
/* Local. Skips numbers, which need not be finite: Gmsh writes boxes of empty entities as infinite. */
OstStatus ost_msh_skip_doubles(OstMshCursor *cursor, const char *what, OstGlobal count);

/* Local. A count at the start of a line, which is text even in a binary file. */
OstStatus ost_msh_count_line(OstMshCursor *cursor, const char *what, OstGlobal *count);

/* Local. Refuses a count of items of at least `bytes_each` bytes if so many do not fit into the rest of the file. */
OstStatus ost_msh_check_count(const OstMshCursor *cursor, const char *what, OstGlobal count, OstGlobal bytes_each);

/* Local. The next number, a count that ost_msh_check_count accepts; `what` is counted. */
OstStatus ost_msh_count(OstMshCursor *cursor, const char *what, OstGlobal bytes_each, OstGlobal *count);

/* Local. The rest of the line without blanks at its ends; goes to the next line. */
typedef struct OstMshText {
    const char *start;
    int length;
} OstMshText;
OstMshText ost_msh_rest_of_line(OstMshCursor *cursor);

/* Local. Raises OST_INVALID_INPUT: the position in the file, then the text. */
OstStatus ost_msh_raise(const OstMshCursor *cursor, const char *file, int line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
#define OST_RAISE_MSH(cursor, ...) ost_msh_raise((cursor), __FILE__, __LINE__, __VA_ARGS__)

#endif
