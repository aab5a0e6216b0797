/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_MSH_CURSOR_H
#define ORTHOSTAT_FORMATS_MSH_CURSOR_H

#include "orthostat/context.h"

/* A .msh file in memory, and a place in it from which numbers are read, whether they are text or bytes. */
typedef struct OstMshCursor {
    OstContext *ctx;
    const char *path;
    char *bytes;       /* of the file, unpacked; a zero follows the last */
    const char *end;   /* behind the last byte */
    const char *next;  /* what is read next */
    const char *place; /* where what was read last begins, for messages */
    int binary;
    int swapped; /* bytes are in the other order than this machine's */
} OstMshCursor;

/* Local. Reads a file, packed by gzip or not, into memory; raises OST_FILE_FAILED or OST_INVALID_INPUT. */
OstStatus ost_msh_open(OstContext *ctx, const char *path, OstMshCursor *cursor);
void ost_msh_close(OstMshCursor *cursor);

/* Local. The next number, of the type that the format names int, size_t and double; `what` names it in messages. An
 * int is more than INT_MIN, a size_t at most OST_LARGEST_LABEL. */
OstStatus ost_msh_int(OstMshCursor *cursor, const char *what, int *value);
OstStatus ost_msh_size(OstMshCursor *cursor, const char *what, OstGlobal *value);
OstStatus ost_msh_double(OstMshCursor *cursor, const char *what, double *value);
OstStatus ost_msh_skip_doubles(OstMshCursor *cursor, const char *what, OstGlobal count);

/* Local. A line that begins with a count, as text even in a binary file. */
OstStatus ost_msh_count_line(OstMshCursor *cursor, const char *what, OstGlobal *count);

/* Local. Refuses a count of things that take at least so many bytes each and so cannot be in the rest of the file. */
OstStatus ost_msh_check_count(const OstMshCursor *cursor, const char *what, OstGlobal count, OstGlobal bytes_each);

/* Local. The rest of the line without blanks at its ends; goes to the next line. */
typedef struct OstMshText {
    const char *start;
    int length;
} OstMshText;
OstMshText ost_msh_rest_of_line(OstMshCursor *cursor);

/* Local. Raises OST_INVALID_INPUT, the text after the place in the file. */
OstStatus ost_msh_raise(const OstMshCursor *cursor, const char *file, int line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
#define OST_RAISE_MSH(cursor, ...) ost_msh_raise((cursor), __FILE__, __LINE__, __VA_ARGS__)

#endif
