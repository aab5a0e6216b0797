/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "mesh/mesh_support.h"

#include "mesh/components/component.h"
#include "mesh/lattice.h"
#include "orthostat/refine.h"

static void check_parts(OstMesh *mesh, int expected)
{
    OstComponents *components = NULL;
    OstGlobal tets = 0;
    assert_success(ost_components_create(mesh, &components));
    assert_int_equal(components->count, expected);
    for (OstLocal p = 0; p < components->count; p++) {
        tets += components->component[p].tets;
        assert_true(p == 0 || components->component[p].first_tet > components->component[p - 1].first_tet);
    }
    assert_int_equal(tets, mesh->global_tets);
    ost_components_destroy(&components);
}

static void a_tube_is_one_part(void **state)
{
    const OstTubeShape tube = {1, {0.0, 0.0, 0.0}, 4.0, {0.9, 1.5}, 12, 2, 8};
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    OstComponents *components = NULL;
    assert_success(ost_chunk_create_tube(ctx, &tube, &chunk));
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_success(ost_components_create(mesh, &components));
    assert_int_equal(components->count, 1);
    assert_int_equal(components->component[0].tets, 6 * 12 * 2 * 8);
    assert_int_equal(components->component[0].first_tet, 1);
    assert_close(components->component[0].low[1], 0.0, 0.0);
    assert_close(components->component[0].high[1], 4.0, 0.0);
    assert_close(components->component[0].high[0], 1.5, 1e-15);
    ost_components_destroy(&components);
    ost_mesh_destroy(&mesh);
}

static void cells_that_touch_in_an_edge_or_a_vertex_are_parts_of_their_own(void **state)
{
    /* The first and the third share a face, the second touches the first along an edge, the fourth is apart. */
    const Cell cell[] = {{{0, 0, 0}, 0}, {{1, 1, 0}, 0}, {{0, 0, 1}, 0}, {{5, 5, 5}, 0}};
    OstMesh *mesh = lattice_mesh(4, cell, 1.0);
    OstComponents *components = NULL;
    assert_success(ost_components_create(mesh, &components));
    assert_int_equal(components->count, 3);
    assert_int_equal(components->component[0].tets, 12);
    assert_int_equal(components->component[1].tets, 6);
    assert_int_equal(components->component[2].tets, 6);
    assert_int_equal(components->component[1].first_tet, 7);
    assert_int_equal(components->component[2].first_tet, 19);
    assert_close(components->component[0].high[2], 2.0, 0.0);
    assert_close(components->component[1].low[0], 1.0, 0.0);
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        static const int part_of_cell[] = {0, 1, 0, 2};
        assert_int_equal(components->of_tet[t], part_of_cell[(mesh->tet_label[t] - 1) / 6]);
    }
    ost_components_destroy(&components);
    ost_mesh_destroy(&mesh);
}

static void parts_stay_what_they_are_when_tets_are_cut_or_become_quadratic(void **state)
{
    const Cell cell[] = {{{0, 0, 0}, 0}, {{1, 1, 0}, 0}, {{0, 0, 1}, 0}, {{5, 5, 5}, 0}};
    OstMesh *mesh = lattice_mesh(4, cell, 1.0);
    OstMesh *fine = NULL, *quadratic = NULL;
    assert_success(ost_mesh_refine(mesh, NULL, &fine));
    assert_success(ost_mesh_raise(fine, NULL, &quadratic));
    check_parts(fine, 3);
    check_parts(quadratic, 3);
    ost_mesh_destroy(&quadratic);
    ost_mesh_destroy(&fine);
    ost_mesh_destroy(&mesh);
}

/* A checkerboard: every cell touches its neighbours in edges alone. */
static void as_many_parts_as_cells_are_told_apart(void **state)
{
    Cell cell[LATTICE_CELLS];
    int cells = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            if ((i + j) % 2 == 0)
                cell[cells++] = (Cell){{i, j, 0}, 0};
    OstMesh *mesh = lattice_mesh(cells, cell, 1.0);
    check_parts(mesh, 8);
    ost_mesh_destroy(&mesh);
}

/* A tet, a neighbour, and the tet again with its vertices in another order; and two tets on one side of a face. */
static void doubled_and_overlapping_tets_are_refused_by_label(void **state)
{
    const double x[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    const OstGlobal doubled[] = {1, 2, 3, 4, 0, 1, 2, 3, 1, 2, 0, 3};
    const OstGlobal same_side[] = {0, 1, 2, 3, 0, 1, 2, 4};
    const struct {
        int tets;
        const OstGlobal *nodes;
        const char *message;
    } bad[] = {{3, doubled, "tets 2 and 3 lie on the same side of a face that they share"},
               {2, same_side, "tets 1 and 2 lie on the same side of a face that they share"}};
    for (int i = 0; i < 2; i++) {
        OstMeshChunk *chunk = hand_chunk(4, 5, x, bad[i].tets, bad[i].nodes);
        OstMesh *mesh = NULL;
        OstComponents *components = NULL;
        assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
        assert_failure(ost_components_create(mesh, &components), OST_INVALID_INPUT, bad[i].message);
        assert_null(components);
        ost_mesh_destroy(&mesh);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_tube_is_one_part),
    cmocka_unit_test(cells_that_touch_in_an_edge_or_a_vertex_are_parts_of_their_own),
    cmocka_unit_test(parts_stay_what_they_are_when_tets_are_cut_or_become_quadratic),
    cmocka_unit_test(as_many_parts_as_cells_are_told_apart),
    cmocka_unit_test(doubled_and_overlapping_tets_are_refused_by_label),
};

OST_TEST_MAIN(tests)
