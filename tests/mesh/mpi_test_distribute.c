/* SPDX-License-Identifier: BSD-3-Clause */
#include "support.h"

#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "mesh_support.h"
#include "orthostat/refine.h"

/* A mesh before partition, complete on every rank, to compare pieces with: node n has label n + 1, tet t has t + 1. */
typedef struct Whole {
    int nodes_per_tet;
    OstGlobal nodes, tets;
    double *x;
    OstGlobal *tet;
} Whole;

static void gather(size_t size, size_t mine, const void *values, size_t all, void **gathered)
{
    const int ranks = ost_size(ctx);
    int *count = malloc(2 * (size_t)ranks * sizeof *count);
    int *start = count + ranks;
    const int bytes = (int)(mine * size);
    assert_int_equal(MPI_Allgather(&bytes, 1, MPI_INT, count, 1, MPI_INT, MPI_COMM_WORLD), MPI_SUCCESS);
    start[0] = 0;
    for (int r = 1; r < ranks; r++)
        start[r] = start[r - 1] + count[r - 1];
    *gathered = malloc(all * size);
    MPI_Allgatherv(values, bytes, MPI_BYTE, *gathered, count, start, MPI_BYTE, MPI_COMM_WORLD);
    free(count);
}

static Whole gather_whole(const OstMeshChunk *chunk)
{
    Whole whole = {chunk->nodes_per_tet, chunk->global_nodes, chunk->global_tets, NULL, NULL};
    const size_t width = (size_t)chunk->nodes_per_tet;
    gather(3 * sizeof(double), (size_t)chunk->node_count, chunk->coordinates, (size_t)whole.nodes, (void **)&whole.x);
    gather(width * sizeof(OstGlobal), (size_t)chunk->tet_count, chunk->tet_nodes, (size_t)whole.tets,
           (void **)&whole.tet);
    return whole;
}

static void free_whole(Whole *whole)
{
    free(whole->x);
    free(whole->tet);
}

/* Counts how often labels 1 .. n are owned over all ranks: once each. */
static void assert_owned_once(OstGlobal n, OstLocal owned, const OstGlobal *labels)
{
    int *times = calloc((size_t)n, sizeof *times);
    for (OstLocal i = 0; i < owned; i++) {
        assert_true(labels[i] >= 1 && labels[i] <= n);
        times[labels[i] - 1]++;
    }
    MPI_Allreduce(MPI_IN_PLACE, times, (int)n, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    for (OstGlobal i = 0; i < n; i++)
        assert_int_equal(times[i], 1);
    free(times);
}

/* Node numbers: contiguous over the ranks, owned ones in order, ghosts ascending and not owned, each label's number the
 * same wherever it is held. */
static void check_node_numbers(const Whole *whole, const OstMesh *mesh)
{
    OstGlobal *number = calloc((size_t)whole->nodes, sizeof *number);
    OstGlobal first = 0;
    const OstGlobal owned = mesh->owned_nodes;
    MPI_Exscan(&owned, &first, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    assert_int_equal(mesh->first_node, ost_rank(ctx) == 0 ? 0 : first);
    assert_true(owned > 0);
    for (OstLocal i = 0; i < mesh->owned_nodes; i++) {
        assert_int_equal(mesh->node_number[i], mesh->first_node + i);
        assert_true(i == 0 || mesh->node_label[i - 1] < mesh->node_label[i]); /* the old order is kept */
        number[mesh->node_label[i] - 1] = mesh->node_number[i];
    }
    MPI_Allreduce(MPI_IN_PLACE, number, (int)whole->nodes, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    for (OstLocal i = mesh->owned_nodes; i < mesh->node_count; i++) {
        assert_true(mesh->node_number[i] < mesh->first_node || mesh->node_number[i] >= mesh->first_node + owned);
        assert_true(i == mesh->owned_nodes || mesh->node_number[i - 1] < mesh->node_number[i]);
        assert_int_equal(number[mesh->node_label[i] - 1], mesh->node_number[i]);
    }
    free(number);
}

static void check_coordinates(const Whole *whole, const OstMesh *mesh)
{
    for (OstLocal i = 0; i < mesh->node_count; i++)
        assert_memory_equal(mesh->coordinates + 3 * (size_t)i, whole->x + 3 * (mesh->node_label[i] - 1),
                            3 * sizeof(double));
}

/* The tets here are those that touch an owned node, all of them, with the nodes that they had. */
static void check_tets(const Whole *whole, const OstMesh *mesh)
{
    const size_t width = (size_t)mesh->nodes_per_tet;
    char *owned = calloc((size_t)whole->nodes, 1);
    char *held = calloc((size_t)whole->tets, 1);
    for (OstLocal i = 0; i < mesh->owned_nodes; i++)
        owned[mesh->node_label[i] - 1] = 1;
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        const OstGlobal label = mesh->tet_label[t];
        OstGlobal nodes[10];
        assert_int_equal(held[label - 1], 0);
        held[label - 1] = 1;
        for (size_t v = 0; v < width; v++) {
            const OstLocal node = mesh->tet_nodes[(size_t)t * width + v];
            assert_int_equal(mesh->node_label[node], whole->tet[(size_t)(label - 1) * width + v] + 1);
            nodes[v] = node;
        }
        assert_int_equal(ost_mesh_owns(mesh, (int)width, nodes), t < mesh->owned_tets);
        assert_true(t == 0 || t == mesh->owned_tets || mesh->tet_label[t - 1] < label); /* the old order is kept */
    }
    for (OstGlobal t = 0; t < whole->tets; t++) {
        int touches = 0;
        for (size_t v = 0; v < width; v++)
            touches |= owned[whole->tet[(size_t)t * width + v]];
        assert_int_equal(held[t], touches);
    }
    free(owned);
    free(held);
}

static void check_halo(const OstMesh *mesh)
{
    double *x = malloc(3 * (size_t)mesh->node_count * sizeof *x);
    memcpy(x, mesh->coordinates, 3 * (size_t)mesh->owned_nodes * sizeof *x);
    for (size_t i = 3 * (size_t)mesh->owned_nodes; i < 3 * (size_t)mesh->node_count; i++)
        x[i] = NAN;
    assert_success(ost_halo_import(mesh->halo, 3 * sizeof *x, x));
    assert_memory_equal(x, mesh->coordinates, 3 * (size_t)mesh->node_count * sizeof *x);
    free(x);
}

/* A sum over tets that depends on which nodes they have in which places, and not on who holds them. */
static uint64_t tet_sum(OstGlobal label, int width, const OstGlobal *node_labels)
{
    uint64_t sum = (uint64_t)label;
    for (int v = 0; v < width; v++)
        sum = (sum ^ (uint64_t)node_labels[v]) * 1099511628211u; /* FNV-1a's prime */
    return sum;
}

static void check_checksum(const Whole *whole, const OstMesh *mesh)
{
    uint64_t expected = 0;
    uint64_t sum = 0;
    OstGlobal labels[10];
    const int width = mesh->nodes_per_tet;
    for (OstGlobal t = 0; t < whole->tets; t++) {
        for (int v = 0; v < width; v++)
            labels[v] = whole->tet[t * width + v] + 1;
        expected += tet_sum(t + 1, width, labels);
    }
    for (OstLocal t = 0; t < mesh->owned_tets; t++) {
        for (int v = 0; v < width; v++)
            labels[v] = mesh->node_label[mesh->tet_nodes[t * width + v]];
        sum += tet_sum(mesh->tet_label[t], width, labels);
    }
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
    assert_true(sum == expected);
}

/* Distributes a chunk and checks every promise of the header. */
static OstMesh *distribute_and_check(OstMeshChunk *chunk)
{
    OstMesh *mesh = NULL;
    Whole whole = gather_whole(chunk);
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_null(chunk);
    assert_int_equal(mesh->global_nodes, whole.nodes);
    assert_int_equal(mesh->global_tets, whole.tets);
    assert_owned_once(whole.nodes, mesh->owned_nodes, mesh->node_label);
    assert_owned_once(whole.tets, mesh->owned_tets, mesh->tet_label);
    check_node_numbers(&whole, mesh);
    check_coordinates(&whole, mesh);
    check_tets(&whole, mesh);
    check_halo(mesh);
    check_checksum(&whole, mesh);
    free_whole(&whole);
    return mesh;
}

static OstMeshChunk *tube_chunk(void)
{
    OstMeshChunk *chunk = NULL;
    assert_success(ost_chunk_create_tube(ctx, &paper_tube, &chunk));
    return chunk;
}

/* The same mesh as a serial reader would give it. */
static OstMeshChunk *on_rank_0(OstMeshChunk *chunk)
{
    Whole whole = gather_whole(chunk);
    OstMeshChunk *serial = hand_chunk(4, (OstLocal)whole.nodes, whole.x, (OstLocal)whole.tets, whole.tet);
    ost_chunk_destroy(&chunk);
    free_whole(&whole);
    return serial;
}

static void assert_balanced(const OstMesh *mesh)
{
    int most = mesh->owned_nodes;
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    assert_true(most * ost_size(ctx) <= 1.2 * (double)mesh->global_nodes);
}

/* A cut across the tube between two rows of nodes has 420 nodes on each side; parts have at most two such ends. */
static void assert_compact(const OstMesh *mesh)
{
    int ghosts = mesh->node_count - mesh->owned_nodes;
    MPI_Allreduce(MPI_IN_PLACE, &ghosts, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    assert_true(ghosts <= 3 * 2 * 420);
}

static void the_tube_made_by_all_is_cut_and_complete(void **state)
{
    OstMesh *mesh = distribute_and_check(tube_chunk());
    assert_balanced(mesh);
    assert_compact(mesh);
    assert_close(total_volume(mesh) / tube_volume(&paper_tube), 1.0, 1e-12);
    ost_mesh_destroy(&mesh);
}

static void the_tube_read_by_rank_0_is_cut_and_complete(void **state)
{
    OstMesh *mesh = distribute_and_check(on_rank_0(tube_chunk()));
    assert_balanced(mesh);
    assert_compact(mesh);
    assert_close(total_volume(mesh) / tube_volume(&paper_tube), 1.0, 1e-12);
    ost_mesh_destroy(&mesh);
}

static void boundaries_and_surface_keep_their_areas(void **state)
{
    OstMesh *mesh = distribute_and_check(tube_chunk());
    const double ring = tube_volume(&paper_tube) / 10.0;
    const double around = 2.0 * 60.0 * sin(M_PI / 60.0) * 10.0; /* wall of a 60-gon prism of radius 1 */
    double vector[3];
    assert_close(boundary_area(mesh, "top", vector), ring, 1e-11);
    assert_close(vector[1], ring, 1e-11);
    assert_close(boundary_area(mesh, "ends", vector), 2.0 * ring, 1e-11);
    assert_close(boundary_area(mesh, "inner", vector), 0.9 * around, 1e-10);
    assert_close(boundary_area(mesh, "outer", vector), 1.5 * around, 1e-10);
    assert_close(surface_area(mesh, vector), 2.0 * ring + 2.4 * around, 1e-10);
    for (int d = 0; d < 3; d++)
        assert_close(vector[d], 0.0, 1e-11);
    for (int b = 0; b < mesh->boundary_count; b++) {
        const OstBoundary *boundary = &mesh->boundaries[b];
        for (OstLocal i = 0; i < boundary->count; i++) {
            const OstGlobal *nodes = boundary->nodes + 3 * i;
            assert_true(nodes[0] < mesh->owned_nodes || nodes[1] < mesh->owned_nodes || nodes[2] < mesh->owned_nodes);
        }
    }
    ost_mesh_destroy(&mesh);
}

static void blocks_of_all_sizes_are_complete(void **state)
{
    static const OstLocal divisions[][3] = {{1, 1, 1}, {3, 1, 1}, {1, 2, 13}, {7, 6, 5}, {40, 2, 3}};
    for (size_t s = 0; s < sizeof divisions / sizeof *divisions; s++) {
        OstMeshChunk *chunk = NULL;
        OstBlockShape shape = {{0.0, 0.0, 0.0}, {1.0, 2.0, 3.0}, {0, 0, 0}};
        memcpy(shape.divisions, divisions[s], sizeof shape.divisions);
        assert_success(ost_chunk_create_block(ctx, &shape, &chunk));
        OstMesh *mesh = distribute_and_check(chunk);
        double vector[3];
        assert_close(total_volume(mesh), 6.0, 1e-13);
        assert_close(surface_area(mesh, vector), 22.0, 1e-12);
        ost_mesh_destroy(&mesh);
    }
}

static void quadratic_tets_come_with_all_their_nodes(void **state)
{
    OstMesh *mesh = distribute_and_check(quadratic_cube(3));
    OstSurface *surface = NULL;
    double vector[3];
    assert_close(total_volume(mesh), 1.0, 1e-14);
    assert_close(surface_area(mesh, vector), 6.0, 1e-13);
    assert_success(ost_surface_create(mesh, NULL, &surface));
    assert_int_equal(surface->nodes_per_face, 6);
    for (OstLocal i = 0; i < surface->count; i++) {
        const OstLocal *f = surface->nodes + 6 * i;
        for (int e = 0; e < 3; e++)
            for (int d = 0; d < 3; d++)
                assert_close(mesh->coordinates[3 * f[3 + e] + d],
                             0.5 * (mesh->coordinates[3 * f[e] + d] + mesh->coordinates[3 * f[(e + 1) % 3] + d]),
                             1e-15);
    }
    ost_surface_destroy(&surface);
    ost_mesh_destroy(&mesh);
}

static void regions_and_axes_travel_with_their_tets(void **state)
{
    OstMeshChunk *chunk = on_rank_0(tube_chunk());
    if (ost_rank(ctx) == 0) { /* the other ranks of a serial reader have no axes at all */
        assert_success(OST_NEW(ctx, &chunk->tet_axes, 9 * (size_t)chunk->tet_count));
        for (OstLocal t = 0; t < chunk->tet_count; t++)
            for (int i = 0; i < 9; i++)
                chunk->tet_axes[9 * (size_t)t + (size_t)i] = 10.0 * t + i;
        for (OstLocal t = 0; t < chunk->tet_count; t++)
            chunk->tet_region[t] = t % 2;
    }
    assert_success(OST_RESIZE(ctx, &chunk->regions.name, 2));
    chunk->regions.count = 2;
    assert_success(ost_copy_string(ctx, "odd", &chunk->regions.name[1]));
    OstMesh *mesh = distribute_and_check(chunk);
    assert_int_equal(ost_mesh_find_region(mesh, "odd"), 1);
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        assert_int_equal(mesh->tet_region[t], (mesh->tet_label[t] - 1) % 2);
        for (int i = 0; i < 9; i++)
            assert_close(mesh->tet_axes[9 * (size_t)t + (size_t)i], 10.0 * (double)(mesh->tet_label[t] - 1) + i, 0.0);
    }
    ost_mesh_destroy(&mesh);
}

static void points_stay_with_their_owner(void **state)
{
    OstMeshChunk *chunk = quadratic_cube(2);
    OstGlobal points[27];
    OstGlobal edge[3] = {0, 1, 0};
    for (OstGlobal n = 0; n < 27; n++)
        points[n] = n;
    /* vertices 0 and 1 are on the z axis; find the node between */
    for (OstLocal t = 0; t < chunk->tet_count; t++)
        for (int e = 0; e < 6; e++)
            if (chunk->tet_nodes[10 * t + ost_tet_edge[e][0]] + chunk->tet_nodes[10 * t + ost_tet_edge[e][1]] == 1)
                edge[2] = chunk->tet_nodes[10 * t + 4 + e];
    add_boundary(chunk, "vertices", 0, 1, 27, points);
    add_boundary(chunk, "edge", 1, 3, 1, edge);
    OstMesh *mesh = distribute_and_check(chunk);
    int counts[2] = {mesh->boundaries[0].count, 0};
    for (OstLocal i = 0; i < mesh->boundaries[0].count; i++)
        assert_true(mesh->boundaries[0].nodes[i] < mesh->owned_nodes);
    for (OstLocal i = 0; i < mesh->boundaries[1].count; i++) {
        const OstGlobal *nodes = mesh->boundaries[1].nodes + 3 * i;
        counts[1] += ost_mesh_owns(mesh, 3, nodes);
        assert_close(mesh->coordinates[3 * nodes[2] + 2], 0.25, 0.0);
    }
    MPI_Allreduce(MPI_IN_PLACE, counts, 2, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    assert_int_equal(counts[0], 27);
    assert_int_equal(counts[1], 1);
    ost_mesh_destroy(&mesh);
}

/* Tets in another order than their nodes, as in a file that another program wrote. */
static void shuffled_tets_are_cut_as_well(void **state)
{
    OstMeshChunk *chunk = tube_chunk();
    Whole whole = gather_whole(chunk);
    for (OstLocal t = 0; t < chunk->tet_count; t++) { /* 7 and 129,600 have no common factor */
        const OstGlobal other = (chunk->first_tet + t) * 7 % whole.tets;
        memcpy(chunk->tet_nodes + 4 * (size_t)t, whole.tet + 4 * other, 4 * sizeof(OstGlobal));
    }
    free_whole(&whole);
    OstMesh *mesh = distribute_and_check(chunk);
    assert_balanced(mesh);
    assert_compact(mesh);
    ost_mesh_destroy(&mesh);
}

static int sum_of_ghosts(const OstMesh *mesh)
{
    int ghosts = mesh->node_count - mesh->owned_nodes;
    MPI_Allreduce(MPI_IN_PLACE, &ghosts, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return ghosts;
}

/* Neighbouring nodes held by different ranks, for the most part. */
static void scattered_nodes_are_cut_as_well(void **state)
{
    OstMeshChunk *chunk = on_rank_0(tube_chunk());
    OstMesh *cut_whole = NULL;
    assert_success(ost_mesh_distribute(ctx, &chunk, &cut_whole));
    const int ghosts = sum_of_ghosts(cut_whole);
    ost_mesh_destroy(&cut_whole);
    chunk = tube_chunk();
    Whole whole = gather_whole(chunk);
    for (OstLocal i = 0; i < chunk->node_count;
         i++) /* old node n gets number 5003 n, and 5003 × 17447 = 1 mod 25,620 */
        memcpy(chunk->coordinates + 3 * (size_t)i, whole.x + 3 * ((chunk->first_node + i) * 17447 % whole.nodes),
               3 * sizeof(double));
    for (size_t i = 0; i < 4 * (size_t)chunk->tet_count; i++)
        chunk->tet_nodes[i] = chunk->tet_nodes[i] * 5003 % whole.nodes;
    for (int b = 0; b < chunk->boundary_count; b++)
        for (OstLocal i = 0; i < 3 * chunk->boundaries[b].count; i++)
            chunk->boundaries[b].nodes[i] = chunk->boundaries[b].nodes[i] * 5003 % whole.nodes;
    free_whole(&whole);
    OstMesh *mesh = distribute_and_check(chunk);
    double vector[3];
    assert_balanced(mesh);
    assert_compact(mesh);
    assert_true(sum_of_ghosts(mesh) <= 1.5 * ghosts);
    assert_close(total_volume(mesh) / tube_volume(&paper_tube), 1.0, 1e-12);
    assert_close(boundary_area(mesh, "ends", vector), 2.0 * tube_volume(&paper_tube) / 10.0, 1e-11);
    ost_mesh_destroy(&mesh);
}

/* As a program may hand it over in arrays: the nodes are all rank 0's, the tets are not. */
static void nodes_apart_from_their_tets_are_cut_as_well(void **state)
{
    OstMeshChunk *chunk = tube_chunk();
    Whole whole = gather_whole(chunk);
    const OstLocal nodes = ost_rank(ctx) == 0 ? (OstLocal)whole.nodes : 0;
    OST_FREE(chunk->coordinates);
    copy_array(3 * (size_t)nodes, sizeof(double), whole.x, (void **)&chunk->coordinates);
    chunk->node_count = nodes;
    chunk->first_node = ost_rank(ctx) == 0 ? 0 : whole.nodes;
    free_whole(&whole);
    OstMesh *mesh = distribute_and_check(chunk);
    assert_balanced(mesh);
    assert_compact(mesh);
    ost_mesh_destroy(&mesh);
}

/* Thirty times as short along x: lengths squared by 1/900. */
static const double stiff_along_x[6] = {1.0 / 900.0, 1.0, 1.0, 0.0, 0.0, 0.0};

static OstStatus metric_along_x(const void *data, const OstMeshChunk *chunk, const double *centroids, double *metric)
{
    (void)data;
    for (size_t t = 0; t < (size_t)chunk->tet_count; t++) {
        assert_true(centroids[3 * t] > 0.0 && centroids[3 * t] < 1.0);
        memcpy(metric + 6 * t, stiff_along_x, sizeof stiff_along_x);
    }
    return OST_SUCCESS;
}

/* Edges along x, of all tets, that are cut by a border between ranks. */
static int cut_along_x(const OstMesh *mesh)
{
    int cut = 0;
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        for (int e = 0; e < 6; e++) {
            const OstLocal a = mesh->tet_nodes[4 * t + ost_tet_edge[e][0]];
            const OstLocal b = mesh->tet_nodes[4 * t + ost_tet_edge[e][1]];
            const double *p = mesh->coordinates + 3 * (size_t)a, *q = mesh->coordinates + 3 * (size_t)b;
            if ((a < mesh->owned_nodes) == (b < mesh->owned_nodes))
                continue; /* two ghosts of different owners are counted by neither: a bound from below will do */
            cut += p[1] == q[1] && p[2] == q[2];
        }
    MPI_Allreduce(MPI_IN_PLACE, &cut, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    return cut;
}

/* A bar of 24 × 8 × 8 hexes is cut across if all edges are alike. Borders along it, two planes at the most, cut up to
 * 2 × 25 × 9 times as many other edges, but no stiff ones; METIS sees clusters of nodes, and may cut a few. */
static void borders_run_along_what_is_stiff(void **state)
{
    static const OstBlockShape bar = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {24, 8, 8}};
    const OstTetMetric metric = {.fill = metric_along_x};
    int cut[2];
    for (int k = 0; k < 2; k++) {
        OstMeshChunk *chunk = NULL;
        OstMesh *mesh = NULL;
        assert_success(ost_chunk_create_block(ctx, &bar, &chunk));
        assert_success(ost_mesh_distribute_by(ctx, &chunk, k == 0 ? NULL : &metric, &mesh));
        cut[k] = cut_along_x(mesh);
        ost_mesh_destroy(&mesh);
    }
    assert_true(ost_size(ctx) == 1 ? cut[0] == 0 && cut[1] == 0 : cut[1] * 4 < cut[0]);
}

static void a_mesh_is_cut_the_same_way_every_time(void **state)
{
    OstMesh *first = distribute_and_check(tube_chunk());
    OstMesh *second = distribute_and_check(tube_chunk());
    assert_int_equal(first->node_count, second->node_count);
    assert_memory_equal(first->node_label, second->node_label, (size_t)first->node_count * sizeof(OstGlobal));
    ost_mesh_destroy(&first);
    ost_mesh_destroy(&second);
}

static void a_doubled_tet_is_named_by_the_surface(void **state)
{
    const double x[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    const OstGlobal doubled[] = {0, 1, 2, 3, 0, 1, 2, 3, 1, 2, 3, 4};
    OstMeshChunk *chunk = hand_chunk(4, 5, x, 3, doubled);
    OstMesh *mesh = NULL;
    OstSurface *surface = NULL;
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_failure(ost_surface_create(mesh, NULL, &surface), OST_INVALID_INPUT, "tets 1 and 2");
    assert_null(surface);
    ost_mesh_destroy(&mesh);
}

/* Two tets between five nodes, with the labels of a file. */
static OstMeshChunk *labelled_chunk(const OstGlobal node_label[5], const OstGlobal tet_label[2])
{
    static const double x[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
    static const OstGlobal tets[] = {0, 1, 2, 3, 1, 2, 3, 4};
    OstMeshChunk *chunk = hand_chunk(4, 5, x, 2, tets);
    copy_array((size_t)chunk->node_count, sizeof(OstGlobal), node_label, (void **)&chunk->node_label);
    copy_array((size_t)chunk->tet_count, sizeof(OstGlobal), tet_label, (void **)&chunk->tet_label);
    return chunk;
}

static void labels_below_1_become_1_and_more(void **state)
{
    const struct {
        OstGlobal node[5], tet[2], least[2], most[2], shift[2];
    } table[] = {{{0, 1, 2, 3, 4}, {0, 1}, {1, 1}, {5, 2}, {1, 1}},
                 {{7, 0, 3, 9, 5}, {4, 8}, {1, 4}, {10, 8}, {1, 0}},
                 {{1, 3, 5, 7, 9}, {2, -5}, {1, 1}, {9, 8}, {0, 6}}};
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        OstMeshChunk *chunk = labelled_chunk(table[i].node, table[i].tet);
        OstMesh *mesh = NULL, *fine = NULL, *linear = NULL;
        assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
        OstGlobal least[2] = {INT64_MAX, INT64_MAX}, most[2] = {-1, -1};
        for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
            least[0] = mesh->node_label[n] < least[0] ? mesh->node_label[n] : least[0];
            most[0] = mesh->node_label[n] > most[0] ? mesh->node_label[n] : most[0];
        }
        for (OstLocal t = 0; t < mesh->owned_tets; t++) {
            least[1] = mesh->tet_label[t] < least[1] ? mesh->tet_label[t] : least[1];
            most[1] = mesh->tet_label[t] > most[1] ? mesh->tet_label[t] : most[1];
        }
        assert_success(ost_min_numbers(ctx, 2, least));
        assert_success(ost_max_numbers(ctx, 2, most));
        assert_memory_equal(least, table[i].least, sizeof least);
        assert_memory_equal(most, table[i].most, sizeof most);
        assert_success(ost_mesh_raise(mesh, NULL, &fine));
        assert_success(ost_mesh_linear(fine, &linear, NULL));
        assert_int_equal(mesh->node_shift, table[i].shift[0]);
        assert_int_equal(mesh->tet_shift, table[i].shift[1]);
        assert_int_equal(linear->node_shift, table[i].shift[0]);
        ost_mesh_destroy(&mesh);
        ost_mesh_destroy(&fine);
        ost_mesh_destroy(&linear);
    }
    const OstGlobal wide[] = {0, 1, 2, 3, INT64_MAX}, low[] = {INT64_MIN, 1};
    OstMesh *mesh = NULL;
    OstMeshChunk *chunk = labelled_chunk(wide, (const OstGlobal[]){1, 2});
    assert_failure(ost_mesh_distribute(ctx, &chunk, &mesh), OST_INVALID_INPUT, "number them from 1");
    chunk = labelled_chunk((const OstGlobal[]){1, 2, 3, 4, 5}, low);
    assert_failure(ost_mesh_distribute(ctx, &chunk, &mesh), OST_INVALID_INPUT, "number them from 1");
}

static void time_is_booked_to_mesh_and_partition(void **state)
{
    const long meshes = ost_ledger_entry(ctx, OST_LEDGER_MESH).entries;
    const long partitions = ost_ledger_entry(ctx, OST_LEDGER_PARTITION).entries;
    OstMeshChunk *chunk = tube_chunk();
    OstMesh *mesh = NULL;
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    assert_int_equal(ost_ledger_entry(ctx, OST_LEDGER_MESH).entries, meshes + 1);
    assert_int_equal(ost_ledger_entry(ctx, OST_LEDGER_PARTITION).entries, partitions + 1);
    ost_mesh_destroy(&mesh);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(the_tube_made_by_all_is_cut_and_complete),
    cmocka_unit_test(the_tube_read_by_rank_0_is_cut_and_complete),
    cmocka_unit_test(boundaries_and_surface_keep_their_areas),
    cmocka_unit_test(blocks_of_all_sizes_are_complete),
    cmocka_unit_test(quadratic_tets_come_with_all_their_nodes),
    cmocka_unit_test(regions_and_axes_travel_with_their_tets),
    cmocka_unit_test(points_stay_with_their_owner),
    cmocka_unit_test(shuffled_tets_are_cut_as_well),
    cmocka_unit_test(scattered_nodes_are_cut_as_well),
    cmocka_unit_test(nodes_apart_from_their_tets_are_cut_as_well),
    cmocka_unit_test(borders_run_along_what_is_stiff),
    cmocka_unit_test(a_mesh_is_cut_the_same_way_every_time),
    cmocka_unit_test(a_doubled_tet_is_named_by_the_surface),
    cmocka_unit_test(labels_below_1_become_1_and_more),
    cmocka_unit_test(time_is_booked_to_mesh_and_partition),
};

OST_TEST_MAIN(tests)
