/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_WRITE_ASIDE_H
#define ORTHOSTAT_CORE_WRITE_ASIDE_H

#include "orthostat/context.h"

#include <stdio.h>

/* A file appears under its name only when it is whole: it is written under a name of its own in the same folder, which
 * no other run shares, and then renamed. On failure what was there stays. Where the name is a symbolic link, the file
 * that it points to is replaced. Start from {0}. */
typedef struct OstAside {
    char *path;  /* the file to replace: no link */
    char *aside; /* the file to write, which is there and empty */
} OstAside;

/* Local. Raises OST_FILE_FAILED, saying why, if the folder cannot be written to or `path` is there and no regular file.
 */
OstStatus ost_aside_open(OstContext *ctx, const char *path, OstAside *aside);

/* Collective. The same, done by rank 0; every rank learns the names. */
OstStatus ost_aside_open_together(OstContext *ctx, const char *path, OstAside *aside);

/* Local. Renames the closed file if `written` is OST_SUCCESS, else removes it; returns `written`, or why the file could
 * not be renamed. Does nothing where ost_aside_open failed. */
OstStatus ost_aside_finish(OstContext *ctx, OstAside *aside, OstStatus written);

/* Collective. The same, done by rank 0; `written` is the same on every rank. */
OstStatus ost_aside_finish_together(OstContext *ctx, OstAside *aside, OstStatus written);

/* Local. Writes a whole file aside by `write`; "-" is standard output. */
OstStatus ost_write_aside(OstContext *ctx, const char *path, OstStatus (*write)(FILE *file, const void *content),
                          const void *content);

/* Local. The file that `path` leads to through symbolic links, in memory that the caller frees; it need not exist. */
OstStatus ost_follow_links(OstContext *ctx, const char *path, char **target);

#endif
