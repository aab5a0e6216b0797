/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "mesh_support.h"

#include "orthostat/refine.h"

/* What plane faces cut off a curved surface, on any number of ranks, beside the volume that is missing. */

static double cut_off(OstMeshChunk *chunk)
{
    OstMesh *mesh = NULL;
    double share = NAN;
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_success(ost_mesh_cut_off(mesh, &share));
    ost_mesh_destroy(&mesh);
    return share;
}

/* A tube has convex and hollow faces. */
static void what_a_tube_lacks_is_found(void **state)
{
    static const int around[] = {12, 20, 60};
    for (int k = 0; k < 3; k++) {
        OstTubeShape tube = paper_tube;
        tube.around = around[k];
        tube.axial = 4;
        const double whole = M_PI * (1.5 * 1.5 - 0.9 * 0.9) * tube.length;
        OstMeshChunk *chunk = NULL;
        assert_success(ost_chunk_create_tube(ctx, &tube, &chunk));
        assert_close(cut_off(chunk) / (whole / tube_volume(&tube) - 1.0), 1.0, 0.02);
    }
}

static void curved_tets_lack_hardly_anything(void **state)
{
    OstTubeShape tube = paper_tube;
    tube.around = 20;
    tube.axial = 4;
    const OstShapeSurface round = ost_shape_surface_tube(&tube);
    OstMeshChunk *chunk = NULL;
    OstMesh *straight = NULL, *curved = NULL;
    double share = NAN;
    assert_success(ost_chunk_create_tube(ctx, &tube, &chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &straight));
    assert_success(ost_mesh_raise(straight, &round, &curved));
    assert_success(ost_mesh_cut_off(curved, &share));
    assert_true(share > 0.0 && share < 2e-4); /* plane faces: 1.7e-2 */
    ost_mesh_destroy(&curved);
    ost_mesh_destroy(&straight);
}

static void edges_of_a_block_are_its_own(void **state)
{
    const OstBlockShape shape = {.size = {1, 2, 3}, .divisions = {3, 4, 5}};
    OstMeshChunk *chunk = NULL;
    assert_success(ost_chunk_create_block(ctx, &shape, &chunk));
    assert_true(fabs(cut_off(chunk)) < 1e-12);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(what_a_tube_lacks_is_found),
    cmocka_unit_test(curved_tets_lack_hardly_anything),
    cmocka_unit_test(edges_of_a_block_are_its_own),
};
OST_TEST_MAIN(tests)
