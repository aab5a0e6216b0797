/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/distribution/graph.h"

#include "core/error.h"
#include "core/memory.h"
#include "mesh/incidence.h"

#include <math.h>

void ost_graph_clear(Graph *graph)
{
    OST_FREE(graph->start, graph->neighbour, graph->edge_weight, graph->row_weight);
}

OstStatus ost_graph_check_limits(OstContext *ctx, const char *what, OstGlobal rows, OstGlobal entries)
{
    const OstGlobal limit = IDX_MAX;
    if (rows > limit || entries > limit)
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED,
                         "METIS (idx_t of %d bits) numbers at most %lld graph rows and entries, but the %s has %lld "
                         "rows and %lld entries; read the mesh in parallel (.vtkhdf) on more ranks, or use a METIS "
                         "with 64-bit idx_t",
                         IDXTYPEWIDTH, (long long)limit, what, (long long)rows, (long long)entries);
    return OST_SUCCESS;
}

void ost_graph_shrink_weights(OstGlobal count, idx_t *weight)
{
    double sum = 0.0;
    for (OstGlobal i = 0; i < count; i++)
        sum += (double)weight[i];
    const double limit = (double)(IDX_MAX / 2); /* rounding up adds at most `count` */
    if (sum <= limit)
        return;
    for (OstGlobal i = 0; i < count; i++)
        weight[i] = (idx_t)ceil((double)weight[i] * (limit / sum));
}

/* Lists the neighbours of one node, each once; with neighbour NULL only counts. seen[n] is the last node of which n was
 * found to be a neighbour. */
static OstLocal list_neighbours(const Slab *slab, const Incidence *incidence, OstLocal node, OstLocal *seen,
                                idx_t *neighbour)
{
    const size_t width = (size_t)slab->nodes_per_tet;
    OstLocal count = 0;
    seen[node] = node;
    for (OstGlobal p = incidence->start[node]; p < incidence->start[node + 1]; p++) {
        const OstLocal *nodes = slab->tet_nodes + (size_t)incidence->tet[p] * width;
        for (size_t v = 0; v < width; v++) {
            if (seen[nodes[v]] == node)
                continue;
            seen[nodes[v]] = node;
            if (neighbour)
                neighbour[count] = nodes[v];
            count++;
        }
    }
    return count;
}

static OstStatus fill_rows(const Slab *slab, const Incidence *incidence, OstLocal *seen, Graph *graph)
{
    const OstLocal n = slab->node_count;
    const OstLocal all = n + slab->ghost_count;
    OstGlobal entries = 0;
    for (OstLocal i = 0; i < all; i++)
        seen[i] = -1;
    for (OstLocal i = 0; i < n; i++)
        entries += list_neighbours(slab, incidence, i, seen, NULL);
    OST_TRY(ost_graph_check_limits(slab->ctx, "nodal graph of one rank's part of the mesh", n, entries));
    OST_TRY(OST_NEW(slab->ctx, &graph->start, (size_t)n + 1));
    OST_TRY(OST_NEW(slab->ctx, &graph->neighbour, entries));
    for (OstLocal i = 0; i < all; i++)
        seen[i] = -1;
    for (OstLocal i = 0; i < n; i++)
        graph->start[i + 1] =
            graph->start[i] + list_neighbours(slab, incidence, i, seen, graph->neighbour + graph->start[i]);
    return OST_SUCCESS;
}

OstStatus ost_graph_of_nodes(const Slab *slab, Graph *graph)
{
    Incidence incidence = {0};
    OstLocal *seen = NULL;
    OstStatus status = OST_SUCCESS;
    graph->rows = slab->node_count;
    OST_TRY_DONE(ost_incidence_build(slab->ctx, slab->node_count, slab->tet_count, slab->nodes_per_tet, slab->tet_nodes,
                                     &incidence));
    OST_TRY_DONE(OST_NEW(slab->ctx, &seen, (size_t)slab->node_count + (size_t)slab->ghost_count));
    OST_TRY_DONE(fill_rows(slab, &incidence, seen, graph));
done:
    OST_FREE(seen);
    ost_incidence_clear(&incidence);
    return status;
}
