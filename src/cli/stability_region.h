/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_CLI_STABILITY_REGION_H
#define ORTHOSTAT_CLI_STABILITY_REGION_H

#include "orthostat/context.h"

/* Local; to be called by one rank. Writes the CSV file nu,E1_over_E2,E3_over_E2 with a closed curve for each nu
 * (ost_orthotropic_naive_boundary); aside first, so that a failure leaves an existing file as it was. */
OstStatus ost_stability_region_write(OstContext *ctx, const char *path, int count, const double *nu);

#endif
