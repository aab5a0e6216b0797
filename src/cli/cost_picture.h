/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_COST_PICTURE_H
#define ORTHOSTAT_CLI_COST_PICTURE_H

#include "study/cost.h"

/* Local; rank 0 draws, by the script plot-cost. Raises OST_FILE_FAILED as ost_cli_run_script does. */
OstStatus ost_cli_draw_cost(const OstCost *cost, const char *picture);

#endif
