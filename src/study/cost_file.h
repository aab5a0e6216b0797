/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_COST_FILE_H
#define ORTHOSTAT_STUDY_COST_FILE_H

#include "study/cost.h"

#include <stdio.h>

/* Local; rank 0 writes, the others return. Writes a study with `write` to a file beside `path` that is renamed when it
 * is whole, or to standard output for "-". Raises OST_FILE_FAILED with the system's reason. */
OstStatus ost_cost_write_file(const OstCost *cost, const char *path, OstStatus (*write)(FILE *, const OstCost *));

#endif
