/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_ASSEMBLY_BATCH_H
#define ORTHOSTAT_ASSEMBLY_BATCH_H

#include "element/element.h"
#include "mesh/mesh_data.h"

/* As many tets as there are lanes, with what the kernels read of them. Where fewer are left, the last one fills the
 * other lanes, and only the first `count` lanes may be used. */
typedef struct OstBatch {
    int count;
    OstLocal tet[OST_LANES];
    OstLocal node[OST_LANES][OST_MAX_TET_NODES];
    OstLanes x[3 * OST_MAX_TET_NODES];
    OstElasticity elasticity;
} OstBatch;

/* A linear tet's vertices in ascending order. Stiffness and forces do not depend on the order, and in this one every
 * block of the upper triangle of the tet's matrix is in the upper triangle of the body's. */
static inline void ost_sort_vertices(const OstLocal *vertices, OstLocal *sorted)
{
    const OstLocal low01 = vertices[0] < vertices[1] ? vertices[0] : vertices[1];
    const OstLocal high01 = vertices[0] < vertices[1] ? vertices[1] : vertices[0];
    const OstLocal low23 = vertices[2] < vertices[3] ? vertices[2] : vertices[3];
    const OstLocal high23 = vertices[2] < vertices[3] ? vertices[3] : vertices[2];
    const OstLocal low = low01 < low23 ? low23 : low01;
    const OstLocal high = high01 < high23 ? high01 : high23;
    sorted[0] = low01 < low23 ? low01 : low23;
    sorted[1] = low < high ? low : high;
    sorted[2] = low < high ? high : low;
    sorted[3] = high01 < high23 ? high23 : high01;
}

/* A tet's nodes in the order that batches and the pattern take them in. */
static inline void ost_order_nodes(int count, const OstLocal *nodes, OstLocal *ordered)
{
    if (count == 4) {
        ost_sort_vertices(nodes, ordered);
        return;
    }
    for (int a = 0; a < count; a++)
        ordered[a] = nodes[a];
}

/* Local. Takes up `count` tets (1 to OST_LANES): nodes, coordinates, elasticity. */
void ost_batch_gather(OstBatch *batch, const OstElement *element, const OstMesh *mesh, const OstMaterialField *field,
                      int count, const OstLocal *tets);

/* Local. The tets from `first` on, as many as there are lanes, up to `end`. */
void ost_batch_gather_from(OstBatch *batch, const OstElement *element, const OstMesh *mesh,
                           const OstMaterialField *field, OstLocal first, OstLocal end);

/* Local. Three numbers of each node, into lanes. */
void ost_batch_gather_vectors(const OstBatch *batch, int nodes, const double *vectors, OstLanes *lanes);

#endif
