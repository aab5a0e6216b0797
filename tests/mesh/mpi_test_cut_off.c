/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "mesh_support.h"

#include "orthostat/refine.h"

/* What plane faces cut off a curved surface, on any number of ranks, beside the volume that is missing. */

static OstCutOff cut_off(OstMeshChunk *chunk)
{
    OstMesh *mesh = NULL;
    OstCutOff found;
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_success(ost_mesh_cut_off(mesh, &found));
    ost_mesh_destroy(&mesh);
    return found;
}

/* Between a circle of radius 1 and a polygon in it. */
static double segments(int corners)
{
    return M_PI - 0.5 * corners * sin(2.0 * M_PI / corners);
}

/* A tube has convex and hollow faces. */
static void what_a_tube_lacks_is_found(void **state)
{
    static const int around[] = {12, 20, 60};
    for (int k = 0; k < 3; k++) {
        OstTubeShape tube = paper_tube;
        tube.around = around[k];
        tube.axial = 4;
        const double section = tube_volume(&tube) / tube.length;
        OstMeshChunk *chunk = NULL;
        assert_success(ost_chunk_create_tube(ctx, &tube, &chunk));
        const OstCutOff found = cut_off(chunk);
        assert_close(found.lacking / (1.5 * 1.5 * segments(tube.around) / section), 1.0, 0.02);
        assert_close(found.filled / (0.9 * 0.9 * segments(tube.around) / section), 1.0, 0.02);
    }
}

/* Finer meshes of the same faces lack as much; those of the shape do not. */
static void refinement_keeps_what_is_cut_off(void **state)
{
    OstTubeShape tube = paper_tube;
    tube.around = 20;
    tube.axial = 4;
    const OstShapeSurface round = ost_shape_surface_tube(&tube), *const shapes[] = {NULL, &round};
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    OstCutOff first;
    assert_success(ost_chunk_create_tube(ctx, &tube, &chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    for (int k = 0; k < 2; k++) {
        OstMesh *fine = NULL, *cut = NULL;
        OstBisection *bisection = NULL;
        OstCutOff found[2];
        assert_success(ost_mesh_refine(mesh, shapes[k], &fine));
        assert_success(ost_mesh_cut_off(fine, &found[0]));
        unsigned char *times = calloc((size_t)mesh->owned_tets + 1, 1);
        memset(times, 3, (size_t)mesh->owned_tets);
        assert_success(ost_bisection_create(mesh, &bisection));
        assert_success(ost_bisection_refine(bisection, times, shapes[k], &cut));
        assert_success(ost_mesh_cut_off(cut, &found[1]));
        assert_success(ost_mesh_cut_off(mesh, &first));
        for (int f = 0; f < 2; f++) {
            assert_true(k == 0 ? found[f].lacking == first.lacking : found[f].lacking < 0.8 * first.lacking);
            assert_true(k == 0 ? found[f].filled == first.filled : found[f].filled < 0.8 * first.filled);
        }
        free(times);
        ost_bisection_destroy(&bisection);
        ost_mesh_destroy(&cut);
        ost_mesh_destroy(&fine);
    }
    ost_mesh_destroy(&mesh);
}

static void curved_tets_lack_hardly_anything(void **state)
{
    OstTubeShape tube = paper_tube;
    tube.around = 20;
    tube.axial = 4;
    const OstShapeSurface round = ost_shape_surface_tube(&tube);
    OstMeshChunk *chunk = NULL;
    OstMesh *straight = NULL, *curved = NULL;
    OstCutOff found;
    assert_success(ost_chunk_create_tube(ctx, &tube, &chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &straight));
    assert_success(ost_mesh_raise(straight, &round, &curved));
    assert_success(ost_mesh_cut_off(curved, &found));
    assert_true(found.lacking > 0.0 && found.lacking < 4e-4); /* plane faces: 2.6e-2 */
    ost_mesh_destroy(&curved);
    ost_mesh_destroy(&straight);
}

static void edges_of_a_block_are_its_own(void **state)
{
    const OstBlockShape shape = {.size = {1, 2, 3}, .divisions = {3, 4, 5}};
    OstMeshChunk *chunk = NULL;
    assert_success(ost_chunk_create_block(ctx, &shape, &chunk));
    const OstCutOff found = cut_off(chunk);
    assert_true(found.lacking < 1e-12 && found.filled < 1e-12);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(what_a_tube_lacks_is_found),
    cmocka_unit_test(refinement_keeps_what_is_cut_off),
    cmocka_unit_test(curved_tets_lack_hardly_anything),
    cmocka_unit_test(edges_of_a_block_are_its_own),
};
OST_TEST_MAIN(tests)
