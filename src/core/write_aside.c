/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/write_aside.h"

#include "core/error.h"
#include "core/interrupt/interrupt.h"
#include "core/memory.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_LINKS = 40, MOST_TRIES = 100 };

static const char aside_name[] = ".orthostat-%08lx";

static OstStatus raise_unwritten(OstContext *ctx, const char *path, const char *reason)
{
    return OST_RAISE(ctx, OST_FILE_FAILED, "cannot write '%s': %s", path, reason);
}

static size_t folder_length(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? (size_t)(slash - path) + 1 : 0;
}

/* `name` in the folder of the file `path`. */
static OstStatus join(OstContext *ctx, const char *path, const char *name, char **joined)
{
    const size_t folder = *name == '/' ? 0 : folder_length(path);
    OST_TRY(OST_NEW(ctx, joined, folder + strlen(name) + 1));
    memcpy(*joined, path, folder);
    strcpy(*joined + folder, name);
    return OST_SUCCESS;
}

OstStatus ost_follow_links(OstContext *ctx, const char *path, char **target)
{
    char link[PATH_MAX + 1];
    OST_TRY(ost_copy_string(ctx, path, target));
    for (int i = 0; i < MOST_LINKS; i++) {
        const ssize_t length = readlink(*target, link, sizeof link - 1);
        if (length < 0)
            return OST_SUCCESS;
        char *next = NULL;
        link[length] = 0;
        const OstStatus status = join(ctx, *target, link, &next);
        OST_FREE(*target);
        *target = next;
        OST_TRY(status);
    }
    OST_FREE(*target);
    return raise_unwritten(ctx, path, strerror(ELOOP));
}

/* Creates the temporary file. O_EXCL: never opens an existing file or a link. */
static OstStatus create(OstContext *ctx, OstAside *aside)
{
    char name[sizeof aside_name + 2 * sizeof(long)];
    unsigned long number = (unsigned long)getpid() * 1000003UL + (unsigned long)(1e6 * ost_seconds());
    for (int i = 0; i < MOST_TRIES; i++) {
        snprintf(name, sizeof name, aside_name, number++ & 0xffffffffUL);
        OST_TRY(join(ctx, aside->path, name, &aside->aside));
        const int descriptor = open(aside->aside, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        const int reason = errno;
        if (descriptor >= 0) {
            ost_half_written(aside->aside);
            close(descriptor);
            return OST_SUCCESS;
        }
        OST_FREE(aside->aside);
        errno = reason;
        if (reason != EEXIST)
            break;
    }
    return raise_unwritten(ctx, aside->path, strerror(errno));
}

OstStatus ost_aside_open(OstContext *ctx, const char *path, OstAside *aside)
{
    struct stat there;
    if (stat(path, &there) == 0 && !S_ISREG(there.st_mode)) /* before links are read: /dev/stdout leads to none */
        return raise_unwritten(ctx, path, "it exists and is not a regular file ('-' stands for standard output)");
    OST_TRY(ost_follow_links(ctx, path, &aside->path));
    const OstStatus status = create(ctx, aside);
    if (status != OST_SUCCESS)
        OST_FREE(aside->path);
    return status;
}

static OstStatus share_name(OstContext *ctx, char **name)
{
    int size = *name ? (int)strlen(*name) + 1 : 0;
    OST_TRY(OST_MPI(ctx, MPI_Bcast(&size, 1, MPI_INT, 0, ost_comm(ctx))));
    OST_TRY(ost_agree(ctx, ost_rank(ctx) == 0 ? OST_SUCCESS : OST_NEW(ctx, name, size)));
    return OST_MPI(ctx, MPI_Bcast(*name, size, MPI_CHAR, 0, ost_comm(ctx)));
}

OstStatus ost_aside_open_together(OstContext *ctx, const char *path, OstAside *aside)
{
    OST_TRY(ost_agree(ctx, ost_rank(ctx) == 0 ? ost_aside_open(ctx, path, aside) : OST_SUCCESS));
    OstStatus status = share_name(ctx, &aside->path);
    OST_THEN(share_name(ctx, &aside->aside));
    return status == OST_SUCCESS ? OST_SUCCESS : ost_aside_finish_together(ctx, aside, status);
}

static void release(OstAside *aside)
{
    OST_FREE(aside->path, aside->aside);
}

OstStatus ost_aside_finish(OstContext *ctx, OstAside *aside, OstStatus written)
{
    OstStatus status = written;
    if (aside->aside && status == OST_SUCCESS && rename(aside->aside, aside->path) != 0)
        status = raise_unwritten(ctx, aside->path, strerror(errno));
    if (aside->aside && status != OST_SUCCESS)
        remove(aside->aside);
    if (aside->aside)
        ost_half_written_forget(aside->aside, status == OST_SUCCESS);
    release(aside);
    return status;
}

OstStatus ost_aside_finish_together(OstContext *ctx, OstAside *aside, OstStatus written)
{
    const OstStatus status = ost_rank(ctx) == 0 ? ost_aside_finish(ctx, aside, written) : written;
    release(aside);
    return ost_agree(ctx, status);
}

/* Returns 0, or errno. A file that cannot be opened is left to the writer, whose message is better. */
static int allocate(const char *path, OstGlobal bytes, int empties)
{
    int reason = 0;
    const int descriptor = open(path, O_WRONLY);
    if (descriptor < 0)
        return 0;
    do
        reason = fallocate(descriptor, 0, 0, (off_t)bytes) == 0 ? 0 : errno;
    while (reason == EINTR);
    if (empties && ftruncate(descriptor, 0) != 0 && reason == 0)
        reason = errno;
    close(descriptor);
    return reason == EOPNOTSUPP || reason == ENOSYS ? 0 : reason;
}

OstStatus ost_aside_reserve(OstContext *ctx, const OstAside *aside, OstGlobal bytes, int empties)
{
    const int reason = ost_rank(ctx) == 0 ? allocate(aside->aside, bytes, empties) : 0;
    return ost_agree(ctx, reason == 0 ? OST_SUCCESS
                                      : OST_RAISE(ctx, OST_FILE_FAILED,
                                                  "%s: needs %.3g MiB of disk space, which cannot be reserved: %s",
                                                  aside->path, (double)bytes / 1048576.0, strerror(reason)));
}

/* Flushes too: an error in what `write` left in the buffer shows only then. */
static OstStatus write_stream(OstContext *ctx, const char *path, FILE *file,
                              OstStatus (*write)(FILE *file, const void *content), const void *content)
{
    OST_TRY(write(file, content));
    return fflush(file) == 0 && !ferror(file) ? OST_SUCCESS : raise_unwritten(ctx, path, strerror(errno));
}

OstStatus ost_write_aside(OstContext *ctx, const char *path, OstStatus (*write)(FILE *file, const void *content),
                          const void *content)
{
    OstAside aside = {0};
    if (strcmp(path, "-") == 0)
        return write_stream(ctx, "standard output", stdout, write, content);
    OST_TRY(ost_aside_open(ctx, path, &aside));
    FILE *file = fopen(aside.aside, "w");
    OstStatus status =
        file ? write_stream(ctx, path, file, write, content) : raise_unwritten(ctx, path, strerror(errno));
    if (file && fclose(file) != 0 && status == OST_SUCCESS)
        status = raise_unwritten(ctx, path, strerror(errno));
    return ost_aside_finish(ctx, &aside, status);
}

void ost_csv_text(FILE *file, const char *text)
{
    fputc('"', file);
    for (; *text; text++) {
        if (*text == '"')
            fputc('"', file);
        fputc(*text, file);
    }
    fputc('"', file);
}

void ost_csv_number(FILE *file, double number)
{
    fputc(',', file);
    if (isfinite(number))
        fprintf(file, "%.17g", number);
}
