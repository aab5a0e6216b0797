/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/memory.h"
#include "mesh/distribution/partition.h"

#include <math.h>
#include <string.h>

static OstStatus find_positions(const OstMeshChunk *chunk, const Slab *slab, double *position)
{
    if (slab->node_count > 0)
        memcpy(position, chunk->coordinates, 3 * (size_t)slab->node_count * sizeof *position);
    return ost_halo_import(slab->halo, 3 * sizeof *position, position);
}

static void find_centroids(const OstMeshChunk *chunk, const Slab *slab, const double *position, double *centroid)
{
    const size_t width = (size_t)chunk->nodes_per_tet;
    for (size_t t = 0; t < (size_t)chunk->tet_count; t++)
        for (size_t v = 0; v < 4; v++) {
            const OstLocal node = slab->tet_nodes[width * t + v];
            for (size_t c = 0; c < 3; c++)
                centroid[3 * t + c] += 0.25 * position[3 * (size_t)node + c];
        }
}

enum { SUMS = 7 }; /* of a node: six numbers of the metric, and the number of tets */

/* Each tet of the chunk is on one rank only, so the sums are complete once the nodes' owners have added all ranks'. */
static OstStatus sum_metrics(const OstMeshChunk *chunk, const Slab *slab, const double *of_tet, double *sums)
{
    const size_t width = (size_t)chunk->nodes_per_tet;
    for (size_t t = 0; t < (size_t)chunk->tet_count; t++)
        for (size_t v = 0; v < width; v++) {
            double *sum = sums + SUMS * (size_t)slab->tet_nodes[width * t + v];
            for (size_t c = 0; c < 6; c++)
                sum[c] += of_tet[6 * t + c];
            sum[6] += 1.0;
        }
    OST_TRY(ost_halo_add_to_owners(slab->halo, SUMS, sums));
    return ost_halo_import(slab->halo, SUMS * sizeof *sums, sums);
}

OstStatus ost_node_metrics_create(const OstMeshChunk *chunk, const Slab *slab, const OstTetMetric *tets,
                                  NodeMetric **nodes)
{
    OstContext *ctx = chunk->ctx;
    const size_t n = (size_t)slab->node_count + (size_t)slab->ghost_count;
    double *position = NULL, *centroid = NULL, *of_tet = NULL, *sums = NULL;
    OstStatus status = OST_NEW(ctx, &position, 3 * n);
    OST_THEN(OST_NEW(ctx, &centroid, 3 * (size_t)chunk->tet_count));
    OST_THEN(OST_NEW(ctx, &of_tet, 6 * (size_t)chunk->tet_count));
    OST_THEN(OST_NEW(ctx, &sums, SUMS * n));
    OST_THEN(OST_NEW(ctx, nodes, n));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(find_positions(chunk, slab, position));
    find_centroids(chunk, slab, position, centroid);
    OST_TRY_DONE(ost_agree(ctx, tets->fill(tets->data, chunk, centroid, of_tet)));
    OST_TRY_DONE(sum_metrics(chunk, slab, of_tet, sums));
    for (size_t i = 0; i < n; i++) {
        memcpy((*nodes)[i].position, position + 3 * i, sizeof(*nodes)[i].position);
        for (size_t c = 0; c < 6; c++)
            (*nodes)[i].metric[c] =
                sums[SUMS * i + c] / fmax(sums[SUMS * i + 6], 1.0); /* ost_check_mesh: without tets */
    }
done:
    OST_FREE(position, centroid, of_tet, sums);
    return status;
}

static idx_t edge_weight(const NodeMetric *a, const NodeMetric *b)
{
    double d[3], w[6];
    for (int c = 0; c < 3; c++)
        d[c] = b->position[c] - a->position[c];
    for (int c = 0; c < 6; c++)
        w[c] = 0.5 * (a->metric[c] + b->metric[c]);
    const double plain = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    const double square = w[0] * d[0] * d[0] + w[1] * d[1] * d[1] + w[2] * d[2] * d[2] +
                          2.0 * (w[3] * d[0] * d[1] + w[4] * d[1] * d[2] + w[5] * d[2] * d[0]);
    const double ratio = plain / square; /* not finite if the nodes coincide */
    return ratio > 1.0 ? (idx_t)lround(fmin(ratio, HEAVIEST_EDGE)) : 1;
}

OstStatus ost_graph_weigh_edges(const Slab *slab, const NodeMetric *nodes, Graph *graph)
{
    OST_TRY(OST_NEW(slab->ctx, &graph->edge_weight, graph->start[graph->rows]));
    for (OstLocal i = 0; i < graph->rows; i++)
        for (idx_t p = graph->start[i]; p < graph->start[i + 1]; p++)
            graph->edge_weight[p] = edge_weight(&nodes[i], &nodes[graph->neighbour[p]]);
    return OST_SUCCESS;
}
