/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/context.h"

static const struct {
    int is_effect;
    const char *label;
} account_table[OST_LEDGER_COUNT] = {
#define OST_LEDGER_ROW(name, is_effect, label) {is_effect, label},
    OST_LEDGER_TABLE(OST_LEDGER_ROW)
#undef OST_LEDGER_ROW
};

const char *ost_account_label(OstAccount account)
{
    return account_table[account].label;
}

int ost_account_is_effect(OstAccount account)
{
    return account_table[account].is_effect;
}

static void bring_clock_up_to_date(OstContext *ctx)
{
    const double now = ost_seconds();
    ctx->ledger[ctx->stack[ctx->depth]].seconds += now - ctx->clock;
    ctx->clock = now;
}

void ost_ledger_enter(OstContext *ctx, OstAccount account)
{
    bring_clock_up_to_date(ctx);
    if (ctx->depth + 1 < OST_LEDGER_DEPTH)
        ctx->depth++;
    ctx->stack[ctx->depth] = account;
    ctx->ledger[account].entries++;
}

void ost_ledger_leave(OstContext *ctx)
{
    bring_clock_up_to_date(ctx);
    if (ctx->depth > 0)
        ctx->depth--;
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
    for (int a = 0; a < OST_LEDGER_COUNT; a++)
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
