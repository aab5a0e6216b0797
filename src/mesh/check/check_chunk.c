/* SPDX-License-Identifier: BSD-3-Clause */
#include "core/error.h"
#include "core/number_range.h"
#include "core/parallel/numbering.h"
#include "core/parallel/reduce.h"
#include "mesh/check/check.h"

#include <math.h>

static OstGlobal node_label(const OstMeshChunk *chunk, OstLocal i)
{
    return chunk->node_label ? chunk->node_label[i] : chunk->first_node + i + 1;
}

static OstGlobal tet_label(const OstMeshChunk *chunk, OstLocal t)
{
    return chunk->tet_label ? chunk->tet_label[t] : chunk->first_tet + t + 1;
}

/* Checks that the ranks' ranges are contiguous and add up to the total. Sets `first` of an empty range. */
static OstStatus check_range(OstContext *ctx, const char *what, OstGlobal *first, OstLocal count, OstGlobal total)
{
    OstGlobal before = 0;
    OstGlobal sum = 0;
    OST_TRY(ost_number_from(ctx, count, &before, &sum));
    if (count == 0)
        *first = before;
    OstStatus status = OST_SUCCESS;
    if (sum != total || *first != before)
        status = OST_RAISE(ctx, OST_INVALID_INPUT,
                           "rank %d has %d %s of the mesh from number %lld on, expected from %lld on, and %lld in all "
                           "(found %lld)",
                           ost_rank(ctx), count, what, (long long)*first, (long long)before, (long long)total,
                           (long long)sum);
    return ost_agree(ctx, status);
}

/* All ranks must describe the same mesh, or later collective calls would not match. */
static OstStatus check_kind(const OstMeshChunk *chunk)
{
    OstContext *ctx = chunk->ctx;
    OstGlobal kind[10] = {chunk->nodes_per_tet, chunk->boundary_count, chunk->regions.count, chunk->global_nodes,
                          chunk->global_tets};
    for (int i = 0; i < 5; i++)
        kind[5 + i] = -kind[i];
    OST_TRY(ost_max_numbers(ctx, 10, kind));
    for (int i = 0; i < 5; i++)
        if (kind[i] != -kind[5 + i])
            return OST_RAISE(ctx, OST_INVALID_INPUT,
                             "the ranks hold shares of different meshes: nodes per tet, boundaries, regions, nodes or "
                             "tets differ between them");
    if (chunk->nodes_per_tet != 4 && chunk->nodes_per_tet != 10)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "the mesh has tets of %d nodes, expected 4 or 10",
                         chunk->nodes_per_tet);
    if (chunk->global_tets < 1)
        return OST_RAISE(ctx, OST_INVALID_INPUT,
                         "the mesh has %lld nodes and no tet; mesh the volume of the body, not its surface alone",
                         (long long)chunk->global_nodes);
    return OST_SUCCESS;
}

static OstStatus check_coordinates(const OstMeshChunk *chunk)
{
    for (OstLocal i = 0; i < chunk->node_count; i++) {
        const double *x = chunk->coordinates + 3 * (size_t)i;
        for (int d = 0; d < 3; d++)
            if (!(fabs(x[d]) <= OST_MOST_NUMBER))
                return OST_RAISE(
                    chunk->ctx, OST_INVALID_INPUT,
                    "vertex %lld has coordinate %g in (%g, %g, %g); coordinates up to %g in size can be computed "
                    "with: mend the mesh, or choose another unit of length",
                    (long long)node_label(chunk, i), x[d], x[0], x[1], x[2], OST_MOST_NUMBER);
    }
    return OST_SUCCESS;
}

static OstStatus check_tet(const OstMeshChunk *chunk, OstLocal t, const OstGlobal *nodes)
{
    const long long label = tet_label(chunk, t);
    for (int v = 0; v < chunk->nodes_per_tet; v++) {
        if (nodes[v] < 0 || nodes[v] >= chunk->global_nodes)
            return OST_RAISE(chunk->ctx, OST_INVALID_INPUT,
                             "tet %lld uses node number %lld (counted from 0), but the mesh has %lld nodes", label,
                             (long long)nodes[v], (long long)chunk->global_nodes);
        for (int w = 0; w < v; w++)
            if (nodes[v] == nodes[w])
                return OST_RAISE(chunk->ctx, OST_INVALID_INPUT,
                                 "tet %lld uses the same node twice, as its nodes %d and %d; give it %d different "
                                 "nodes",
                                 label, w + 1, v + 1, chunk->nodes_per_tet);
    }
    if (chunk->tet_region[t] < 0 || chunk->tet_region[t] >= chunk->regions.count)
        return OST_RAISE(chunk->ctx, OST_INVALID_INPUT, "tet %lld is in region number %d, but the mesh has %d regions",
                         label, chunk->tet_region[t], chunk->regions.count);
    return OST_SUCCESS;
}

static OstStatus check_boundary(const OstMeshChunk *chunk, const OstBoundary *boundary)
{
    const size_t entries = (size_t)boundary->count * (size_t)boundary->nodes_per_item;
    for (size_t i = 0; i < entries; i++)
        if (boundary->nodes[i] < 0 || boundary->nodes[i] >= chunk->global_nodes)
            return OST_RAISE(chunk->ctx, OST_INVALID_INPUT,
                             "boundary '%s' uses node number %lld (counted from 0), but the mesh has %lld nodes",
                             boundary->name, (long long)boundary->nodes[i], (long long)chunk->global_nodes);
    return OST_SUCCESS;
}

static OstStatus check_share(const OstMeshChunk *chunk)
{
    OST_TRY(check_coordinates(chunk));
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        OST_TRY(check_tet(chunk, t, chunk->tet_nodes + (size_t)t * (size_t)chunk->nodes_per_tet));
    for (int b = 0; b < chunk->boundary_count; b++)
        OST_TRY(check_boundary(chunk, &chunk->boundaries[b]));
    return OST_SUCCESS;
}

OstStatus ost_check_chunk(OstMeshChunk *chunk)
{
    OstContext *ctx = chunk->ctx;
    OST_TRY(check_kind(chunk));
    OST_TRY(check_range(ctx, "nodes", &chunk->first_node, chunk->node_count, chunk->global_nodes));
    OST_TRY(check_range(ctx, "tets", &chunk->first_tet, chunk->tet_count, chunk->global_tets));
    return ost_agree(ctx, check_share(chunk));
}
