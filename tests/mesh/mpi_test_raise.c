/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "mesh_support.h"
#include "orthostat/refine.h"
#include "piece_checks.h"

static const OstTubeShape short_tube = {1, {0.5, -1.0, 2.0}, 2.0, {0.9, 1.5}, 12, 2, 3};

static OstMesh *raise_and_check(const OstMesh *linear, const OstShapeSurface *shape)
{
    OstMesh *quadratic = NULL;
    assert_success(ost_mesh_raise(linear, shape, &quadratic));
    assert_int_equal(quadratic->nodes_per_tet, 10);
    check_piece(quadratic);
    return quadratic;
}

/* n × n × n Kuhn cells have a node at each vertex, edge middle, face middle and cell middle: (2n + 1)³. */
static void a_raised_block_has_the_nodes_of_one_twice_as_fine(void **state)
{
    for (OstLocal n = 1; n < 6; n += 2) {
        OstMesh *linear = mesh_of_block(ctx, 1.0, 1.0, 1.0, n, n, n);
        OstMesh *quadratic = raise_and_check(linear, NULL);
        const OstLocal side = 2 * n + 1;
        int *times = calloc((size_t)(side * side * side), sizeof *times);
        assert_int_equal(quadratic->global_nodes, side * side * side);
        assert_int_equal(quadratic->global_tets, linear->global_tets);
        for (OstLocal i = 0; i < quadratic->owned_nodes; i++) {
            const double *x = quadratic->coordinates + 3 * i;
            OstLocal place = 0;
            for (int d = 0; d < 3; d++) {
                assert_close(2 * n * x[d], round(2 * n * x[d]), 1e-13);
                place = place * side + (OstLocal)lround(2 * n * x[d]);
            }
            times[place]++;
        }
        MPI_Allreduce(MPI_IN_PLACE, times, side * side * side, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
        for (OstLocal i = 0; i < side * side * side; i++)
            assert_int_equal(times[i], 1);
        free(times);
        ost_mesh_destroy(&quadratic);
        ost_mesh_destroy(&linear);
    }
}

static void middles_lie_between_their_vertices(void **state)
{
    OstMesh *linear = mesh_of_tube(ctx, &short_tube);
    OstMesh *quadratic = raise_and_check(linear, NULL);
    for (OstLocal t = 0; t < quadratic->tet_count; t++)
        for (int e = 0; e < 6; e++)
            for (int d = 0; d < 3; d++) {
                const OstLocal *nodes = tet_of(quadratic, t);
                const double *x = quadratic->coordinates + d;
                assert_close(x[3 * nodes[4 + e]],
                             0.5 * (x[3 * nodes[ost_tet_edge[e][0]]] + x[3 * nodes[ost_tet_edge[e][1]]]), 0.0);
            }
    assert_close(total_volume(quadratic) / tube_volume(&short_tube), 1.0, 1e-13);
    assert_close(curved_volume(quadratic) / tube_volume(&short_tube), 1.0, 1e-13);
    ost_mesh_destroy(&quadratic);
    ost_mesh_destroy(&linear);
}

static void vertices_and_tets_keep_what_they_had(void **state)
{
    OstMesh *linear = mesh_of_tube(ctx, &short_tube);
    assert_success(OST_NEW(ctx, &linear->tet_axes, 9 * (size_t)linear->tet_count));
    for (OstLocal t = 0; t < linear->tet_count; t++)
        linear->tet_axes[9 * t + 4] = (double)linear->tet_label[t];
    OstMesh *quadratic = raise_and_check(linear, NULL);
    assert_int_equal(quadratic->tet_count, linear->tet_count);
    assert_int_equal(quadratic->owned_tets, linear->owned_tets);
    assert_string_equal(quadratic->regions.name[0], "tube");
    for (OstLocal t = 0; t < quadratic->tet_count; t++) {
        assert_int_equal(quadratic->tet_label[t], linear->tet_label[t]);
        assert_close(quadratic->tet_axes[9 * t + 4], (double)linear->tet_label[t], 0.0);
        for (int v = 0; v < 4; v++)
            assert_int_equal(quadratic->node_label[tet_of(quadratic, t)[v]], linear->node_label[tet_of(linear, t)[v]]);
        for (int v = 4; v < 10; v++)
            assert_true(quadratic->node_label[tet_of(quadratic, t)[v]] > linear->global_nodes);
    }
    ost_mesh_destroy(&quadratic);
    ost_mesh_destroy(&linear);
}

static void the_same_on_any_number_of_ranks(void **state)
{
    OstContext *alone = NULL;
    assert_int_equal(ost_context_create(MPI_COMM_SELF, &alone), OST_SUCCESS);
    const OstShapeSurface surface = ost_shape_surface_tube(&short_tube);
    OstMesh *linear = mesh_of_tube(ctx, &short_tube);
    OstMesh *whole = mesh_of_tube(alone, &short_tube);
    OstMesh *quadratic = raise_and_check(linear, &surface);
    OstMesh *serial = NULL;
    assert_int_equal(ost_mesh_raise(whole, &surface, &serial), OST_SUCCESS);
    check_against_serial(quadratic, serial);
    ost_mesh_destroy(&serial);
    ost_mesh_destroy(&quadratic);
    ost_mesh_destroy(&whole);
    ost_mesh_destroy(&linear);
    assert_int_equal(ost_ledger_bytes(alone), 0);
    ost_context_destroy(&alone);
}

/* Distance from the tube's axis. */
static double radius_of(const OstMesh *mesh, OstGlobal node)
{
    const double *x = mesh->coordinates + 3 * node;
    return hypot(x[0] - short_tube.origin[0], x[2] - short_tube.origin[2]);
}

static void curved_tubes_have_their_nodes_on_circles(void **state)
{
    const OstShapeSurface surface = ost_shape_surface_tube(&short_tube);
    OstMesh *linear = mesh_of_tube(ctx, &short_tube);
    OstMesh *quadratic = raise_and_check(linear, &surface);
    const char *names[] = {"inner", "outer"};
    for (int side = 0; side < 2; side++) {
        const OstBoundary *boundary = &quadratic->boundaries[ost_mesh_find_boundary(quadratic, names[side])];
        assert_int_equal(boundary->nodes_per_item, 6);
        for (OstLocal i = 0; i < 6 * boundary->count; i++)
            assert_close(radius_of(quadratic, boundary->nodes[i]), short_tube.radii[side], 1e-15);
    }
    for (OstLocal n = 0; n < quadratic->node_count; n++) { /* two cells through the wall: nodes at its quarters */
        const double quarter = 4.0 * (radius_of(quadratic, n) - 0.9) / 0.6;
        assert_close(quarter, round(quarter), 1e-13);
    }
    ost_mesh_destroy(&quadratic);
    ost_mesh_destroy(&linear);
}

/* Quadratic edges meet circles to fourth order in area: halving h leaves a sixteenth of the error. */
static void the_volume_of_curved_tubes_converges_with_order_four(void **state)
{
    const double exact = M_PI * (1.5 * 1.5 - 0.9 * 0.9) * 2.0;
    double error[2];
    for (int level = 0; level < 2; level++) {
        OstTubeShape shape = short_tube;
        shape.around <<= level;
        shape.radial <<= level;
        shape.axial <<= level;
        const OstShapeSurface surface = ost_shape_surface_tube(&shape);
        OstMesh *linear = mesh_of_tube(ctx, &shape);
        OstMesh *quadratic = raise_and_check(linear, &surface);
        error[level] = fabs(curved_volume(quadratic) - exact) / exact;
        ost_mesh_destroy(&quadratic);
        ost_mesh_destroy(&linear);
    }
    assert_true(error[0] < 2e-3);
    assert_close(log2(error[0] / error[1]), 4.0, 0.1);
}

static void boundaries_are_raised_with_their_faces(void **state)
{
    OstMesh *linear = mesh_of_block(ctx, 1.0, 2.0, 3.0, 3, 2, 4);
    OstMesh *quadratic = raise_and_check(linear, NULL);
    const char *names[] = {"xmin", "ymax", "zmin"};
    const double areas[] = {6.0, 3.0, 2.0};
    double vector[3];
    for (int s = 0; s < 3; s++)
        assert_close(boundary_area(quadratic, names[s], vector), areas[s], 1e-13);
    assert_close(surface_area(quadratic, vector), 22.0, 1e-12);
    for (int b = 0; b < quadratic->boundary_count; b++) {
        const OstBoundary *boundary = &quadratic->boundaries[b];
        for (OstLocal i = 0; i < boundary->count; i++)
            for (int e = 0; e < 3; e++)
                for (int d = 0; d < 3; d++) {
                    const OstGlobal *nodes = boundary->nodes + 6 * i;
                    const double *x = quadratic->coordinates + d;
                    assert_close(x[3 * nodes[3 + e]], 0.5 * (x[3 * nodes[e]] + x[3 * nodes[(e + 1) % 3]]), 0.0);
                }
    }
    ost_mesh_destroy(&quadratic);
    ost_mesh_destroy(&linear);
}

static void the_linear_mesh_of_a_raised_one_is_the_one_it_was(void **state)
{
    OstMesh *before = mesh_of_tube(ctx, &short_tube);
    OstMesh *quadratic = raise_and_check(before, NULL);
    OstMesh *after = NULL;
    OstLocal *node_of_vertex = NULL;
    assert_success(ost_mesh_linear(quadratic, &after, &node_of_vertex));
    check_piece(after);
    assert_int_equal(after->node_count, before->node_count);
    assert_int_equal(after->owned_nodes, before->owned_nodes);
    assert_int_equal(after->first_node, before->first_node);
    assert_memory_equal(after->node_number, before->node_number, (size_t)before->node_count * sizeof(OstGlobal));
    assert_memory_equal(after->node_label, before->node_label, (size_t)before->node_count * sizeof(OstGlobal));
    assert_memory_equal(after->coordinates, before->coordinates, 3 * (size_t)before->node_count * sizeof(double));
    assert_int_equal(after->tet_count, before->tet_count);
    assert_memory_equal(after->tet_nodes, before->tet_nodes, 4 * (size_t)before->tet_count * sizeof(OstLocal));
    for (int b = 0; b < after->boundary_count; b++) {
        const OstBoundary *boundary = &after->boundaries[b];
        assert_int_equal(boundary->count, before->boundaries[b].count);
        assert_memory_equal(boundary->nodes, before->boundaries[b].nodes,
                            3 * (size_t)boundary->count * sizeof(OstGlobal));
    }
    for (OstLocal v = 0; v < after->node_count; v++) {
        assert_int_equal(quadratic->node_label[node_of_vertex[v]], after->node_label[v]);
        assert_true(v == 0 || node_of_vertex[v] > node_of_vertex[v - 1]);
    }
    OST_FREE(node_of_vertex);
    ost_mesh_destroy(&after);
    ost_mesh_destroy(&quadratic);
    ost_mesh_destroy(&before);
}

/* Cut by METIS as a quadratic mesh, a rank can own a mid-edge node without either of its vertices. */
static void a_quadratic_mesh_read_as_such_has_all_parents_here(void **state)
{
    OstMeshChunk *chunk = quadratic_cube(3);
    OstMesh *quadratic = NULL;
    OstMesh *linear = NULL;
    OstMesh *again = NULL;
    assert_success(ost_mesh_distribute(ctx, &chunk, &quadratic));
    assert_success(ost_mesh_linear(quadratic, &linear, NULL));
    check_numbers(linear);
    check_halo(linear);
    assert_int_equal(linear->global_nodes, 64);
    OstLocal *parents = malloc(2 * (size_t)quadratic->node_count * sizeof *parents);
    memset(parents, -1, 2 * (size_t)quadratic->node_count * sizeof *parents);
    assert_success(ost_mesh_parents(quadratic, linear, parents));
    OstGlobal vertices = 0;
    for (OstLocal n = 0; n < quadratic->node_count; n++) {
        const OstLocal *p = parents + 2 * n;
        assert_true(p[0] >= 0 && p[0] < linear->node_count && p[1] >= 0 && p[1] < linear->node_count);
        for (int d = 0; d < 3; d++)
            assert_close(quadratic->coordinates[3 * n + d],
                         0.5 * (linear->coordinates[3 * p[0] + d] + linear->coordinates[3 * p[1] + d]), 1e-15);
        vertices += p[0] == p[1] && n < quadratic->owned_nodes;
    }
    assert_int_equal(sum_over_ranks(vertices), 64);
    assert_success(ost_mesh_raise(linear, NULL, &again));
    check_piece(again);
    assert_int_equal(again->global_nodes, 343);
    assert_close(total_volume(again), 1.0, 1e-14);
    free(parents);
    ost_mesh_destroy(&again);
    ost_mesh_destroy(&linear);
    ost_mesh_destroy(&quadratic);
}

static void points_and_curves_are_raised(void **state)
{
    OstMeshChunk *chunk = marked_column();
    OstMesh *linear = NULL;
    OstMesh *skeleton = NULL;
    assert_success(ost_mesh_distribute(ctx, &chunk, &linear));
    OstMesh *quadratic = raise_and_check(linear, NULL);
    OstGlobal owned[2] = {quadratic->boundaries[1].count, 0};
    for (OstLocal i = 0; i < quadratic->boundaries[0].count; i++) {
        const OstGlobal *nodes = quadratic->boundaries[0].nodes + 3 * i;
        const double *z = quadratic->coordinates + 2;
        assert_close(z[3 * nodes[2]], 0.5 * (z[3 * nodes[0]] + z[3 * nodes[1]]), 0.0);
        owned[1] += ost_mesh_owns(quadratic, 3, nodes);
    }
    assert_int_equal(sum_over_ranks(owned[0]), 2);
    assert_int_equal(sum_over_ranks(owned[1]), 4);
    assert_success(ost_mesh_linear(quadratic, &skeleton, NULL));
    assert_int_equal(skeleton->boundaries[0].count, linear->boundaries[0].count);
    assert_int_equal(skeleton->boundaries[1].count, linear->boundaries[1].count);
    ost_mesh_destroy(&skeleton);
    ost_mesh_destroy(&quadratic);
    ost_mesh_destroy(&linear);
}

static void what_cannot_be_raised_is_refused(void **state)
{
    OstMesh *linear = mesh_of_block(ctx, 1.0, 1.0, 1.0, 2, 2, 2);
    OstMesh *quadratic = NULL;
    OstMesh *none = NULL;
    assert_success(ost_mesh_raise(linear, NULL, &quadratic));
    assert_failure(ost_mesh_raise(quadratic, NULL, &none), OST_INVALID_INPUT, "tets of 10 nodes, expected 4");
    assert_failure(ost_mesh_linear(linear, &none, NULL), OST_INVALID_INPUT, "tets of 4 nodes, expected 10");
    assert_failure(ost_mesh_parents(linear, linear, NULL), OST_INVALID_INPUT, "not of the same tets");
    linear->tet_label[0] = INT64_MAX / 2; /* some rank owns its first tet */
    assert_failure(ost_mesh_raise(linear, NULL, &none), OST_LIMIT_EXCEEDED, "too large to make the labels");
    assert_null(none);
    ost_mesh_destroy(&quadratic);
    ost_mesh_destroy(&linear);
}

static void a_folded_tet_is_named(void **state)
{
    OstShapeSurface sphere;
    OstMesh *mesh = flat_on_sphere(&sphere);
    OstMesh *none = NULL;
    assert_failure(ost_mesh_raise(mesh, &sphere, &none), OST_INVALID_INPUT, "tet 1 with curved edges folds over");
    assert_null(none);
    ost_mesh_destroy(&mesh);
}

static void the_middle_of_an_edge_is_the_same_from_both_ends(void **state)
{
    const double origin[3] = {0.3, -0.2, 0.1};
    const OstShapeSurface shapes[3] = {{OST_SURFACE_NONE, {0.0}, {0.0}},
                                       {OST_SURFACE_TUBE, {0.3, -0.2, 0.1}, {1.0, 2.0, -0.5}},
                                       ost_shape_surface_sphere(origin)};
    const double a[3] = {1.1, 0.7, -0.3};
    const double b[3] = {0.4, 1.9, 0.8};
    for (int s = 0; s < 3; s++) {
        double one[3];
        double other[3];
        ost_shape_surface_middle(&shapes[s], a, b, one);
        ost_shape_surface_middle(&shapes[s], b, a, other);
        assert_memory_equal(one, other, sizeof one);
    }
}

static void across_the_axis_the_middle_is_straight(void **state)
{
    const OstShapeSurface tube = {OST_SURFACE_TUBE, {0.0, 0.0, 0.0}, {0.0, 0.0, 3.0}};
    const double ends[2][2][3] = {{{1.0, 0.0, 2.0}, {-1.0, 0.0, 0.0}}, {{0.0, 0.0, 0.0}, {0.0, 2.0, 1.0}}};
    const double expected[2][3] = {{0.0, 0.0, 1.0}, {0.0, 1.0, 0.5}};
    double middle[3];
    for (int i = 0; i < 2; i++) {
        ost_shape_surface_middle(&tube, ends[i][0], ends[i][1], middle);
        for (int d = 0; d < 3; d++)
            assert_close(middle[d], expected[i][d], 1e-15);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_raised_block_has_the_nodes_of_one_twice_as_fine),
    cmocka_unit_test(middles_lie_between_their_vertices),
    cmocka_unit_test(vertices_and_tets_keep_what_they_had),
    cmocka_unit_test(the_same_on_any_number_of_ranks),
    cmocka_unit_test(curved_tubes_have_their_nodes_on_circles),
    cmocka_unit_test(the_volume_of_curved_tubes_converges_with_order_four),
    cmocka_unit_test(boundaries_are_raised_with_their_faces),
    cmocka_unit_test(the_linear_mesh_of_a_raised_one_is_the_one_it_was),
    cmocka_unit_test(a_quadratic_mesh_read_as_such_has_all_parents_here),
    cmocka_unit_test(points_and_curves_are_raised),
    cmocka_unit_test(what_cannot_be_raised_is_refused),
    cmocka_unit_test(a_folded_tet_is_named),
    cmocka_unit_test(the_middle_of_an_edge_is_the_same_from_both_ends),
    cmocka_unit_test(across_the_axis_the_middle_is_straight),
};

OST_TEST_MAIN(tests)
