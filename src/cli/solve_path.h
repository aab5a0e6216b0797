/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_SOLVE_PATH_H
#define ORTHOSTAT_CLI_SOLVE_PATH_H

#include "orthostat/path.h"
#include "problem/scene_data.h"

/* Collective. Can all files of the case's path be written beside `output`? Raises as ost_check_outputs does. */
OstStatus ost_cli_check_path_outputs(const OstCase *c, const char *output);

/* Collective. Takes the steps of the case's path, from its checkpoint if `resumes`; writes fields, history and
 * checkpoint after each. `result` is that of the last step, also where that one failed; the caller destroys both. */
OstStatus ost_cli_solve_path(const OstScene *scene, const char *output, int resumes, OstPath **path,
                             OstResult **result);

#endif
