/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/progress.h"

#include "core/context.h"
#include "core/interrupt/interrupt.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* The line on a terminal is redrawn at most this often; that of a log appears as often, both in seconds. A rate is
 * trusted after so many seconds, and so much of the work. */
static const double redraw = 0.1, log_again = 30.0, rate_known = 0.5, share_known = 0.02;

/* What is shown. The timer's handler reads it: the text is complete before `ready` is set. */
static struct {
    OstContext *ctx;
    int on_terminal, shown;
    volatile int ready;
    char text[160];
    double
        expected; /* seconds that the whole was foretold to take; 0: the text tells of the whole, or nothing is known */
    double start, drawn, logged;
} line;

/* Does standard error end at a terminal? mpirun stands between, so scripts/orthostat finds out before it starts that
 * and sets the variable. */
static int is_on_terminal(void)
{
    return isatty(STDERR_FILENO) || getenv("ORTHOSTAT_ON_TERMINAL") != NULL;
}

static void put(const char *text)
{
    const ssize_t written = write(STDERR_FILENO, text, strlen(text));
    (void)written;
}

/* "2 min 5 s", without stdio, which a handler may not use. */
static void append_number(char *text, long number)
{
    char digits[24];
    int count = 0;
    do
        digits[count++] = (char)('0' + number % 10);
    while ((number /= 10) > 0);
    char *end = text + strlen(text);
    while (count > 0)
        *end++ = digits[--count];
    *end = 0;
}

static void append_seconds(char *text, double seconds)
{
    long left = (long)(seconds + 0.5);
    if (left >= 3600) {
        append_number(text, left / 3600);
        strcat(text, " h ");
        left = left % 3600 / 60 * 60;
    }
    if (left >= 60) {
        append_number(text, left / 60);
        left = seconds < 600.0 ? left % 60 : 0;
        strcat(text, left > 0 ? " min " : " min");
    }
    if (left > 0 || seconds < 59.5) {
        append_number(text, left);
        strcat(text, " s");
    }
}

/* What was foretold to take less says nothing once it is over. */
static const double soon_over = 5.0;

/* By what was foretold of the whole. */
static void append_whole(char *text, double since)
{
    const double left = line.expected - since;
    if (!(line.expected > 0.0) || (left < 0.0 && line.expected < soon_over))
        return;
    if (left < 0.0) {
        strcat(text, "longer than the ");
        append_seconds(text, line.expected);
        strcat(text, " foretold");
    } else {
        append_number(text, (long)(100.0 * since / line.expected));
        strcat(text, " % of the whole, about ");
        append_seconds(text, left);
        strcat(text, " left");
    }
    strcat(text, " | ");
}

static void show(double now)
{
    char text[320] = "";
    const double since = now - line.start;
    if (!line.ready || !line.ctx || line.ctx->level == OST_LOG_QUIET)
        return;
    if (line.on_terminal ? now - line.drawn < redraw : now - line.logged < log_again)
        return;
    line.drawn = line.logged = now;
    strcat(text, line.on_terminal ? "\r\033[K" : "orthostat: after ");
    if (!line.on_terminal) {
        append_seconds(text, since);
        strcat(text, ": ");
    }
    append_whole(text, since);
    strcat(text, line.text);
    if (line.on_terminal && since >= 1.0) {
        strcat(text, " (");
        append_seconds(text, since);
        strcat(text, ")");
    }
    strcat(text, line.on_terminal ? "" : "\n");
    put(text);
    line.shown = line.on_terminal;
}

static void tick(void)
{
    show(ost_seconds());
}

void ost_progress_start(OstContext *ctx)
{
    if (ost_rank(ctx) != 0)
        return;
    line.ctx = ctx;
    line.on_terminal = is_on_terminal();
    line.start = line.logged = ost_seconds();
    ost_tick_every_second(tick);
}

void ost_progress_end(void)
{
    line.ready = 0;
    line.ctx = NULL;
}

/* How far one thing is, and when it began: its rate tells how much time is left. */
static void begin(OstProgress *of, const char *what, double fraction, double now)
{
    snprintf(of->what, sizeof of->what, "%s", what);
    of->start = now;
    of->first = fraction;
}

static void write_progress(const OstProgress *of, double now, char *text, size_t size)
{
    const double done = of->fraction - of->first;
    snprintf(text, size, "%s %.0f %%", of->what, 100.0 * (of->fraction < 1.0 ? of->fraction : 1.0));
    if (now - of->start > rate_known && done > share_known && of->fraction < 1.0 && size > 80) {
        strcat(text, ", ");
        append_seconds(text, (now - of->start) * (1.0 - of->fraction) / done);
        strcat(text, " left");
    }
}

/* What the parts of a batch count for at the most until they are taken up: their files come after. */
static const double most_of_batch = 0.9;

/* How much of the task is done; never less than before. */
static void advance(OstContext *ctx)
{
    const OstProgressBatch *batch = &ctx->batch;
    const int taken = ctx->task_done - batch->first;
    double done = ctx->task_done;
    if (taken >= 0 && taken < batch->count && batch->seconds > 0.0) {
        const double share = (ost_seconds() - batch->start) / batch->seconds;
        const double solved = taken > 0 || share > most_of_batch ? most_of_batch : share;
        done = batch->first + solved * batch->count + (1.0 - most_of_batch) * taken;
    }
    done /= ctx->task_count;
    ctx->task.fraction = done > ctx->task.fraction ? done : ctx->task.fraction;
}

/* How far a row of runs is, if this is one, and the phase. */
static void compose(OstContext *ctx)
{
    const double now = ost_seconds();
    char whole[160] = "", phase[160] = "", text[sizeof line.text];
    if (ctx->task.what[0])
        advance(ctx);
    if (ctx->task.what[0])
        write_progress(&ctx->task, now, whole, sizeof whole);
    if (ctx->phase.what[0] && ctx->phase.fraction >= 0.0)
        write_progress(&ctx->phase, now, phase, sizeof phase);
    else
        snprintf(phase, sizeof phase, "%s", ctx->phase.what);
    snprintf(text, sizeof text, "%.80s%s%.76s", whole, whole[0] && phase[0] ? " | " : "", phase);
    line.ready = 0;
    memcpy(line.text, text, sizeof text);
    line.expected = whole[0] ? 0.0 : ctx->expected;
    line.ready = text[0] != 0;
    show(now);
}

static int shows(const OstContext *ctx)
{
    return line.ctx == ctx && ctx->rank == 0 && ctx->level != OST_LOG_QUIET;
}

static void erase(void)
{
    if (line.shown)
        put("\r\033[K");
    line.shown = 0;
}

void ost_progress_expect_batch(OstContext *ctx, double once, double each)
{
    ctx->expected_once = once;
    ctx->expected_each = each;
}

void ost_progress_batch(OstContext *ctx, int count)
{
    ctx->batch =
        (OstProgressBatch){ctx->task_done, count, ost_seconds(), ctx->expected_once + ctx->expected_each * count};
    if (count == 0 && ctx->task_count > 0) /* what a batch seemed to have done, it has not */
        ctx->task.fraction = (double)ctx->task_done / ctx->task_count;
}

void ost_progress(OstContext *ctx, const char *what, double fraction)
{
    if (!shows(ctx))
        return;
    if (fraction < 0.0) {
        erase();
        if (!what[0]) /* a line of the log follows: what is done goes on */
            return;
        ctx->phase.what[0] = 0;
        ctx->phase.fraction = -1.0;
        return;
    }
    if (strncmp(ctx->phase.what, what, sizeof ctx->phase.what - 1) != 0 || ctx->phase.fraction < 0.0 ||
        fraction < ctx->phase.fraction)
        begin(&ctx->phase, what, fraction, ost_seconds());
    ctx->phase.fraction = fraction;
    compose(ctx);
}

void ost_progress_task(OstContext *ctx, const char *what, int done, int count)
{
    if (!shows(ctx))
        return;
    if (count == 0) {
        erase();
        ctx->task.what[0] = 0;
        ctx->batch.count = 0;
        return;
    }
    if (!ctx->task.what[0] || done < ctx->task_done) {
        begin(&ctx->task, what, (double)done / count, ost_seconds());
        ctx->task.fraction = 0.0;
    }
    snprintf(ctx->task.what, sizeof ctx->task.what, "%s", what);
    ctx->task_done = done;
    ctx->task_count = count;
    compose(ctx);
}

void ost_progress_expect(OstContext *ctx, double seconds)
{
    ctx->expected = seconds;
}

void ost_progress_phase(OstContext *ctx, const char *phase)
{
    if (!shows(ctx) || strncmp(ctx->phase.what, phase, sizeof ctx->phase.what - 1) == 0)
        return;
    begin(&ctx->phase, phase, 0.0, ost_seconds());
    ctx->phase.fraction = -1.0;
    compose(ctx);
}
