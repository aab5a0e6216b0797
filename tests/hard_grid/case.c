/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "hard_grid/grid.h"

#include <stdio.h>

static const char *verdict_of(const HardReading *reading)
{
    if (reading->status != OST_SUCCESS)
        return "refused";
    return hard_states_its_error(reading) ? "accepted" : "accepted, WRONGLY STATED";
}

static void print(const char *path, const HardReading *reading)
{
    const HardErrors *off = &reading->truth.off;
    printf("%s: %s\n", path, verdict_of(reading));
    if (reading->status != OST_SUCCESS)
        printf("  reason           %s\n", reading->reason);
    if (!off->known)
        puts("  errors           not known: the reference did not settle");
    else
        printf("  errors           displacement %.1e (stated %.1e), reactions %.1e and stresses %.1e (stated %.1e)\n",
               off->displacement, reading->stated_error, off->reaction, off->stress, reading->stated_forces);
}

OstStatus hard_read_case(OstContext *ctx, const char *path, int *passed)
{
    HardReading reading = {.point = {0}};
    OstCase *c = NULL;
    OstScene *scene = NULL;
    const OstLogLevel level = ost_log_level(ctx);
    OstStatus status;
    OST_TRY_DONE(ost_case_read(ctx, path, &c));
    OST_TRY_DONE(ost_scene_create(c, &scene));
    ost_log_set_level(ctx, OST_LOG_QUIET);
    OST_TRY_DONE(hard_solve_scene(scene, &reading));
    if (ost_rank(ctx) == 0)
        print(path, &reading);
    *passed = reading.status != OST_SUCCESS || hard_states_its_error(&reading);
done:
    ost_log_set_level(ctx, level);
    ost_scene_destroy(&scene);
    ost_case_destroy(&c);
    return status;
}
