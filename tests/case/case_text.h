/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_CASE_TEXT_H
#define ORTHOSTAT_TESTS_CASE_TEXT_H

#include "case/case_data.h"
#include "support.h"

#include <unistd.h>

/* Case files from text: rank 0 writes a file of its own, all read it. */

static const char steel[] = "materials: [{region: all, youngs_modulus: 2, poissons_ratio: 0.3}]\n";
static const char cube[] = "mesh: {block: {size: [1, 1, 1], divisions: [2, 2, 2]}}\n";

static inline void case_path(char path[256])
{
    const char *folder = getenv("TMPDIR");
    int id = (int)getpid();
    MPI_Bcast(&id, 1, MPI_INT, 0, ost_comm(ctx));
    snprintf(path, 256, "%s/orthostat-case-%d.yaml", folder ? folder : "/tmp", id);
}

static inline void write_bytes(const char *path, const char *bytes, size_t size)
{
    if (ost_rank(ctx) == 0) {
        FILE *file = fopen(path, "wb");
        assert_non_null(file);
        assert_int_equal(fwrite(bytes, 1, size, file), size);
        assert_int_equal(fclose(file), 0);
    }
    MPI_Barrier(ost_comm(ctx));
}

static inline OstStatus read_bytes_of(const char *bytes, size_t size, OstCase **c)
{
    char path[256];
    case_path(path);
    write_bytes(path, bytes, size);
    const OstStatus status = ost_case_read(ctx, path, c);
    MPI_Barrier(ost_comm(ctx));
    if (ost_rank(ctx) == 0)
        remove(path);
    return status;
}

static inline OstStatus read_text(const char *text, OstCase **c)
{
    return read_bytes_of(text, strlen(text), c);
}

/* Reading fails, and the message is the file's path, a colon, and exactly `expected` (or begins with it, where that
 * ends with dots). */
#define assert_refused(text, expected) check_refused((text), (expected), __FILE__, __LINE__)

static inline void check_refused(const char *text, const char *expected, const char *file, int line)
{
    char path[256], whole[2048];
    OstCase *c = NULL;
    case_path(path);
    const OstStatus status = read_text(text, &c);
    snprintf(whole, sizeof whole, "%s:%s", path, expected);
    size_t length = strlen(whole);
    const int prefix = length > 3 && strcmp(whole + length - 3, "...") == 0;
    if (prefix)
        whole[length -= 3] = 0;
    const char *found = ost_error_text(ctx);
    if (status != OST_INVALID_INPUT || c || (prefix ? strncmp(found, whole, length) : strcmp(found, whole)) != 0) {
        ost_case_destroy(&c);
        print_error("%s:%d: status %s\n  found    '%s'\n  expected '%s'\n", file, line, ost_status_name(status), found,
                    whole);
        fail();
    }
}

#endif
