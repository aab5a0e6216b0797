/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "mesh/mesh_support.h"

#include "mesh/lattice.h"
#include "mesh/misfit.h"

static OstMisfits misfits_of(OstMeshChunk *chunk, int joined)
{
    OstMesh *mesh = NULL;
    OstMisfits found;
    unsigned char *flags = NULL;
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_success(OST_NEW(ctx, &flags, mesh->node_count));
    memset(flags, joined, (size_t)mesh->node_count);
    assert_success(ost_mesh_find_misfits(mesh, flags, &found));
    OST_FREE(flags);
    ost_mesh_destroy(&mesh);
    return found;
}

/* A tet over the triangle (0, 0), (1, 0), (0, 1), and two below it, which meet in the middle of its long side: `gap`
 * lower, and `height` high. */
static OstMeshChunk *hanging(double gap, double height)
{
    const double low = -gap;
    const double x[][3] = {
        {0, 0, 0},   {1, 0, 0},   {0, 1, 0},  {0.25, 0.25, height}, {0.5, 0.5, low}, {0.25, 0.25, low - height},
        {0, 0, low}, {1, 0, low}, {0, 1, low}};
    const OstGlobal first = gap > 0.0 ? 6 : 0; /* of the triangle below */
    const OstGlobal tets[] = {0, 1, 2, 3, first, 4, first + 1, 5, first, first + 2, 4, 5};
    return hand_chunk(4, gap > 0.0 ? 9 : 6, x[0], 3, tets);
}

static void a_vertex_in_the_middle_of_an_edge_is_found_on_any_number_of_ranks(void **state)
{
    const OstMisfits found = misfits_of(hanging(0.0, 1.0), 0);
    assert_int_equal(found.faces, 3);
    assert_int_equal(found.cracked, 0);
    assert_int_equal(found.tet, 1);
    assert_int_equal(found.neighbour, 2);
    for (int d = 0; d < 3; d++) {
        assert_close(found.low[d], 0.0, 0.0);
        assert_close(found.high[d], d < 2 ? 1.0 : 0.0, 0.0);
    }
}

static void tied_vertices_gaps_and_thin_plates_are_none(void **state)
{
    assert_int_equal(misfits_of(hanging(0.0, 1.0), 1).faces, 0);
    assert_int_equal(misfits_of(hanging(0.005, 1.0), 0).faces, 0);
    const OstBlockShape plate = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1e-5}, {4, 4, 1}};
    OstMeshChunk *chunk = NULL;
    assert_success(ost_chunk_create_block(ctx, &plate, &chunk));
    assert_int_equal(misfits_of(chunk, 0).faces, 0);
}

/* Two cubes with a face in common, whose diagonal there is one in the first and the other in the second. */
static void triangles_across_both_diagonals_are_found_where_the_quadrilateral_is_not_plane_too(void **state)
{
    for (int warped = 0; warped < 2; warped++) {
        const Cell cells[] = {{{0, 0, 0}, 0}, {{1, 0, 0}, 0}};
        OstMeshChunk *chunk = lattice_chunk(2, cells, 1.0);
        for (OstLocal i = 6 * 4; i < 4 * chunk->tet_count; i++) { /* its tets are those of its mirror image */
            const double *x = chunk->coordinates + 3 * chunk->tet_nodes[i];
            for (OstLocal n = 0; n < chunk->node_count; n++) {
                const double *y = chunk->coordinates + 3 * n;
                if (y[0] == x[0] && y[1] == x[1] && y[2] == 1.0 - x[2]) {
                    chunk->tet_nodes[i] = n;
                    break;
                }
            }
        }
        for (OstLocal i = 6 * 4; i < 4 * chunk->tet_count; i += 4) {
            const OstGlobal kept = chunk->tet_nodes[i];
            chunk->tet_nodes[i] = chunk->tet_nodes[i + 1];
            chunk->tet_nodes[i + 1] = kept;
        }
        for (OstLocal n = 0; n < chunk->node_count && warped; n++) {
            double *x = chunk->coordinates + 3 * n;
            x[0] += x[0] == 1.0 && x[1] == 1.0 && x[2] == 1.0 ? 0.2 : 0.0;
        }
        assert_int_equal(misfits_of(chunk, 0).faces, 4);
    }
}

/* With vertices of their own at the same places. */
static void the_sides_of_a_crack_fit(void **state)
{
    const Cell cells[] = {{{0, 0, 0}, 0}, {{1, 0, 0}, 1}};
    const OstMisfits found = misfits_of(lattice_chunk(2, cells, 1e6), 0);
    assert_int_equal(found.faces, 0);
    assert_int_equal(found.cracked, 4);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_vertex_in_the_middle_of_an_edge_is_found_on_any_number_of_ranks),
    cmocka_unit_test(tied_vertices_gaps_and_thin_plates_are_none),
    cmocka_unit_test(triangles_across_both_diagonals_are_found_where_the_quadrilateral_is_not_plane_too),
    cmocka_unit_test(the_sides_of_a_crack_fit),
};

OST_TEST_MAIN(tests)
