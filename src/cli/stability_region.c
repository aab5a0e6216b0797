/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/stability_region.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/write_aside.h"
#include "orthostat/material.h"

#include <stdio.h>

enum { POINTS = 360 };

typedef struct Curves {
    int count;
    const double *nu, *ratios;
} Curves;

static OstStatus write_curves(FILE *file, const void *content)
{
    const Curves *curves = content;
    fputs("nu,E1_over_E2,E3_over_E2\n", file);
    for (int k = 0; k < curves->count; k++)
        for (int i = 0; i <= POINTS; i++) { /* the last is the first: a closed curve */
            const double *point = curves->ratios + 2 * ((size_t)POINTS * (size_t)k + (size_t)(i % POINTS));
            fprintf(file, "%.12g,%.12g,%.12g\n", curves->nu[k], point[0], point[1]);
        }
    return OST_SUCCESS;
}

OstStatus ost_stability_region_write(OstContext *ctx, const char *path, int count, const double *nu)
{
    double *ratios = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(ctx, &ratios, 2 * (size_t)POINTS * (size_t)count));
    for (int k = 0; k < count; k++)
        OST_TRY_DONE(ost_orthotropic_naive_boundary(ctx, nu[k], POINTS, ratios + 2 * (size_t)POINTS * (size_t)k));
    status = ost_write_aside(ctx, path, write_curves, &(Curves){count, nu, ratios});
done:
    OST_FREE(ratios);
    return status;
}
