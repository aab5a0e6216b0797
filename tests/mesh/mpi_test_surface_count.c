/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "mesh/mesh_data.h"

/* Faces of a mesh's surface, on any number of ranks. */

static void count(OstMeshChunk *chunk, double *of_chunk, double *of_mesh)
{
    OstMesh *mesh = NULL;
    assert_success(ost_chunk_surface_faces(chunk, of_chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_success(ost_mesh_surface_faces(mesh, of_mesh));
    ost_mesh_destroy(&mesh);
}

static void a_blocks_faces_are_counted(void **state)
{
    const OstBlockShape shape = {.size = {1, 1, 1}, .divisions = {3, 4, 5}};
    OstMeshChunk *chunk = NULL;
    double of_chunk = 0.0, of_mesh = 0.0;
    assert_success(ost_chunk_create_block(ctx, &shape, &chunk));
    count(chunk, &of_chunk, &of_mesh);
    assert_close(of_chunk, 4.0 * (12 + 20 + 15), 0.0);
    assert_close(of_mesh, of_chunk, 0.0);
}

static void a_thin_tubes_faces_are_counted(void **state)
{
    const OstTubeShape shape = {.axis = 1, .length = 1, .radii = {0.9, 1}, .around = 9, .radial = 1, .axial = 4};
    OstMeshChunk *chunk = NULL;
    double of_chunk = 0.0, of_mesh = 0.0;
    assert_success(ost_chunk_create_tube(ctx, &shape, &chunk));
    count(chunk, &of_chunk, &of_mesh);
    assert_close(of_chunk, 4.0 * (9 * 4 + 9), 0.0);
    assert_close(of_mesh, of_chunk, 0.0);
}

/* Of 162,000 tets every second face is compared: the count is off by a few of its standard deviations at most. */
static void a_large_chunks_faces_are_sampled(void **state)
{
    const OstBlockShape shape = {.size = {1, 1, 1}, .divisions = {30, 30, 30}};
    OstMeshChunk *chunk = NULL;
    double faces = 0.0;
    assert_success(ost_chunk_create_block(ctx, &shape, &chunk));
    assert_success(ost_chunk_surface_faces(chunk, &faces));
    assert_close(faces / 10800.0, 1.0, 0.05);
    ost_chunk_destroy(&chunk);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_blocks_faces_are_counted),
    cmocka_unit_test(a_thin_tubes_faces_are_counted),
    cmocka_unit_test(a_large_chunks_faces_are_sampled),
};
OST_TEST_MAIN(tests)
