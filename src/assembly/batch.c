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

void ost_batch_gather(OstBatch *batch, const OstMesh *mesh, const OstMaterialField *field, int count,
                      const OstLocal *tets)
{
    const int nodes = mesh->nodes_per_tet;
    batch->count = count;
    for (int lane = 0; lane < OST_LANES; lane++) {
        const OstLocal tet = tets[lane < count ? lane : count - 1];
        batch->tet[lane] = tet;
        ost_order_nodes(nodes, mesh->tet_nodes + (size_t)nodes * (size_t)tet, batch->node[lane]);
    }
    ost_batch_gather_vectors(batch, nodes, mesh->coordinates, batch->x);
    ost_elasticity_gather(&batch->elasticity, field, batch->tet);
}
