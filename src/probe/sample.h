/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_PROBE_SAMPLE_H
#define ORTHOSTAT_PROBE_SAMPLE_H

#include "fields/stress_measure.h"
#include "probe/locate.h"
#include "problem/result_data.h"

/* The answer at a point. */
typedef struct OstSample {
    OstGlobal tet;                      /* label of the tet that holds it; 0: outside the body, and the rest is 0 */
    double displacement[3];             /* by the tet's shape functions */
    double stress[OST_STRESS_MEASURES]; /* of the tet's own stress at the point: not averaged with its neighbours' */
    double stress_error[OST_STRESS_MEASURES]; /* the exact values less these, as estimated; NAN: not known */
} OstSample;

/* Collective. The answer at `count` points, which all ranks pass alike; every rank gets all samples. */
OstStatus ost_sample_points(const OstResult *result, OstLocal count, const double *points, OstSample *samples);

#endif
