/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_COST_PICTURE_H
#define ORTHOSTAT_CLI_COST_PICTURE_H

#include "study/cost.h"

/* Local; rank 0 draws. Has the script plot-cost draw the prices. Raises OST_FILE_FAILED if the script is not there or
 * fails; it says why itself. */
OstStatus ost_cli_draw_cost(const OstCost *cost, const char *picture);

#endif
