/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/stability_region.h"

#include "core/error.h"
#include "core/memory.h"
#include "orthostat/material.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { POINTS = 360 };

static void write_curve(FILE *file, double nu, const double *ratios)
{
    for (int i = 0; i <= POINTS; i++) { /* the last is the first: a closed curve */
        const double *point = ratios + 2 * (i % POINTS);
        fprintf(file, "%.12g,%.12g,%.12g\n", nu, point[0], point[1]);
    }
}

static OstStatus write_aside(OstContext *ctx, const char *path, const char *aside, int count, const double *nu,
                             const double *ratios)
{
    FILE *file = fopen(aside, "w");
    if (!file)
        return OST_RAISE(ctx, OST_FILE_FAILED, "%s cannot be written: %s", path, strerror(errno));
    fputs("nu,E1_over_E2,E3_over_E2\n", file);
    for (int k = 0; k < count; k++)
        write_curve(file, nu[k], ratios + 2 * (size_t)POINTS * (size_t)k);
    int failed = ferror(file) != 0;
    failed |= fclose(file) != 0;
    if (!failed && rename(aside, path) == 0)
        return OST_SUCCESS;
    const int reason = errno;
    remove(aside);
    return OST_RAISE(ctx, OST_FILE_FAILED, "%s could not be written whole: %s", path, strerror(reason));
}

OstStatus ost_stability_region_write(OstContext *ctx, const char *path, int count, const double *nu)
{
    double *ratios = NULL;
    char *aside = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(ctx, &ratios, 2 * (size_t)POINTS * (size_t)count));
    for (int k = 0; k < count; k++)
        OST_TRY_DONE(ost_orthotropic_naive_boundary(ctx, nu[k], POINTS, ratios + 2 * (size_t)POINTS * (size_t)k));
    const size_t size = strlen(path) + sizeof ".partial";
    OST_TRY_DONE(OST_NEW(ctx, &aside, size));
    snprintf(aside, size, "%s.partial", path);
    OST_TRY_DONE(write_aside(ctx, path, aside, count, nu, ratios));
done:
    OST_FREE(aside);
    OST_FREE(ratios);
    return status;
}
