/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_STUDY_FORECAST_SHOW_H
#define ORTHOSTAT_STUDY_FORECAST_SHOW_H

#include "problem/scene_data.h"

/* Collective. Tells those who wait (core/progress.h) how long the scene's case will take on this machine, or how long
 * load cases that are solved at the same time. */
OstStatus ost_forecast_show(const OstScene *scene);

#endif
