/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_FORMATS_SCRATCH_H
#define ORTHOSTAT_TESTS_FORMATS_SCRATCH_H

#include "support.h"

#include <ftw.h>
#include <unistd.h>

/* A folder of the test's own for the files it writes, the same one on every rank; made when it is first asked for and
 * removed when the program ends. */
static char scratch_folder[256];

static int remove_entry(const char *path, const struct stat *facts, int kind, struct FTW *place)
{
    (void)facts;
    (void)kind;
    (void)place;
    return remove(path);
}

static void remove_scratch(void)
{
    nftw(scratch_folder, remove_entry, 8, FTW_DEPTH | FTW_PHYS);
}

static void make_scratch(void)
{
    if (ost_rank(ctx) == 0) {
        const char *base = getenv("TMPDIR");
        snprintf(scratch_folder, sizeof scratch_folder, "%s/orthostat-XXXXXX", base ? base : "/tmp");
        assert_non_null(mkdtemp(scratch_folder));
        atexit(remove_scratch);
    }
    MPI_Bcast(scratch_folder, sizeof scratch_folder, MPI_CHAR, 0, ost_comm(ctx));
}

/* Full path of a file in the scratch folder, in one of a few buffers. */
static const char *scratch(const char *name)
{
    static char path[4][512];
    static int next;
    if (scratch_folder[0] == '\0')
        make_scratch();
    next = (next + 1) % 4;
    snprintf(path[next], sizeof path[next], "%s/%s", scratch_folder, name);
    return path[next];
}

/* Rank 0 writes a file; all may read it afterwards. */
static const char *write_bytes(const char *name, const void *bytes, size_t length)
{
    const char *path = scratch(name);
    if (ost_rank(ctx) == 0) {
        FILE *file = fopen(path, "wb");
        assert_non_null(file);
        assert_int_equal(fwrite(bytes, 1, length, file), length);
        assert_int_equal(fclose(file), 0);
    }
    MPI_Barrier(ost_comm(ctx));
    return path;
}

static inline const char *write_text(const char *name, const char *text)
{
    return write_bytes(name, text, strlen(text));
}

#endif
