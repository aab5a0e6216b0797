/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_MEANS_H
#define ORTHOSTAT_ASSEMBLY_MEANS_H

#include "assembly/batch.h"

/* Called with each batch of owned tets, the displacements u of their nodes, and their means. */
typedef void (*OstMeansVisit)(void *data, const OstBatch *batch, const OstElement *element, const OstSimd *u,
                              const OstMeans *means);

/* Local. Computes the means of strain, stress and energy of the owned tets under the displacement u (3 × node_count),
 * batch by batch. */
void ost_visit_means(const OstMesh *mesh, const OstMaterialField *field, const double *u, OstMeansVisit visit,
                     void *data);

#endif
