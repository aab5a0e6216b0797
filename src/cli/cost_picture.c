/* SPDX-License-Identifier: BSD-3-Clause */
#include "cli/cost_picture.h"

#include "cli/installed.h"
#include "core/error.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

OstStatus ost_cli_draw_cost(const OstCost *cost, const char *picture)
{
    enum { LONGEST = 4096 };
    char folder[LONGEST]; /* a new one, where no file of the user can be in the way */
    char prices[LONGEST + 16];
    const char *place = getenv("TMPDIR");
    if (ost_rank(cost->ctx) != 0)
        return OST_SUCCESS;
    if (!place || !place[0])
        place = "/tmp";
    snprintf(folder, sizeof folder, "%s/orthostat-prices-XXXXXX", place); /* if truncated, mkdtemp fails with EINVAL */
    if (!mkdtemp(folder))
        return OST_RAISE(
            cost->ctx, OST_FILE_FAILED,
            "cannot make a folder in '%.200s' for the picture's numbers: %s; TMPDIR can name another place", place,
            strerror(errno));
    snprintf(prices, sizeof prices, "%s/prices.json", folder);
    OstStatus status = ost_cost_write_json(cost, prices);
    if (status == OST_SUCCESS)
        status = ost_cli_run_script(cost->ctx, "plot-cost", prices, picture);
    remove(prices);
    rmdir(folder);
    return status;
}
