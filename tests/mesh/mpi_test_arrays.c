/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "mesh_support.h"

enum { BOUNDARIES = 6 };

/* A block of one region with its sides, as arrays of this rank's share; the chunk keeps what they point to. */
typedef struct BlockArrays {
    OstMeshChunk *chunk;
    OstBoundaryArrays side[BOUNDARIES];
    OstMeshArrays arrays;
} BlockArrays;

static void make_block(BlockArrays *block)
{
    const OstBlockShape shape = {{0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}, {3, 2, 4}};
    assert_success(ost_chunk_create_block(ctx, &shape, &block->chunk));
    const OstMeshChunk *chunk = block->chunk;
    for (int b = 0; b < BOUNDARIES; b++)
        block->side[b] = (OstBoundaryArrays){.name = chunk->boundaries[b].name,
                                             .dimension = 2,
                                             .count = chunk->boundaries[b].count,
                                             .nodes = chunk->boundaries[b].nodes};
    block->arrays = (OstMeshArrays){.nodes_per_tet = 4,
                                    .node_count = chunk->node_count,
                                    .coordinates = chunk->coordinates,
                                    .tet_count = chunk->tet_count,
                                    .tet_nodes = chunk->tet_nodes,
                                    .boundary_count = BOUNDARIES,
                                    .boundaries = block->side};
}

static void the_mesh_is_that_of_the_arrays_and_they_are_copied(void **state)
{
    BlockArrays block;
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    OstMesh *expected = NULL;
    make_block(&block);
    assert_success(ost_chunk_create_from_arrays(ctx, &block.arrays, &chunk));
    assert_success(ost_mesh_distribute(ctx, &block.chunk, &expected));
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_int_equal(mesh->global_tets, 6 * 3 * 2 * 4);
    assert_int_equal(mesh->node_count, expected->node_count);
    assert_memory_equal(mesh->coordinates, expected->coordinates, 3 * sizeof(double) * (size_t)mesh->node_count);
    assert_memory_equal(mesh->node_label, expected->node_label, sizeof(OstGlobal) * (size_t)mesh->node_count);
    assert_int_equal(mesh->tet_count, expected->tet_count);
    assert_memory_equal(mesh->tet_nodes, expected->tet_nodes, 4 * sizeof(OstLocal) * (size_t)mesh->tet_count);
    assert_string_equal(mesh->regions.name[0], "body");
    assert_int_equal(mesh->boundary_count, BOUNDARIES);
    for (int b = 0; b < BOUNDARIES; b++) {
        const OstBoundary *side = &mesh->boundaries[b];
        assert_string_equal(side->name, expected->boundaries[b].name);
        assert_int_equal(side->count, expected->boundaries[b].count);
        assert_memory_equal(side->nodes, expected->boundaries[b].nodes, 3 * sizeof(OstGlobal) * (size_t)side->count);
    }
    ost_mesh_destroy(&mesh);
    ost_mesh_destroy(&expected);
}

/* Two tets of a region each, with axes, and a boundary of each dimension; all of it on rank 0. */
static const double two_tets_x[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
static const OstGlobal two_tets[] = {0, 1, 2, 3, 1, 2, 3, 4};
static const double two_tets_axes[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 1, 0, 0};
static const int32_t two_tets_region[] = {1, 0};
static const char *const two_names[] = {"top", "foot"};
static const OstGlobal corner[] = {4};
static const OstGlobal edge[] = {0, 1};
static const OstGlobal face[] = {0, 2, 1};
static const OstBoundaryArrays two_tets_boundaries[] = {
    {"corner", 0, 1, corner}, {"edge", 1, 1, edge}, {"face", 2, 1, face}};

static OstMeshArrays two_tets_arrays(void)
{
    return (OstMeshArrays){.nodes_per_tet = 4,
                           .node_count = 5,
                           .coordinates = two_tets_x,
                           .tet_count = 2,
                           .tet_nodes = two_tets,
                           .tet_axes = two_tets_axes,
                           .tet_region = two_tets_region,
                           .region_count = 2,
                           .region_names = two_names,
                           .boundary_count = 3,
                           .boundaries = two_tets_boundaries};
}

static void rank_0_may_bring_it_all(void **state)
{
    const OstMeshArrays arrays = two_tets_arrays();
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    assert_success(ost_chunk_create_from_arrays(ctx, ost_rank(ctx) == 0 ? &arrays : NULL, &chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_int_equal(mesh->global_nodes, 5);
    assert_int_equal(ost_mesh_find_region(mesh, "foot"), 1);
    assert_int_equal(ost_mesh_find_boundary(mesh, "face"), 2);
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        const size_t from = (size_t)mesh->tet_label[t] - 1;
        assert_int_equal(mesh->tet_region[t], two_tets_region[from]);
        assert_memory_equal(mesh->tet_axes + 9 * (size_t)t, two_tets_axes + 9 * from, 9 * sizeof(double));
    }
    ost_mesh_destroy(&mesh);
}

static void a_mesh_can_be_read_by_functions_alone(void **state)
{
    const OstMeshArrays arrays = two_tets_arrays();
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    assert_success(ost_chunk_create_from_arrays(ctx, ost_rank(ctx) == 0 ? &arrays : NULL, &chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_int_equal(ost_mesh_nodes_per_tet(mesh), 4);
    assert_int_equal(ost_mesh_global_nodes(mesh), 5);
    assert_int_equal(ost_mesh_global_tets(mesh), 2);
    assert_int_equal(ost_mesh_region_count(mesh), 2);
    assert_string_equal(ost_mesh_region_name(mesh, 1), "foot");
    assert_int_equal(ost_mesh_boundary_count(mesh), 3);
    assert_string_equal(ost_mesh_boundary_name(mesh, 1), "edge");
    OstGlobal owned[2] = {ost_mesh_owned_nodes(mesh), ost_mesh_owned_tets(mesh)};
    MPI_Allreduce(MPI_IN_PLACE, owned, 2, MPI_INT64_T, MPI_SUM, ost_comm(ctx));
    assert_int_equal(owned[0], 5);
    assert_int_equal(owned[1], 2);
    for (OstLocal n = 0; n < ost_mesh_node_count(mesh); n++)
        assert_memory_equal(ost_mesh_coordinates(mesh) + 3 * n, two_tets_x + 3 * (ost_mesh_node_labels(mesh)[n] - 1),
                            3 * sizeof(double));
    for (OstLocal t = 0; t < ost_mesh_tet_count(mesh); t++) {
        const OstGlobal from = ost_mesh_tet_labels(mesh)[t] - 1;
        for (int v = 0; v < 4; v++)
            assert_int_equal(ost_mesh_node_labels(mesh)[ost_mesh_tet_nodes(mesh)[4 * t + v]] - 1,
                             two_tets[4 * from + v]);
        assert_int_equal(ost_mesh_tet_regions(mesh)[t], two_tets_region[from]);
        assert_memory_equal(ost_mesh_tet_axes(mesh) + 9 * t, two_tets_axes + 9 * from, 9 * sizeof(double));
    }
    int nodes_per_item = 0;
    const OstGlobal *nodes = NULL;
    const OstLocal count = ost_mesh_boundary_items(mesh, ost_mesh_find_boundary(mesh, "face"), &nodes_per_item, &nodes);
    assert_int_equal(nodes_per_item, 3);
    for (OstLocal i = 0; i < 3 * count; i++)
        assert_int_equal(ost_mesh_node_labels(mesh)[nodes[i]] - 1, face[i]);
    ost_mesh_destroy(&mesh);
}

static void refuses(const OstMeshArrays *arrays, const char *text)
{
    OstMeshChunk *chunk = NULL;
    assert_failure(ost_chunk_create_from_arrays(ctx, ost_rank(ctx) == 0 ? arrays : NULL, &chunk), OST_INVALID_INPUT,
                   text);
    assert_null(chunk);
    assert_true(ost_ledger_bytes(ctx) == 0);
}

static void what_does_not_fit_is_named(void **state)
{
    OstMeshArrays arrays = two_tets_arrays();
    arrays.nodes_per_tet = 8;
    refuses(&arrays, "nodes_per_tet is 8, expected 4 or 10");
    arrays = two_tets_arrays();
    arrays.tet_count = -1;
    refuses(&arrays, "-1 tets");
    arrays = two_tets_arrays();
    arrays.coordinates = NULL;
    refuses(&arrays, "coordinates is NULL on rank 0, expected 15 numbers");
    arrays = two_tets_arrays();
    arrays.node_count = 4;
    refuses(&arrays, "tet 2 uses node number 4 (counted from 0), but the mesh has 4 nodes");
    arrays = two_tets_arrays();
    arrays.region_count = 1;
    refuses(&arrays, "tet 1 is in region number 1, but the mesh has 1 regions");
    arrays = two_tets_arrays();
    arrays.region_names = NULL;
    refuses(&arrays, "region 0 (counted from 0) has no name");
    arrays = two_tets_arrays();
    arrays.region_names = (const char *const[]){"foot", "foot"};
    refuses(&arrays, "two regions are called 'foot'");
    refuses(NULL, "rank 0 must have arrays");
}

static void boundaries_that_do_not_fit_are_named(void **state)
{
    OstMeshArrays arrays = two_tets_arrays();
    OstBoundaryArrays boundaries[2] = {{"face", 2, 1, face}, {"face", 0, 1, corner}};
    arrays.boundary_count = 2;
    arrays.boundaries = boundaries;
    refuses(&arrays, "two boundaries are called 'face'");
    boundaries[1].name = "";
    refuses(&arrays, "boundary 1 (counted from 0) has no name");
    boundaries[1].name = "a\x01";
    refuses(&arrays, "the name of boundary 1 (counted from 0) holds a control character");
    boundaries[1] = (OstBoundaryArrays){"far", 3, 1, corner};
    refuses(&arrays, "boundary 'far' has dimension 3 and 1 items");
    boundaries[1] = (OstBoundaryArrays){"far", 0, 1, (const OstGlobal[]){5}};
    refuses(&arrays, "boundary 'far' uses node number 5 (counted from 0), but the mesh has 5 nodes");
    arrays.boundaries = NULL;
    refuses(&arrays, "boundaries is NULL on rank 0, expected 2");
}

static void ranks_must_list_the_same_names(void **state)
{
    if (ost_size(ctx) == 1)
        return;
    const int other = ost_rank(ctx) == 1;
    const OstBoundaryArrays boundary = {other ? "left" : "right", 2, 0, NULL};
    OstMeshArrays arrays = two_tets_arrays();
    OstMeshChunk *chunk = NULL;
    arrays.boundary_count = 1;
    arrays.boundaries = &boundary;
    if (ost_rank(ctx) > 0)
        arrays.node_count = arrays.tet_count = 0;
    assert_failure(ost_chunk_create_from_arrays(ctx, &arrays, &chunk), OST_INVALID_INPUT,
                   "boundary 0 is 'left' of dimension 2 on rank 1, and 'right' of dimension 2 on rank 0");
    arrays.boundary_count = other ? 0 : 1;
    assert_failure(ost_chunk_create_from_arrays(ctx, &arrays, &chunk), OST_INVALID_INPUT,
                   "rank 1 brings 2 regions and 0 boundaries, rank 0 2 and 1");
    arrays.boundary_count = 0;
    arrays.region_count = other ? 0 : 1;
    arrays.region_names = (const char *const[]){"wood"};
    assert_failure(ost_chunk_create_from_arrays(ctx, &arrays, &chunk), OST_INVALID_INPUT,
                   "region 0 is 'body' on rank 1 and 'wood' on rank 0");
    assert_null(chunk);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_mesh_is_that_of_the_arrays_and_they_are_copied),
    cmocka_unit_test(rank_0_may_bring_it_all),
    cmocka_unit_test(a_mesh_can_be_read_by_functions_alone),
    cmocka_unit_test(what_does_not_fit_is_named),
    cmocka_unit_test(boundaries_that_do_not_fit_are_named),
    cmocka_unit_test(ranks_must_list_the_same_names),
};

OST_TEST_MAIN(tests)
