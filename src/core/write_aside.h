/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_WRITE_ASIDE_H
#define ORTHOSTAT_CORE_WRITE_ASIDE_H

#include "orthostat/context.h"

#include <stdio.h>

/* Replaces a file atomically: writes a temporary file with a unique name in the same folder and renames it once it is
 * complete. On failure the old file stays. A symbolic link is followed, and its target replaced. Start from {0}. */
typedef struct OstAside {
    char *path;  /* the file to replace, symbolic links resolved */
    char *aside; /* the temporary file: it exists and is empty */
} OstAside;

/* Local. Raises OST_FILE_FAILED with the reason if the folder is not writable, or if `path` exists and is not a regular
 * file. */
OstStatus ost_aside_open(OstContext *ctx, const char *path, OstAside *aside);

/* Collective. Rank 0 does the same; every rank gets the names. */
OstStatus ost_aside_open_together(OstContext *ctx, const char *path, OstAside *aside);

/* Local. Renames the closed temporary file if `written` is OST_SUCCESS, and otherwise removes it. Returns `written`, or
 * raises OST_FILE_FAILED if it cannot be renamed. Does nothing after a failed ost_aside_open. */
OstStatus ost_aside_finish(OstContext *ctx, OstAside *aside, OstStatus written);

/* Collective. Rank 0 does the same; `written` is the same on every rank. */
OstStatus ost_aside_finish_together(OstContext *ctx, OstAside *aside, OstStatus written);

/* Collective. Is there room on disk for this many bytes (as rank 0 gives them)? Asks the file system to reserve them,
 * which respects quotas and limits too; then empties the file again, or leaves them reserved, so that no other program
 * takes them while the file is written. A file system that cannot reserve space is trusted. Raises OST_FILE_FAILED. */
OstStatus ost_aside_reserve(OstContext *ctx, const OstAside *aside, OstGlobal bytes, int empties);

/* Local. Opens, writes by `write` and finishes a file; "-" is standard output. */
OstStatus ost_write_aside(OstContext *ctx, const char *path, OstStatus (*write)(FILE *file, const void *content),
                          const void *content);

/* Local. Cells of a CSV file: a text in quotes, in which quotes are doubled; a number after a comma, of which only the
 * comma is left if it is not finite. */
void ost_csv_text(FILE *file, const char *text);
void ost_csv_number(FILE *file, double number);

/* Local. The file behind any symbolic links of `path`, which need not exist. The caller frees it. */
OstStatus ost_follow_links(OstContext *ctx, const char *path, char **target);

#endif
