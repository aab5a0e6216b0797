/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_FORECAST_STAGE_H
#define ORTHOSTAT_STUDY_FORECAST_STAGE_H

#include "effect/effect.h"
#include "study/forecast/meter.h"

/* The stages of a run, by which its seconds are foretold and listed. Columns: name, label. */
#define OST_STAGE_TABLE(X)            \
    X(OST_STAGE_REST, "rest")         \
    X(OST_STAGE_MESH, "mesh")         \
    X(OST_STAGE_ASSEMBLY, "assembly") \
    X(OST_STAGE_SETUP, "setup")       \
    X(OST_STAGE_SOLVE, "solve")       \
    X(OST_STAGE_ESTIMATE, "estimate") \
    X(OST_STAGE_OUTPUT, "output")
#define OST_STAGE_ENUM(name, label) name,
typedef enum { OST_STAGE_TABLE(OST_STAGE_ENUM) OST_STAGES } OstStage;
#undef OST_STAGE_ENUM

extern const char *const ost_stage_label[]; /* by OstStage */

/* Local. Sums a meter's accounts by stage. */
void ost_stage_sum(const OstMeter *meter, double seconds[OST_STAGES]);

#endif
