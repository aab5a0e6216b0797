/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/means.h"

void ost_visit_means(const OstMesh *mesh, const OstMaterialField *field, const double *u, OstMeansVisit visit,
                     void *data)
{
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    OstBatch batch;
    ost_elasticity_clear(&batch.elasticity);
    for (OstLocal first = 0; first < mesh->owned_tets; first += OST_SIMD_WIDTH) {
        OstSimd of_nodes[3 * OST_MAX_TET_NODES];
        OstMeans means;
        ost_batch_gather_from(&batch, element, mesh, field, first, mesh->owned_tets);
        ost_batch_gather_vectors(&batch, element->nodes, u, of_nodes);
        element->means(batch.x, &batch.elasticity, of_nodes, &means);
        visit(data, &batch, element, of_nodes, &means);
    }
}
