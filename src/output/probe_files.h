/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_OUTPUT_PROBE_FILES_H
#define ORTHOSTAT_OUTPUT_PROBE_FILES_H

#include "problem/result_data.h"
#include "problem/scene_data.h"

/* Local. The table of a probe stands beside the file of fields: bar_NAME.csv for bar.vtu, bar_0001_NAME.csv for the
 * step bar_0001.vtu. */
void ost_probe_file_name(const char *fields, const OstProbe *probe, size_t size, char *name);

/* Collective. Writes the tables of all probes of the case, as CSV: a row for each point, with empty cells for one that
 * is outside the body, of which it warns. */
OstStatus ost_probe_write(const OstScene *scene, const OstResult *result, const char *fields);

#endif
