/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_VTKHDF_WHOLE_H
#define ORTHOSTAT_TESTS_VTKHDF_WHOLE_H

#include "core/memory.h"
#include "core/small.h"
#include "mesh/mesh_data.h"
#include "support.h"

/* A small mesh gathered on every rank and put in the order of its labels, which must be 1, 2, 3, ..., so that two that
 * were cut up differently can be compared. */
typedef struct Whole {
    OstMeshChunk *chunk; /* for names and counts; not owned */
    OstGlobal nodes, tets;
    int nodes_per_tet;
    double *coordinates;   /* by node label */
    OstGlobal *tet_nodes;  /* by tet label: node labels */
    int32_t *tet_region;   /* by tet label */
    OstGlobal *item_count; /* of each boundary */
    OstGlobal **boundary;  /* labels of the items, sorted */
} Whole;

/* Every rank's `count` items in a row, on all ranks. */
static void *gather_items(OstContext *context, size_t count, size_t size, const void *mine, OstGlobal *total)
{
    const int ranks = ost_size(context);
    const int bytes = (int)(count * size);
    int *length = calloc((size_t)ranks, sizeof *length);
    int *start = calloc((size_t)ranks + 1, sizeof *start);
    MPI_Allgather(&bytes, 1, MPI_INT, length, 1, MPI_INT, ost_comm(context));
    for (int r = 0; r < ranks; r++)
        start[r + 1] = start[r] + length[r];
    char *all = calloc((size_t)start[ranks] + 1, 1);
    MPI_Allgatherv(mine, bytes, MPI_BYTE, all, length, start, MPI_BYTE, ost_comm(context));
    *total = start[ranks] / (OstGlobal)size;
    free(length);
    free(start);
    return all;
}

static int compare_items(const void *a, const void *b, void *width)
{
    return memcmp(a, b, *(size_t *)width);
}

/* Labels, or 1, 2, 3, ... where there are none; freed by the caller. */
static OstGlobal *gather_labels(OstContext *context, OstLocal count, OstGlobal first, const OstGlobal *label,
                                OstGlobal *total)
{
    OstGlobal *mine = calloc((size_t)count + 1, sizeof *mine);
    for (OstLocal i = 0; i < count; i++)
        mine[i] = label ? label[i] : first + i + 1;
    OstGlobal *all = gather_items(context, (size_t)count, sizeof *mine, mine, total);
    free(mine);
    for (OstGlobal i = 0; i < *total; i++)
        assert_in_range(all[i], 1, *total);
    return all;
}

static void gather_tets(const OstMeshChunk *chunk, const OstGlobal *node_label, Whole *whole)
{
    const size_t n = (size_t)chunk->nodes_per_tet;
    OstGlobal total;
    OstGlobal *label = gather_labels(chunk->ctx, chunk->tet_count, chunk->first_tet, chunk->tet_label, &whole->tets);
    OstGlobal *nodes = gather_items(chunk->ctx, (size_t)chunk->tet_count, n * sizeof *nodes, chunk->tet_nodes, &total);
    int32_t *region = gather_items(chunk->ctx, (size_t)chunk->tet_count, sizeof *region, chunk->tet_region, &total);
    whole->tet_nodes = calloc((size_t)whole->tets * n, sizeof *whole->tet_nodes);
    whole->tet_region = calloc((size_t)whole->tets, sizeof *whole->tet_region);
    for (OstGlobal t = 0; t < whole->tets; t++) {
        whole->tet_region[label[t] - 1] = region[t];
        for (size_t k = 0; k < n; k++) {
            assert_in_range(nodes[(size_t)t * n + k], 0, whole->nodes - 1);
            whole->tet_nodes[(size_t)(label[t] - 1) * n + k] = node_label[nodes[(size_t)t * n + k]];
        }
    }
    free(label);
    free(nodes);
    free(region);
}

static void gather_boundaries(const OstMeshChunk *chunk, const OstGlobal *node_label, Whole *whole)
{
    whole->boundary = calloc((size_t)chunk->boundary_count + 1, sizeof *whole->boundary);
    whole->item_count = calloc((size_t)chunk->boundary_count + 1, sizeof *whole->item_count);
    for (int b = 0; b < chunk->boundary_count; b++) {
        const OstBoundary *boundary = &chunk->boundaries[b];
        size_t width = (size_t)boundary->nodes_per_item * sizeof(OstGlobal);
        OstGlobal *items =
            gather_items(chunk->ctx, (size_t)boundary->count, width, boundary->nodes, &whole->item_count[b]);
        for (OstGlobal i = 0; i < whole->item_count[b] * boundary->nodes_per_item; i++) {
            assert_in_range(items[i], 0, whole->nodes - 1);
            items[i] = node_label[items[i]];
        }
        qsort_r(items, (size_t)whole->item_count[b], width, compare_items, &width);
        whole->boundary[b] = items;
    }
}

static void gather_whole(OstMeshChunk *chunk, Whole *whole)
{
    OstGlobal total;
    *whole = (Whole){.chunk = chunk, .nodes_per_tet = chunk->nodes_per_tet};
    OstGlobal *label =
        gather_labels(chunk->ctx, chunk->node_count, chunk->first_node, chunk->node_label, &whole->nodes);
    double *place = gather_items(chunk->ctx, (size_t)chunk->node_count, 3 * sizeof *place, chunk->coordinates, &total);
    whole->coordinates = calloc((size_t)whole->nodes * 3, sizeof *whole->coordinates);
    for (OstGlobal i = 0; i < whole->nodes; i++)
        memcpy(whole->coordinates + 3 * (label[i] - 1), place + 3 * i, 3 * sizeof *place);
    gather_tets(chunk, label, whole);
    gather_boundaries(chunk, label, whole);
    assert_int_equal(whole->nodes, chunk->global_nodes);
    assert_int_equal(whole->tets, chunk->global_tets);
    free(label);
    free(place);
}

static void free_whole(Whole *whole)
{
    for (int b = 0; b < whole->chunk->boundary_count; b++)
        free(whole->boundary[b]);
    free(whole->boundary);
    free(whole->item_count);
    free(whole->coordinates);
    free(whole->tet_nodes);
    free(whole->tet_region);
}

static void expect_same(const Whole *a, const Whole *b)
{
    assert_int_equal(a->nodes, b->nodes);
    assert_int_equal(a->tets, b->tets);
    assert_int_equal(a->nodes_per_tet, b->nodes_per_tet);
    assert_memory_equal(a->coordinates, b->coordinates, (size_t)a->nodes * 3 * sizeof(double));
    assert_memory_equal(a->tet_nodes, b->tet_nodes, (size_t)(a->tets * a->nodes_per_tet) * sizeof(OstGlobal));
    assert_memory_equal(a->tet_region, b->tet_region, (size_t)a->tets * sizeof(int32_t));
    assert_int_equal(a->chunk->regions.count, b->chunk->regions.count);
    for (int r = 0; r < a->chunk->regions.count; r++)
        assert_string_equal(a->chunk->regions.name[r], b->chunk->regions.name[r]);
    assert_int_equal(a->chunk->boundary_count, b->chunk->boundary_count);
    for (int i = 0; i < a->chunk->boundary_count; i++) {
        const OstBoundary *left = &a->chunk->boundaries[i], *right = &b->chunk->boundaries[i];
        assert_string_equal(left->name, right->name);
        assert_int_equal(left->dimension, right->dimension);
        assert_int_equal(left->nodes_per_item, right->nodes_per_item);
        assert_int_equal(a->item_count[i], b->item_count[i]);
        assert_true(a->item_count[i] > 0);
        assert_memory_equal(a->boundary[i], b->boundary[i],
                            (size_t)(a->item_count[i] * left->nodes_per_item) * sizeof(OstGlobal));
    }
}

/* Sum of the tets' volumes. */
static double whole_volume(const Whole *whole)
{
    double volume = 0.0;
    for (OstGlobal t = 0; t < whole->tets; t++) {
        double edge[9];
        const OstGlobal *nodes = whole->tet_nodes + t * whole->nodes_per_tet;
        for (int k = 0; k < 9; k++)
            edge[k] =
                whole->coordinates[3 * (nodes[1 + k / 3] - 1) + k % 3] - whole->coordinates[3 * (nodes[0] - 1) + k % 3];
        volume += ost_determinant3(edge) / 6.0;
    }
    return volume;
}

#endif
