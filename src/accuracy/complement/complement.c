/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/complement/complement.h"

#include "accuracy/complement/function_halo.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/small.h"

#include <string.h>

/* A direction is constrained at a node if no more than this is left of it. */
static const double small_share = 1e-9;

void ost_complement_clear(OstComplement *complement)
{
    ost_edge_table_clear(&complement->edges);
    ost_face_table_clear(&complement->faces);
    ost_halo_destroy(&complement->edge_halo);
    ost_halo_destroy(&complement->face_halo);
    OST_FREE(complement->support);
    OST_FREE(complement->supported);
    OST_FREE(complement->projector);
    OST_FREE(complement->turned);
    OST_FREE(complement->bed);
}

int ost_complement_per_tet(const OstComplement *complement)
{
    return complement->mesh->nodes_per_tet == 10 ? 10 : 6;
}

void ost_complement_of_tet(const OstComplement *complement, OstLocal tet, OstLocal *functions)
{
    memcpy(functions, complement->edges.of_tet + 6 * (size_t)tet, 6 * sizeof *functions);
    for (size_t f = 0; f < 4 && complement->faces.count > 0; f++)
        functions[6 + f] = complement->edges.count + complement->faces.of_tet[4 * (size_t)tet + f];
}

int ost_complement_of_face(const OstComplement *complement, const OstLocal *nodes, OstLocal functions[4])
{
    static const int corner[3] = {0, 1, 2};
    const OstMesh *mesh = complement->mesh;
    OstLocal sorted[3];
    for (int i = 0; i < 3; i++)
        functions[i] = ost_edge_find(&complement->edges, mesh, nodes[i], nodes[(i + 1) % 3]);
    if (complement->faces.count == 0)
        return 3;
    ost_face_sort(mesh, nodes, corner, sorted);
    const OstLocal edge = ost_edge_find(&complement->edges, mesh, sorted[0], sorted[1]);
    functions[3] = complement->edges.count + ost_face_find(&complement->faces, edge, sorted[2]);
    return 4;
}

/* --- constraints --- */

static int is_constrained(const OstSupports *supports, OstLocal node, const double direction[3])
{
    double projector[9], left[3];
    if (ost_supports_get(supports, node, projector, NULL) == 0)
        return 0;
    ost_apply3(projector, direction, left);
    return ost_norm3(left) <= small_share;
}

/* The directions in which all nodes of a face are constrained, of those that the first node has. */
static int find_common(const OstSupports *supports, int count, const OstLocal *nodes, double direction[9])
{
    const OstSupport *first = NULL;
    int common = 0;
    for (int a = 0; a < count; a++) {
        const OstLocal index = supports->index[nodes[a]];
        if (index < 0)
            return 0;
        if (!first || supports->support[index].constrained < first->constrained)
            first = &supports->support[index];
    }
    for (int k = 0; k < first->constrained; k++) {
        int all = 1;
        for (int a = 0; a < count && all; a++)
            all = is_constrained(supports, nodes[a], first->direction + 3 * k);
        if (all)
            memcpy(direction + 3 * common++, first->direction + 3 * k, 3 * sizeof *direction);
    }
    return common;
}

/* Removes a direction from the range of a symmetric projector. */
static void remove_direction(double projector[9], const double direction[3])
{
    double left[3];
    ost_apply3(projector, direction, left);
    const double square = ost_dot3(left, left);
    if (square <= small_share * small_share)
        return;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            projector[3 * i + j] -= left[i] * left[j] / square;
}

static OstStatus constrain(OstComplement *complement, OstLocal function, int count, const double *direction)
{
    static const double identity[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    OstLocal *index = &complement->support[function];
    if (*index < 0) {
        if ((complement->support_count & (complement->support_count - 1)) == 0) { /* room for twice as many */
            const size_t room = 2 * ((size_t)complement->support_count + 1);
            OST_TRY(OST_RESIZE(complement->mesh->ctx, &complement->projector, 9 * room));
            OST_TRY(OST_RESIZE(complement->mesh->ctx, &complement->supported, room));
        }
        complement->supported[complement->support_count] = function;
        *index = complement->support_count++;
        memcpy(complement->projector + 9 * (size_t)*index, identity, sizeof identity);
    }
    for (int k = 0; k < count; k++)
        remove_direction(complement->projector + 9 * (size_t)*index, direction + 3 * k);
    return OST_SUCCESS;
}

/* Are a face's nodes all followers, or all leaders? What the other face does between its nodes is not known here. On
 * an edge of a periodic cell nodes of one face are both. */
static int is_linked(const OstLinks *links, int count, const OstLocal *nodes)
{
    int follow = links != NULL, lead = links != NULL, either = links && links->periodic;
    for (int a = 0; a < count && links; a++) {
        const int follows = links->of_node[nodes[a]] >= 0;
        follow &= follows;
        lead &= links->leads[nodes[a]];
        either &= follows || links->leads[nodes[a]];
    }
    return follow || lead || either;
}

static OstStatus constrain_faces(OstComplement *complement, const OstSupports *supports, const OstSurface *surface)
{
    const int n = surface->nodes_per_face;
    for (OstLocal f = 0; f < surface->count; f++) {
        const OstLocal *nodes = surface->nodes + (size_t)n * (size_t)f;
        OstLocal functions[4];
        double direction[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
        const int common = is_linked(supports->links, n, nodes) ? 3 : find_common(supports, n, nodes, direction);
        const int count = common > 0 ? ost_complement_of_face(complement, nodes, functions) : 0;
        for (int k = 0; k < count; k++)
            if (ost_complement_owns(complement, functions[k]))
                OST_TRY(constrain(complement, functions[k], common, direction));
    }
    return OST_SUCCESS;
}

/* The nodes that have supports or links: faces between these alone matter, and they are quickly found. */
static OstStatus mark_nodes(const OstSupports *supports, const OstMesh *mesh, unsigned char **marked)
{
    const OstLinks *links = supports->links;
    OST_TRY(OST_NEW(mesh->ctx, marked, mesh->node_count));
    for (OstLocal n = 0; n < mesh->node_count; n++)
        (*marked)[n] = supports->index[n] >= 0 || (links && (links->of_node[n] >= 0 || links->leads[n]));
    return OST_SUCCESS;
}

static OstStatus find_constraints(OstComplement *complement, const OstSupports *supports)
{
    OstContext *ctx = complement->mesh->ctx;
    unsigned char *marked = NULL;
    OstSurface *surface = NULL;
    OstStatus status = OST_NEW(ctx, &complement->support, complement->count);
    OST_THEN(mark_nodes(supports, complement->mesh, &marked));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (OstLocal k = 0; k < complement->count; k++)
        complement->support[k] = -1;
    OST_TRY_DONE(ost_surface_create(complement->mesh, marked, &surface));
    status = ost_agree(ctx, constrain_faces(complement, supports, surface));
done:
    OST_FREE(marked);
    ost_surface_destroy(&surface);
    return status;
}

void ost_complement_project(const OstComplement *complement, float *values)
{
    const OstLocal edges = complement->edges.count;
    for (OstLocal k = 0; k < complement->support_count; k++) {
        const double *projector = complement->projector + 9 * (size_t)k;
        float *value = values + OST_PER_FUNCTION * (size_t)complement->supported[k];
        const double given[3] = {value[0], value[1], value[2]};
        double left[3];
        ost_apply3(projector, given, left);
        for (int i = 0; i < 3; i++)
            value[i] = (float)left[i];
    }
    const size_t size = OST_PER_FUNCTION * sizeof *values;
    memset(values + OST_PER_FUNCTION * (size_t)complement->owned_edges, 0,
           (size_t)(edges - complement->owned_edges) * size);
    memset(values + OST_PER_FUNCTION * (size_t)(edges + complement->owned_faces), 0,
           (size_t)(complement->faces.count - complement->owned_faces) * size);
}

void ost_complement_add_bed(const OstComplement *complement, const float *w, float *forces)
{
    static const int of[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    for (size_t k = 0; k < (size_t)complement->count && complement->bed; k++)
        for (size_t n = 0; n < 9; n++)
            forces[OST_PER_FUNCTION * k + n / 3] +=
                (float)complement->bed[6 * k + (size_t)of[n]] * w[OST_PER_FUNCTION * k + n % 3];
}

void ost_complement_constrain_block(const OstComplement *complement, OstLocal function, double symmetric[6])
{
    static const int of[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2}, place[6] = {0, 4, 8, 1, 5, 6};
    const OstLocal support = complement->support[function];
    double block[9], inner[9], left[9];
    for (int p = 0; p < 6 && complement->bed; p++)
        symmetric[p] += complement->bed[6 * (size_t)function + (size_t)p];
    const double size = (symmetric[0] + symmetric[1] + symmetric[2]) / 3.0;
    if (support < 0)
        return;
    const double *projector = complement->projector + 9 * (size_t)support;
    for (int n = 0; n < 9; n++)
        block[n] = symmetric[of[n]];
    ost_multiply3(projector, block, left);
    ost_multiply3(left, projector, inner);
    for (int p = 0; p < 6; p++)
        symmetric[p] = inner[place[p]] + size * ((p < 3) - projector[place[p]]);
}

OstStatus ost_complement_import(const OstComplement *complement, float *values)
{
    const size_t size = OST_PER_FUNCTION * sizeof *values;
    OST_TRY(ost_halo_import(complement->edge_halo, size, values));
    if (complement->mesh->nodes_per_tet != 10)
        return OST_SUCCESS;
    return ost_halo_import(complement->face_halo, size, values + OST_PER_FUNCTION * (size_t)complement->edges.count);
}

static OstStatus find_turns(OstComplement *complement)
{
    const OstMesh *mesh = complement->mesh;
    if (mesh->nodes_per_tet != 10)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(mesh->ctx, &complement->turned, mesh->tet_count));
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
        for (int e = 0; e < 6; e++)
            if (ost_complement_turn(mesh, nodes[ost_tet_edge[e][0]], nodes[ost_tet_edge[e][1]]) < 0.0)
                complement->turned[tet] |= (unsigned char)(1U << e);
    }
    return OST_SUCCESS;
}

OstStatus ost_complement_create(const OstMesh *mesh, const OstSupports *supports, OstComplement *complement)
{
    *complement = (OstComplement){.mesh = mesh};
    OstStatus status = ost_edge_table_build(mesh, &complement->edges);
    if (status == OST_SUCCESS && mesh->nodes_per_tet == 10)
        status = ost_face_table_build(mesh, &complement->edges, &complement->faces);
    OST_THEN(find_turns(complement));
    OST_TRY(ost_agree(mesh->ctx, status));
    complement->count = complement->edges.count + complement->faces.count;
    complement->owned_edges = complement->edges.start[mesh->owned_nodes];
    complement->owned_faces = mesh->nodes_per_tet == 10 ? complement->faces.start[complement->owned_edges] : 0;
    OST_TRY(ost_function_halo(mesh, &complement->edges, NULL, &complement->edge_halo));
    if (mesh->nodes_per_tet == 10)
        OST_TRY(ost_function_halo(mesh, &complement->edges, &complement->faces, &complement->face_halo));
    return find_constraints(complement, supports);
}
