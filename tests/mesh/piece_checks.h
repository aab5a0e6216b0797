/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_PIECE_CHECKS_H
#define ORTHOSTAT_TESTS_PIECE_CHECKS_H

/* Include after mesh_support.h: the promises of orthostat/mesh.h, checked on a mesh that was made of another. */
#include "core/parallel/halo.h"

static inline OstGlobal sum_over_ranks(OstGlobal mine)
{
    MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    return mine;
}

static inline double highest_of_ranks(double mine)
{
    MPI_Allreduce(MPI_IN_PLACE, &mine, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return mine;
}

static inline const OstLocal *tet_of(const OstMesh *mesh, OstLocal tet)
{
    return mesh->tet_nodes + (size_t)tet * (size_t)mesh->nodes_per_tet;
}

/* Owned nodes are contiguous over ranks, ghosts ascend and are others'. */
static inline void check_numbers(const OstMesh *mesh)
{
    OstGlobal first = 0;
    const OstGlobal owned = mesh->owned_nodes;
    MPI_Exscan(&owned, &first, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    assert_int_equal(mesh->first_node, ost_rank(ctx) == 0 ? 0 : first);
    assert_int_equal(mesh->global_nodes, sum_over_ranks(owned));
    assert_int_equal(mesh->global_tets, sum_over_ranks(mesh->owned_tets));
    for (OstLocal i = 0; i < mesh->node_count; i++) {
        const OstGlobal number = mesh->node_number[i];
        if (i < mesh->owned_nodes)
            assert_int_equal(number, mesh->first_node + i);
        else
            assert_true(number < mesh->first_node || number >= mesh->first_node + owned);
        assert_true(number >= 0 && number < mesh->global_nodes);
        assert_true(i <= mesh->owned_nodes || number > mesh->node_number[i - 1]);
    }
}

static inline void check_halo(const OstMesh *mesh)
{
    double *x = malloc(3 * (size_t)mesh->node_count * sizeof *x);
    OstGlobal *number = malloc((size_t)mesh->node_count * sizeof *number);
    OstGlobal *label = malloc((size_t)mesh->node_count * sizeof *label);
    for (OstLocal i = 0; i < mesh->node_count; i++) {
        const int owned = i < mesh->owned_nodes;
        for (int d = 0; d < 3; d++)
            x[3 * i + d] = owned ? mesh->coordinates[3 * i + d] : NAN;
        number[i] = owned ? mesh->node_number[i] : -1;
        label[i] = owned ? mesh->node_label[i] : -1;
    }
    assert_success(ost_halo_import(mesh->halo, 3 * sizeof *x, x));
    assert_success(ost_halo_import(mesh->halo, sizeof *number, number));
    assert_success(ost_halo_import(mesh->halo, sizeof *label, label));
    assert_memory_equal(x, mesh->coordinates, 3 * (size_t)mesh->node_count * sizeof *x);
    assert_memory_equal(number, mesh->node_number, (size_t)mesh->node_count * sizeof *number);
    assert_memory_equal(label, mesh->node_label, (size_t)mesh->node_count * sizeof *label);
    free(label);
    free(number);
    free(x);
}

/* Counted over the tets that ranks own, an owned node has as many tets as are held here: none is missing. */
static inline void check_completeness(const OstMesh *mesh)
{
    double *tets = calloc((size_t)mesh->node_count, sizeof *tets);
    OstLocal *held = calloc((size_t)mesh->node_count, sizeof *held);
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        for (int v = 0; v < mesh->nodes_per_tet; v++) {
            tets[tet_of(mesh, t)[v]] += t < mesh->owned_tets;
            held[tet_of(mesh, t)[v]]++;
        }
    }
    assert_success(ost_halo_add_to_owners(mesh->halo, 1, tets));
    for (OstLocal i = 0; i < mesh->node_count; i++) {
        assert_true(held[i] > 0);
        if (i < mesh->owned_nodes)
            assert_int_equal(held[i], (OstLocal)tets[i]);
    }
    free(held);
    free(tets);
}

static inline int touches_owned(const OstMesh *mesh, int count, const OstGlobal *nodes)
{
    int owned = 0;
    for (int v = 0; v < count; v++)
        owned += nodes[v] >= 0 && nodes[v] < mesh->owned_nodes;
    return owned > 0;
}

/* Owned tets first, by their lowest node; the others touch an owned node. */
static inline void check_tet_owners(const OstMesh *mesh)
{
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        OstGlobal nodes[10];
        for (int v = 0; v < mesh->nodes_per_tet; v++)
            nodes[v] = tet_of(mesh, t)[v];
        assert_int_equal(ost_mesh_owns(mesh, mesh->nodes_per_tet, nodes), t < mesh->owned_tets);
        assert_true(touches_owned(mesh, mesh->nodes_per_tet, nodes));
        assert_true(ost_tet_volume(mesh->coordinates, tet_of(mesh, t)) > 0.0);
    }
}

static inline void check_piece(const OstMesh *mesh)
{
    check_numbers(mesh);
    check_halo(mesh);
    check_completeness(mesh);
    check_tet_owners(mesh);
    for (int b = 0; b < mesh->boundary_count; b++) {
        const OstBoundary *boundary = &mesh->boundaries[b];
        for (OstLocal i = 0; i < boundary->count; i++)
            assert_true(touches_owned(mesh, boundary->nodes_per_item, boundary->nodes + i * boundary->nodes_per_item));
    }
}

/* Places of labels in ascending order. */
typedef struct Labelled {
    OstGlobal label;
    OstLocal place;
} Labelled;

static inline int compare_labelled(const void *a, const void *b)
{
    const OstGlobal x = ((const Labelled *)a)->label;
    const OstGlobal y = ((const Labelled *)b)->label;
    return (x > y) - (x < y);
}

static inline Labelled *sort_labels(OstLocal count, const OstGlobal *label)
{
    Labelled *sorted = malloc(((size_t)count + 1) * sizeof *sorted);
    for (OstLocal i = 0; i < count; i++)
        sorted[i] = (Labelled){label[i], i};
    qsort(sorted, (size_t)count, sizeof *sorted, compare_labelled);
    for (OstLocal i = 1; i < count; i++)
        assert_true(sorted[i - 1].label < sorted[i].label);
    return sorted;
}

static inline OstLocal find_label(const Labelled *sorted, OstLocal count, OstGlobal label)
{
    const Labelled key = {label, 0};
    const Labelled *found = bsearch(&key, sorted, (size_t)count, sizeof key, compare_labelled);
    if (!found)
        fail_msg("label %lld is not in the mesh made on one rank", (long long)label);
    return found ? found->place : 0;
}

/* The mesh made on one rank has unique labels, and this piece has the same nodes, tets and items under them. */
static inline void check_against_serial(const OstMesh *mesh, const OstMesh *serial)
{
    assert_int_equal(mesh->global_nodes, serial->node_count);
    assert_int_equal(mesh->global_tets, serial->tet_count);
    Labelled *nodes = sort_labels(serial->node_count, serial->node_label);
    Labelled *tets = sort_labels(serial->tet_count, serial->tet_label);
    for (OstLocal i = 0; i < mesh->node_count; i++) {
        const OstLocal n = find_label(nodes, serial->node_count, mesh->node_label[i]);
        assert_memory_equal(mesh->coordinates + 3 * i, serial->coordinates + 3 * n, 3 * sizeof(double));
    }
    for (OstLocal t = 0; t < mesh->tet_count; t++) {
        const OstLocal s = find_label(tets, serial->tet_count, mesh->tet_label[t]);
        assert_int_equal(mesh->tet_region[t], serial->tet_region[s]);
        for (int v = 0; v < mesh->nodes_per_tet; v++)
            assert_int_equal(mesh->node_label[tet_of(mesh, t)[v]], serial->node_label[tet_of(serial, s)[v]]);
    }
    for (int b = 0; b < mesh->boundary_count; b++) {
        const OstBoundary *boundary = &mesh->boundaries[b];
        OstGlobal owned = 0;
        for (OstLocal i = 0; i < boundary->count; i++)
            owned += ost_mesh_owns(mesh, boundary->nodes_per_item, boundary->nodes + i * boundary->nodes_per_item);
        assert_int_equal(sum_over_ranks(owned), serial->boundaries[b].count);
    }
    free(tets);
    free(nodes);
}

/* Volume of quadratic tets with curved edges: the Jacobian is cubic, for which the rule of 5 points is exact
 * (Zienkiewicz and Taylor, The Finite Element Method 1, 5th ed., table 9.3: weights -4/5 and 9/20). */
static inline double jacobian(const OstMesh *mesh, OstLocal tet, const double b[4])
{
    double columns[9] = {0.0};
    for (int n = 0; n < 10; n++) {
        double slope[4] = {0.0, 0.0, 0.0, 0.0}; /* of the shape function by each barycentric coordinate */
        if (n < 4)
            slope[n] = 4.0 * b[n] - 1.0;
        else
            for (int end = 0; end < 2; end++)
                slope[ost_tet_edge[n - 4][end]] = 4.0 * b[ost_tet_edge[n - 4][1 - end]];
        for (int i = 0; i < 3; i++)
            for (int d = 0; d < 3; d++)
                columns[3 * i + d] +=
                    (slope[i + 1] - slope[0]) * mesh->coordinates[3 * (size_t)tet_of(mesh, tet)[n] + (size_t)d];
    }
    return columns[0] * (columns[4] * columns[8] - columns[5] * columns[7]) -
           columns[1] * (columns[3] * columns[8] - columns[5] * columns[6]) +
           columns[2] * (columns[3] * columns[7] - columns[4] * columns[6]);
}

static inline double curved_volume(const OstMesh *mesh)
{
    static const double point[5][4] = {{0.25, 0.25, 0.25, 0.25},
                                       {0.5, 1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0},
                                       {1.0 / 6.0, 0.5, 1.0 / 6.0, 1.0 / 6.0},
                                       {1.0 / 6.0, 1.0 / 6.0, 0.5, 1.0 / 6.0},
                                       {1.0 / 6.0, 1.0 / 6.0, 1.0 / 6.0, 0.5}};
    double volume = 0.0;
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        for (int q = 0; q < 5; q++)
            volume += (q == 0 ? -0.8 : 0.45) * jacobian(mesh, t, point[q]) / 6.0;
    MPI_Allreduce(MPI_IN_PLACE, &volume, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return volume;
}

/* A mesh of a shape, on a context of any size. */
static inline OstMesh *mesh_of_tube(OstContext *on, const OstTubeShape *shape)
{
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    assert_int_equal(ost_chunk_create_tube(on, shape, &chunk), OST_SUCCESS);
    assert_int_equal(ost_mesh_distribute(on, &chunk, &mesh), OST_SUCCESS);
    return mesh;
}

static inline OstMesh *mesh_of_block(OstContext *on, double x, double y, double z, OstLocal nx, OstLocal ny,
                                     OstLocal nz)
{
    const OstBlockShape shape = {{0.0, 0.0, 0.0}, {x, y, z}, {nx, ny, nz}};
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    assert_int_equal(ost_chunk_create_block(on, &shape, &chunk), OST_SUCCESS);
    assert_int_equal(ost_mesh_distribute(on, &chunk, &mesh), OST_SUCCESS);
    return mesh;
}

/* A column of four cells on rank 0, with a curve along an edge of it, and two of its corners. */
static inline OstMeshChunk *marked_column(void)
{
    static const OstGlobal edge[8] = {0, 1, 1, 2, 2, 3, 3, 4}, corners[2] = {0, 19}; /* along z */
    const OstBlockShape shape = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {1, 1, 4}};
    OstContext *alone = NULL;
    OstMeshChunk *block = NULL;
    assert_int_equal(ost_context_create(MPI_COMM_SELF, &alone), OST_SUCCESS);
    assert_int_equal(ost_chunk_create_block(alone, &shape, &block), OST_SUCCESS);
    OstMeshChunk *chunk = hand_chunk(4, 20, block->coordinates, block->tet_count, block->tet_nodes);
    add_boundary(chunk, "edge", 1, 2, 4, edge);
    add_boundary(chunk, "corners", 0, 1, 2, corners);
    ost_chunk_destroy(&block);
    ost_context_destroy(&alone);
    return chunk;
}

static inline double worst_quality(const OstMesh *mesh)
{
    double worst = 1.0;
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        worst = fmin(worst, ost_tet_quality(mesh->coordinates, tet_of(mesh, t)));
    return -highest_of_ranks(-worst);
}

static inline OstMesh *mesh_of_octant(OstContext *on, const OstOctantShape *shape)
{
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    assert_int_equal(ost_chunk_create_octant(on, shape, &chunk), OST_SUCCESS);
    assert_int_equal(ost_mesh_distribute(on, &chunk, &mesh), OST_SUCCESS);
    return mesh;
}

static inline OstMesh *mesh_of_sector(OstContext *on, const OstSectorShape *shape)
{
    OstMeshChunk *chunk = NULL;
    OstMesh *mesh = NULL;
    assert_int_equal(ost_chunk_create_sector(on, shape, &chunk), OST_SUCCESS);
    assert_int_equal(ost_mesh_distribute(on, &chunk, &mesh), OST_SUCCESS);
    return mesh;
}

/* A tet flat against a sphere: with curved edges its base bulges through its top. */
static inline OstMesh *flat_on_sphere(OstShapeSurface *sphere)
{
    const double x[12] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.35, 0.35, 0.35};
    const OstGlobal tet[4] = {0, 1, 2, 3};
    const double centre[3] = {0.0, 0.0, 0.0};
    OstMeshChunk *chunk = hand_chunk(4, 4, x, 1, tet);
    OstMesh *mesh = NULL;
    *sphere = ost_shape_surface_sphere(centre);
    assert_success(ost_mesh_distribute(ctx, &chunk, &mesh));
    return mesh;
}

#endif
