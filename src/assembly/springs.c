/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/springs.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "element/element.h"
#include "element/shape_functions.h"

#include <string.h>

/* A direction is held if its spring has more than this share of the node's stiffest one. */
static const double holds = 1e-12;

/* Faces at a node belong to one smooth surface if the cosine between their normals is more: the sides of a tube of
 * eight flat ones (0.707), not those of a hexagonal prism. */
static const double smooth_surface = 0.7;

OstStatus ost_supports_allow_springs(OstSupports *supports)
{
    return supports->spring ? OST_SUCCESS : OST_NEW(supports->ctx, &supports->spring, 9 * supports->mesh->node_count);
}

/* Adds weight × (across I + (along - across) n n'). */
static void add_stiffness(OstSupports *supports, OstLocal node, const OstSpringStiffness *stiffness, const double n[3],
                          double weight)
{
    double *block = supports->spring + 9 * (size_t)node;
    for (int i = 0; i < 3; i++) {
        block[4 * i] += weight * stiffness->across;
        for (int j = 0; j < 3; j++)
            block[3 * i + j] += weight * (stiffness->along - stiffness->across) * n[i] * n[j];
    }
}

void ost_supports_add_spring(OstSupports *supports, OstLocal node, const OstSpringStiffness *stiffness)
{
    add_stiffness(supports, node, stiffness, stiffness->direction, 1.0);
}

/* Weights that give the exact normal where the vertices lie on a sphere (N. Max, Weights for computing vertex normals
 * from facet normals, 1999); the two faces at a mid-edge node count alike. */
static double weight_of_normal(const double *x, int k, int quadratic, double size)
{
    double square[2] = {0.0};
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < 3; i++) {
            const double edge = x[3 * ((k + 1 + side) % 3) + i] - x[3 * k + i];
            square[side] += edge * edge;
        }
    return quadratic ? 1.0 : size / (square[0] * square[1]);
}

/* The smooth piece of surface that a face with this normal belongs to; the nearest, if there are too many. */
static int side_of(OstBed *bed, const double normal[3])
{
    int best = 0;
    double cosine = -2.0;
    for (int s = 0; s < bed->sides; s++) {
        const double found = ost_dot3(bed->side[s].normal, normal) / ost_norm3(bed->side[s].normal);
        if (found > cosine) {
            cosine = found;
            best = s;
        }
    }
    const int room = bed->sides < (int)(sizeof bed->side / sizeof *bed->side);
    return cosine > smooth_surface || !room ? best : bed->sides++;
}

static void add_to_bed(OstBed *bed, double stiffness, const double normal[3], double weight)
{
    const int side = side_of(bed, normal);
    bed->side[side].stiffness += stiffness;
    for (int i = 0; i < 3; i++)
        bed->side[side].normal[i] += weight * normal[i];
    for (int i = 0; i < 9; i++)
        bed->block[i] += stiffness * normal[i / 3] * normal[i % 3];
}

/* A face's share of the foundation at one of its nodes. */
static void add_at_node(OstSupports *supports, OstLocal node, const OstSpringStiffness *stiffness, const double *area,
                        const double *x, int k, int quadratic)
{
    const double size = ost_norm3(area);
    const double normal[3] = {area[0] / size, area[1] / size, area[2] / size};
    const int along_normal = ost_norm3(stiffness->direction) == 0.0;
    add_stiffness(supports, node, stiffness, along_normal ? normal : stiffness->direction, size / 6.0);
    if (along_normal && stiffness->along > stiffness->across)
        add_to_bed(&supports->bed[node], size / 6.0 * (stiffness->along - stiffness->across), normal,
                   weight_of_normal(x, k, quadratic, size));
}

OstStatus ost_supports_add_foundation(OstSupports *supports, OstLocal face_count, const OstLocal *faces,
                                      int nodes_per_face, const OstSpringStiffness *stiffness)
{
    const int quadratic = nodes_per_face == 6;
    if (face_count > 0 && !supports->bed)
        OST_TRY(OST_NEW(supports->ctx, &supports->bed, supports->mesh->owned_nodes));
    for (OstLocal f = 0; f < face_count; f++) {
        const OstLocal *nodes = faces + (size_t)nodes_per_face * (size_t)f;
        double x[3 * OST_MAX_FACE_NODES];
        ost_gather3(nodes_per_face, nodes, supports->mesh->coordinates, x);
        for (int k = 0; k < 3; k++) {
            const OstLocal node = nodes[quadratic ? 3 + k : k];
            double at[3] = {0.0}, area[3];
            at[k] += quadratic ? 0.5 : 1.0;
            at[(k + 1) % 3] += quadratic ? 0.5 : 0.0;
            ost_shape_area_vector(nodes_per_face, at, x, area);
            if (node < supports->mesh->owned_nodes)
                add_at_node(supports, node, stiffness, area, x, k, quadratic);
        }
    }
    return OST_SUCCESS;
}

OstStatus ost_spring_directions(const OstSupports *supports, OstLocal node, OstSupport *held)
{
    const double *spring = supports->spring + 9 * (size_t)node;
    const double least = holds * (spring[0] + spring[4] + spring[8]);
    double values[3], vectors[9], rest[9];
    held->constrained = 0;
    for (int i = 0; i < 9; i++)
        rest[i] = spring[i] - (supports->bed ? supports->bed[node].block[i] : 0.0);
    OST_TRY(ost_symmetric_eigen(supports->ctx, 3, rest, values, vectors));
    for (int k = 0; k < 3; k++)
        if (values[k] > least)
            memcpy(held->direction + 3 * held->constrained++, vectors + 3 * k, 3 * sizeof(double));
    return OST_SUCCESS;
}

OstStatus ost_bed_directions(const OstSupports *supports, OstLocal node, double facets[9], double smooth[9])
{
    const OstBed *bed = supports->bed ? &supports->bed[node] : NULL;
    double values[3], vectors[9];
    memset(facets, 0, 9 * sizeof *facets);
    memset(smooth, 0, 9 * sizeof *smooth);
    if (!bed || bed->sides == 0)
        return OST_SUCCESS;
    const double sum = bed->block[0] + bed->block[4] + bed->block[8];
    OST_TRY(ost_symmetric_eigen(supports->ctx, 3, bed->block, values, vectors));
    for (int i = 0; i < 9; i++)
        facets[i] = sqrt(fmax(values[i / 3], 0.0) / sum) * vectors[i];
    for (int i = 0; i < 3 * bed->sides; i++) {
        const double *normal = bed->side[i / 3].normal;
        smooth[i] = sqrt(bed->side[i / 3].stiffness / sum) * normal[i % 3] / ost_norm3(normal);
    }
    return OST_SUCCESS;
}

void ost_spring_force(const OstSupports *supports, double scale, const double *u, double *force)
{
    for (size_t node = 0; node < (size_t)supports->mesh->owned_nodes; node++) {
        double of_node[3];
        ost_apply3(supports->spring + 9 * node, u + 3 * node, of_node);
        for (size_t i = 0; i < 3; i++)
            force[3 * node + i] -= scale * of_node[i];
    }
}

double ost_spring_energy(const OstSupports *supports, const double *u)
{
    double energy = 0.0;
    for (size_t node = 0; node < (size_t)supports->mesh->owned_nodes; node++) {
        double of_node[3];
        ost_apply3(supports->spring + 9 * node, u + 3 * node, of_node);
        energy += 0.5 * ost_dot3(of_node, u + 3 * node);
    }
    return energy;
}

static void add_block(double *sum, double share, const double *block)
{
    for (int i = 0; i < 9; i++)
        sum[i] += share * block[i];
}

/* Gives the mid-edge nodes' springs to the ends of their edges, each node once. */
static void share_edges(const OstSupports *quadratic, const OstLocal *vertex_of_node, unsigned char *done,
                        OstSupports *linear)
{
    const OstMesh *mesh = quadratic->mesh;
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        const OstLocal *node = ost_mesh_nodes_of(mesh, tet);
        for (int e = 0; e < 6; e++) {
            const OstLocal middle = node[4 + e];
            for (int end = 0; end < 2 && !done[middle]; end++)
                add_block(linear->spring + 9 * (size_t)vertex_of_node[node[ost_tet_edge[e][end]]], 0.5,
                          quadratic->spring + 9 * (size_t)middle);
            done[middle] = 1;
        }
    }
}

OstStatus ost_springs_on_vertices(const OstSupports *quadratic, const OstLocal *node_of_vertex, OstSupports *linear)
{
    OstContext *ctx = quadratic->ctx;
    OstLocal *vertex_of_node = NULL;
    unsigned char *done = NULL;
    OstStatus status = ost_supports_allow_springs(linear);
    OST_THEN(OST_NEW(ctx, &vertex_of_node, quadratic->mesh->node_count));
    OST_THEN(OST_NEW(ctx, &done, quadratic->mesh->node_count));
    for (OstLocal v = 0; v < linear->mesh->node_count && status == OST_SUCCESS; v++) {
        vertex_of_node[node_of_vertex[v]] = v;
        add_block(linear->spring + 9 * (size_t)v, 1.0, quadratic->spring + 9 * (size_t)node_of_vertex[v]);
    }
    if (status == OST_SUCCESS)
        share_edges(quadratic, vertex_of_node, done, linear);
    OST_FREE(vertex_of_node);
    OST_FREE(done);
    return status;
}
