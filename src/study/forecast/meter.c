/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/forecast/meter.h"

#include "core/error.h"
#include "core/parallel/reduce.h"

OstStatus ost_meter_start(OstContext *ctx, OstMeter *meter)
{
    OST_TRY(OST_MPI(ctx, MPI_Barrier(ost_comm(ctx))));
    for (int a = 0; a < OST_EFFECT_END; a++)
        meter->account[a] = ost_ledger_entry(ctx, a).seconds;
    ost_ledger_restart_peak(ctx);
    meter->bytes = (double)ost_ledger_bytes(ctx);
    meter->seconds = ost_seconds();
    return OST_SUCCESS;
}

OstStatus ost_meter_read(OstContext *ctx, OstMeter *meter)
{
    meter->seconds = ost_seconds() - meter->seconds;
    meter->bytes = (double)ost_ledger_peak_bytes(ctx) - meter->bytes;
    for (int a = 0; a < OST_EFFECT_END; a++)
        meter->account[a] = ost_ledger_entry(ctx, a).seconds - meter->account[a];
    OST_TRY(ost_max(ctx, 1, &meter->seconds));
    OST_TRY(ost_max(ctx, OST_EFFECT_END, meter->account));
    return ost_sum(ctx, 1, &meter->bytes);
}
