/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef ORTHOSTAT_TESTS_MESH_SUPPORT_H
#define ORTHOSTAT_TESTS_MESH_SUPPORT_H

/* Include after support.h: meshes to test with. */
#include "core/memory.h"
#include "mesh/mesh_data.h"

/* The tube of Li and Barbič's Fig. 6. */
static const OstTubeShape paper_tube = {1, {0.0, 0.0, 0.0}, 10.0, {0.9, 1.5}, 60, 6, 60};

/* Volume of the ring between two regular n-gons, times the length: ½ n sin(2π/n) (b² - a²) L. */
static inline double tube_volume(const OstTubeShape *tube)
{
    const double n = tube->around;
    const double a = tube->radii[0];
    const double b = tube->radii[1];
    return 0.5 * n * sin(2.0 * M_PI / n) * (b * b - a * a) * tube->length;
}

static inline void copy_array(size_t count, size_t size, const void *from, void **to)
{
    assert_success(ost_allocate(ctx, count, size, to));
    if (count > 0)
        memcpy(*to, from, count * size);
}

/* A mesh written by hand, all of it on rank 0, as a serial reader gives it. Node numbers count from 0. */
static inline OstMeshChunk *hand_chunk(int nodes_per_tet, OstLocal nodes, const double *coordinates, OstLocal tets,
                                       const OstGlobal *tet_nodes)
{
    OstMeshChunk *chunk = NULL;
    const int mine = ost_rank(ctx) == 0;
    assert_success(OST_NEW(ctx, &chunk, 1));
    chunk->ctx = ctx;
    chunk->nodes_per_tet = nodes_per_tet;
    chunk->global_nodes = nodes;
    chunk->global_tets = tets;
    chunk->node_count = mine ? nodes : 0;
    chunk->tet_count = mine ? tets : 0;
    copy_array(3 * (size_t)chunk->node_count, sizeof(double), coordinates, (void **)&chunk->coordinates);
    copy_array((size_t)nodes_per_tet * (size_t)chunk->tet_count, sizeof(OstGlobal), tet_nodes,
               (void **)&chunk->tet_nodes);
    assert_success(OST_NEW(ctx, &chunk->tet_region, chunk->tet_count));
    assert_success(OST_NEW(ctx, &chunk->regions.name, 1));
    chunk->regions.count = 1;
    assert_success(ost_copy_string(ctx, "all", &chunk->regions.name[0]));
    return chunk;
}

/* Gives a chunk one boundary; the items are rank 0's. */
static inline void add_boundary(OstMeshChunk *chunk, const char *name, int dimension, int nodes_per_item,
                                OstLocal count, const OstGlobal *nodes)
{
    const int mine = ost_rank(ctx) == 0;
    assert_success(OST_RESIZE(ctx, &chunk->boundaries, chunk->boundary_count + 1));
    OstBoundary *boundary = &chunk->boundaries[chunk->boundary_count++];
    boundary->dimension = dimension;
    boundary->nodes_per_item = nodes_per_item;
    boundary->count = mine ? count : 0;
    assert_success(ost_copy_string(ctx, name, &boundary->name));
    copy_array((size_t)boundary->count * (size_t)nodes_per_item, sizeof(OstGlobal), nodes, (void **)&boundary->nodes);
}

/* The number of the node between two others, found or added; `ends` holds two per node past `vertices`. */
static inline OstGlobal middle_of(OstGlobal vertices, OstGlobal a, OstGlobal b, OstGlobal *ends, OstGlobal *count)
{
    const OstGlobal low = a < b ? a : b;
    const OstGlobal high = a < b ? b : a;
    for (OstGlobal e = 0; e < *count; e++)
        if (ends[2 * e] == low && ends[2 * e + 1] == high)
            return vertices + e;
    ends[2 * *count] = low;
    ends[2 * *count + 1] = high;
    return vertices + (*count)++;
}

/* The unit cube in n³ hexes of quadratic tets, on rank 0. */
static inline OstMeshChunk *quadratic_cube(OstLocal n)
{
    OstContext *alone = NULL;
    OstMeshChunk *linear = NULL;
    OstMeshChunk *chunk = NULL;
    const OstBlockShape shape = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}, {n, n, n}};
    assert_int_equal(ost_context_create(MPI_COMM_SELF, &alone), OST_SUCCESS);
    assert_int_equal(ost_chunk_create_block(alone, &shape, &linear), OST_SUCCESS);
    const OstLocal tets = linear->tet_count;
    const OstLocal vertices = linear->node_count;
    OstGlobal *nodes = malloc((size_t)tets * 10 * sizeof *nodes);
    OstGlobal *ends = malloc((size_t)tets * 12 * sizeof *ends);
    OstGlobal middles = 0;
    for (OstLocal t = 0; t < tets; t++) {
        OstGlobal *tet = nodes + 10 * t;
        memcpy(tet, linear->tet_nodes + 4 * t, 4 * sizeof *tet);
        for (int e = 0; e < 6; e++)
            tet[4 + e] = middle_of(vertices, tet[ost_tet_edge[e][0]], tet[ost_tet_edge[e][1]], ends, &middles);
    }
    double *x = malloc((size_t)(vertices + middles) * 3 * sizeof *x);
    memcpy(x, linear->coordinates, (size_t)vertices * 3 * sizeof *x);
    for (OstGlobal m = 0; m < middles; m++)
        for (int d = 0; d < 3; d++)
            x[3 * (vertices + m) + d] = 0.5 * (x[3 * ends[2 * m] + d] + x[3 * ends[2 * m + 1] + d]);
    chunk = hand_chunk(10, (OstLocal)(vertices + middles), x, tets, nodes);
    free(x);
    free(ends);
    free(nodes);
    ost_chunk_destroy(&linear);
    ost_context_destroy(&alone);
    return chunk;
}

static inline double total_volume(const OstMesh *mesh)
{
    double volume = 0.0;
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        volume += ost_tet_volume(mesh->coordinates, mesh->tet_nodes + (size_t)t * (size_t)mesh->nodes_per_tet);
    MPI_Allreduce(MPI_IN_PLACE, &volume, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    return volume;
}

/* Area vector of a triangle of local nodes: half the cross product of two sides. */
static inline void area_vector(const OstMesh *mesh, const OstGlobal nodes[3], double area[3])
{
    const double *x = mesh->coordinates + 3 * nodes[0];
    const double *y = mesh->coordinates + 3 * nodes[1];
    const double *z = mesh->coordinates + 3 * nodes[2];
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3;
        const int f = (d + 2) % 3;
        area[d] = 0.5 * ((y[e] - x[e]) * (z[f] - x[f]) - (y[f] - x[f]) * (z[e] - x[e]));
    }
}

/* Sums the areas (and area vectors) of those faces that this rank owns, over all ranks. */
static inline double total_area(const OstMesh *mesh, OstLocal count, int nodes_per_face, const OstGlobal *faces,
                                double vector[3])
{
    double sum[4] = {0.0, 0.0, 0.0, 0.0};
    for (OstLocal i = 0; i < count; i++) {
        const OstGlobal *nodes = faces + (size_t)i * (size_t)nodes_per_face;
        double area[3];
        if (!ost_mesh_owns(mesh, nodes_per_face, nodes))
            continue;
        area_vector(mesh, nodes, area);
        for (int d = 0; d < 3; d++)
            sum[d] += area[d];
        sum[3] += sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]);
    }
    MPI_Allreduce(MPI_IN_PLACE, sum, 4, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    memcpy(vector, sum, 3 * sizeof *vector);
    return sum[3];
}

static inline double boundary_area(const OstMesh *mesh, const char *name, double vector[3])
{
    const int b = ost_mesh_find_boundary(mesh, name);
    assert_true(b >= 0);
    const OstBoundary *boundary = &mesh->boundaries[b];
    return total_area(mesh, boundary->count, boundary->nodes_per_item, boundary->nodes, vector);
}

static inline double surface_area(const OstMesh *mesh, double vector[3])
{
    OstSurface *surface = NULL;
    assert_success(ost_surface_create(mesh, NULL, &surface));
    const size_t entries = (size_t)surface->count * (size_t)surface->nodes_per_face;
    OstGlobal *faces = malloc((entries + 1) * sizeof *faces);
    for (size_t i = 0; i < entries; i++)
        faces[i] = surface->nodes[i];
    for (OstLocal i = 0; i < surface->count; i++) {
        int owned = 0;
        for (int v = 0; v < surface->nodes_per_face; v++)
            owned += surface->nodes[i * surface->nodes_per_face + v] < mesh->owned_nodes;
        assert_true(owned > 0);
    }
    const double area = total_area(mesh, surface->count, surface->nodes_per_face, faces, vector);
    free(faces);
    ost_surface_destroy(&surface);
    return area;
}

#endif
