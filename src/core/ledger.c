/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/context.h"

void ost_ledger_name(OstContext *ctx, OstAccount account, const char *label)
{
    ctx->label[account] = label;
}

const char *ost_ledger_label(const OstContext *ctx, OstAccount account)
{
    return ctx->label[account] ? ctx->label[account] : "an effect";
}

void ost_ledger_open(OstContext *ctx)
{
#define OST_LEDGER_ROW(name, label) ost_ledger_name(ctx, name, label);
    OST_LEDGER_TABLE(OST_LEDGER_ROW)
#undef OST_LEDGER_ROW
    ctx->stack[0] = OST_LEDGER_OTHER;
    ctx->ledger[OST_LEDGER_OTHER].entries = 1;
    ctx->clock = ost_seconds();
}

static void bring_clock_up_to_date(OstContext *ctx)
{
    const double now = ost_seconds();
    ctx->ledger[ctx->stack[ctx->depth]].seconds += now - ctx->clock;
    ctx->clock = now;
}

void ost_ledger_enter(OstContext *ctx, OstAccount account)
{
    const OstAccount around = ctx->stack[ctx->depth];
    const OstAccount booked = around >= OST_LEDGER_PHASES && account < OST_LEDGER_PHASES ? around : account;
    bring_clock_up_to_date(ctx);
    if (ctx->depth + 1 < OST_LEDGER_DEPTH)
        ctx->depth++;
    ctx->stack[ctx->depth] = booked;
    ctx->ledger[booked].entries += booked != around;
}

void ost_ledger_leave(OstContext *ctx)
{
    bring_clock_up_to_date(ctx);
    if (ctx->depth > 0)
        ctx->depth--;
}

void ost_ledger_multiplied(OstContext *ctx, double entries)
{
    ctx->ledger[ctx->stack[ctx->depth]].multiplied += entries;
}

OstLedgerEntry ost_ledger_entry(OstContext *ctx, OstAccount account)
{
    bring_clock_up_to_date(ctx);
    return ctx->ledger[account];
}

size_t ost_ledger_bytes(const OstContext *ctx)
{
    return ctx->bytes;
}

size_t ost_ledger_peak_bytes(const OstContext *ctx)
{
    return ctx->peak_bytes;
}

void ost_ledger_restart_peak(OstContext *ctx)
{
    for (int a = 0; a < OST_LEDGER_ACCOUNTS; a++)
        ctx->ledger[a].peak_bytes = ctx->ledger[a].bytes;
    ctx->peak_bytes = ctx->bytes;
}

void ost_ledger_book(OstContext *ctx, OstAccount account, size_t bytes, int freed)
{
    OstLedgerEntry *entry = &ctx->ledger[account];
    if (freed) {
        entry->bytes -= bytes;
        ctx->bytes -= bytes;
        return;
    }
    entry->bytes += bytes;
    ctx->bytes += bytes;
    if (entry->bytes > entry->peak_bytes)
        entry->peak_bytes = entry->bytes;
    if (ctx->bytes > ctx->peak_bytes)
        ctx->peak_bytes = ctx->bytes;
}
