/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_OUTPUT_FIELDS_FILE_H
#define ORTHOSTAT_OUTPUT_FIELDS_FILE_H

#include "formats/serial/output_array.h"

/* Collective. Writes arrays on a mesh to a file of the form that its name's ending says; raises OST_INVALID_USAGE for
 * another ending. `mark` is NULL for an answer. */
OstStatus ost_fields_write(const OstMesh *mesh, const char *path, int count, const OstOutputArray *arrays,
                           const OstOutputMark *mark);

#endif
