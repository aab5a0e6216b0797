/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_DESTINATION_H
#define ORTHOSTAT_CLI_DESTINATION_H

#include "case/case_data.h"

enum { OST_LONGEST_PATH = 4096 };

/* Local. Where the fields of a case go: `asked` (--output, or NULL), the case's output file, or the case's name with
 * .vtkhdf for its ending, in the current folder. Raises if the name has no ending of a file of fields,
 * or is too long. */
OstStatus ost_choose_output(const OstCase *c, const char *asked, char path[OST_LONGEST_PATH]);

/* Collective; rank 0 looks. Can a file be written to each path (NULL: none; "-": standard output)? Each must be
 * a regular file or a new one, in a folder that can be written to, no file that the case reads, and not the same as
 * another. Raises naming what is in the way. */
OstStatus ost_check_outputs(const OstCase *c, int count, const char *const *paths);

/* Collective. Can the tables of the case's probes be written beside the file `fields`, and the JSON (NULL: none)
 * elsewhere? Raises as ost_check_outputs does. */
OstStatus ost_check_probe_outputs(const OstCase *c, const char *fields, const char *json);

/* Collective. Can the files of all load cases of the case be written beside `output`? Raises likewise. */
OstStatus ost_check_case_outputs(const OstCase *c, const char *output);

/* Local. Are these one file, which is there? NULL is none. */
int ost_cli_is_same_file(const char *path, const char *other);

/* Local. Does "-", standard output, stand for the path? NULL does not. */
int ost_cli_is_stdout(const char *path);

#endif
