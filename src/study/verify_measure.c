/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/verify.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "element/element.h"
#include "element/quadrature.h"
#include "element/shape_functions.h"

#include <string.h>

/* What a measure looks at. */
typedef struct View {
    const OstMesh *mesh;
    const OstResult *result;
    const OstExactField *exact;
    const OstVerifyQuantity *quantity;
} View;

static void gather(const OstLocal *nodes, int count, const double *values, double *rows)
{
    for (int a = 0; a < count; a++)
        memcpy(rows + 3 * a, values + 3 * (size_t)nodes[a], 3 * sizeof *rows);
}

static void find_direction(const OstVerifyQuantity *quantity, const double place[3], double direction[3])
{
    double away[3] = {place[0], place[1], place[2]};
    if (quantity->along == OST_ALONG_FIXED) {
        memcpy(direction, quantity->direction, sizeof quantity->direction);
        return;
    }
    if (quantity->along == OST_ALONG_CYLINDER_RADIUS)
        away[2] = 0.0;
    const double length = ost_norm3(away);
    for (int i = 0; i < 3; i++)
        direction[i] = length > 0.0 ? away[i] / length : 0.0;
}

/* --- stress of the answer at a point of a face --- */

static double pick_component(OstStressComponent component, const double s[6], const double place[3])
{
    if (component < OST_STRESS_RADIAL)
        return s[component];
    const double radius = hypot(place[0], place[1]);
    const double cosine = place[0] / radius, sine = place[1] / radius;
    const double shear = 2.0 * cosine * sine * s[3];
    return component == OST_STRESS_RADIAL ? cosine * cosine * s[0] + sine * sine * s[1] + shear
                                          : sine * sine * s[0] + cosine * cosine * s[1] - shear;
}

static void strain_at(const View *view, OstLocal tet, const double at[4], double strain[6])
{
    const int n = view->mesh->nodes_per_tet;
    const OstLocal *nodes = view->mesh->tet_nodes + (size_t)n * (size_t)tet;
    double x[3 * OST_MAX_TET_NODES] = {0.0}, u[3 * OST_MAX_TET_NODES], gradients[3 * OST_MAX_TET_NODES];
    double g[9] = {0.0};
    gather(nodes, n, view->mesh->coordinates, x);
    gather(nodes, n, view->result->displacement, u);
    ost_shape_gradients(n, at, x, gradients);
    for (int a = 0; a < n; a++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                g[3 * i + j] += u[3 * a + i] * gradients[3 * a + j];
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        strain[i] = g[4 * i];
        strain[3 + i] = g[3 * i + next] + g[3 * next + i];
    }
}

static void multiply6(const double c[36], const double strain[6], double stress[6])
{
    for (int i = 0; i < 6; i++) {
        stress[i] = 0.0;
        for (int j = 0; j < 6; j++)
            stress[i] += c[6 * i + j] * strain[j];
    }
}

static OstStatus stress_at(const View *view, OstLocal tet, const OstLocal *face, const double at[3],
                           const double place[3], double *value)
{
    const OstLocal *vertices = view->mesh->tet_nodes + (size_t)view->mesh->nodes_per_tet * (size_t)tet;
    double in_tet[4] = {0.0}, c[36], strain[6], stress[6];
    for (int v = 0; v < 4; v++)
        for (int a = 0; a < 3; a++)
            if (face[a] == vertices[v])
                in_tet[v] = at[a];
    strain_at(view, tet, in_tet, strain);
    OST_TRY(view->exact->stiffness(view->exact->data, place, c));
    multiply6(c, strain, stress);
    *value = pick_component(view->quantity->component, stress, place);
    return OST_SUCCESS;
}

/* --- means over faces, sums over nodes --- */

/* Adds a face's integral of the quantity, and its area, to sums[0] and sums[1]. */
static OstStatus add_face(const View *view, const OstSurface *surface, OstLocal f, double sums[2])
{
    const int n = surface->nodes_per_face;
    const OstLocal *nodes = surface->nodes + (size_t)n * (size_t)f;
    double x[3 * OST_MAX_FACE_NODES], u[3 * OST_MAX_FACE_NODES], values[OST_MAX_FACE_NODES];
    gather(nodes, n, view->mesh->coordinates, x);
    gather(nodes, n, view->result->displacement, u);
    for (int q = 0; q < ost_triangle_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_triangle_degree5.point[q];
        double place[3], moved[3], direction[3], area[3];
        ost_shape_values(n, point->at, values);
        ost_shape_place(n, values, x, place);
        ost_shape_place(n, values, u, moved);
        ost_shape_area_vector(n, point->at, x, area);
        find_direction(view->quantity, place, direction);
        double value = ost_dot3(moved, direction);
        if (view->quantity->kind == OST_MEASURE_STRESS)
            OST_TRY(stress_at(view, surface->tet[f], nodes, point->at, place, &value));
        sums[0] += 0.5 * point->weight * ost_norm3(area) * value;
        sums[1] += 0.5 * point->weight * ost_norm3(area);
    }
    return OST_SUCCESS;
}

static OstStatus sum_faces(const View *view, const unsigned char *selected, const OstSurface *surface, double sums[2])
{
    const int n = surface->nodes_per_face;
    for (OstLocal f = 0; f < surface->count; f++) {
        OstGlobal nodes[OST_MAX_FACE_NODES];
        int whole = 1;
        for (int a = 0; a < n; a++) {
            nodes[a] = surface->nodes[(size_t)n * (size_t)f + (size_t)a];
            whole &= selected[nodes[a]];
        }
        if (whole && ost_mesh_owns(view->mesh, n, nodes))
            OST_TRY(add_face(view, surface, f, sums));
    }
    return OST_SUCCESS;
}

/* Adds the sum over owned nodes, and their number. */
static void sum_nodes(const View *view, OstLocal count, const OstLocal *nodes, const double *values, double sums[2])
{
    for (OstLocal i = 0; i < count; i++) {
        double direction[3];
        if (nodes[i] >= view->mesh->owned_nodes)
            continue;
        find_direction(view->quantity, view->mesh->coordinates + 3 * (size_t)nodes[i], direction);
        sums[0] += ost_dot3(values + 3 * (size_t)nodes[i], direction);
        sums[1] += 1.0;
    }
}

static OstStatus reduce(OstContext *ctx, int count, double *sums)
{
    return OST_MPI(ctx, MPI_Allreduce(MPI_IN_PLACE, sums, count, MPI_DOUBLE, MPI_SUM, ost_comm(ctx)));
}

static OstStatus measure_faces(const View *view, OstLocal count, const OstLocal *nodes, double sums[2])
{
    OstContext *ctx = view->mesh->ctx;
    OstSurface *surface = NULL;
    unsigned char *selected = NULL;
    OstStatus status = ost_surface_create(view->mesh, &surface);
    if (status != OST_SUCCESS)
        return status;
    status = OST_NEW(ctx, &selected, view->mesh->node_count);
    for (OstLocal i = 0; i < count && status == OST_SUCCESS; i++)
        selected[nodes[i]] = 1;
    if (status == OST_SUCCESS)
        status = sum_faces(view, selected, surface, sums);
    status = ost_agree(ctx, status);
    if (status == OST_SUCCESS)
        status = reduce(ctx, 2, sums);
    OST_FREE(selected);
    ost_surface_destroy(&surface);
    return status;
}

static OstStatus measure_selection(const View *view, const OstCase *c, double *value)
{
    const OstVerifyQuantity *quantity = view->quantity;
    OstContext *ctx = view->mesh->ctx;
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    double sums[2] = {0.0, 0.0};
    OstStatus status = ost_select_nodes(c, view->mesh, &quantity->on, &count, &nodes);
    if (status == OST_SUCCESS && quantity->kind != OST_MEASURE_REACTION)
        status = measure_faces(view, count, nodes, sums);
    if (status == OST_SUCCESS && sums[1] == 0.0 && quantity->kind == OST_MEASURE_STRESS)
        status = OST_RAISE(ctx, OST_INVALID_INPUT, "%s:%d: stress is measured over faces, and the selection has none",
                           c->path, quantity->line);
    if (status == OST_SUCCESS && sums[1] == 0.0) {
        const int reaction = quantity->kind == OST_MEASURE_REACTION;
        sum_nodes(view, count, nodes, reaction ? view->result->reaction : view->result->displacement, sums);
        status = reduce(ctx, 2, sums);
        sums[1] = reaction ? 1.0 : sums[1];
    }
    OST_FREE(nodes);
    *value = sums[0] / sums[1];
    return status;
}

/* --- the whole field --- */

/* Adds the squares of the formula's field and of the difference, integrated over a tet. */
static OstStatus add_displacement(const View *view, const double *u, const double *values, const double place[3], int n,
                                  double weight, double sums[2])
{
    double exact[3], moved[3];
    OST_TRY(view->exact->displacement(view->exact->data, place, exact));
    ost_shape_place(n, values, u, moved);
    for (int i = 0; i < 3; i++) {
        sums[0] += weight * exact[i] * exact[i];
        sums[1] += weight * (moved[i] - exact[i]) * (moved[i] - exact[i]);
    }
    return OST_SUCCESS;
}

static OstStatus add_energy(const View *view, OstLocal tet, const double at[4], const double place[3], double weight,
                            double sums[2])
{
    double g[9], c[36], strain[6], stress[6], exact[6];
    OST_TRY(view->exact->gradient(view->exact->data, place, g));
    OST_TRY(view->exact->stiffness(view->exact->data, place, c));
    strain_at(view, tet, at, strain);
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        exact[i] = g[4 * i];
        exact[3 + i] = g[3 * i + next] + g[3 * next + i];
    }
    multiply6(c, exact, stress);
    for (int i = 0; i < 6; i++) {
        sums[0] += weight * stress[i] * exact[i];
        strain[i] -= exact[i];
    }
    multiply6(c, strain, stress);
    for (int i = 0; i < 6; i++)
        sums[1] += weight * stress[i] * strain[i];
    return OST_SUCCESS;
}

static OstStatus add_tet(const View *view, OstLocal tet, double sums[2])
{
    const int n = view->mesh->nodes_per_tet;
    const OstLocal *nodes = view->mesh->tet_nodes + (size_t)n * (size_t)tet;
    double x[3 * OST_MAX_TET_NODES], u[3 * OST_MAX_TET_NODES], gradients[3 * OST_MAX_TET_NODES];
    gather(nodes, n, view->mesh->coordinates, x);
    gather(nodes, n, view->result->displacement, u);
    for (int q = 0; q < ost_tet_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_tet_degree5.point[q];
        double values[OST_MAX_TET_NODES], place[3];
        ost_shape_values(n, point->at, values);
        ost_shape_place(n, values, x, place);
        const double weight = point->weight * ost_shape_gradients(n, point->at, x, gradients) / 6.0;
        if (view->quantity->norm == OST_NORM_DISPLACEMENT)
            OST_TRY(add_displacement(view, u, values, place, n, weight, sums));
        else
            OST_TRY(add_energy(view, tet, point->at, place, weight, sums));
    }
    return OST_SUCCESS;
}

static OstStatus measure_field(const View *view, OstVerifyReading *reading)
{
    OstContext *ctx = view->mesh->ctx;
    double sums[2] = {0.0, 0.0};
    OstStatus status = OST_SUCCESS;
    for (OstLocal tet = 0; tet < view->mesh->owned_tets && status == OST_SUCCESS; tet++)
        status = add_tet(view, tet, sums);
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(reduce(ctx, 2, sums));
    reading->expected = sqrt(sums[0]);
    reading->obtained = sqrt(sums[1]);
    reading->error = reading->obtained / reading->expected;
    return OST_SUCCESS;
}

static OstStatus find_expected(const OstCase *c, const OstExact *exact, const OstVerifyQuantity *quantity,
                               double *expected)
{
    *expected = quantity->expected;
    if (!quantity->expected_name)
        return OST_SUCCESS;
    const int value = ost_formula_find_value(exact->formula, quantity->expected_name);
    if (value < 0)
        return OST_RAISE(c->ctx, OST_INVALID_INPUT, "%s:%d: the formula '%s' has no value '%s'", c->path,
                         quantity->line, exact->formula->name, quantity->expected_name);
    *expected = exact->data.value[value];
    return OST_SUCCESS;
}

OstStatus ost_verify_measure(const OstScene *scene, const OstResult *result, const OstExact *exact,
                             const OstVerifyQuantity *quantity, OstVerifyReading *reading)
{
    const View view = {scene->mesh, result, &exact->field, quantity};
    if (quantity->kind == OST_MEASURE_FIELD)
        return measure_field(&view, reading);
    OST_TRY(find_expected(scene->c, exact, quantity, &reading->expected));
    if (quantity->kind == OST_MEASURE_ENERGY)
        reading->obtained = result->checks.strain_energy;
    else
        OST_TRY(measure_selection(&view, scene->c, &reading->obtained));
    reading->obtained *= quantity->scale;
    reading->error = fabs(reading->obtained - reading->expected) / fabs(reading->expected);
    return OST_SUCCESS;
}
