/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STEPS_FILE_H
#define ORTHOSTAT_STEPS_FILE_H

#include "orthostat/context.h"

OST_API_BEGIN

/* One file for several results on one mesh, as of load cases: ParaView (from 5.12) and VTK (from 9.3) read it as steps
 * in time. It gets its name when it is finished. */
typedef struct OstStepsFile OstStepsFile;

/* Collective. A file of at most so many steps; `path` ends with .vtkhdf. ost_result_write_step (orthostat/result.h)
 * writes them. */
OstStatus ost_steps_file_create(OstContext *ctx, const char *path, int most, OstStepsFile **file);

/* Collective. Finishes the file, if it has a step; after a failed step there is none. The pointer is nulled. */
OstStatus ost_steps_file_finish(OstStepsFile **file);

OST_API_END

#endif
