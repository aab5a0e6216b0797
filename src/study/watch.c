/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/watch.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "orthostat/verify.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* A place this share of an edge away from its vertex is another place. */
static const double near_enough = 0.1;

static const double *point_of(const OstMesh *mesh, OstLocal node)
{
    return mesh->coordinates + 3 * (size_t)node;
}

static double distance(const double a[3], const double b[3])
{
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return ost_norm3(d);
}

/* A vertex of the body: where it lies, and who has it. */
typedef struct Vertex {
    OstLocal node; /* on its owner; elsewhere -1 */
    int owner;
    double distance; /* from the place asked for */
    double at[3];
} Vertex;

static void keep_nearer(const OstMesh *mesh, const double place[3], OstLocal node, Vertex *vertex)
{
    const double away = distance(point_of(mesh, node), place);
    if (away > vertex->distance)
        return;
    if (away == vertex->distance && vertex->node >= 0 && mesh->node_label[node] >= mesh->node_label[vertex->node])
        return;
    vertex->distance = away;
    vertex->node = node;
}

/* Of vertices that are equally near the one with the lowest label is meant, whoever owns it. */
static OstStatus agree_on_vertex(const OstMesh *mesh, Vertex *vertex)
{
    OstContext *ctx = mesh->ctx;
    double nearest = DBL_MAX;
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(&vertex->distance, &nearest, 1, MPI_DOUBLE, MPI_MIN, ost_comm(ctx))));
    const int candidate = vertex->node >= 0 && vertex->distance == nearest;
    const OstGlobal label = candidate ? mesh->node_label[vertex->node] : INT64_MAX;
    OstGlobal lowest = 0;
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(&label, &lowest, 1, MPI_INT64_T, MPI_MIN, ost_comm(ctx))));
    const int chosen = candidate && label == lowest;
    const int mine = chosen ? ost_rank(ctx) : -1;
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(&mine, &vertex->owner, 1, MPI_INT, MPI_MAX, ost_comm(ctx))));
    vertex->distance = nearest;
    if (!chosen)
        vertex->node = -1;
    return OST_SUCCESS;
}

/* Mid-edge nodes are no tet's corner. */
static OstStatus find_vertex(const OstMesh *mesh, const double place[3], Vertex *vertex)
{
    vertex->node = -1;
    vertex->distance = DBL_MAX;
    for (OstLocal t = 0; t < mesh->tet_count; t++)
        for (int k = 0; k < 4; k++) {
            const OstLocal node = mesh->tet_nodes[(size_t)t * (size_t)mesh->nodes_per_tet + (size_t)k];
            if (node < mesh->owned_nodes)
                keep_nearer(mesh, place, node, vertex);
        }
    OST_TRY(agree_on_vertex(mesh, vertex));
    if (vertex->node >= 0)
        memcpy(vertex->at, point_of(mesh, vertex->node), sizeof vertex->at);
    return OST_MPI(mesh->ctx, MPI_Bcast(vertex->at, 3, MPI_DOUBLE, vertex->owner, ost_comm(mesh->ctx)));
}

static int is_corner(const OstLocal *tet, OstLocal node)
{
    return tet[0] == node || tet[1] == node || tet[2] == node || tet[3] == node;
}

/* The shortest edge at a vertex; its owner holds all its tets. */
static OstStatus shortest_edge(const OstMesh *mesh, const Vertex *vertex, double *length)
{
    *length = DBL_MAX;
    for (OstLocal t = 0; vertex->node >= 0 && t < mesh->tet_count; t++) {
        const OstLocal *tet = mesh->tet_nodes + (size_t)t * (size_t)mesh->nodes_per_tet;
        if (!is_corner(tet, vertex->node))
            continue;
        for (int k = 0; k < 4; k++)
            if (tet[k] != vertex->node)
                *length = fmin(*length, distance(point_of(mesh, tet[k]), vertex->at));
    }
    return OST_MPI(mesh->ctx, MPI_Bcast(length, 1, MPI_DOUBLE, vertex->owner, ost_comm(mesh->ctx)));
}

OstStatus ost_watch_place(const OstMesh *mesh, OstWatch *watch)
{
    if (watch->kind != OST_WATCH_DISPLACEMENT)
        return OST_SUCCESS;
    double *place = watch->on.point;
    double edge = 0.0;
    Vertex vertex;
    OST_TRY(find_vertex(mesh, place, &vertex));
    OST_TRY(shortest_edge(mesh, &vertex, &edge));
    if (vertex.distance > near_enough * edge)
        ost_warn(mesh->ctx,
                 "'%s' is watched at (%g, %g, %g), the vertex nearest to (%g, %g, %g); the edges there are %g "
                 "long",
                 watch->name, vertex.at[0], vertex.at[1], vertex.at[2], place[0], place[1], place[2], edge);
    memcpy(place, vertex.at, sizeof vertex.at);
    return OST_SUCCESS;
}

static void take(const double vector[3], int component, OstWatched *watched)
{
    watched->value = component == OST_WATCH_LENGTH ? ost_norm3(vector) : vector[component];
}

static OstStatus displacement(const OstResult *result, const OstWatch *watch, OstWatched *watched)
{
    const OstMesh *mesh = result->mesh;
    Vertex vertex;
    double u[3] = {0.0};
    OST_TRY(find_vertex(mesh, watch->on.point, &vertex));
    if (vertex.node >= 0)
        memcpy(u, result->displacement + 3 * (size_t)vertex.node, sizeof u);
    OST_TRY(OST_MPI(mesh->ctx, MPI_Bcast(u, 3, MPI_DOUBLE, vertex.owner, ost_comm(mesh->ctx))));
    take(u, watch->component, watched);
    watched->scale = result->largest_displacement;
    return OST_SUCCESS;
}

static OstStatus reaction(const OstScene *scene, const OstResult *result, const OstWatch *watch, OstWatched *watched)
{
    OstContext *ctx = scene->ctx;
    OstLocal *nodes = NULL;
    OstLocal count = 0;
    double sum[3] = {0.0};
    OST_TRY(ost_select_nodes(scene->c, scene->mesh, &watch->on, &count, &nodes));
    for (OstLocal n = 0; n < count; n++)
        for (int i = 0; i < 3 && nodes[n] < scene->mesh->owned_nodes; i++)
            sum[i] += result->reaction[3 * (size_t)nodes[n] + (size_t)i];
    OST_FREE(nodes);
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, sum, 3, MPI_DOUBLE, MPI_SUM, ost_comm(ctx))));
    take(sum, watch->component, watched);
    watched->scale = ost_norm3(sum);
    return OST_SUCCESS;
}

OstStatus ost_watch_evaluate(const OstScene *scene, const OstResult *result, const OstWatch *watch, OstWatched *watched)
{
    switch (watch->kind) {
    case OST_WATCH_DISPLACEMENT:
        return displacement(result, watch, watched);
    case OST_WATCH_REACTION:
        return reaction(scene, result, watch, watched);
    case OST_WATCH_STRAIN_ENERGY:
        watched->value = watched->scale = result->checks.strain_energy;
        return OST_SUCCESS;
    }
    return OST_RAISE(scene->ctx, OST_INVALID_INPUT, "%s:%d: nothing is watched", scene->c->path, watch->line);
}

/* --- what a case watches, before and after --- */

static OstStatus check_selection(const OstScene *scene, const char *what, const char *name, int line,
                                 const OstSelection *on)
{
    OstContext *ctx = scene->ctx;
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    int some = 0;
    OST_TRY(ost_select_nodes(scene->c, scene->mesh, on, &count, &nodes));
    OST_FREE(nodes);
    const int mine = count > 0;
    OST_TRY(OST_MPI(ctx, MPI_Allreduce(&mine, &some, 1, MPI_INT, MPI_MAX, ost_comm(ctx))));
    return some ? OST_SUCCESS
                : OST_RAISE(ctx, OST_INVALID_INPUT, "%s:%d: %s '%s' is of no vertex: its selection is empty",
                            scene->c->path, line, what, name);
}

OstStatus ost_watch_check(const OstScene *scene)
{
    const OstCase *c = scene->c;
    for (int w = 0; w < c->watch_count; w++) {
        OstWatch placed = c->watches[w]; /* placed for the warning alone: a solve looks for its vertex by itself */
        OST_TRY(ost_watch_place(scene->mesh, &placed));
        if (placed.kind == OST_WATCH_REACTION)
            OST_TRY(check_selection(scene, "the watched", placed.name, placed.line, &placed.on));
    }
    for (int q = 0; c->verify && q < c->verify->quantity_count; q++) {
        const OstVerifyQuantity *quantity = &c->verify->quantity[q];
        if (quantity->kind != OST_MEASURE_FIELD && quantity->kind != OST_MEASURE_ENERGY)
            OST_TRY(check_selection(scene, "the verified", quantity->name, quantity->line, &quantity->on));
    }
    return OST_SUCCESS;
}

OstStatus ost_watch_evaluate_all(const OstScene *scene, const OstResult *result, OstWatchedValue **values)
{
    OstContext *ctx = scene->ctx;
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, values, scene->c->watch_count)));
    for (int w = 0; w < scene->c->watch_count; w++) {
        const OstWatch *watch = &scene->c->watches[w];
        OstWatched watched;
        const OstStatus status = ost_watch_evaluate(scene, result, watch, &watched);
        if (status != OST_SUCCESS) {
            OST_FREE(*values);
            return status;
        }
        (*values)[w] = (OstWatchedValue){watch->name, watched.value, watch->expected};
    }
    return OST_SUCCESS;
}

void ost_watch_print(const OstWatchedValue *values, int count)
{
    for (int w = 0; w < count; w++) {
        const double expected = values[w].expected;
        printf("%-22s %.10g", values[w].name, values[w].value);
        if (!isnan(expected) && expected != 0.0)
            printf(", expected %.10g: %.2g %% off", expected, 100.0 * fabs(values[w].value / expected - 1.0));
        puts("");
    }
}
