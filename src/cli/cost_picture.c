/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/cost_picture.h"

#include "cli/script.h"
#include "core/error.h"

#include <stdio.h>

enum { LONGEST_PATH = 4096 };

OstStatus ost_cli_draw_cost(const OstCost *cost, const char *picture)
{
    char prices[LONGEST_PATH];
    if (ost_rank(cost->ctx) != 0)
        return OST_SUCCESS;
    const int length = snprintf(prices, sizeof prices, "%s.prices.json", picture);
    if (length < 0 || (size_t)length >= sizeof prices)
        return OST_RAISE(cost->ctx, OST_FILE_FAILED, "the path of the picture is too long: %.200s...", picture);
    OST_TRY(ost_cost_write_json(cost, prices));
    const OstStatus status = ost_cli_run_script(cost->ctx, "plot-cost", prices, picture);
    remove(prices);
    return status;
}
