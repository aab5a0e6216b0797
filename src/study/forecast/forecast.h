/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_FORECAST_FORECAST_H
#define ORTHOSTAT_STUDY_FORECAST_FORECAST_H

#include "case/plan.h"
#include "study/forecast/rates.h"

/* What a run will take, foretold from the plan alone. The work of each stage is counted in a unit of its own: bytes
 * that go through memory, or operations; rates.h has the seconds of a unit. */
typedef struct OstForecast {
    double iterations; /* of the linear solver; of one linear solve */
    double work[OST_STAGES];
    double seconds[OST_STAGES];
    double start;          /* seconds until the program and MPI run */
    double in_all;         /* seconds */
    double newton;         /* seconds of an iteration of Newton's method; 0: large rotations are off */
    double newton_in_all;  /* of the least iterations, where large rotations are on; they are in in_all */
    double bytes;          /* at the peak, of our arrays, over all ranks */
    double with_libraries; /* the same and the processes themselves */
} OstForecast;

/* Local. A run of the case `c`, of which `plan` is the plan, on so many ranks, each with a core of its own. */
void ost_forecast_make(const OstCase *c, const OstPlan *plan, const OstRates *rates, int ranks, OstForecast *forecast);

/* Local. Iterations of the linear solver for an error of the equations as the case asks for; and the work of the stages
 * if it takes so many. */
double ost_forecast_iterations(const OstPlan *plan);
void ost_forecast_work(const OstCase *c, const OstPlan *plan, double iterations, double work[OST_STAGES]);

#endif
