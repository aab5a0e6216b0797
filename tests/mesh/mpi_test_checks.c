/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "core/parallel/reduce.h"
#include "mesh/distribution/graph.h"
#include "mesh/distribution/partition.h"
#include "mesh_support.h"
#include "orthostat/refine.h"

/* A unit cube in six tets (nodes 0-7), for a hand-made fault each. */
typedef struct Cube {
    double x[27]; /* nine nodes */
    OstGlobal tets[28];
    OstLocal nodes, count;
} Cube;

static Cube sound_cube(void)
{
    static const OstGlobal division[24] = {0, 4, 6, 7, 0, 2, 3, 7, 0, 1, 5, 7, 0, 4, 7, 5, 0, 1, 7, 3, 0, 2, 7, 6};
    Cube cube = {.nodes = 8, .count = 6};
    for (int n = 0; n < 8; n++)
        for (int d = 0; d < 3; d++)
            cube.x[3 * n + d] = n >> (2 - d) & 1;
    memcpy(cube.tets, division, sizeof division);
    return cube;
}

static void refuses(const Cube *cube, const char *text)
{
    OstMeshChunk *chunk = hand_chunk(4, cube->nodes, cube->x, cube->count, cube->tets);
    OstMesh *mesh = NULL;
    assert_failure(ost_mesh_distribute(ctx, &chunk, &mesh), OST_INVALID_INPUT, text);
    assert_null(chunk);
    assert_null(mesh);
    assert_true(ost_ledger_bytes(ctx) == 0);
}

static void a_sound_cube_passes(void **state)
{
    const Cube cube = sound_cube();
    OstMeshChunk *chunk = hand_chunk(4, cube.nodes, cube.x, cube.count, cube.tets);
    OstMesh *mesh = NULL;
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_close(total_volume(mesh), 1.0, 1e-15);
    ost_mesh_destroy(&mesh);
}

static void inverted_tets_are_named_lowest_first(void **state)
{
    Cube cube = sound_cube();
    for (int t = 2; t < 5; t++) {
        const OstGlobal third = cube.tets[4 * t + 2];
        cube.tets[4 * t + 2] = cube.tets[4 * t + 3];
        cube.tets[4 * t + 3] = third;
    }
    refuses(&cube, "tet 3 is inverted: its volume is -0.166667");
    refuses(&cube, "3 of its tets");
}

static void flat_tets_are_named(void **state)
{
    Cube cube = sound_cube();
    const OstGlobal flat[4] = {0, 1, 2, 3};
    memcpy(cube.tets + 24, flat, sizeof flat);
    cube.count = 7;
    refuses(&cube, "tet 7 is flat: its volume is 0");
    for (int n = 0; n < 8; n++) /* flat but for rounding, and far from the origin */
        for (int d = 0; d < 3; d++)
            cube.x[3 * n + d] = 1000.0 / 3.0 + 0.1 * cube.x[3 * n + d] + (d == 0 ? 0.3 * cube.x[3 * n + 1] : 0.0);
    refuses(&cube, "tet 7 is flat");
}

static void a_sliver_of_quality_1e_9_is_no_flat_tet(void **state)
{
    const OstGlobal tet[4] = {0, 1, 2, 3};
    for (double scale = 1e-6; scale < 1e7; scale *= 1e6) {
        const double x[12] = {0, 0, 0, scale, 0, 0, 0, scale, 0, 0, 0, 1e-9 * scale};
        OstMeshChunk *chunk = hand_chunk(4, 4, x, 1, tet);
        OstMesh *mesh = NULL;
        assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
        assert_int_equal(mesh->tet_count, 1);
        assert_true(ost_tet_quality(mesh->coordinates, mesh->tet_nodes) < 3e-9);
        ost_mesh_destroy(&mesh);
    }
}

static void coordinates_must_be_finite(void **state)
{
    Cube cube = sound_cube();
    cube.x[3 * 5 + 1] = NAN;
    refuses(&cube, "vertex 6 has coordinate nan");
    cube.x[3 * 5 + 1] = 0.0;
    cube.x[3 * 7 + 2] = -INFINITY;
    refuses(&cube, "vertex 8 has coordinate -inf");
}

static void vertices_without_tet_are_listed(void **state)
{
    Cube cube = sound_cube();
    cube.nodes = 9;
    refuses(&cube, "1 vertex is used by no tet: 9; remove it");
    double x[3 * 20];
    OstGlobal tet[4] = {3, 5, 6, 19};
    for (int n = 0; n < 20; n++)
        for (int d = 0; d < 3; d++)
            x[3 * n + d] = (n == 5 && d == 0) || (n == 6 && d == 1) || (n == 19 && d == 2);
    OstMeshChunk *chunk = hand_chunk(4, 20, x, 1, tet);
    OstMesh *mesh = NULL;
    assert_failure(ost_mesh_distribute(ctx, &chunk, &mesh), OST_INVALID_INPUT,
                   "16 vertices are used by no tet: 1, 2, 3, 5, 8, 9, 10, 11 and 8 more; remove them");
}

static void numbers_must_fit_the_mesh(void **state)
{
    Cube cube = sound_cube();
    cube.tets[9] = 8;
    refuses(&cube, "tet 3 uses node number 8 (counted from 0), but the mesh has 8 nodes");
    cube.tets[9] = cube.tets[8];
    refuses(&cube, "tet 3 uses the same node twice, as its nodes 1 and 2");
    cube = sound_cube();
    cube.count = 0;
    refuses(&cube, "8 nodes and no tet");
}

/* The mid-edge node of a chunk of 27 vertices with the lowest (or highest) sum of coordinates; rank 0 has all nodes. */
static OstLocal extreme_middle(const OstMeshChunk *cube, double sign)
{
    OstLocal best = 27;
    for (OstLocal n = 28; n < cube->node_count; n++) {
        const double *x = cube->coordinates + 3 * (size_t)n, *least = cube->coordinates + 3 * (size_t)best;
        if (sign * (x[0] + x[1] + x[2]) < sign * (least[0] + least[1] + least[2]))
            best = n;
    }
    return best;
}

/* A cube with one edge bent so far that tets fold, and at the opposite corner one bent a little. */
static OstMeshChunk *bent_cube(void)
{
    OstMeshChunk *cube = quadratic_cube(2);
    if (ost_rank(ctx) == 0) {
        cube->coordinates[3 * (size_t)extreme_middle(cube, 1.0)] += 0.3;
        cube->coordinates[3 * (size_t)extreme_middle(cube, -1.0)] += 0.02;
    }
    return cube;
}

static void hear_once(void *heard, const char *text)
{
    assert_non_null(strstr(text, "straighten: the edges of "));
    assert_non_null(strstr(text, " curved tets that folded over are now straight; the worst, tet "));
    ++*(int *)heard;
}

static void tets_that_fold_are_made_straight_if_asked(void **state)
{
    OstMeshChunk *cube = bent_cube();
    OstMesh *mesh = NULL;
    int warnings = 0;
    assert_failure(ost_mesh_distribute(ctx, &cube, &mesh), OST_INVALID_INPUT,
                   "such tets; give them straight edges (element: {straighten: true} in a case");
    cube = bent_cube();
    cube->straighten = 1;
    const OstLogLevel level = ost_log_level(ctx);
    ost_log_set_level(ctx, OST_LOG_QUIET);
    ost_warn_listen(ctx, hear_once, &warnings);
    assert_success(ost_mesh_distribute(ctx, &cube, &mesh));
    ost_warn_listen(ctx, NULL, NULL);
    ost_log_set_level(ctx, level);
    assert_int_equal(warnings, ost_rank(ctx) == 0);
    double farthest = 0.0;
    for (OstLocal t = 0; t < mesh->tet_count; t++)
        for (int e = 0; e < 6; e++) {
            const OstLocal *nodes = mesh->tet_nodes + 10 * (size_t)t;
            const double *a = mesh->coordinates + 3 * (size_t)nodes[ost_tet_edge[e][0]];
            const double *b = mesh->coordinates + 3 * (size_t)nodes[ost_tet_edge[e][1]];
            const double *middle = mesh->coordinates + 3 * (size_t)nodes[4 + e];
            for (int d = 0; d < 3; d++)
                farthest = fmax(farthest, fabs(middle[d] - 0.5 * (a[d] + b[d])));
        }
    assert_success(ost_max(ctx, 1, &farthest));
    assert_close(farthest, 0.02, 1e-15);
    ost_mesh_destroy(&mesh);
}

static void tets_that_fold_may_become_linear(void **state)
{
    OstMeshChunk *cube = bent_cube();
    OstMesh *mesh = NULL, *linear = NULL;
    double volume = 0.0;
    cube->only_vertices = 1;
    assert_success(ost_mesh_distribute(ctx, &cube, &mesh));
    assert_success(ost_mesh_linear(mesh, &linear, NULL));
    for (OstLocal t = 0; t < linear->owned_tets; t++)
        volume += ost_tet_volume(linear->coordinates, ost_mesh_nodes_of(linear, t));
    assert_success(ost_sum(ctx, 1, &volume));
    assert_close(volume, 1.0, 1e-14);
    ost_mesh_destroy(&linear);
    ost_mesh_destroy(&mesh);
}

static void labels_of_the_file_are_used(void **state)
{
    Cube cube = sound_cube();
    cube.x[3 * 5 + 1] = NAN;
    OstMeshChunk *chunk = hand_chunk(4, cube.nodes, cube.x, cube.count, cube.tets);
    OstMesh *mesh = NULL;
    assert_success(OST_NEW(ctx, &chunk->node_label, 8));
    for (int n = 0; n < 8; n++)
        chunk->node_label[n] = 100 + n;
    assert_failure(ost_mesh_distribute(ctx, &chunk, &mesh), OST_INVALID_INPUT, "vertex 105 has coordinate nan");
}

static void a_boundary_belongs_to_the_body(void **state)
{
    const Cube cube = sound_cube();
    const OstGlobal loose[3] = {1, 2, 4}; /* nodes of the cube, but of no common tet */
    OstMeshChunk *chunk = hand_chunk(4, cube.nodes, cube.x, cube.count, cube.tets);
    OstMesh *mesh = NULL;
    add_boundary(chunk, "pull", 2, 3, 1, loose);
    assert_failure(ost_mesh_distribute(ctx, &chunk, &mesh), OST_INVALID_INPUT, "boundary 'pull' has a face");
}

static void fewer_nodes_than_ranks_are_refused(void **state)
{
    const Slab slab = {.ctx = ctx, .global_nodes = ost_size(ctx) - 1};
    char text[64];
    snprintf(text, sizeof text, "mesh of %d nodes is too small for %d ranks", ost_size(ctx) - 1, ost_size(ctx));
    assert_failure(ost_partition(&slab, NULL, NULL), OST_INVALID_INPUT, text);
    assert_failure(ost_partition(&slab, NULL, NULL), OST_INVALID_INPUT, "use fewer ranks");
}

static void limits_of_metis_are_told_before_it_is_called(void **state)
{
    assert_success(ost_graph_check_limits(ctx, "graph", 1000, INT32_MAX));
    if (IDXTYPEWIDTH == 32) {
        assert_failure(ost_graph_check_limits(ctx, "nodal graph", 1000, (OstGlobal)INT32_MAX + 1), OST_LIMIT_EXCEEDED,
                       "the nodal graph has 1000 rows and 2147483648 entries");
        assert_failure(ost_graph_check_limits(ctx, "nodal graph", 3000000000, 1), OST_LIMIT_EXCEEDED, "32 bits");
    }
}

static void large_weights_are_scaled_to_what_metis_sums(void **state)
{
    idx_t weights[4] = {1, INT32_MAX, 0, INT32_MAX / 2};
    ost_graph_shrink_weights(4, weights);
    OstGlobal sum = 0;
    for (int i = 0; i < 4; i++)
        sum += weights[i];
    if (IDXTYPEWIDTH == 32)
        assert_true(sum <= INT32_MAX && sum > INT32_MAX / 4);
    assert_int_equal(weights[0], 1);
    assert_int_equal(weights[2], 0);
    assert_true(llabs((long long)weights[1] - 2 * (long long)weights[3]) < 4);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(a_sound_cube_passes),
    cmocka_unit_test(inverted_tets_are_named_lowest_first),
    cmocka_unit_test(flat_tets_are_named),
    cmocka_unit_test(a_sliver_of_quality_1e_9_is_no_flat_tet),
    cmocka_unit_test(coordinates_must_be_finite),
    cmocka_unit_test(vertices_without_tet_are_listed),
    cmocka_unit_test(numbers_must_fit_the_mesh),
    cmocka_unit_test(tets_that_fold_are_made_straight_if_asked),
    cmocka_unit_test(tets_that_fold_may_become_linear),
    cmocka_unit_test(labels_of_the_file_are_used),
    cmocka_unit_test(a_boundary_belongs_to_the_body),
    cmocka_unit_test(fewer_nodes_than_ranks_are_refused),
    cmocka_unit_test(limits_of_metis_are_told_before_it_is_called),
    cmocka_unit_test(large_weights_are_scaled_to_what_metis_sums),
};

OST_TEST_MAIN(tests)
