/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/batch.h"

void ost_batch_gather_vectors(const OstBatch *batch, int nodes, const double *vectors, OstLanes *lanes)
{
    for (int a = 0; a < nodes; a++)
        for (int lane = 0; lane < OST_LANES; lane++) {
            const double *vector = vectors + 3 * (size_t)batch->node[lane][a];
            for (int i = 0; i < 3; i++)
                lanes[3 * a + i][lane] = vector[i];
        }
}

void ost_batch_gather(OstBatch *batch, const OstElement *element, const OstMesh *mesh, const OstMaterialField *field,
                      int count, const OstLocal *tets)
{
    const int nodes = element->nodes;
    OstLanes places[3 * OST_MAX_POINTS]; /* asked for where axes come from a formula alone */
    batch->count = count;
    for (int lane = 0; lane < OST_LANES; lane++) {
        const OstLocal tet = tets[lane < count ? lane : count - 1];
        batch->tet[lane] = tet;
        ost_order_nodes(nodes, mesh->tet_nodes + (size_t)nodes * (size_t)tet, batch->node[lane]);
    }
    ost_batch_gather_vectors(batch, nodes, mesh->coordinates, batch->x);
    if (field->region_formula && element->points > 0)
        element->places(batch->x, places);
    ost_elasticity_gather(&batch->elasticity, field, batch->tet, element->points, places);
}

void ost_batch_gather_from(OstBatch *batch, const OstElement *element, const OstMesh *mesh,
                           const OstMaterialField *field, OstLocal first, OstLocal end)
{
    const OstLocal left = end - first;
    OstLocal tets[OST_LANES];
    for (int lane = 0; lane < OST_LANES; lane++)
        tets[lane] = first + lane;
    ost_batch_gather(batch, element, mesh, field, left < OST_LANES ? (int)left : OST_LANES, tets);
}
