/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/follower.h"

#include "core/error.h"
#include "core/index_map.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "element/element.h"
#include "element/quadrature.h"
#include "element/shape_functions.h"

#include <string.h>

OstStatus ost_follower_add(const OstMesh *mesh, OstLocal count, const OstLocal *faces, int nodes_per_face,
                           double pressure, int function, OstFollower **follower)
{
    const size_t numbers = (size_t)nodes_per_face * (size_t)count;
    OstFollower *made = NULL;
    OST_TRY(OST_NEW(mesh->ctx, &made, 1));
    *made = (OstFollower){.mesh = mesh,
                          .nodes_per_face = nodes_per_face,
                          .count = count,
                          .pressure = pressure,
                          .function = function,
                          .next = *follower};
    *follower = made;
    OST_TRY(OST_NEW(mesh->ctx, &made->faces, numbers));
    memcpy(made->faces, faces, numbers * sizeof *faces);
    return OST_SUCCESS;
}

void ost_follower_destroy(OstFollower **follower)
{
    while (*follower) {
        OstFollower *next = (*follower)->next;
        OST_FREE((*follower)->faces);
        OST_FREE(*follower);
        *follower = next;
    }
}

/* The nodes of a face, and their places under u. */
static const OstLocal *place_face(const OstFollower *follower, OstLocal face, const double *u, double *x)
{
    const int n = follower->nodes_per_face;
    const OstLocal *nodes = follower->faces + (size_t)n * (size_t)face;
    double moved[3 * OST_MAX_FACE_NODES];
    ost_gather3(n, nodes, follower->mesh->coordinates, x);
    if (u)
        ost_gather3(n, nodes, u, moved);
    for (int i = 0; i < 3 * n && u; i++)
        x[i] += moved[i];
    return nodes;
}

static void add_force(const OstFollower *follower, double factor, const double *u, double *force)
{
    const OstMesh *mesh = follower->mesh;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    for (OstLocal f = 0; f < follower->count; f++) {
        double x[3 * OST_MAX_FACE_NODES], areas[OST_MAX_FACE_NODES], area_vectors[3 * OST_MAX_FACE_NODES];
        const OstLocal *nodes = place_face(follower, f, u, x);
        element->node_areas(x, areas, area_vectors);
        for (int a = 0; a < follower->nodes_per_face; a++)
            for (int i = 0; i < 3 && nodes[a] < mesh->owned_nodes; i++)
                force[3 * (size_t)nodes[a] + (size_t)i] -= factor * follower->pressure * area_vectors[3 * a + i];
    }
}

void ost_follower_force(const OstFollower *follower, int function, double factor, const double *u, double *force)
{
    for (; follower; follower = follower->next)
        if (follower->function == function)
            add_force(follower, factor, u, force);
}

/* Volume of the cone over a face: a third of the integral of x · n da. */
static double cone(const OstFollower *follower, OstLocal face, const double *u)
{
    const OstElement *element = ost_element_of(follower->mesh->nodes_per_tet);
    double x[3 * OST_MAX_FACE_NODES], areas[OST_MAX_FACE_NODES], area_vectors[3 * OST_MAX_FACE_NODES], sum = 0.0;
    place_face(follower, face, u, x);
    element->node_areas(x, areas, area_vectors);
    for (int i = 0; i < 3 * follower->nodes_per_face; i++)
        sum += x[i] * area_vectors[i];
    return sum / 3.0;
}

static double find_work(const OstFollower *follower, const double *u)
{
    const int n = follower->nodes_per_face;
    double work = 0.0;
    for (OstLocal f = 0; f < follower->count; f++) {
        OstGlobal nodes[OST_MAX_FACE_NODES];
        for (int a = 0; a < n; a++)
            nodes[a] = follower->faces[(size_t)n * (size_t)f + (size_t)a];
        if (ost_mesh_owns(follower->mesh, n, nodes))
            work -= follower->pressure * (cone(follower, f, u) - cone(follower, f, NULL));
    }
    return work;
}

double ost_follower_work(const OstFollower *follower, int function, double factor, const double *u)
{
    double work = 0.0;
    for (; follower; follower = follower->next)
        if (follower->function == function)
            work += factor * find_work(follower, u);
    return work;
}

/* Edges of all pressed faces, as pairs of vertices and their function of time, and the sum of the pressures on their
 * sides, with opposite signs on the two: not zero on a rim. Where a rank owns a node of an edge, it has both sides. */
typedef struct Edges {
    OstIndex *index;
    double *sum;
    OstLocal capacity;
} Edges;

static OstStatus add_edge(const OstFollower *follower, const OstLocal *nodes, int e, Edges *edges, OstLocal *place)
{
    const OstLocal from = nodes[e], to = nodes[(e + 1) % 3];
    const OstGlobal key[3] = {from < to ? from : to, from < to ? to : from, follower->function};
    OST_TRY(ost_index_place(edges->index, key, place));
    if (*place < edges->capacity)
        return OST_SUCCESS;
    const OstLocal before = edges->capacity;
    edges->capacity = *place / 2 * 3 + 64;
    OST_TRY(OST_RESIZE(follower->mesh->ctx, &edges->sum, edges->capacity));
    memset(edges->sum + before, 0, (size_t)(edges->capacity - before) * sizeof *edges->sum);
    return OST_SUCCESS;
}

static int may_move(const OstSupports *supports, OstLocal node)
{
    const OstLocal index = supports->index[node];
    return node < supports->mesh->owned_nodes && (index < 0 || supports->support[index].constrained < 3);
}

/* In a first pass over the faces sums up the pressures, in a second looks for a node of a rim that may move. */
static OstStatus find_free_rim(const OstFollower *first, const OstSupports *supports, Edges *edges, int *found)
{
    for (int pass = 0; pass < 2; pass++)
        for (const OstFollower *follower = first; follower; follower = follower->next)
            for (OstLocal f = 0; f < follower->count; f++)
                for (int e = 0; e < 3; e++) {
                    const int n = follower->nodes_per_face;
                    const OstLocal *nodes = follower->faces + (size_t)n * (size_t)f;
                    OstLocal place;
                    OST_TRY(add_edge(follower, nodes, e, edges, &place));
                    if (pass == 0)
                        edges->sum[place] += nodes[e] < nodes[(e + 1) % 3] ? follower->pressure : -follower->pressure;
                    else if (edges->sum[place] != 0.0)
                        *found |= may_move(supports, nodes[e]) || may_move(supports, nodes[(e + 1) % 3]) ||
                                  (n == 6 && may_move(supports, nodes[3 + e]));
                }
    return OST_SUCCESS;
}

OstStatus ost_follower_conserves(const OstFollower *follower, const OstSupports *supports, int *conserves)
{
    OstContext *ctx = supports->ctx;
    Edges edges = {0};
    int free_rim = 0;
    *conserves = 1;
    if (!follower)
        return OST_SUCCESS;
    OstStatus status = ost_index_create(ctx, 3, &edges.index);
    OST_THEN(find_free_rim(follower, supports, &edges, &free_rim));
    ost_index_destroy(&edges.index);
    OST_FREE(edges.sum);
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(ost_max_ints(ctx, 1, &free_rim));
    *conserves = !free_rim;
    return OST_SUCCESS;
}

/* block -= scale × the matrix of v ↦ c × v */
static void subtract_cross(double scale, const double c[3], double block[9])
{
    for (int i = 0; i < 3; i++) {
        block[3 * i + (i + 1) % 3] += scale * c[(i + 2) % 3];
        block[3 * i + (i + 2) % 3] -= scale * c[(i + 1) % 3];
    }
}

/* The derivative of each node's area vector by each node's place, in blocks of nodes a and b. The area vector at a
 * point is s × r, with s and r the derivatives of the place by the face's two coordinates. */
static void differentiate(int n, const double *x, double *blocks)
{
    memset(blocks, 0, 9 * (size_t)(n * n) * sizeof *blocks);
    for (int q = 0; q < ost_triangle_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_triangle_degree5.point[q];
        double shape[OST_MAX_FACE_NODES], slopes[OST_MAX_FACE_NODES][2], along[2][3] = {{0.0}};
        ost_shape_values(n, point->at, shape);
        ost_shape_face_slopes(n, point->at, slopes);
        for (int a = 0; a < n; a++)
            for (int i = 0; i < 3; i++)
                for (int k = 0; k < 2; k++)
                    along[k][i] += slopes[a][k] * x[3 * a + i];
        for (int a = 0; a < n; a++)
            for (int b = 0; b < n; b++) { /* d (s × r) = ds × r + s × dr = -r × ds + s × dr */
                const double weight = 0.5 * point->weight * shape[a];
                double *block = blocks + 9 * (size_t)(n * a + b);
                subtract_cross(weight * slopes[b][0], along[1], block);
                subtract_cross(-weight * slopes[b][1], along[0], block);
            }
    }
}

static double *block_of(const OstSystem *system, OstLocal row, OstLocal column)
{
    const OstBlockMatrix *matrix = system->matrix;
    return matrix->value + 9 * (size_t)ost_row_find(matrix->row_start, matrix->column, row, column);
}

static void stiffen(const OstFollower *follower, double factor, const double *u, OstSystem *system)
{
    const int n = follower->nodes_per_face;
    for (OstLocal f = 0; f < follower->count; f++) {
        double x[3 * OST_MAX_FACE_NODES], blocks[9 * OST_MAX_FACE_NODES * OST_MAX_FACE_NODES];
        const OstLocal *nodes = place_face(follower, f, u, x);
        const double half = 0.5 * factor * follower->pressure;
        differentiate(n, x, blocks);
        for (int a = 0; a < n; a++)
            for (int b = 0; b < n; b++) {
                const OstLocal row = system->row_of_node[nodes[a]];
                const OstLocal column = system->row_of_node[nodes[b]];
                if (row < 0 || row >= system->matrix->rows || column < 0)
                    continue;
                double *sum = block_of(system, row, column);
                for (int i = 0; i < 3; i++)
                    for (int j = 0; j < 3; j++)
                        sum[3 * i + j] +=
                            half * (blocks[9 * (n * a + b) + 3 * i + j] + blocks[9 * (n * b + a) + 3 * j + i]);
            }
    }
}

void ost_follower_stiffen(const OstFollower *follower, const double *factor, const double *u, OstSystem *system)
{
    for (; follower; follower = follower->next)
        stiffen(follower, factor[follower->function], u, system);
}

static void add_skew(const OstFollower *follower, double factor, const double *u, const double *v, double *product)
{
    const int n = follower->nodes_per_face;
    const double half = 0.5 * factor * follower->pressure;
    for (OstLocal f = 0; f < follower->count; f++) {
        double x[3 * OST_MAX_FACE_NODES], blocks[9 * OST_MAX_FACE_NODES * OST_MAX_FACE_NODES];
        const OstLocal *nodes = place_face(follower, f, u, x);
        differentiate(n, x, blocks);
        for (int a = 0; a < n; a++)
            for (int b = 0; b < n && nodes[a] < follower->mesh->owned_nodes; b++)
                for (int i = 0; i < 3; i++)
                    for (int j = 0; j < 3; j++)
                        product[3 * (size_t)nodes[a] + (size_t)i] +=
                            half * (blocks[9 * (n * a + b) + 3 * i + j] - blocks[9 * (n * b + a) + 3 * j + i]) *
                            v[3 * (size_t)nodes[b] + (size_t)j];
    }
}

void ost_follower_add_skew(const OstFollower *follower, const double *factor, const double *u, const double *v,
                           double *product)
{
    for (; follower; follower = follower->next)
        add_skew(follower, factor[follower->function], u, v, product);
}
