/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CASE_FILE_BYTES_H
#define ORTHOSTAT_CASE_FILE_BYTES_H

#include "orthostat/context.h"

/* Collective. The bytes of a file, read by rank 0 and broadcast; memory from the context. Raises OST_FILE_FAILED if it
 * cannot be read, OST_INVALID_INPUT if it has more than `most` bytes. */
OstStatus ost_read_file_bytes(OstContext *ctx, const char *path, size_t most, char **bytes, size_t *size);

#endif
