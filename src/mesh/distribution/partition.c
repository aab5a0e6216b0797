/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/distribution/partition.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "mesh/distribution/cluster.h"

#include <limits.h>

/* Rank 0's graph of all ranks' rows, with the number of rows and entries of each rank. The arrays are NULL elsewhere.
 */
typedef struct Gathering {
    int *row_count, *row_start; /* one block of memory with the two below */
    int *entry_count, *entry_start;
    Graph whole;
} Gathering;

static MPI_Datatype idx_type(void)
{
    return IDXTYPEWIDTH == 64 ? MPI_INT64_T : MPI_INT32_T;
}

static void gathering_clear(Gathering *gathering)
{
    OST_FREE(gathering->row_count);
    ost_graph_clear(&gathering->whole);
}

/* Checks the limits, and allocates the arrays on rank 0. */
static OstStatus make_room(OstContext *ctx, OstGlobal rows, OstGlobal entries, Gathering *gathering)
{
    if (entries > INT_MAX)
        return OST_RAISE(ctx, OST_LIMIT_EXCEEDED, "the graph of node clusters has %lld entries, more than MPI gathers",
                         (long long)entries);
    OST_TRY(ost_graph_check_limits(ctx, "graph of node clusters", rows, entries));
    if (ost_rank(ctx) != 0)
        return OST_SUCCESS;
    const size_t size = (size_t)ost_size(ctx);
    Graph *whole = &gathering->whole;
    whole->rows = (OstLocal)rows;
    OST_TRY(OST_NEW(ctx, &gathering->row_count, 4 * size));
    gathering->row_start = gathering->row_count + size;
    gathering->entry_count = gathering->row_start + size;
    gathering->entry_start = gathering->entry_count + size;
    OST_TRY(OST_NEW(ctx, &whole->start, (size_t)rows + 1));
    OST_TRY(OST_NEW(ctx, &whole->row_weight, rows));
    OST_TRY(OST_NEW(ctx, &whole->neighbour, entries));
    return OST_NEW(ctx, &whole->edge_weight, entries);
}

static OstStatus gather_counts(OstContext *ctx, int rows, int entries, Gathering *gathering)
{
    OST_TRY(OST_MPI(ctx, MPI_Gather(&rows, 1, MPI_INT, gathering->row_count, 1, MPI_INT, 0, ost_comm(ctx))));
    OST_TRY(OST_MPI(ctx, MPI_Gather(&entries, 1, MPI_INT, gathering->entry_count, 1, MPI_INT, 0, ost_comm(ctx))));
    for (int r = 1; ost_rank(ctx) == 0 && r < ost_size(ctx); r++) {
        gathering->row_start[r] = gathering->row_start[r - 1] + gathering->row_count[r - 1];
        gathering->entry_start[r] = gathering->entry_start[r - 1] + gathering->entry_count[r - 1];
    }
    return OST_SUCCESS;
}

/* Each rank counts the ends of its rows from its own first entry: shifts them by the entries of the ranks before. */
static void shift_starts(OstContext *ctx, Gathering *gathering)
{
    for (int r = 1; r < ost_size(ctx); r++)
        for (int i = 0; i < gathering->row_count[r]; i++)
            gathering->whole.start[1 + gathering->row_start[r] + i] += gathering->entry_start[r];
}

static OstStatus gather_graph(OstContext *ctx, const Graph *mine, Gathering *gathering)
{
    const int rows = mine->rows;
    const int entries = (int)mine->start[rows];
    OstGlobal total[2] = {rows, entries};
    Graph *whole = &gathering->whole;
    MPI_Comm comm = ost_comm(ctx);
    OST_TRY(ost_sum_numbers(ctx, 2, total));
    OST_TRY(ost_agree(ctx, make_room(ctx, total[0], total[1], gathering)));
    OST_TRY(gather_counts(ctx, rows, entries, gathering));
    OST_TRY(OST_MPI(ctx, MPI_Gatherv(mine->start + 1, rows, idx_type(), whole->start ? whole->start + 1 : NULL,
                                     gathering->row_count, gathering->row_start, idx_type(), 0, comm)));
    OST_TRY(OST_MPI(ctx, MPI_Gatherv(mine->row_weight, rows, idx_type(), whole->row_weight, gathering->row_count,
                                     gathering->row_start, idx_type(), 0, comm)));
    OST_TRY(OST_MPI(ctx, MPI_Gatherv(mine->neighbour, entries, idx_type(), whole->neighbour, gathering->entry_count,
                                     gathering->entry_start, idx_type(), 0, comm)));
    OST_TRY(OST_MPI(ctx, MPI_Gatherv(mine->edge_weight, entries, idx_type(), whole->edge_weight, gathering->entry_count,
                                     gathering->entry_start, idx_type(), 0, comm)));
    if (ost_rank(ctx) == 0)
        shift_starts(ctx, gathering);
    return OST_SUCCESS;
}

static OstStatus raise_too_small(const Slab *slab)
{
    return OST_RAISE(slab->ctx, OST_INVALID_INPUT, "mesh of %lld nodes is too small for %d ranks; use fewer ranks",
                     (long long)slab->global_nodes, ost_size(slab->ctx));
}

/* Gives an empty part one cluster of the part with the most clusters. */
static OstStatus fill_part(const Slab *slab, const Graph *graph, idx_t empty, OstLocal *clusters, idx_t *part)
{
    idx_t largest = 0;
    for (idx_t p = 1; p < ost_size(slab->ctx); p++)
        if (clusters[p] > clusters[largest])
            largest = p;
    if (clusters[largest] < 2)
        return raise_too_small(slab);
    OstLocal c = graph->rows - 1;
    while (part[c] != largest || graph->row_weight[c] == 0)
        c--;
    part[c] = empty;
    clusters[largest]--;
    clusters[empty]++;
    return OST_SUCCESS;
}

/* METIS may leave parts empty if there are few nodes. */
static OstStatus fill_empty_parts(const Slab *slab, const Graph *graph, idx_t *part)
{
    OstContext *ctx = slab->ctx;
    OstLocal *clusters = NULL; /* with nodes in them, per part */
    OST_TRY(OST_NEW(ctx, &clusters, ost_size(ctx)));
    OstStatus status = OST_SUCCESS;
    for (OstLocal c = 0; c < graph->rows; c++)
        clusters[part[c]] += graph->row_weight[c] > 0;
    for (idx_t p = 0; p < ost_size(ctx) && status == OST_SUCCESS; p++)
        if (clusters[p] == 0)
            status = fill_part(slab, graph, p, clusters, part);
    OST_FREE(clusters);
    return status;
}

/* Rank 0 partitions the gathered graph, and sends each rank the parts of its clusters. */
static OstStatus partition_on_rank_0(const Slab *slab, Gathering *gathering, int clusters, idx_t *cluster_part)
{
    OstContext *ctx = slab->ctx;
    idx_t *part = NULL;
    OstStatus status = OST_SUCCESS;
    if (ost_rank(ctx) == 0) {
        ost_graph_shrink_weights(gathering->whole.rows, gathering->whole.row_weight);
        ost_graph_shrink_weights(gathering->whole.start[gathering->whole.rows], gathering->whole.edge_weight);
        status = OST_NEW(ctx, &part, gathering->whole.rows);
        OST_THEN(ost_metis_partition(ctx, &gathering->whole, ost_size(ctx), PART_IMBALANCE, part));
        OST_THEN(fill_empty_parts(slab, &gathering->whole, part));
    }
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(OST_MPI(ctx, MPI_Scatterv(part, gathering->row_count, gathering->row_start, idx_type(), cluster_part,
                                           clusters, idx_type(), 0, ost_comm(ctx))));
done:
    OST_FREE(part);
    return status;
}

static OstStatus partition_clusters(const Slab *slab, const Graph *nodes, const Clusters *clusters, int *part)
{
    OstContext *ctx = slab->ctx;
    Graph mine = {0};
    Gathering gathering = {0};
    idx_t *cluster_part = NULL;
    OstStatus status = ost_cluster_graph(slab, nodes, clusters, &mine);
    OST_THEN(OST_NEW(ctx, &cluster_part, clusters->count));
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(gather_graph(ctx, &mine, &gathering));
    OST_TRY_DONE(partition_on_rank_0(slab, &gathering, clusters->count, cluster_part));
    for (OstLocal i = 0; i < slab->node_count; i++)
        part[i] = (int)cluster_part[clusters->of_node[i] - clusters->first];
    OST_TRY_DONE(ost_halo_import(slab->halo, sizeof *part, part));
done:
    OST_FREE(cluster_part);
    gathering_clear(&gathering);
    ost_graph_clear(&mine);
    return status;
}

OstStatus ost_partition(const Slab *slab, const NodeMetric *metric, int *part)
{
    OstContext *ctx = slab->ctx;
    Graph nodes = {0};
    Clusters clusters = {0};
    OstStatus status = OST_SUCCESS;
    if (slab->global_nodes < ost_size(ctx))
        return raise_too_small(slab);
    status = ost_graph_of_nodes(slab, &nodes);
    if (status == OST_SUCCESS && metric)
        status = ost_graph_weigh_edges(slab, metric, &nodes);
    OST_TRY_DONE(ost_agree(ctx, status));
    OST_TRY_DONE(ost_clusters_create(slab, &nodes, &clusters));
    OST_TRY_DONE(partition_clusters(slab, &nodes, &clusters, part));
done:
    ost_graph_clear(&nodes);
    ost_clusters_clear(&clusters);
    return status;
}
