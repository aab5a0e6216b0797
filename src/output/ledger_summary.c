/* SPDX-License-Identifier: BSD-3-Clause */
#include "output/summary.h"

#include "core/error.h"

#include <stdio.h>
#include <sys/resource.h>

static double peak_process_bytes(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? 1024.0 * (double)usage.ru_maxrss : 0.0;
}

OstStatus ost_ledger_summarise(OstContext *ctx, OstLedgerSummary *summary)
{
    double seconds[OST_LEDGER_COUNT];
    double bytes[OST_LEDGER_COUNT + 2];
    for (int a = 0; a < OST_LEDGER_COUNT; a++) {
        const OstLedgerEntry entry = ost_ledger_entry(ctx, (OstAccount)a);
        seconds[a] = entry.seconds;
        bytes[a] = (double)entry.peak_bytes;
        summary->entries[a] = entry.entries;
    }
    bytes[OST_LEDGER_COUNT] = (double)ost_ledger_peak_bytes(ctx);
    bytes[OST_LEDGER_COUNT + 1] = peak_process_bytes();
    double total = 0.0;
    for (int a = 0; a < OST_LEDGER_COUNT; a++)
        total += seconds[a];
    MPI_Comm comm = ost_comm(ctx);
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(seconds, summary->seconds, OST_LEDGER_COUNT, MPI_DOUBLE, MPI_MAX, comm)));
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(&total, &summary->total_seconds, 1, MPI_DOUBLE, MPI_MAX, comm)));
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, summary->entries, OST_LEDGER_COUNT, MPI_LONG, MPI_MAX, comm)));
    double all_bytes[OST_LEDGER_COUNT + 2];
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(bytes, all_bytes, OST_LEDGER_COUNT + 2, MPI_DOUBLE, MPI_SUM, comm)));
    for (int a = 0; a < OST_LEDGER_COUNT; a++)
        summary->peak_bytes[a] = all_bytes[a];
    summary->peak_tracked_bytes = all_bytes[OST_LEDGER_COUNT];
    summary->peak_process_bytes = all_bytes[OST_LEDGER_COUNT + 1];
    return OST_SUCCESS;
}

static const double mebibyte = 1048576.0;

static void print_account(const OstLedgerSummary *summary, int account, const char *label, int on)
{
    if (!on)
        printf("  %-20s        off\n", label);
    else
        printf("  %-20s %8.3f s %9.2f MiB\n", label, summary->seconds[account],
               summary->peak_bytes[account] / mebibyte);
}

void ost_ledger_print(const OstScene *scene, const OstLedgerSummary *summary)
{
    if (ost_rank(scene->ctx) != 0)
        return;
    static const struct {
        const char *label;
        OstAccount account;
    } effects[OST_PLAN_COUNT] = {
#define OST_EFFECT_ROW(name, label, account) {label, account},
        OST_EFFECT_TABLE(OST_EFFECT_ROW)
#undef OST_EFFECT_ROW
    };
    printf("\nledger (seconds of the slowest rank, memory of all at its peak)\n");
    for (int a = 0; a < OST_LEDGER_COUNT; a++)
        if (!ost_account_is_effect((OstAccount)a) && summary->entries[a] > 0)
            print_account(summary, a, ost_account_label((OstAccount)a), 1);
    printf(" effects\n");
    for (int e = 0; e < OST_PLAN_COUNT; e++)
        print_account(summary, effects[e].account, effects[e].label, scene->plan.effect[e].on);
    printf("  %-20s %8.3f s %9.2f MiB   (processes: %.0f MiB)\n", "total", summary->total_seconds,
           summary->peak_tracked_bytes / mebibyte, summary->peak_process_bytes / mebibyte);
}
