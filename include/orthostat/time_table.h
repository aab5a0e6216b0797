/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TIME_TABLE_H
#define ORTHOSTAT_TIME_TABLE_H

#include "orthostat/status.h"

OST_API_BEGIN

/* A factor as a function of the pseudo-time t: linear between points of strictly ascending time, and constant before
 * the first and after the last. Without points the factor is t itself. */
typedef struct OstTimeTable {
    int count;
    double *time, *factor;
} OstTimeTable;

/* Local. The factor at t. A path that begins with a factor other than 0 is led there from nothing: from t = -1 to 0 the
 * factor grows from 0 to that at t = 0. */
double ost_time_factor(const OstTimeTable *table, double t);

/* Local. Are both the same points? */
int ost_time_tables_agree(const OstTimeTable *one, const OstTimeTable *other);

OST_API_END

#endif
