/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_MSH_CURSOR_H
#define ORTHOSTAT_FORMATS_MSH_CURSOR_H

#include "orthostat/context.h"

#include <stdio.h>

enum { OST_MSH_LINE_SIZE = 250 }; /* Gmsh reads lines into 256 characters, and takes the rest for the next line */

/* Walks over the numbers of a .msh file, whether they are written as text or as bytes. */
typedef struct OstMshCursor {
    OstContext *ctx;
    const char *path;
    FILE *file;
    OstGlobal bytes;     /* of the file */
    OstGlobal line_ends; /* passed so far; not counted in binary sections */
    OstGlobal line;      /* of what was read last, from 1 */
    int binary;
    int swapped; /* bytes are in the other order than this machine's */
} OstMshCursor;

/* Local. Next line without its end; *found is 0 at the end of the file. Longer lines than a buffer are refused. */
OstStatus ost_msh_line(OstMshCursor *cursor, char line[OST_MSH_LINE_SIZE], int *found);

/* Local. Next number, of the type that the format names int, size_t and double; `what` names it in messages. */
OstStatus ost_msh_int(OstMshCursor *cursor, const char *what, int *value);
OstStatus ost_msh_size(OstMshCursor *cursor, const char *what, OstGlobal *value);
OstStatus ost_msh_double(OstMshCursor *cursor, const char *what, double *value);

/* Local. The next line, which must hold one whole number as text and nothing else, even in a binary file. It counts
 * things that take at least so many bytes each. */
OstStatus ost_msh_count_line(OstMshCursor *cursor, const char *what, OstGlobal bytes_each, int *count);

/* Local. Refuses a count of things that take at least so many bytes each and so cannot be in the file. */
OstStatus ost_msh_count(const OstMshCursor *cursor, const char *what, OstGlobal count, OstGlobal bytes_each);

/* Local. Raises OST_INVALID_INPUT, the text after the place in the file. */
OstStatus ost_msh_raise(const OstMshCursor *cursor, const char *file, int line, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
#define OST_RAISE_MSH(cursor, ...) ost_msh_raise((cursor), __FILE__, __LINE__, __VA_ARGS__)

#endif
