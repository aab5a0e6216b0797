/* SPDX-License-Identifier: BSD-3-Clause */
#include "mesh/distribution/share.h"
#include "support.h"

#include "mesh/mesh_support.h"

#include "mesh/coincident.h"
#include "mesh/components/component.h"
#include "mesh/lattice.h"

static int count_parts(const OstMesh *mesh)
{
    OstComponents *components = NULL;
    assert_success(ost_components_create(mesh, &components));
    const int count = components->count;
    ost_components_destroy(&components);
    return count;
}

enum { N = 4 }; /* divisions of the cube */

/* Two cubes side by side in one space, each with vertices of its own on the face between them. */
static const Cell side_by_side[] = {{{0, 0, 0}, 0}, {{1, 0, 0}, 1}};

static void coincident_vertices_are_counted_with_a_tolerance_that_joins_them(void **state)
{
    for (double scale = 1e-6; scale < 1e7; scale *= 1e6) {
        OstMesh *mesh = lattice_mesh(2, side_by_side, scale);
        OstGlobal count = 0;
        double tolerance = 0.0;
        assert_success(ost_mesh_count_coincident(mesh, NULL, &count, &tolerance));
        assert_int_equal(count, 4);
        assert_close(tolerance, 0.01 * scale, 1e-12 * scale);
        ost_mesh_destroy(&mesh);
    }
}

static void merging_joins_two_bodies_along_their_common_face(void **state)
{
    OstMeshChunk *chunk = lattice_chunk(2, side_by_side, 1.0);
    OstGlobal merged = 0;
    OstMesh *mesh = NULL;
    for (OstLocal i = 0; i < chunk->node_count; i++) /* near, not the same */
        chunk->coordinates[3 * i + 1] += i < 8 ? 0.0 : 1e-7;
    const OstGlobal points[] = {1, 8, 3}; /* 8 is where 1 is */
    add_boundary(chunk, "marks", 0, 1, 3, points);
    assert_success(ost_chunk_merge(chunk, 1e-6, &merged));
    assert_int_equal(merged, 4);
    assert_int_equal(chunk->global_nodes, 12);
    assert_int_equal(chunk->boundaries[0].count, ost_rank(ctx) == 0 ? 2 : 0);
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_int_equal(count_parts(mesh), 1);
    assert_close(total_volume(mesh), 2.0, 1e-6);
    OstGlobal labels = 0;
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        labels += mesh->node_label[n];
        /* the first cube's vertices keep their place */
        assert_true(mesh->node_label[n] > 8 || fmod(mesh->coordinates[3 * n + 1], 1.0) == 0.0);
    }
    MPI_Allreduce(MPI_IN_PLACE, &labels, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    assert_int_equal(labels, 16 * 17 / 2 - (9 + 11 + 13 + 15)); /* what went: corners with x = 1 of the second */
    ost_mesh_destroy(&mesh);
}

/* A cube whose every tet has four vertices of its own, spread over the ranks. */
static OstMeshChunk *soup(void)
{
    const OstBlockShape shape = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {N, N, N}};
    OstMeshChunk *chunk = NULL;
    assert_success(ost_chunk_create_block(ctx, &shape, &chunk));
    chunk->first_node = 4 * chunk->first_tet;
    chunk->node_count = 4 * chunk->tet_count;
    chunk->global_nodes = 4 * chunk->global_tets;
    assert_success(OST_RESIZE(ctx, &chunk->coordinates, 3 * chunk->node_count));
    for (OstLocal i = 0; i < chunk->node_count; i++) {
        const OstGlobal lattice = chunk->tet_nodes[i];
        const OstGlobal index[3] = {lattice / ((N + 1) * (N + 1)), lattice / (N + 1) % (N + 1), lattice % (N + 1)};
        for (int d = 0; d < 3; d++)
            chunk->coordinates[3 * i + d] = (double)index[d] / N;
        chunk->tet_nodes[i] = chunk->first_node + i;
    }
    for (int b = 0; b < chunk->boundary_count; b++)
        chunk->boundaries[b].count = 0;
    return chunk;
}

static void a_soup_of_tets_becomes_one_body_wherever_its_vertices_are(void **state)
{
    OstMeshChunk *chunk = soup();
    OstGlobal merged = 0;
    OstMesh *mesh = NULL;
    assert_success(ost_chunk_merge(chunk, 0.01, &merged));
    assert_int_equal(chunk->global_nodes, (N + 1) * (N + 1) * (N + 1));
    assert_int_equal(merged, 4 * chunk->global_tets - chunk->global_nodes);
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_int_equal(count_parts(mesh), 1);
    assert_close(total_volume(mesh), 1.0, 1e-14);
    ost_mesh_destroy(&mesh);
}

static void unmerged_the_soup_is_as_many_parts_as_tets(void **state)
{
    OstMeshChunk *chunk = soup();
    OstMesh *mesh = NULL;
    OstGlobal count = 0;
    double tolerance = 0.0;
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_int_equal(count_parts(mesh), 6 * N * N * N);
    assert_success(ost_mesh_count_coincident(mesh, NULL, &count, &tolerance));
    assert_int_equal(count, 24 * N * N * N - (N + 1) * (N + 1) * (N + 1));
    ost_mesh_destroy(&mesh);
}

static void a_distance_that_would_collapse_a_tet_is_refused(void **state)
{
    OstMeshChunk *chunk = lattice_chunk(2, side_by_side, 1.0);
    OstGlobal merged = 0;
    assert_failure(ost_chunk_merge(chunk, 1.0, &merged), OST_INVALID_INPUT,
                   "merge: 1 would join vertices of tet 1, which has an edge of length 1; give a smaller distance");
    ost_chunk_destroy(&chunk);
}

/* Three cells whose vertices at x = 1 lie 0, 0.4 and 0.8 along y: ends of a chain of 0.5 are not joined. */
static void a_chain_of_near_vertices_is_refused(void **state)
{
    static const double x[] = {
        0, 0, 0, 1, 0,   0, 0, 1, 0, 0, 0, 1,  /* a tet */
        3, 0, 0, 1, 0.4, 0, 3, 1, 0, 3, 0, 1,  /* another; its second vertex is near the first's */
        0, 9, 0, 1, 0.8, 0, 1, 9, 0, 0, 9, 1}; /* a third, near the second's */
    const OstGlobal tets[] = {0, 1, 2, 3, 4, 6, 5, 7, 8, 9, 10, 11};
    OstMeshChunk *chunk = hand_chunk(4, 12, x, 3, tets);
    OstGlobal merged = 0;
    assert_failure(ost_chunk_merge(chunk, 0.5, &merged), OST_INVALID_INPUT,
                   "merge: 0.5 joins vertex 10 with one that is joined with another");
    ost_chunk_destroy(&chunk);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(coincident_vertices_are_counted_with_a_tolerance_that_joins_them),
    cmocka_unit_test(merging_joins_two_bodies_along_their_common_face),
    cmocka_unit_test(a_soup_of_tets_becomes_one_body_wherever_its_vertices_are),
    cmocka_unit_test(unmerged_the_soup_is_as_many_parts_as_tets),
    cmocka_unit_test(a_distance_that_would_collapse_a_tet_is_refused),
    cmocka_unit_test(a_chain_of_near_vertices_is_refused),
};

OST_TEST_MAIN(tests)
