/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_FORCE_H
#define ORTHOSTAT_ASSEMBLY_FORCE_H

#include "assembly/batch.h"

/* Local. Adds scale × K u of the tets of a batch to `force`, 3 numbers for each of the first `owned` local nodes. */
void ost_batch_add_force(const OstBatch *batch, const OstElement *element, const double *u, double scale,
                         OstLocal owned, double *force);

#endif
