/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_OUTPUT_SERIES_H
#define ORTHOSTAT_OUTPUT_SERIES_H

#include "orthostat/context.h"

/* A file of fields, and its place in time. */
typedef struct OstSeriesFile {
    const char *name; /* with its folder, which is the list's */
    double time;
} OstSeriesFile;

/* Local. Writes a list of files for ParaView: .pvd for .vtu and .pvtu, else .hdf.series. */
OstStatus ost_series_write(OstContext *ctx, const char *list, int count, const OstSeriesFile *files);

#endif
