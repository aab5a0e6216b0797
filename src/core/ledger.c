/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/context.h"
#include "core/progress.h"

#include <string.h>

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
    if (booked != around)
        ost_progress_phase(ctx, ost_ledger_label(ctx, booked));
}

void ost_ledger_leave(OstContext *ctx)
{
    bring_clock_up_to_date(ctx);
    if (ctx->depth > 0)
        ctx->depth--;
}

void ost_ledger_forget_work(OstContext *ctx)
{
    for (int a = 0; a < OST_LEDGER_ACCOUNTS; a++)
        ctx->ledger[a].work = (OstWork){0};
    memset(ctx->level_work, 0, sizeof ctx->level_work);
}

/* Adds to the innermost account and, if that is the solve, to the level: checks use multigrid, too. */
static void book_work(OstContext *ctx, const OstWork *more)
{
    const OstAccount account = ctx->stack[ctx->depth];
    const int level = account == OST_LEDGER_SOLVE ? ctx->work_level : 0;
    OstWork *const to[] = {&ctx->ledger[account].work, &ctx->level_work[level]};
    for (int i = 0; i < 2; i++) {
        to[i]->multiplied += more->multiplied;
        to[i]->exchanges += more->exchanges;
        to[i]->messages += more->messages;
        to[i]->bytes += more->bytes;
        to[i]->reductions += more->reductions;
        to[i]->gathers += more->gathers;
        to[i]->gathered += more->gathered;
        to[i]->visits += more->visits;
    }
}

void ost_ledger_multiplied(OstContext *ctx, double entries)
{
    book_work(ctx, &(OstWork){.multiplied = entries});
}

void ost_ledger_sent(OstContext *ctx, int messages, double bytes)
{
    book_work(ctx, &(OstWork){.exchanges = 1.0, .messages = messages, .bytes = bytes});
}

void ost_ledger_reduced(OstContext *ctx, int times)
{
    book_work(ctx, &(OstWork){.reductions = times});
}

void ost_ledger_gathered(OstContext *ctx, double bytes)
{
    book_work(ctx, &(OstWork){.gathers = 1.0, .gathered = bytes});
}

void ost_ledger_visited(OstContext *ctx)
{
    book_work(ctx, &(OstWork){.visits = 1.0});
}

void ost_ledger_level(OstContext *ctx, int level)
{
    ctx->work_level = level >= 0 && level < OST_LEDGER_LEVELS ? 1 + level : 0;
}

OstWork ost_ledger_level_work(const OstContext *ctx, int level)
{
    return ctx->level_work[1 + level];
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
