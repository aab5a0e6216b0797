/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CORE_JSON_FILE_H
#define ORTHOSTAT_CORE_JSON_FILE_H

#include "orthostat/context.h"

#include <jansson.h>

/* Local. A number, or null for one that is not finite, which JSON cannot write. */
json_t *ost_json_number(double number);

/* Local. A text, less what is left of its last character where a buffer has cut that: JSON wants whole ones. */
json_t *ost_json_text(const char *text);

/* Local. The warnings so far (ost_warning) as a list of strings. */
json_t *ost_json_warnings(const OstContext *ctx);

/* Local. Writes the document as core/write_aside.h does, or to standard output for "-", and releases the caller's
 * reference to it. Raises OST_FILE_FAILED with the system's reason. */
OstStatus ost_json_write(OstContext *ctx, json_t *document, const char *path);

#endif
