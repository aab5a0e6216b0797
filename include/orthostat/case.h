/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_H
#define ORTHOSTAT_CASE_H

#include "orthostat/output_field.h"
#include "orthostat/solver.h"

OST_API_BEGIN

/* A case as its YAML states it: physics only. Files that a case reads (mesh, axes, .bou lists) are named relative to
 * the case file's folder; the file it writes, relative to the directory the program is called in. */
typedef struct OstCase OstCase;

/* Collective. Reads and checks a case file (rank 0 reads the file, every rank parses). Raises OST_FILE_FAILED if there
 * is none, OST_INVALID_INPUT as "path:line:column: what was found, what was expected, what to do" (unknown keys with
 * the nearest known one). Nothing of the mesh is looked at. */
OstStatus ost_case_read(OstContext *ctx, const char *path, OstCase **out);

/* Collective. The same, with changes "KEY=VALUE" made to it first, as by the option --set of the program
 * (docs/commands.md). The path "-" is standard input; files it names are then relative to the current folder. */
OstStatus ost_case_read_with(OstContext *ctx, const char *path, int count, const char *const *settings, OstCase **out);

/* Collective. The same for the text of a case, which every rank passes alike: UTF-8 that ends with a zero byte. `path`
 * stands in messages, and files that the case names are relative to its folder; there need be no such file. */
OstStatus ost_case_parse(OstContext *ctx, const char *path, const char *text, OstCase **out);

/* Collective. The same, changed as by ost_case_read_with. */
OstStatus ost_case_parse_with(OstContext *ctx, const char *path, const char *text, int count,
                              const char *const *settings, OstCase **out);

/* Collective. The same for one run of a sweep over the keys of the settings: raises OST_INVALID_USAGE where one of them
 * changes what another one sets. */
OstStatus ost_case_read_swept(OstContext *ctx, const char *path, int count, const char *const *settings, OstCase **out);
OstStatus ost_case_parse_swept(OstContext *ctx, const char *path, const char *text, int count,
                               const char *const *settings, OstCase **out);

void ost_case_destroy(OstCase **c);

/* Local. The load cases (`cases`): how many, 0 if there are none; and one of them by number from 0, which is a case of
 * its own, with what is stated for all, and lives as long as the case. */
int ost_case_load_case_count(const OstCase *c);
const OstCase *ost_case_load_case(const OstCase *c, int number);
const char *ost_case_load_case_name(const OstCase *c, int number);

/* Local. What stands in the case; texts live as long as it does. */
const char *ost_case_path(const OstCase *c);
const char *ost_case_title(const OstCase *c);
const char *ost_case_output_file(const OstCase *c); /* NULL: the case names none */
unsigned ost_case_output_fields(const OstCase *c);  /* bits of OstOutputFieldBit: 1 << OST_FIELD_STRESS */
const OstSolverOptions *ost_case_solver_options(const OstCase *c);
int ost_case_watch_count(const OstCase *c); /* quantities of interest (orthostat/watch.h) */
int ost_case_has_path(const OstCase *c);    /* a path of load steps (orthostat/path.h) */
int ost_case_asks_error(const OstCase *c);  /* an accuracy is asked for (orthostat/adaption.h) */

OST_API_END

#endif
