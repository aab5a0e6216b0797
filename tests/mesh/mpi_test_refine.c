/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "mesh_support.h"
#include "orthostat/refine.h"
#include "piece_checks.h"

static const OstTubeShape short_tube = {1, {0.5, -1.0, 2.0}, 2.0, {0.9, 1.5}, 9, 2, 3};

static OstMesh *refine_and_check(const OstMesh *coarse, const OstShapeSurface *shape)
{
    OstMesh *fine = NULL;
    assert_success(ost_mesh_refine(coarse, shape, &fine));
    assert_int_equal(fine->nodes_per_tet, coarse->nodes_per_tet);
    assert_int_equal(fine->global_tets, 8 * coarse->global_tets);
    check_piece(fine);
    return fine;
}

/* Refines in place, `times` times. */
static void refine_again(OstMesh **mesh, const OstShapeSurface *shape, int times)
{
    for (int i = 0; i < times; i++) {
        OstMesh *fine = refine_and_check(*mesh, shape);
        ost_mesh_destroy(mesh);
        *mesh = fine;
    }
}

/* Which of the 6 n³ Kuhn tets of the unit cube in n³ cells is this? Its vertices, by the sum of their indices, go from
 * the lowest corner of a cell to the highest, a step in another direction each time. */
static OstLocal kuhn_number(const OstMesh *mesh, OstLocal tet, OstLocal n)
{
    OstLocal path[4][3];
    int filled = 0;
    OstLocal lowest = 3 * n;
    for (int v = 0; v < 4; v++) {
        OstLocal sum = 0;
        for (int d = 0; d < 3; d++)
            sum += (OstLocal)lround(n * mesh->coordinates[3 * tet_of(mesh, tet)[v] + d]);
        lowest = sum < lowest ? sum : lowest;
    }
    for (int v = 0; v < 4; v++) {
        OstLocal index[3];
        for (int d = 0; d < 3; d++) {
            const double x = n * mesh->coordinates[3 * tet_of(mesh, tet)[v] + d];
            assert_close(x, round(x), 1e-12);
            index[d] = (OstLocal)lround(x);
        }
        const OstLocal place = index[0] + index[1] + index[2] - lowest;
        assert_true(place < 4);
        filled |= 1 << place;
        memcpy(path[place], index, sizeof index);
    }
    assert_int_equal(filled, 15);
    int order = 0;
    int steps = 0;
    for (int v = 1; v < 4; v++) {
        for (int d = 0; d < 3; d++) {
            const OstLocal step = path[v][d] - path[v - 1][d];
            assert_true(step == 0 || step == 1);
            steps |= step << d;
            if (step)
                order = 3 * order + d;
        }
    }
    assert_int_equal(steps, 7);
    return ((path[0][0] * n + path[0][1]) * n + path[0][2]) * 27 + order;
}

static void refined_blocks_are_blocks_with_doubled_divisions(void **state)
{
    OstMesh *mesh = mesh_of_block(ctx, 1.0, 1.0, 1.0, 2, 2, 2);
    for (OstLocal n = 4; n <= 8; n *= 2) {
        refine_again(&mesh, NULL, 1);
        assert_int_equal(mesh->global_nodes, (n + 1) * (n + 1) * (n + 1));
        const OstLocal numbers = 27 * n * n * n;
        int *times = calloc((size_t)numbers, sizeof *times);
        for (OstLocal t = 0; t < mesh->owned_tets; t++)
            times[kuhn_number(mesh, t, n)]++;
        MPI_Allreduce(MPI_IN_PLACE, times, numbers, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
        OstLocal tets = 0;
        for (OstLocal i = 0; i < numbers; i++) {
            assert_true(times[i] <= 1);
            tets += times[i];
        }
        assert_int_equal(tets, 6 * n * n * n);
        free(times);
    }
    ost_mesh_destroy(&mesh);
}

/* Also in index space: the mean angle and radius of a tube's nodes are those of the finer tube. */
static void refined_tubes_are_tubes_with_doubled_divisions(void **state)
{
    const OstShapeSurface surface = ost_shape_surface_tube(&short_tube);
    OstTubeShape twice = short_tube;
    twice.around *= 2;
    twice.radial *= 2;
    twice.axial *= 2;
    OstMesh *mesh = mesh_of_tube(ctx, &short_tube);
    OstMesh *expected = mesh_of_tube(ctx, &twice);
    double vector[3];
    refine_again(&mesh, &surface, 1);
    assert_int_equal(mesh->global_nodes, expected->global_nodes);
    assert_close(total_volume(mesh) / tube_volume(&twice), 1.0, 1e-13);
    assert_close(worst_quality(mesh), worst_quality(expected), 1e-12);
    for (int b = 0; b < mesh->boundary_count; b++) {
        const char *name = mesh->boundaries[b].name;
        const double area = boundary_area(expected, name, vector);
        assert_close(boundary_area(mesh, name, vector) / area, 1.0, 1e-13);
    }
    ost_mesh_destroy(&expected);
    ost_mesh_destroy(&mesh);
}

static void nodes_of_refined_tubes_lie_on_true_circles(void **state)
{
    const OstShapeSurface surface = ost_shape_surface_tube(&short_tube);
    OstMesh *mesh = mesh_of_tube(ctx, &short_tube);
    refine_again(&mesh, &surface, 2);
    for (int side = 0; side < 2; side++) {
        const OstBoundary *boundary = &mesh->boundaries[ost_mesh_find_boundary(mesh, side == 0 ? "inner" : "outer")];
        for (OstLocal i = 0; i < 3 * boundary->count; i++) {
            const double *x = mesh->coordinates + 3 * boundary->nodes[i];
            assert_close(hypot(x[0] - 0.5, x[2] - 2.0), short_tube.radii[side], 1e-14);
        }
    }
    ost_mesh_destroy(&mesh);
}

static void the_volume_of_refined_tubes_converges_with_order_two(void **state)
{
    const double exact = M_PI * (1.5 * 1.5 - 0.9 * 0.9) * 2.0;
    const OstShapeSurface surface = ost_shape_surface_tube(&short_tube);
    OstMesh *mesh = mesh_of_tube(ctx, &short_tube);
    double before = exact - total_volume(mesh);
    for (int level = 1; level < 3; level++) {
        refine_again(&mesh, &surface, 1);
        const double after = exact - total_volume(mesh);
        assert_true(after > 0.0);
        assert_close(log2(before / after), 2.0, 0.1 / level);
        before = after;
    }
    ost_mesh_destroy(&mesh);
}

static void the_same_on_any_number_of_ranks(void **state)
{
    OstContext *alone = NULL;
    assert_int_equal(ost_context_create(MPI_COMM_SELF, &alone), OST_SUCCESS);
    const OstShapeSurface surface = ost_shape_surface_tube(&short_tube);
    OstMesh *mesh = mesh_of_tube(ctx, &short_tube);
    OstMesh *serial = mesh_of_tube(alone, &short_tube);
    for (int level = 0; level < 2; level++) {
        OstMesh *fine = NULL;
        refine_again(&mesh, &surface, 1);
        assert_int_equal(ost_mesh_refine(serial, &surface, &fine), OST_SUCCESS);
        ost_mesh_destroy(&serial);
        serial = fine;
        check_against_serial(mesh, serial);
    }
    ost_mesh_destroy(&serial);
    ost_mesh_destroy(&mesh);
    assert_int_equal(ost_ledger_bytes(alone), 0);
    ost_context_destroy(&alone);
}

/* After two refinements Bey's children have all the shapes that they will ever have. */
static void quality_stays_bounded(void **state)
{
    static const double fourth[][3] = {{0.3, 0.4, 0.2}, {0.1, 0.2, 3.0}, {0.9, -0.3, 0.25}, {2.0, 1.0, 0.5}};
    const OstGlobal tet[4] = {0, 1, 2, 3};
    for (size_t s = 0; s < sizeof fourth / sizeof *fourth; s++) {
        const double x[12] = {0, 0, 0, 1.0, 0.1, 0.0, 0.2, 0.8, 0.0, fourth[s][0], fourth[s][1], fourth[s][2]};
        OstMeshChunk *chunk = hand_chunk(4, 4, x, 1, tet);
        OstMesh *mesh = NULL;
        assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
        const double first = worst_quality(mesh);
        const double volume = total_volume(mesh);
        refine_again(&mesh, NULL, 2);
        const double second = worst_quality(mesh);
        assert_true(second > 0.3 * first);
        refine_again(&mesh, NULL, 2);
        assert_close(worst_quality(mesh) / second, 1.0, 1e-10);
        assert_close(total_volume(mesh) / volume, 1.0, 1e-13);
        ost_mesh_destroy(&mesh);
    }
}

/* In this tet the middles of 02 and 13 are far apart, and those of 01 and 23 near. */
static void a_much_shorter_diagonal_is_taken(void **state)
{
    const double x[12] = {-1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.1, 0.0, -1.0, 0.1};
    const OstGlobal nodes[3][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}};
    for (int order = 0; order < 3; order++) {
        OstMeshChunk *chunk = hand_chunk(4, 4, x, 1, nodes[order]);
        OstMesh *mesh = NULL;
        assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
        OstMesh *fine = refine_and_check(mesh, NULL);
        int shortest = 0;
        for (OstLocal t = 0; t < fine->owned_tets; t++) {
            double length = 1.0;
            for (int e = 0; e < 6; e++) {
                const double *a = fine->coordinates + 3 * tet_of(fine, t)[ost_tet_edge[e][0]];
                const double *b = fine->coordinates + 3 * tet_of(fine, t)[ost_tet_edge[e][1]];
                length = fmin(length, sqrt(pow(a[0] - b[0], 2) + pow(a[1] - b[1], 2) + pow(a[2] - b[2], 2)));
            }
            shortest += length < 0.11;
        }
        assert_int_equal(sum_over_ranks(shortest), 4);
        ost_mesh_destroy(&fine);
        ost_mesh_destroy(&mesh);
    }
}

static void boundaries_regions_and_axes_are_inherited(void **state)
{
    OstMesh *mesh = mesh_of_block(ctx, 1.0, 2.0, 3.0, 2, 3, 4);
    double vector[3];
    assert_success(OST_NEW(ctx, &mesh->tet_axes, 9 * (size_t)mesh->tet_count));
    for (OstLocal t = 0; t < mesh->tet_count; t++)
        for (int i = 0; i < 9; i++)
            mesh->tet_axes[9 * t + i] = 10.0 * (double)mesh->tet_label[t] + i;
    OstMesh *fine = refine_and_check(mesh, NULL);
    assert_string_equal(fine->regions.name[0], "block");
    for (OstLocal t = 0; t < fine->tet_count; t++) {
        const double parent = (double)((fine->tet_label[t] - 1) / 8 + 1);
        for (int i = 0; i < 9; i++)
            assert_close(fine->tet_axes[9 * t + i], 10.0 * parent + i, 0.0);
    }
    const char *names[] = {"xmin", "ymax", "zmin"};
    const double areas[] = {6.0, 3.0, 2.0};
    for (int s = 0; s < 3; s++)
        assert_close(boundary_area(fine, names[s], vector), areas[s], 1e-13);
    assert_close(vector[2], -2.0, 1e-13);
    assert_close(surface_area(fine, vector), 22.0, 1e-12);
    ost_mesh_destroy(&fine);
    ost_mesh_destroy(&mesh);
}

static void points_and_curves_are_refined(void **state)
{
    OstMeshChunk *chunk = marked_column();
    OstMesh *mesh = NULL;
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    refine_again(&mesh, NULL, 2);
    OstGlobal curves = 0;
    for (OstLocal i = 0; i < mesh->boundaries[0].count; i++) {
        const OstGlobal *nodes = mesh->boundaries[0].nodes + 2 * i;
        for (int v = 0; v < 2; v++)
            assert_close(hypot(mesh->coordinates[3 * nodes[v]], mesh->coordinates[3 * nodes[v] + 1]), 0.0, 0.0);
        assert_close(mesh->coordinates[3 * nodes[1] + 2] - mesh->coordinates[3 * nodes[0] + 2], 0.0625, 1e-15);
        curves += ost_mesh_owns(mesh, 2, nodes);
    }
    assert_int_equal(sum_over_ranks(curves), 16);
    assert_int_equal(sum_over_ranks(mesh->boundaries[1].count), 2);
    for (OstLocal i = 0; i < mesh->boundaries[1].count; i++)
        assert_true(mesh->node_label[mesh->boundaries[1].nodes[i]] == 1 ||
                    mesh->node_label[mesh->boundaries[1].nodes[i]] == 20);
    ost_mesh_destroy(&mesh);
}

static double furthest_from_middle(const OstMesh *mesh)
{
    double furthest = 0.0;
    for (OstLocal t = 0; t < mesh->tet_count; t++)
        for (int e = 0; e < 6; e++)
            for (int d = 0; d < 3; d++) {
                const OstLocal *nodes = tet_of(mesh, t);
                const double *x = mesh->coordinates + d;
                furthest = fmax(furthest, fabs(x[3 * nodes[4 + e]] - 0.5 * x[3 * nodes[ost_tet_edge[e][0]]] -
                                               0.5 * x[3 * nodes[ost_tet_edge[e][1]]]));
            }
    return highest_of_ranks(furthest);
}

/* Refined as it is curved, a mesh fills the same space to rounding; a halved edge of constant curvature leaves a
 * quarter of its distance from the chord. */
static void curved_tets_keep_their_space_when_refined(void **state)
{
    const OstShapeSurface surface = ost_shape_surface_tube(&short_tube);
    OstMesh *linear = mesh_of_tube(ctx, &short_tube);
    OstMesh *mesh = NULL;
    assert_success(ost_mesh_raise(linear, &surface, &mesh));
    const double volume = curved_volume(mesh);
    const double bulge = furthest_from_middle(mesh);
    refine_again(&mesh, NULL, 1);
    assert_close(curved_volume(mesh) / volume, 1.0, 1e-12);
    assert_close(furthest_from_middle(mesh) / bulge, 0.25, 1e-2);
    refine_again(&mesh, NULL, 1);
    assert_close(curved_volume(mesh) / volume, 1.0, 1e-12);
    ost_mesh_destroy(&mesh);
    ost_mesh_destroy(&linear);
}

static void quadratic_tubes_refine_onto_their_circles(void **state)
{
    const OstShapeSurface surface = ost_shape_surface_tube(&short_tube);
    const double exact = M_PI * (1.5 * 1.5 - 0.9 * 0.9) * 2.0;
    OstMesh *linear = mesh_of_tube(ctx, &short_tube);
    OstMesh *mesh = NULL;
    assert_success(ost_mesh_raise(linear, &surface, &mesh));
    const double before = curved_volume(mesh) - exact;
    refine_again(&mesh, &surface, 1);
    assert_close(log2(before / (curved_volume(mesh) - exact)), 4.0, 0.1);
    const OstBoundary *outer = &mesh->boundaries[ost_mesh_find_boundary(mesh, "outer")];
    assert_int_equal(outer->nodes_per_item, 6);
    for (OstLocal i = 0; i < 6 * outer->count; i++) {
        const double *x = mesh->coordinates + 3 * outer->nodes[i];
        assert_close(hypot(x[0] - 0.5, x[2] - 2.0), 1.5, 1e-14);
    }
    ost_mesh_destroy(&mesh);
    ost_mesh_destroy(&linear);
}

/* A quadratic mesh that METIS cut as such, and one that was raised where it lies. */
static void quadratic_meshes_read_as_such_are_refined(void **state)
{
    OstMeshChunk *chunk = quadratic_cube(2);
    OstMesh *mesh = NULL;
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    refine_again(&mesh, NULL, 2);
    assert_int_equal(mesh->global_nodes, 17 * 17 * 17);
    assert_close(curved_volume(mesh), 1.0, 1e-12); /* 15,360 terms */
    assert_close(furthest_from_middle(mesh), 0.0, 1e-15);
    ost_mesh_destroy(&mesh);
}

static void a_shape_that_inverts_a_tet_is_refused(void **state)
{
    OstShapeSurface sphere;
    OstMesh *mesh = flat_on_sphere(&sphere);
    OstMesh *none = NULL;
    assert_failure(ost_mesh_refine(mesh, &sphere, &none), OST_INVALID_INPUT, "inverted");
    assert_null(none);
    ost_mesh_destroy(&mesh);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(refined_blocks_are_blocks_with_doubled_divisions),
    cmocka_unit_test(refined_tubes_are_tubes_with_doubled_divisions),
    cmocka_unit_test(nodes_of_refined_tubes_lie_on_true_circles),
    cmocka_unit_test(the_volume_of_refined_tubes_converges_with_order_two),
    cmocka_unit_test(the_same_on_any_number_of_ranks),
    cmocka_unit_test(quality_stays_bounded),
    cmocka_unit_test(a_much_shorter_diagonal_is_taken),
    cmocka_unit_test(boundaries_regions_and_axes_are_inherited),
    cmocka_unit_test(points_and_curves_are_refined),
    cmocka_unit_test(curved_tets_keep_their_space_when_refined),
    cmocka_unit_test(quadratic_tubes_refine_onto_their_circles),
    cmocka_unit_test(quadratic_meshes_read_as_such_are_refined),
    cmocka_unit_test(a_shape_that_inverts_a_tet_is_refused),
};

OST_TEST_MAIN(tests)
