/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/memory.h"

#include "core/context.h"
#include "core/error.h"

#include <limits.h>
#include <malloc.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Large blocks start on a cache line: a vector register is as long as one, and loads of it that touch two lines take
 * twice as long. Not with sanitizers, which would miss an access right behind the block. */
#if defined __SANITIZE_ADDRESS__
enum { LINE = 64, LARGE = INT_MAX };
#else
enum { LINE = 64, LARGE = 1024 }; /* bytes */
#endif

/* Precedes every block, so that freeing it needs only the pointer. Aligned, so that the block behind it is. */
typedef struct Header {
    _Alignas(max_align_t) OstContext *ctx;
    size_t bytes;
    OstAccount account;
    unsigned before; /* bytes from what malloc returned to the header */
} Header;

/* Where the header goes: at the start, or so that the block behind it starts on a cache line. */
static unsigned bytes_before(const char *start, int aligned)
{
    return aligned ? (unsigned)(-(uintptr_t)(start + sizeof(Header)) % LINE) : 0;
}

static OstStatus raise_out_of_memory(OstContext *ctx, size_t count, size_t size)
{
    return OST_RAISE(
        ctx, OST_OUT_OF_MEMORY,
        "out of memory: %zu items of %zu bytes (%.1f MiB) could not be allocated for '%s' in addition to %.1f MiB; use "
        "more machines or a smaller mesh",
        count, size, (double)count * (double)size / 1048576.0, ost_ledger_label(ctx, ctx->stack[ctx->depth]),
        (double)ctx->bytes / 1048576.0);
}

static int overflows(size_t count, size_t size)
{
    return size != 0 && count > (SIZE_MAX / 2 - sizeof(Header) - LINE) / size;
}

static OstStatus allocate(OstContext *ctx, size_t count, size_t size, int cleared, void **memory)
{
    *memory = NULL;
    if (overflows(count, size))
        return raise_out_of_memory(ctx, count, size);
    const int aligned = count * size >= LARGE;
    const size_t bytes = sizeof(Header) + count * size + (aligned ? LINE : 0);
    char *start = cleared ? calloc(1, bytes) : malloc(bytes);
    if (!start)
        return raise_out_of_memory(ctx, count, size);
    const unsigned before = bytes_before(start, aligned);
    Header *header = (Header *)(void *)(start + before);
    header->before = before;
    header->ctx = ctx;
    header->bytes = count * size;
    header->account = ctx->stack[ctx->depth];
    ost_ledger_book(ctx, header->account, header->bytes, 0);
    *memory = header + 1;
    return OST_SUCCESS;
}

OstStatus ost_allocate(OstContext *ctx, size_t count, size_t size, void **memory)
{
    return allocate(ctx, count, size, 1, memory);
}

OstStatus ost_allocate_uncleared(OstContext *ctx, size_t count, size_t size, void **memory)
{
    return allocate(ctx, count, size, 0, memory);
}

OstStatus ost_reallocate(OstContext *ctx, size_t count, size_t size, void **memory)
{
    if (!*memory)
        return ost_allocate(ctx, count, size, memory);
    if (overflows(count, size))
        return raise_out_of_memory(ctx, count, size);
    Header *header = (Header *)*memory - 1;
    const size_t old_bytes = header->bytes;
    const size_t bytes = count * size;
    const unsigned old_before = header->before;
    const int aligned = bytes >= LARGE || old_before > 0;
    char *start = realloc((char *)header - old_before, sizeof *header + bytes + (aligned ? LINE : 0));
    if (!start)
        return raise_out_of_memory(ctx, count, size);
    const unsigned before = bytes_before(start, aligned);
    header = (Header *)(void *)(start + before);
    if (before != old_before)
        memmove(header, start + old_before, sizeof *header + (bytes < old_bytes ? bytes : old_bytes));
    header->before = before;
    if (bytes > old_bytes)
        memset((char *)(header + 1) + old_bytes, 0, bytes - old_bytes);
    header->bytes = bytes;
    ost_ledger_book(ctx, header->account, old_bytes, 1);
    ost_ledger_book(ctx, header->account, bytes, 0);
    *memory = header + 1;
    return OST_SUCCESS;
}

OstStatus ost_grow(OstContext *ctx, size_t count, size_t size, void **memory)
{
    const size_t bytes = *memory ? ((Header *)*memory - 1)->bytes : 0;
    return count <= bytes / size ? OST_SUCCESS : ost_reallocate(ctx, count + count / 2 + 16, size, memory);
}

void ost_free_memory(void *memory)
{
    if (!memory)
        return;
    Header *header = (Header *)memory - 1;
    ost_ledger_book(header->ctx, header->account, header->bytes, 1);
    free((char *)header - header->before);
}

void ost_keep_freed_memory(void)
{
#ifdef __GLIBC__
    mallopt(M_MMAP_MAX, 0);
    mallopt(M_TRIM_THRESHOLD, -1);
#endif
}

void ost_return_freed_memory(void)
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

OstStatus ost_copy_string(OstContext *ctx, const char *text, char **copy)
{
    OST_TRY(OST_NEW(ctx, copy, strlen(text) + 1));
    strcpy(*copy, text);
    return OST_SUCCESS;
}
