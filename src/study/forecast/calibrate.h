/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_FORECAST_CALIBRATE_H
#define ORTHOSTAT_STUDY_FORECAST_CALIBRATE_H

#include "study/forecast/forecast.h"

/* Measures what this machine can do: runs small and large bodies, thin and solid, of linear and quadratic tets, and
 * takes from them the seconds of a unit of work of each stage. Further bodies only show how well that foretells. */

enum { OST_CALIBRATION_RUNS = 14 };

typedef struct OstCalibrationRun {
    const char *name;
    int order;
    int counts; /* are the rates taken from it? */
    OstForecast foretold;
    OstGlobal unknowns;
    double iterations, seconds, bytes; /* taken; seconds without the program's start */
    double stage[OST_STAGES];
} OstCalibrationRun;

typedef struct OstCalibration {
    OstRates rates;
    int count;
    OstCalibrationRun run[OST_CALIBRATION_RUNS];
} OstCalibration;

/* Collective. Takes less than a minute on an idle machine. `version` is the program's. */
OstStatus ost_calibrate(OstContext *ctx, const char *version, OstCalibration *calibration);

/* Local; rank 0 prints: of each run what was foretold over what it took. */
void ost_calibration_print(const OstContext *ctx, const OstCalibration *calibration);

/* Local; rank 0 writes the same as JSON to a file, or to standard output for "-". */
OstStatus ost_calibration_write_json(OstContext *ctx, const OstCalibration *calibration, const char *path);

#endif
