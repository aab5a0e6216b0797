/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_MEANS_H
#define ORTHOSTAT_ASSEMBLY_MEANS_H

#include "assembly/batch.h"

/* What is done with a batch of owned tets, the displacements of their nodes, and their means of strain, stress and
 * energy. */
typedef void (*OstMeansVisit)(void *data, const OstBatch *batch, const OstElement *element, const OstLanes *u,
                              const OstMeans *means);

/* Local. Visits the owned tets batch by batch under the displacement u (3 × node_count). */
void ost_visit_means(const OstMesh *mesh, const OstMaterialField *field, const double *u, OstMeansVisit visit,
                     void *data);

#endif
