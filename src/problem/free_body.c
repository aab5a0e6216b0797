/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/free_body.h"

#include "core/error.h"
#include "core/small.h"

#include <string.h>

/* Distances that differ by less than this share are taken as equal; the lower label then decides. */
static const double same = 1e-9;

/* Chooses three vertices far apart. A candidate's distance is taken from the centre, then from the first vertex, then
 * from the line through the first two. */
typedef struct Choice {
    const double *centre;
    int chosen;
    double at[2][3];
} Choice;

static double distance(const Choice *choice, const double *x)
{
    const double *from = choice->chosen == 0 ? choice->centre : choice->at[0];
    double arm[3];
    for (int i = 0; i < 3; i++)
        arm[i] = x[i] - from[i];
    if (choice->chosen < 2)
        return ost_norm3(arm);
    double along[3], across[3];
    for (int i = 0; i < 3; i++)
        along[i] = choice->at[1][i] - choice->at[0][i];
    ost_cross3(arm, along, across);
    return ost_norm3(across) / ost_norm3(along);
}

/* The vertex at the largest distance, on every rank; `node` is its local number on its owner, and -1 elsewhere. */
static OstStatus find_farthest(const OstMesh *mesh, const Choice *choice, OstLocal *node, double at[3])
{
    OstContext *ctx = mesh->ctx;
    double farthest = 0.0;
    for (OstLocal n = 0; n < mesh->owned_nodes; n++)
        farthest = fmax(farthest, distance(choice, mesh->coordinates + 3 * (size_t)n));
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, &farthest, 1, MPI_DOUBLE, MPI_MAX, ost_comm(ctx))));
    OstGlobal lowest = INT64_MAX;
    *node = -1;
    for (OstLocal n = 0; n < mesh->owned_nodes; n++) {
        if (distance(choice, mesh->coordinates + 3 * (size_t)n) < farthest * (1.0 - same) ||
            mesh->node_label[n] >= lowest)
            continue;
        lowest = mesh->node_label[n];
        *node = n;
    }
    OstGlobal first = lowest;
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(&lowest, &first, 1, MPI_INT64_T, MPI_MIN, ost_comm(ctx))));
    int owner = lowest == first && *node >= 0 ? ost_rank(ctx) : ost_size(ctx);
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, &owner, 1, MPI_INT, MPI_MIN, ost_comm(ctx))));
    if (owner == ost_rank(ctx))
        memcpy(at, mesh->coordinates + 3 * (size_t)*node, 3 * sizeof *at);
    else
        *node = -1;
    return OST_MPI(ctx, MPI_Bcast(at, 3, MPI_DOUBLE, owner, ost_comm(ctx)));
}

static void difference(const double *to, const double *from, double d[3])
{
    for (int i = 0; i < 3; i++)
        d[i] = to[i] - from[i];
}

/* Constrained directions: all three of the first vertex; two of the second, across the line from the first; one of the
 * third, across the plane of the three. */
static void choose_directions(double at[3][3], double direction[6][3], int vertex[6])
{
    double line[3], arm[3];
    difference(at[1], at[0], line);
    difference(at[2], at[0], arm);
    for (int i = 0; i < 6; i++)
        vertex[i] = i < 3 ? 0 : i < 5 ? 1 : 2;
    memset(direction, 0, 9 * sizeof(double));
    for (int i = 0; i < 3; i++)
        direction[i][i] = 1.0;
    ost_cross3(line, arm, direction[3]);
    ost_cross3(line, direction[3], direction[4]);
    memcpy(direction[5], direction[3], 3 * sizeof(double));
    for (int k = 3; k < 6; k++) {
        const double length = ost_norm3(direction[k]);
        for (int i = 0; i < 3; i++)
            direction[k][i] /= length;
    }
}

static OstStatus constrain_three(const OstMesh *mesh, OstSupports *supports)
{
    OstContext *ctx = mesh->ctx;
    double low[3], high[3], centre[3], at[3][3], direction[6][3];
    OstLocal node[3];
    int vertex[6];
    Choice choice = {.centre = centre};
    OST_TRY(ost_mesh_bounds(mesh, low, high));
    for (int i = 0; i < 3; i++)
        centre[i] = 0.5 * (low[i] + high[i]);
    for (int k = 0; k < 3; k++) {
        OST_TRY(find_farthest(mesh, &choice, &node[k], at[k]));
        if (k < 2)
            memcpy(choice.at[k], at[k], sizeof at[k]);
        choice.chosen = k + 1;
    }
    choose_directions(at, direction, vertex);
    OstStatus status = OST_SUCCESS;
    for (int k = 0; k < 6 && status == OST_SUCCESS; k++)
        if (node[vertex[k]] >= 0)
            status = ost_supports_constrain(supports, node[vertex[k]], direction[k], 0.0);
    OST_TRY(ost_agree(ctx, status));
    return ost_supports_complete(supports);
}

OstStatus ost_free_body_supports(const OstMesh *mesh, const OstEffects *effects, OstSupports **supports)
{
    ost_ledger_enter(mesh->ctx, OST_EFFECT_FREE_BODY);
    OstStatus status = ost_agree(mesh->ctx, ost_supports_create(mesh, supports));
    if (status == OST_SUCCESS) {
        (*supports)->effects = effects;
        status = constrain_three(mesh, *supports);
    }
    if (status != OST_SUCCESS)
        ost_supports_destroy(supports);
    ost_ledger_leave(mesh->ctx);
    return status;
}

/* Integrals over the body: volume, position, displacement, curl of the displacement. */
enum { SUM_VOLUME, SUM_POSITION, SUM_DISPLACEMENT = 4, SUM_CURL = 7, SUM_BODY = 10 };

/* By the tet's vertices alone: right for rigid motion and uniform strain, in quadratic tets too. */
static void add_tet(const OstMesh *mesh, const OstLocal *nodes, const double *u, double sums[SUM_BODY])
{
    const double volume = ost_tet_volume(mesh->coordinates, nodes);
    double edge[9], inverse[9] = {0.0}, change[9], gradient[9];
    for (int v = 0; v < 4; v++) {
        for (int i = 0; i < 3; i++) {
            sums[SUM_POSITION + i] += 0.25 * volume * mesh->coordinates[3 * (size_t)nodes[v] + (size_t)i];
            sums[SUM_DISPLACEMENT + i] += 0.25 * volume * u[3 * (size_t)nodes[v] + (size_t)i];
        }
        if (v == 0)
            continue;
        difference(mesh->coordinates + 3 * (size_t)nodes[v], mesh->coordinates + 3 * (size_t)nodes[0],
                   edge + 3 * (v - 1));
        difference(u + 3 * (size_t)nodes[v], u + 3 * (size_t)nodes[0], change + 3 * (v - 1));
    }
    ost_invert3(edge, inverse);
    ost_multiply3(inverse, change, gradient); /* row j: du/dx_j */
    sums[SUM_VOLUME] += volume;
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        sums[SUM_CURL + i] += volume * (gradient[3 * j + k] - gradient[3 * k + j]);
    }
}

static OstStatus centre_body(const OstMesh *mesh, double *displacement)
{
    double sums[SUM_BODY] = {0.0};
    double centre[3], mean[3], rotation[3];
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        add_tet(mesh, mesh->tet_nodes + (size_t)t * (size_t)mesh->nodes_per_tet, displacement, sums);
    OST_TRY(OST_MPI(mesh->ctx, MPI_Allreduce(MPI_IN_PLACE, sums, SUM_BODY, MPI_DOUBLE, MPI_SUM, ost_comm(mesh->ctx))));
    for (int i = 0; i < 3; i++) {
        centre[i] = sums[SUM_POSITION + i] / sums[SUM_VOLUME];
        mean[i] = sums[SUM_DISPLACEMENT + i] / sums[SUM_VOLUME];
        rotation[i] = 0.5 * sums[SUM_CURL + i] / sums[SUM_VOLUME];
    }
    for (OstLocal n = 0; n < mesh->node_count; n++) {
        double arm[3], turned[3];
        difference(mesh->coordinates + 3 * (size_t)n, centre, arm);
        ost_cross3(rotation, arm, turned);
        for (int i = 0; i < 3; i++)
            displacement[3 * (size_t)n + (size_t)i] -= mean[i] + turned[i];
    }
    return OST_SUCCESS;
}

OstStatus ost_free_body_centre(const OstMesh *mesh, double *displacement)
{
    ost_ledger_enter(mesh->ctx, OST_EFFECT_FREE_BODY);
    const OstStatus status = centre_body(mesh, displacement);
    ost_ledger_leave(mesh->ctx);
    return status;
}
