/* SPDX-License-Identifier: BSD-3-Clause */
#include "orthostat/time_table.h"

#include <string.h>

static double look_up(const OstTimeTable *table, double t)
{
    const double *time = table->time;
    const double *factor = table->factor;
    int next = 0;
    while (next < table->count && time[next] <= t)
        next++;
    if (next == 0)
        return factor[0];
    if (next == table->count)
        return factor[next - 1];
    const double share = (t - time[next - 1]) / (time[next] - time[next - 1]);
    return (1.0 - share) * factor[next - 1] + share * factor[next];
}

double ost_time_factor(const OstTimeTable *table, double t)
{
    if (table->count == 0)
        return t > 0.0 ? t : 0.0;
    if (t >= 0.0)
        return look_up(table, t);
    return t > -1.0 ? (1.0 + t) * look_up(table, 0.0) : 0.0;
}

int ost_time_tables_agree(const OstTimeTable *one, const OstTimeTable *other)
{
    const size_t bytes = (size_t)one->count * sizeof(double);
    return one->count == other->count && (bytes == 0 || (memcmp(one->time, other->time, bytes) == 0 &&
                                                         memcmp(one->factor, other->factor, bytes) == 0));
}
