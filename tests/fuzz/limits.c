/* SPDX-License-Identifier: BSD-3-Clause */
#include "fuzz.h"

#include "core/context.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/time.h>
#include <unistd.h>

#if defined(__SANITIZE_ADDRESS__)
#define COUNTS_ALL_MEMORY 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define COUNTS_ALL_MEMORY 1
#endif
#endif
#ifndef COUNTS_ALL_MEMORY
#define COUNTS_ALL_MEMORY 0
#endif

enum { MEMORY_FACTOR = 10, SECONDS = 1 };

static size_t bytes_before;

#if COUNTS_ALL_MEMORY
/* Of sanitizer/allocator_interface.h, which GCC does not install. */
int __sanitizer_install_malloc_and_free_hooks(void (*)(const volatile void *, size_t), void (*)(const volatile void *));
size_t __sanitizer_get_allocated_size(const volatile void *);

/* Open MPI's threads allocate when they please. */
static _Thread_local int counts;
static size_t bytes_now, bytes_most;

static void count_malloc(const volatile void *memory, size_t size)
{
    if (!memory || !counts)
        return;
    bytes_now += size;
    if (bytes_now > bytes_most)
        bytes_most = bytes_now;
}

static void count_free(const volatile void *memory)
{
    if (memory && counts)
        bytes_now -= __sanitizer_get_allocated_size(memory);
}

/* Counting begins in the middle of a process, so only differences mean anything. */
static void count_memory(OstContext *ctx)
{
    static int installed;
    (void)ctx;
    if (!installed && !__sanitizer_install_malloc_and_free_hooks(count_malloc, count_free))
        abort();
    installed = counts = 1;
    bytes_most = bytes_now;
}

static size_t memory_now(const OstContext *ctx)
{
    (void)ctx;
    return bytes_now;
}

static size_t memory_most(const OstContext *ctx)
{
    (void)ctx;
    return bytes_most;
}
#else
static void count_memory(OstContext *ctx)
{
    ost_ledger_restart_peak(ctx);
}

static size_t memory_now(const OstContext *ctx)
{
    return ost_ledger_bytes(ctx);
}

static size_t memory_most(const OstContext *ctx)
{
    return ost_ledger_peak_bytes(ctx);
}
#endif

static void say_and_abort(int signal_number)
{
    static const char text[] = "fuzz: HANG: the reader took more than a second of processor time\n";
    (void)signal_number;
    if (write(STDERR_FILENO, text, sizeof text - 1) < 0)
        _exit(1);
    abort();
}

/* Processor time rather than the clock's: other programs may be busy. */
static void set_alarm(int seconds)
{
    const struct itimerval timer = {.it_value = {.tv_sec = seconds}};
    if (setitimer(ITIMER_PROF, &timer, NULL) != 0)
        abort();
}

void fuzz_limits_start(OstContext *ctx)
{
    signal(SIGPROF, say_and_abort);
    count_memory(ctx);
    bytes_before = memory_now(ctx);
    set_alarm(SECONDS);
}

void fuzz_limits_end(OstContext *ctx, size_t input_bytes)
{
    set_alarm(0);
    ost_forget_warnings(ctx);
    const size_t most = memory_most(ctx) - bytes_before;
    const size_t allowed = MEMORY_FACTOR * input_bytes + fuzz_target.constant;
    const size_t left = fuzz_target.library_caches ? ost_ledger_bytes(ctx) : memory_now(ctx) - bytes_before;
    if (most > allowed) {
        fprintf(stderr, "fuzz: MEMORY: %zu bytes for a file of %zu, allowed are %zu\n", most, input_bytes, allowed);
        abort();
    }
    if (left != 0) {
        fprintf(stderr, "fuzz: LEAK: %zu bytes were not freed\n", left);
        abort();
    }
}
