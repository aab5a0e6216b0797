/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_FORMATS_SERIAL_INPUT_FILE_H
#define ORTHOSTAT_FORMATS_SERIAL_INPUT_FILE_H

#include "orthostat/context.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>

/* What readers of serial formats share. */

/* Local. Opens a regular file for reading; fills its size. */
OstStatus ost_file_open(OstContext *ctx, const char *path, FILE **file, OstGlobal *bytes);

/* Local. The path of a file that another one names: relative to that one's folder. */
void ost_file_beside(const char *path, const char *name, char beside[PATH_MAX]);

/* Local. Does a path end in `ending`, in upper or lower case? */
int ost_has_ending(const char *path, const char *ending);

/* Local. Raises OST_INVALID_INPUT from a source file and line: the place, such as "mesh.msh:12", then the text, in
 * which control characters of the input become question marks. */
OstStatus ost_file_raise(OstContext *ctx, const char *file, int line, const char *place, const char *format,
                         va_list arguments) __attribute__((format(printf, 5, 0)));

#endif
