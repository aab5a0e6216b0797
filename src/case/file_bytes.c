/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/file_bytes.h"

#include "core/error.h"
#include "core/memory.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

static OstStatus read_stream(OstContext *ctx, const char *path, FILE *file, size_t most, char **bytes, size_t *size)
{
    size_t room = 16384;
    OST_TRY(OST_NEW(ctx, bytes, room));
    for (;;) {
        *size += fread(*bytes + *size, 1, room - *size, file);
        if (ferror(file))
            return OST_RAISE(ctx, OST_FILE_FAILED, "%s: cannot be read: %s", path, strerror(errno));
        if (*size < room)
            return OST_RESIZE(ctx, bytes, *size);
        if (*size > most)
            return OST_RAISE(ctx, OST_INVALID_INPUT, "%s: more than %zu bytes; a case file is a page or two", path,
                             most);
        room *= 2;
        OST_TRY(OST_RESIZE(ctx, bytes, room));
    }
}

static OstStatus read_file(OstContext *ctx, const char *path, size_t most, char **bytes, size_t *size)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return OST_RAISE(ctx, OST_FILE_FAILED, "%s: cannot be opened: %s", path, strerror(errno));
    OstStatus status = read_stream(ctx, path, file, most, bytes, size);
    fclose(file);
    return status;
}

OstStatus ost_read_file_bytes(OstContext *ctx, const char *path, size_t most, char **bytes, size_t *size)
{
    OstStatus status = OST_SUCCESS;
    OstGlobal length = 0;
    *bytes = NULL;
    *size = 0;
    if (ost_rank(ctx) == 0)
        status = read_file(ctx, path, most, bytes, size);
    OST_TRY_DONE(ost_agree(ctx, status));
    length = (OstGlobal)*size;
    OST_TRY_DONE(OST_MPI(ctx, MPI_Bcast(&length, 1, MPI_INT64_T, 0, ost_comm(ctx))));
    if (ost_rank(ctx) != 0)
        status = OST_NEW(ctx, bytes, length);
    OST_TRY_DONE(ost_agree(ctx, status));
    *size = (size_t)length;
    OST_TRY_DONE(OST_MPI(ctx, MPI_Bcast(*bytes, (int)length, MPI_BYTE, 0, ost_comm(ctx))));
done:
    if (status != OST_SUCCESS)
        OST_FREE(*bytes);
    return status;
}
