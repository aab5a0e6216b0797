/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_SOLVE_RECOVERY_H
#define ORTHOSTAT_SOLVE_RECOVERY_H

#include "orthostat/result.h"

/* Local. Strain, stress and strain energy density of the owned tets, as far as the bits of `fields` (OstOutputFieldBit)
 * ask. */
OstStatus ost_result_recover(OstResult *result, unsigned fields);

#endif
