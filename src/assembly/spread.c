/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/spread.h"

#include "assembly/loads.h"
#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "effect/effect.h"
#include "element/element.h"
#include "element/quadrature.h"
#include "element/shape_functions.h"

#include <string.h>

/* A moment of inertia of this share of the largest is rounding. */
static const double no_inertia = 1e-12;

/* A moment of this share about a line on which everything lies is rounding too. */
static const double no_moment = 1e-9;

void ost_spread_at(const OstSpread *spread, const double place[3], double value[3])
{
    const double arm[3] = {place[0] - spread->centre[0], place[1] - spread->centre[1], place[2] - spread->centre[2]};
    ost_cross3(spread->turn, arm, value);
    for (int i = 0; i < 3; i++)
        value[i] += spread->mean[i] + ost_dot3(spread->gradient + (size_t)i * 3, arm);
}

/* What the forces act on: faces, or vertices if nodes_per_item is 1. */
typedef struct Carrier {
    const OstMesh *mesh;
    OstLocal count;
    const OstLocal *items;
    int nodes_per_item;
} Carrier;

/* Sums of weights, weight × x, and weight × x x' (11 22 33 12 23 31), x from `from`. */
enum { WEIGHT, FIRST, SECOND = FIRST + 3, SUMS = SECOND + 6 };

static void add_point(const double place[3], const double from[3], double weight, double sums[SUMS])
{
    const double x[3] = {place[0] - from[0], place[1] - from[1], place[2] - from[2]};
    sums[WEIGHT] += weight;
    for (int i = 0; i < 3; i++) {
        sums[FIRST + i] += weight * x[i];
        sums[SECOND + i] += weight * x[i] * x[i];
        sums[SECOND + 3 + i] += weight * x[i] * x[(i + 1) % 3];
    }
}

static void add_face(const Carrier *on, const OstLocal *nodes, const double from[3], double sums[SUMS])
{
    const int n = on->nodes_per_item;
    OstGlobal local[OST_MAX_FACE_NODES] = {0};
    double x[3 * OST_MAX_FACE_NODES], values[OST_MAX_FACE_NODES], place[3], area[3];
    for (int a = 0; a < n; a++)
        local[a] = nodes[a];
    if (!ost_mesh_owns(on->mesh, n, local))
        return;
    ost_gather3(n, nodes, on->mesh->coordinates, x);
    for (int q = 0; q < ost_triangle_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_triangle_degree5.point[q];
        ost_shape_values(n, point->at, values);
        ost_shape_place(n, values, x, place);
        ost_shape_area_vector(n, point->at, x, area);
        add_point(place, from, 0.5 * point->weight * ost_norm3(area), sums);
    }
}

/* Collective. Over all ranks, each face and each vertex once. */
static OstStatus sum_up(const Carrier *on, const double from[3], double sums[SUMS])
{
    memset(sums, 0, SUMS * sizeof *sums);
    for (OstLocal i = 0; i < on->count; i++) {
        const OstLocal *nodes = on->items + (size_t)on->nodes_per_item * (size_t)i;
        if (on->nodes_per_item > 1)
            add_face(on, nodes, from, sums);
        else if (*nodes < on->mesh->owned_nodes)
            add_point(on->mesh->coordinates + 3 * (size_t)*nodes, from, 1.0, sums);
    }
    return ost_sum(on->mesh->ctx, SUMS, sums);
}

/* The turn b whose forces b × x have the moment J b, J = trace(S) I - S; along axes without inertia there is none. */
static OstStatus find_turn(OstContext *ctx, const double second[6], const double moment[3], double turn[3])
{
    static const int place[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    const double trace = second[0] + second[1] + second[2];
    double inertia[9], values[3], axes[9];
    for (int i = 0; i < 9; i++)
        inertia[i] = (i % 4 == 0 ? trace : 0.0) - second[place[i]];
    OST_TRY(ost_symmetric_eigen(ctx, 3, inertia, values, axes));
    memset(turn, 0, 3 * sizeof *turn);
    for (int k = 0; k < 3; k++) {
        const double *axis = axes + 3 * k;
        const double part = ost_dot3(moment, axis);
        if (values[k] > no_inertia * values[2]) {
            for (int i = 0; i < 3; i++)
                turn[i] += part / values[k] * axis[i];
        } else if (fabs(part) > no_moment * ost_norm3(moment)) {
            return OST_RAISE(ctx, OST_INVALID_INPUT,
                             "the selection is %s, and forces on it have no moment about (%g, %g, %g); select a face, "
                             "or vertices beside that line",
                             values[2] > 0.0 ? "one line" : "one point", axis[0], axis[1], axis[2]);
        }
    }
    return OST_SUCCESS;
}

static OstStatus spread_over(const Carrier *on, const OstResultant *resultant, OstSpread *spread)
{
    static const double origin[3] = {0.0};
    OstContext *ctx = on->mesh->ctx;
    double sums[SUMS], arm[3], moment[3] = {0.0};
    *spread = (OstSpread){.mean = {0.0}};
    OST_TRY(sum_up(on, origin, sums));
    if (!(sums[WEIGHT] > 0.0))
        return OST_RAISE(ctx, OST_INVALID_INPUT, "a moment is to act on a selection that holds nothing");
    for (int i = 0; i < 3; i++)
        spread->centre[i] = sums[FIRST + i] / sums[WEIGHT];
    OST_TRY(sum_up(on, spread->centre, sums));
    for (int i = 0; i < 3; i++) {
        spread->mean[i] = resultant->force[i] / sums[WEIGHT];
        arm[i] = resultant->at[i] - spread->centre[i];
    }
    if (resultant->acts_at)
        ost_cross3(arm, resultant->force, moment);
    for (int i = 0; i < 3; i++)
        moment[i] += resultant->moment[i];
    return find_turn(ctx, sums + SECOND, moment, spread->turn);
}

OstStatus ost_spread_over_faces(const OstMesh *mesh, OstLocal count, const OstLocal *faces, int nodes_per_face,
                                const OstResultant *resultant, OstSpread *spread)
{
    const Carrier on = {mesh, count, faces, nodes_per_face};
    return spread_over(&on, resultant, spread);
}

OstStatus ost_spread_over_vertices(const OstMesh *mesh, OstLocal count, const OstLocal *nodes,
                                   const OstResultant *resultant, OstSpread *spread)
{
    return ost_spread_over_faces(mesh, count, nodes, 1, resultant, spread);
}

static OstStatus force_at(const void *data, const double place[3], const double area[3], double force[3])
{
    ost_spread_at(data, place, force);
    for (int i = 0; i < 3; i++)
        force[i] *= ost_norm3(area);
    return OST_SUCCESS;
}

void ost_load_spread_on_faces(const OstMesh *mesh, OstLocal count, const OstLocal *faces, int nodes_per_face,
                              const OstSpread *spread, double *force)
{
    (void)ost_load_by_traction(mesh, count, faces, nodes_per_face, force_at, spread, force); /* cannot fail */
}

void ost_load_spread_on_vertices(const OstMesh *mesh, OstLocal count, const OstLocal *nodes, const OstSpread *spread,
                                 double *force)
{
    for (OstLocal n = 0; n < count; n++) {
        double of_node[3];
        if (nodes[n] >= mesh->owned_nodes)
            continue;
        ost_spread_at(spread, mesh->coordinates + 3 * (size_t)nodes[n], of_node);
        for (int i = 0; i < 3; i++)
            force[3 * (size_t)nodes[n] + (size_t)i] += of_node[i];
    }
}
