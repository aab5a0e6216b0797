/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/distribution/cluster.h"

#include "core/error.h"
#include "core/interrupt/interrupt.h"
#include "core/memory.h"
#include "core/parallel/numbering.h"

enum {
    CLUSTERS_PER_RANK = 64,  /* enough to balance the parts to a few percent */
    SMALLEST_CLUSTER = 4,    /* with fewer nodes on average, each node is a cluster of its own */
    CLUSTER_IMBALANCE = 300, /* unequal clusters balance out within a part, and cut fewer heavy edges */
    METIS_SEED = 20140721    /* any fixed number: the same mesh always has the same partition */
};

void ost_clusters_clear(Clusters *clusters)
{
    OST_FREE(clusters->of_node);
}

/* METIS needs an edge, and fewer parts than rows. */
static int partition_without_metis(const Graph *graph, idx_t parts, idx_t *part)
{
    if (parts > 1 && parts < graph->rows && graph->start[graph->rows] > 0)
        return 0;
    for (OstLocal i = 0; i < graph->rows; i++)
        part[i] = parts >= graph->rows ? (idx_t)i : (idx_t)((OstGlobal)i * parts / graph->rows);
    return 1;
}

OstStatus ost_metis_partition(OstContext *ctx, const Graph *graph, idx_t parts, idx_t imbalance, idx_t *part)
{
    if (partition_without_metis(graph, parts, part))
        return OST_SUCCESS;
    idx_t options[METIS_NOPTIONS];
    METIS_SetDefaultOptions(options);
    options[METIS_OPTION_SEED] = METIS_SEED;
    options[METIS_OPTION_NUMBERING] = 0;
    options[METIS_OPTION_UFACTOR] = imbalance;
    idx_t rows = graph->rows;
    idx_t constraints = 1;
    idx_t edge_cut = 0;
    const int result = METIS_PartGraphKway(&rows, &constraints, graph->start, graph->neighbour, graph->row_weight, NULL,
                                           graph->edge_weight, &parts, NULL, NULL, options, &edge_cut, part);
    if (result == METIS_ERROR)
        ost_metis_failed();
    if (result == METIS_ERROR_MEMORY)
        return OST_RAISE(ctx, OST_OUT_OF_MEMORY, "METIS ran out of memory when it partitioned a graph of %lld rows",
                         (long long)rows);
    if (result != METIS_OK)
        return OST_RAISE(ctx, OST_LIBRARY_FAILED, "METIS_PartGraphKway returned %d for %lld rows and %lld parts",
                         result, (long long)rows, (long long)parts);
    return OST_SUCCESS;
}

/* The number of clusters for this rank's nodes. */
static idx_t cluster_target(const Slab *slab)
{
    const OstLocal n = slab->node_count;
    if (n == slab->global_nodes)
        return n;
    const double wanted = (double)CLUSTERS_PER_RANK * ost_size(slab->ctx) * n / (double)slab->global_nodes;
    return wanted * SMALLEST_CLUSTER >= n ? n : (idx_t)wanted + 1;
}

/* The graph without its edges to ghosts, with weights that METIS can sum. */
static OstStatus drop_ghosts(OstContext *ctx, const Graph *nodes, Graph *inner)
{
    const OstLocal n = nodes->rows;
    inner->rows = n;
    OST_TRY(OST_NEW(ctx, &inner->start, (size_t)n + 1));
    OST_TRY(OST_NEW(ctx, &inner->neighbour, nodes->start[n]));
    if (nodes->edge_weight)
        OST_TRY(OST_NEW(ctx, &inner->edge_weight, nodes->start[n]));
    idx_t entries = 0;
    for (OstLocal i = 0; i < n; i++) {
        for (idx_t p = nodes->start[i]; p < nodes->start[i + 1]; p++) {
            if (nodes->neighbour[p] >= n)
                continue;
            if (inner->edge_weight)
                inner->edge_weight[entries] = nodes->edge_weight[p];
            inner->neighbour[entries++] = nodes->neighbour[p];
        }
        inner->start[i + 1] = entries;
    }
    if (inner->edge_weight)
        ost_graph_shrink_weights(entries, inner->edge_weight);
    return OST_SUCCESS;
}

static OstStatus cluster_slab(const Slab *slab, const Graph *nodes, Clusters *clusters)
{
    Graph inner = {0};
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(OST_NEW(slab->ctx, &clusters->of_node, (size_t)slab->node_count + (size_t)slab->ghost_count));
    const idx_t target = cluster_target(slab);
    clusters->count = (OstLocal)target;
    if (target < nodes->rows)
        OST_TRY_DONE(drop_ghosts(slab->ctx, nodes, &inner));
    else
        inner.rows = nodes->rows;
    OST_TRY_DONE(ost_metis_partition(slab->ctx, &inner, target, CLUSTER_IMBALANCE, clusters->of_node));
done:
    ost_graph_clear(&inner);
    return status;
}

OstStatus ost_clusters_create(const Slab *slab, const Graph *nodes, Clusters *clusters)
{
    OstContext *ctx = slab->ctx;
    OST_TRY(ost_agree(ctx, cluster_slab(slab, nodes, clusters)));
    OST_TRY(ost_number_from(ctx, clusters->count, &clusters->first, &clusters->total));
    OST_TRY(ost_graph_check_limits(ctx, "graph of node clusters", clusters->total, 0));
    for (OstLocal i = 0; i < slab->node_count; i++)
        clusters->of_node[i] += (idx_t)clusters->first;
    return ost_halo_import(slab->halo, sizeof(idx_t), clusters->of_node);
}

/* Nodes sorted by cluster: node[start[c]] .. node[start[c + 1] - 1]. */
static OstStatus sort_by_cluster(const Slab *slab, const Clusters *clusters, OstLocal **start, OstLocal **node)
{
    OST_TRY(OST_NEW(slab->ctx, start, (size_t)clusters->count + 2));
    OST_TRY(OST_NEW(slab->ctx, node, slab->node_count));
    OstLocal *next = *start + 1;
    for (OstLocal i = 0; i < slab->node_count; i++)
        next[clusters->of_node[i] - clusters->first + 1]++;
    for (OstLocal c = 0; c < clusters->count; c++)
        next[c + 1] += next[c];
    for (OstLocal i = 0; i < slab->node_count; i++)
        (*node)[next[clusters->of_node[i] - clusters->first]++] = i;
    return OST_SUCCESS;
}

/* Adds the edges of one node to its cluster's row, from `begin` to `end`. A cluster has few neighbours: they are looked
 * for one by one. */
static void add_edges(const Graph *nodes, const idx_t *of_node, OstLocal node, idx_t begin, Graph *graph, idx_t *end)
{
    for (idx_t p = nodes->start[node]; p < nodes->start[node + 1]; p++) {
        const idx_t other = of_node[nodes->neighbour[p]];
        if (other == of_node[node])
            continue;
        idx_t place = begin;
        while (place < *end && graph->neighbour[place] != other)
            place++;
        if (place == *end)
            graph->neighbour[(*end)++] = other;
        graph->edge_weight[place] += nodes->edge_weight ? nodes->edge_weight[p] : 1;
    }
}

OstStatus ost_cluster_graph(const Slab *slab, const Graph *nodes, const Clusters *clusters, Graph *graph)
{
    OstContext *ctx = slab->ctx;
    OstLocal *start = NULL;
    OstLocal *node = NULL;
    idx_t end = 0;
    OstStatus status = OST_SUCCESS;
    graph->rows = clusters->count;
    OST_TRY_DONE(sort_by_cluster(slab, clusters, &start, &node));
    OST_TRY_DONE(OST_NEW(ctx, &graph->start, (size_t)graph->rows + 1));
    OST_TRY_DONE(OST_NEW(ctx, &graph->neighbour, nodes->start[nodes->rows]));
    OST_TRY_DONE(OST_NEW(ctx, &graph->edge_weight, nodes->start[nodes->rows]));
    OST_TRY_DONE(OST_NEW(ctx, &graph->row_weight, graph->rows));
    for (OstLocal c = 0; c < graph->rows; c++) {
        for (OstLocal i = start[c]; i < start[c + 1]; i++)
            add_edges(nodes, clusters->of_node, node[i], graph->start[c], graph, &end);
        graph->row_weight[c] = start[c + 1] - start[c];
        graph->start[c + 1] = end;
    }
done:
    OST_FREE(start, node);
    return status;
}
