/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_JSON_FILE_H
#define ORTHOSTAT_STUDY_JSON_FILE_H

#include "orthostat/context.h"

#include <jansson.h>

/* Local. Writes the document aside and renames it to `path`; - is standard output. Raises OST_FILE_FAILED with the
 * system's reason. */
OstStatus ost_json_file_write(OstContext *ctx, const json_t *document, const char *path);

#endif
