/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_DESTINATION_H
#define ORTHOSTAT_CLI_DESTINATION_H

#include "orthostat/case.h"

enum { OST_LONGEST_PATH = 4096 };

/* Local. Where the fields of a case go: `asked` (--output, or NULL), the case's output file, or the case's name with
 * .vtkhdf for its ending, in the current folder. Raises if the name does not end with .vtkhdf or is too long. */
OstStatus ost_choose_output(const OstCase *c, const char *asked, char path[OST_LONGEST_PATH]);

/* Collective; rank 0 looks. Can the fields be written to `output` and the summary to `json` (NULL, or "-" for standard
 * output)? Each must be a regular file or a new one, in a folder that can be written to, no file that the case reads,
 * and not the other. Raises naming what is in the way. */
OstStatus ost_check_destinations(const OstCase *c, const char *output, const char *json);

/* Collective; rank 0 looks. Can a report be written to each path (NULL: there is none; "-": standard output)? They are
 * bound as above, and all differ. */
OstStatus ost_check_reports(const OstCase *c, int count, const char *const *paths);

#endif
