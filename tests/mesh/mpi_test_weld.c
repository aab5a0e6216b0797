/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "mesh_support.h"

#include <math.h>

/* Inclusions, 1e6 times stiffer, in a cube of 16³ hexes of six tets: are they whole on one rank? */

enum { CELLS = 16, SIDE = CELLS + 1, NODES = SIDE * SIDE * SIDE };

/* Inclusions of width³ hexes, one in each period³. */
typedef struct Pattern {
    OstLocal period, width;
    double ratio;
} Pattern;

static int is_inside(const Pattern *pattern, OstGlobal hex)
{
    const OstLocal shift = (pattern->period - pattern->width) / 2;
    int inside = 1;
    for (int d = 0; d < 3; d++, hex /= CELLS) {
        const OstLocal at = (OstLocal)(hex % CELLS) % pattern->period - shift;
        inside &= at >= 0 && at < pattern->width;
    }
    return inside;
}

static OstStatus stiffness_of(const void *data, const OstMeshChunk *chunk, double *stiffness)
{
    const Pattern *pattern = data;
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        stiffness[t] = chunk->tet_region[t] ? pattern->ratio : 1.0;
    return OST_SUCCESS;
}

/* Numbers that put neighbours on different ranks, where `scattered`: 1000 and 4913 have no common factor. */
static OstGlobal number_of(OstGlobal node, int scattered)
{
    return scattered ? node * 1000 % NODES : node;
}

/* All of the cube on rank 0, as a serial reader gives it, or a share on every rank. */
static OstMeshChunk *make_chunk(const Pattern *pattern, int scattered)
{
    OstMeshChunk *chunk = NULL;
    const OstBlockShape shape = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {CELLS, CELLS, CELLS}};
    assert_success(ost_chunk_create_block(ctx, &shape, &chunk));
    assert_success(OST_RESIZE(ctx, &chunk->regions.name, 2));
    assert_success(ost_copy_string(ctx, "core", &chunk->regions.name[1]));
    chunk->regions.count = 2;
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        chunk->tet_region[t] = is_inside(pattern, (chunk->first_tet + t) / 6);
    if (!scattered)
        return chunk;
    for (OstLocal i = 0; i < chunk->node_count; i++) { /* 1000 × 113 = 1 mod 4913 */
        const OstGlobal was = (chunk->first_node + i) * 113 % NODES;
        const OstGlobal at[3] = {was / (SIDE * SIDE), was / SIDE % SIDE, was % SIDE};
        for (int d = 0; d < 3; d++)
            chunk->coordinates[3 * (size_t)i + (size_t)d] = (double)at[d] / CELLS;
    }
    for (size_t i = 0; i < 4 * (size_t)chunk->tet_count; i++)
        chunk->tet_nodes[i] = number_of(chunk->tet_nodes[i], 1);
    for (int b = 0; b < chunk->boundary_count; b++)
        for (OstLocal i = 0; i < 3 * chunk->boundaries[b].count; i++)
            chunk->boundaries[b].nodes[i] = number_of(chunk->boundaries[b].nodes[i], 1);
    return chunk;
}

static OstMesh *distribute(const Pattern *pattern, int scattered)
{
    const OstTetMetric material = {.data = pattern, .stiffness = stiffness_of};
    OstMeshChunk *chunk = make_chunk(pattern, scattered);
    OstMesh *mesh = NULL;
    assert_success(ost_mesh_distribute_by(ctx, &chunk, &material, &mesh));
    return mesh;
}

/* Stiff tets with nodes of several ranks, on all ranks. */
static int count_split(const OstMesh *mesh)
{
    int split = 0;
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        int owned = 0;
        for (int v = 0; v < 4; v++)
            owned += mesh->tet_nodes[4 * (size_t)t + (size_t)v] < mesh->owned_nodes;
        split += mesh->tet_region[t] == 1 && owned < 4;
    }
    MPI_Allreduce(MPI_IN_PLACE, &split, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return split;
}

static double imbalance(const OstMesh *mesh)
{
    int most = mesh->owned_nodes;
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return (double)most * ost_size(ctx) / (double)mesh->global_nodes;
}

static void inclusions_are_whole(void **state)
{
    static const Pattern patterns[] = {{4, 2, 1e6}, {2, 1, 1e6}, {8, 5, 1e6}};
    for (size_t p = 0; p < sizeof patterns / sizeof patterns[0]; p++)
        for (int scattered = 0; scattered < 2; scattered++) {
            OstMesh *mesh = distribute(&patterns[p], scattered);
            assert_int_equal(count_split(mesh), 0);
            assert_true(imbalance(mesh) < 1.25);
            ost_mesh_destroy(&mesh);
        }
}

/* Every second layer of hexes is flat: no rank has one side of it alone. */
static void the_two_sides_of_a_flat_layer_are_together(void **state)
{
    const Pattern none = {4, 0, 1.0};
    for (int scattered = 0; scattered < 2; scattered++) {
        OstMeshChunk *chunk = make_chunk(&none, scattered);
        OstMesh *mesh = NULL;
        int split = 0;
        for (OstLocal i = 0; i < chunk->node_count; i++) {
            const long layer = lround(CELLS * chunk->coordinates[3 * (size_t)i + 2]);
            chunk->coordinates[3 * (size_t)i + 2] = (0.002 * (double)(layer % 2) + (double)(layer / 2 * 2)) / CELLS;
        }
        assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
        for (OstLocal t = 0; t < mesh->owned_tets; t++)
            for (int e = 0; e < 6; e++) {
                const OstLocal a = mesh->tet_nodes[4 * (size_t)t + (size_t)ost_tet_edge[e][0]];
                const OstLocal b = mesh->tet_nodes[4 * (size_t)t + (size_t)ost_tet_edge[e][1]];
                const double *p = mesh->coordinates + 3 * (size_t)a, *q = mesh->coordinates + 3 * (size_t)b;
                split += hypot(hypot(p[0] - q[0], p[1] - q[1]), p[2] - q[2]) < 0.01 / CELLS &&
                         (a < mesh->owned_nodes) != (b < mesh->owned_nodes);
            }
        assert_int_equal(split, 0);
        assert_true(imbalance(mesh) < 1.25);
        ost_mesh_destroy(&mesh);
    }
}

/* A body that hangs together, and one whose moduli hardly differ, are cut as if they were of one material. */
static void other_bodies_are_cut_as_before(void **state)
{
    static const Pattern patterns[] = {{4, 2, 1e3}, {16, 14, 1e6}};
    for (size_t p = 0; p < sizeof patterns / sizeof patterns[0]; p++) {
        OstMeshChunk *chunk = make_chunk(&patterns[p], 0);
        OstMesh *mesh = distribute(&patterns[p], 0), *plain = NULL;
        assert_success(ost_mesh_distribute(ctx, &chunk, &plain));
        assert_int_equal(mesh->owned_nodes, plain->owned_nodes);
        assert_memory_equal(mesh->node_label, plain->node_label,
                            (size_t)plain->owned_nodes * sizeof *plain->node_label);
        assert_true(ost_size(ctx) == 1 || count_split(mesh) > 0);
        ost_mesh_destroy(&mesh);
        ost_mesh_destroy(&plain);
    }
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(inclusions_are_whole),
    cmocka_unit_test(the_two_sides_of_a_flat_layer_are_together),
    cmocka_unit_test(other_bodies_are_cut_as_before),
};

OST_TEST_MAIN(tests)
