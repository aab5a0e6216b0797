/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_OUTPUT_PATH_FILES_H
#define ORTHOSTAT_OUTPUT_PATH_FILES_H

#include "orthostat/path.h"
#include "problem/scene_data.h"

#include <stddef.h>
#include <stdio.h>

/* The files of a path stand beside each other: for bar.vtkhdf, bar_0001.vtkhdf and so on, one for each step;
 * bar.hdf.series, which lists them with their times (of bar.vtu and bar.pvtu: bar.pvd); bar_history.csv; and
 * bar.checkpoint. */
typedef enum { OST_PATH_SERIES, OST_PATH_HISTORY, OST_PATH_CHECKPOINT, OST_PATH_FILES } OstPathFile;

/* Local. Their names, by the name of the case's output file. Steps count from 1. */
void ost_path_file_name(const char *output, OstPathFile which, size_t size, char *name);
void ost_path_step_name(const char *output, int step, size_t size, char *name);

/* Local; rank 0 writes. The steps done: as a list of files for ParaView, and as a table with the case's quantities of
 * interest, which are the steps' first notes. Both are replaced when complete. */
OstStatus ost_path_write_series(OstContext *ctx, OstPath *path, const char *output);
OstStatus ost_path_write_history(const OstScene *scene, OstPath *path, const char *output);

/* Local; only rank 0 prints. The steps done, as a table. */
void ost_path_print(const OstScene *scene, OstPath *path, const char *output);

/* Local. The same as a list of objects; the caller's reference, NULL if jansson fails. */
struct json_t;
struct json_t *ost_path_json(const OstScene *scene, OstPath *path);

#endif
