/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_FORCE_H
#define ORTHOSTAT_ASSEMBLY_FORCE_H

#include "assembly/batch.h"

/* OstElement.force or OstElement.magnitude. */
typedef void (*OstForceKernel)(const OstSimd *x, const OstElasticity *elasticity, const OstSimd *u, OstSimd *force);

/* Local. Adds scale × the kernel's forces on a batch to `force`, which has 3 numbers for each of the first `owned`
 * local nodes. */
void ost_batch_add_force(const OstBatch *batch, int nodes, OstForceKernel kernel, const double *u, double scale,
                         OstLocal owned, double *force);

#endif
