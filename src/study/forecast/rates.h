/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_FORECAST_RATES_H
#define ORTHOSTAT_STUDY_FORECAST_RATES_H

#include "study/forecast/stage.h"

enum { OST_MACHINE_SIZE = 128, OST_VERSION_SIZE = 32 };

/* Seconds of a unit of a stage's work (forecast.h), in runs whose arrays take few bytes or many: a processor's caches
 * hold the former. */
typedef struct OstRate {
    double small, large;
} OstRate;

/* What a machine can do: measured by `orthostat cost --calibrate`, or typical. Plain data. */
typedef struct OstRates {
    int typical; /* nothing was measured: rates of the machine on which docs/performance.md was made */
    char machine[OST_MACHINE_SIZE];
    char version[OST_VERSION_SIZE]; /* of the program */
    char day[16];                   /* 2026-11-22 */
    int cores;
    double start;                          /* seconds until the program and MPI run */
    double process_bytes;                  /* of a process with its libraries, before it has arrays */
    double small_bytes[2], large_bytes[2]; /* of the runs measured, by order */
    OstRate stage[2][OST_STAGES];          /* by order less 1 */
} OstRates;

/* Local. The rates that come with the program. */
OstRates ost_rates_typical(void);

/* Local. This machine: its name, its cores, the version of the program; nothing measured. */
OstRates ost_rates_of_here(const char *version);

/* Local. The seconds of a unit of work in a run of so many bytes a rank. */
double ost_rate_at(const OstRates *rates, int order, OstStage stage, double bytes);

/* Local. The file in the user's cache folder: $XDG_CACHE_HOME/orthostat/rates.json, or ~/.cache/orthostat/rates.json.
 * Returns 0 if neither XDG_CACHE_HOME nor HOME is set. */
int ost_rates_path(char *path, size_t size);

/* Collective. Reads the file; without one, or where it cannot be read (then with a warning), the typical rates. */
OstStatus ost_rates_load(OstContext *ctx, OstRates *rates);

/* Local; rank 0 writes. Makes the folder if need be. */
OstStatus ost_rates_save(OstContext *ctx, const OstRates *rates);

/* Local. Where the rates are from, in words: "typical of ..."; "measured here on ..."; "measured on another machine".
 */
void ost_rates_words(const OstRates *rates, const char *version, char *text, size_t size);

#endif
