/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_FORECAST_METER_H
#define ORTHOSTAT_STUDY_FORECAST_METER_H

#include "effect/effect.h"

/* What one run of a study costs: the seconds of the slowest rank, as a whole and by account of the ledger, and the
 * bytes of our own arrays at their peak, over all ranks. */
typedef struct OstMeter {
    double seconds;
    double account[OST_EFFECT_END];
    double bytes;
} OstMeter;

/* Collective. Starts the meter: all ranks at once. */
OstStatus ost_meter_start(OstContext *ctx, OstMeter *meter);

/* Collective. Turns what was read at the start into what was spent since. */
OstStatus ost_meter_read(OstContext *ctx, OstMeter *meter);

#endif
