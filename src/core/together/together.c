/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/together/together.h"

#include "core/context.h"
#include "core/error.h"
#include "core/memory.h"

#include <stdint.h>
#include <string.h>
#include <sys/mman.h>
#include <ucontext.h>

enum { STACK = 1 << 20, GUARD = 1 << 16 }; /* bytes; only what is used takes memory */

/* What a context holds of the work that is being done. */
typedef struct Place {
    OstAccount stack[OST_LEDGER_DEPTH];
    int depth, work_level;
    double elsewhere;
    char error_text[OST_ERROR_TEXT_SIZE], error_origin[OST_ERROR_ORIGIN_SIZE];
} Place;

typedef struct Task {
    ucontext_t context;
    char *stack;          /* from a guard page on, so that an overflow ends the program */
    int is_over, gathers; /* does it wait for all others? */
    OstServe *serve;      /* what it waits for; NULL: nothing */
    int most;             /* of such requests that are served at once */
    void *common, *request;
    long turn;        /* requests are numbered as they come */
    long requests;    /* of this task so far */
    OstStatus status; /* of what it waited for */
    double since;     /* when it began to wait */
    Place place;
} Task;

struct OstTogether {
    OstContext *ctx;
    ucontext_t outside;
    Place place; /* of what runs the tasks */
    int count;
    long requests; /* so far */
    Task *task, *running;
    void (*function)(void *data, int number);
    void *data;
};

static void leave_place(const OstContext *ctx, Place *place)
{
    memcpy(place->stack, ctx->stack, sizeof place->stack);
    place->depth = ctx->depth;
    place->work_level = ctx->work_level;
    place->elsewhere = ctx->elsewhere;
    memcpy(place->error_text, ctx->error_text, sizeof place->error_text);
    memcpy(place->error_origin, ctx->error_origin, sizeof place->error_origin);
}

static void take_place(const Place *place, OstContext *ctx)
{
    memcpy(ctx->stack, place->stack, sizeof ctx->stack);
    ctx->depth = place->depth;
    ctx->work_level = place->work_level;
    ctx->elsewhere = place->elsewhere;
    memcpy(ctx->error_text, place->error_text, sizeof ctx->error_text);
    memcpy(ctx->error_origin, place->error_origin, sizeof ctx->error_origin);
}

/* Seconds until now are booked where they were spent. */
static void move(OstContext *ctx, Place *from, const Place *to)
{
    (void)ost_ledger_entry(ctx, ctx->stack[ctx->depth]);
    leave_place(ctx, from);
    take_place(to, ctx);
}

/* The function that a stack begins with: its argument comes in two halves, as makecontext has no pointers. */
static void begin(unsigned high, unsigned low)
{
    struct OstTogether *together = (struct OstTogether *)(((uintptr_t)high << 32) | (uintptr_t)low);
    together->function(together->data, (int)(together->running - together->task));
    together->running->is_over = 1;
}

static OstStatus prepare(struct OstTogether *together, Task *task)
{
    OstContext *ctx = together->ctx;
    const uintptr_t address = (uintptr_t)together;
    void *stack = mmap(NULL, STACK, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (stack == MAP_FAILED)
        return OST_RAISE(ctx, OST_OUT_OF_MEMORY, "no room for a stack of %d bytes", STACK);
    task->stack = stack;
    if (mprotect(stack, GUARD, PROT_NONE) != 0 || getcontext(&task->context) != 0)
        return OST_RAISE(ctx, OST_OUT_OF_MEMORY, "a stack of %d bytes cannot be used", STACK);
    task->context.uc_stack.ss_sp = task->stack + GUARD;
    task->context.uc_stack.ss_size = STACK - GUARD;
    task->context.uc_link = &together->outside;
    makecontext(&task->context, (void (*)(void))begin, 2, (unsigned)((uint64_t)address >> 32), (unsigned)address);
    leave_place(ctx, &task->place);
    task->since = ost_seconds();
    return OST_SUCCESS;
}

/* Until it waits or is over. */
static void run(struct OstTogether *together, Task *task)
{
    OstContext *ctx = together->ctx;
    task->place.elsewhere += ost_seconds() - task->since;
    move(ctx, &together->place, &task->place);
    ctx->together = together;
    together->running = task;
    swapcontext(&together->outside, &task->context);
    ctx->together = NULL;
    task->since = ost_seconds();
    move(ctx, &task->place, &together->place);
}

static int is_alike(const Task *a, const Task *b)
{
    return a->serve && a->serve == b->serve && a->common == b->common;
}

/* One of those that wait for what most wait for; NULL: none waits. So the few that a full service leaves over wait on,
 * as the others will come back for the same. */
static const Task *choose(const struct OstTogether *together)
{
    const Task *chosen = NULL;
    int most = 0;
    for (int k = 0; k < together->count; k++) {
        int alike = 0;
        for (int j = 0; j < together->count; j++)
            alike += is_alike(&together->task[j], &together->task[k]);
        if (alike > most)
            chosen = &together->task[k];
        most = alike > most ? alike : most;
    }
    return chosen;
}

/* Does a go before b? One that is behind does, so that tasks that do the same stay in step; else the first come. */
static int goes_before(const Task *a, const Task *b)
{
    return a->requests != b->requests ? a->requests < b->requests : a->turn < b->turn;
}

/* Those that wait for the same, in turn; as many as are served at once. */
static int line_up(struct OstTogether *together, const Task *chosen, Task *of[OST_MOST_TOGETHER])
{
    int count = 0;
    for (int k = 0; k < together->count; k++) {
        Task *task = &together->task[k];
        int place = count;
        if (!is_alike(task, chosen))
            continue;
        for (; place > 0 && goes_before(task, of[place - 1]); place--)
            of[place] = of[place - 1];
        of[place] = task;
        count++;
    }
    return count < chosen->most ? count : chosen->most;
}

/* The work is booked where the first of those served is. */
static void serve(struct OstTogether *together, const Task *chosen)
{
    OstContext *ctx = together->ctx;
    void *request[OST_MOST_TOGETHER];
    Task *of[OST_MOST_TOGETHER];
    const int count = line_up(together, chosen, of);
    for (int k = 0; k < count; k++)
        request[k] = of[k]->request;
    const double start = ost_seconds();
    move(ctx, &together->place, &of[0]->place);
    const OstStatus status = chosen->serve(chosen->common, count, request);
    move(ctx, &of[0]->place, &together->place);
    const double share = (ost_seconds() - start) / count;
    for (int k = 0; k < count; k++) {
        of[k]->serve = NULL;
        of[k]->status = status;
        of[k]->place.elsewhere -= share;
        if (status != OST_SUCCESS && k > 0)
            memcpy(of[k]->place.error_text, of[0]->place.error_text, sizeof of[0]->place.error_text);
    }
}

/* All that are not over have gathered: they go on. Returns how many. */
static int let_go(struct OstTogether *together)
{
    int count = 0;
    for (int k = 0; k < together->count; k++) {
        count += together->task[k].gathers;
        together->task[k].gathers = 0;
    }
    return count;
}

static void run_all(struct OstTogether *together)
{
    const Task *chosen = NULL;
    do {
        for (int k = 0; k < together->count; k++) {
            Task *task = &together->task[k];
            if (!task->is_over && !task->gathers && !task->serve)
                run(together, task);
        }
        chosen = choose(together);
        if (chosen)
            serve(together, chosen);
    } while (chosen || let_go(together) > 0);
}

OstStatus ost_together_run(OstContext *ctx, int count, void (*task)(void *data, int number), void *data)
{
    struct OstTogether together = {.ctx = ctx, .count = count, .function = task, .data = data};
    OstStatus status = OST_NEW(ctx, &together.task, count);
    for (int k = 0; k < count && status == OST_SUCCESS; k++)
        status = prepare(&together, &together.task[k]);
    status = ost_agree(ctx, status);
    if (status == OST_SUCCESS)
        run_all(&together);
    for (int k = 0; together.task && k < count; k++)
        if (together.task[k].stack)
            munmap(together.task[k].stack, STACK);
    OST_FREE(together.task);
    return status;
}

OstStatus ost_together(OstContext *ctx, OstServe *served_by, int most, void *common, void *request)
{
    struct OstTogether *together = ctx->together;
    if (!together)
        return served_by(common, 1, &request);
    Task *task = together->running;
    task->serve = served_by;
    task->most = most;
    task->turn = together->requests++;
    task->requests++;
    task->common = common;
    task->request = request;
    swapcontext(&task->context, &together->outside);
    return task->status;
}

void ost_together_gather(OstContext *ctx)
{
    struct OstTogether *together = ctx->together;
    if (!together)
        return;
    together->running->gathers = 1;
    swapcontext(&together->running->context, &together->outside);
}

int ost_together_any(const OstContext *ctx)
{
    return ctx->together != NULL;
}

double ost_own_seconds(const OstContext *ctx)
{
    return ost_seconds() - ctx->elsewhere;
}
