/* SPDX-License-Identifier: BSD-3-Clause */
#include "output/summary.h"

#include "core/error.h"
#include "core/parallel/reduce.h"

#include <stdio.h>
#include <sys/resource.h>

static double peak_process_bytes(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? 1024.0 * (double)usage.ru_maxrss : 0.0;
}

OstStatus ost_ledger_summarise(OstContext *ctx, OstLedgerSummary *summary)
{
    double seconds[OST_EFFECT_END];
    double bytes[OST_EFFECT_END + 2];
    for (int a = 0; a < OST_EFFECT_END; a++) {
        const OstLedgerEntry entry = ost_ledger_entry(ctx, a);
        seconds[a] = entry.seconds;
        bytes[a] = (double)entry.peak_bytes;
        summary->entries[a] = entry.entries;
        summary->multiplied[a] = entry.work.multiplied;
    }
    bytes[OST_EFFECT_END] = (double)ost_ledger_peak_bytes(ctx);
    bytes[OST_EFFECT_END + 1] = peak_process_bytes();
    OST_TRY(ost_sum(ctx, OST_EFFECT_END, summary->multiplied));
    double total = 0.0;
    for (int a = 0; a < OST_EFFECT_END; a++)
        total += seconds[a];
    MPI_Comm comm = ost_comm(ctx);
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(seconds, summary->seconds, OST_EFFECT_END, MPI_DOUBLE, MPI_MAX, comm)));
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(&total, &summary->total_seconds, 1, MPI_DOUBLE, MPI_MAX, comm)));
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, summary->entries, OST_EFFECT_END, MPI_LONG, MPI_MAX, comm)));
    double all_bytes[OST_EFFECT_END + 2];
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(bytes, all_bytes, OST_EFFECT_END + 2, MPI_DOUBLE, MPI_SUM, comm)));
    for (int a = 0; a < OST_EFFECT_END; a++)
        summary->peak_bytes[a] = all_bytes[a];
    summary->peak_tracked_bytes = all_bytes[OST_EFFECT_END];
    summary->peak_process_bytes = all_bytes[OST_EFFECT_END + 1];
    return OST_SUCCESS;
}

static const double mebibyte = 1048576.0;

static void print_account(const OstLedgerSummary *summary, OstAccount account, const char *label)
{
    printf("  %-23s %8.3f s %9.2f MiB\n", label, summary->seconds[account], summary->peak_bytes[account] / mebibyte);
}

void ost_ledger_print(const OstScene *scene, const OstLedgerSummary *summary)
{
    if (ost_rank(scene->ctx) != 0)
        return;
    printf("\nledger (seconds of the slowest rank, memory of all at its peak)\n");
    for (int a = 0; a < OST_LEDGER_PHASES; a++)
        if (summary->entries[a] > 0)
            print_account(summary, a, ost_ledger_label(scene->ctx, a));
    printf(" effects\n");
    for (int e = OST_EFFECT_FIRST; e < OST_EFFECT_END; e++)
        /* What was counted even if the effect is off, so that a contradiction shows. */
        if (ost_effect_on(&scene->plan.effects, (OstEffect)e) || summary->entries[e] > 0)
            print_account(summary, e, ost_effect_label((OstEffect)e));
        else
            printf("  %-23s        off\n", ost_effect_label((OstEffect)e));
    printf("  %-23s %8.3f s %9.2f MiB   (processes: %.0f MiB)\n", "total", summary->total_seconds,
           summary->peak_tracked_bytes / mebibyte, summary->peak_process_bytes / mebibyte);
}
