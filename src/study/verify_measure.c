/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/verify_view.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "element/quadrature.h"
#include "element/shape_functions.h"

#include <string.h>

typedef OstVerifyView View;

/* Sums over a selection: of the quantity, of the squared distance from the formula's field, and of the area (or the
 * number of nodes). */
enum { VALUE, SQUARE, SIZE, SUMS };

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

/* --- at a point of a face --- */

typedef struct Point {
    const OstSurface *surface;
    OstLocal face;
    const double *at; /* in the face */
    double place[3];
} Point;

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

/* The element's stress: with mean dilatation, the stiff mode enters by its mean over the tet. */
static OstStatus stress_in_tet(const View *view, const OstViewTet *tet, const double at[4], const double place[3],
                               double stress[6])
{
    double c[36], strain[6];
    OstViewMode mode;
    OST_TRY(view->exact->stiffness(view->exact->data, place, c));
    ost_view_strain(tet, at, strain);
    ost_view_stress(c, strain, stress);
    ost_view_mode(view, tet->number, place, &mode);
    const double excess = ost_view_dot6(mode.m, strain) - ost_view_mean_of_mode(view, tet);
    for (int p = 0; p < 6 && mode.split; p++)
        stress[p] -= excess * mode.m[p];
    return OST_SUCCESS;
}

static double size_of_stress(const double s[6])
{
    return sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

/* The distance is that of all components, also where one of them is the quantity. */
static OstStatus find_stress(const View *view, const Point *point, double *value, double *distance)
{
    const OstLocal number = point->surface->tet[point->face];
    const OstLocal *face = point->surface->nodes + (size_t)point->surface->nodes_per_face * (size_t)point->face;
    const OstLocal *vertices = view->mesh->tet_nodes + (size_t)view->mesh->nodes_per_tet * (size_t)number;
    double in_tet[4] = {0.0}, stress[6], exact[6];
    OstViewTet tet;
    for (int v = 0; v < 4; v++)
        for (int a = 0; a < 3; a++)
            if (face[a] == vertices[v])
                in_tet[v] = point->at[a];
    ost_view_gather_tet(view, number, &tet);
    OST_TRY(stress_in_tet(view, &tet, in_tet, point->place, stress));
    OST_TRY(view->exact->stress(view->exact->data, point->place, exact));
    *value = pick_component(view->quantity->component, stress, point->place);
    for (int p = 0; p < 6; p++)
        exact[p] -= stress[p];
    *distance = size_of_stress(exact);
    return OST_SUCCESS;
}

static OstStatus find_displacement(const View *view, const double place[3], const double u[3], double *value,
                                   double *distance)
{
    double direction[3], exact[3];
    find_direction(view->quantity, place, direction);
    OST_TRY(view->exact->displacement(view->exact->data, place, exact));
    *value = ost_dot3(u, direction);
    *distance = *value - ost_dot3(exact, direction);
    return OST_SUCCESS;
}

/* --- over faces, and over nodes --- */

static OstStatus add_face(const View *view, const OstSurface *surface, OstLocal f, double sums[SUMS])
{
    const int n = surface->nodes_per_face;
    const OstLocal *nodes = surface->nodes + (size_t)n * (size_t)f;
    double x[3 * OST_MAX_FACE_NODES], u[3 * OST_MAX_FACE_NODES], values[OST_MAX_FACE_NODES];
    ost_view_gather(nodes, n, view->mesh->coordinates, x);
    ost_view_gather(nodes, n, view->result->displacement, u);
    for (int q = 0; q < ost_triangle_degree5.count; q++) {
        Point point = {surface, f, ost_triangle_degree5.point[q].at, {0.0}};
        double moved[3], area[3], value, distance;
        ost_shape_values(n, point.at, values);
        ost_shape_place(n, values, x, point.place);
        ost_shape_place(n, values, u, moved);
        ost_shape_area_vector(n, point.at, x, area);
        OST_TRY(view->quantity->kind == OST_MEASURE_STRESS
                    ? find_stress(view, &point, &value, &distance)
                    : find_displacement(view, point.place, moved, &value, &distance));
        const double weight = 0.5 * ost_triangle_degree5.point[q].weight * ost_norm3(area);
        sums[VALUE] += weight * value;
        sums[SQUARE] += weight * distance * distance;
        sums[SIZE] += weight;
    }
    return OST_SUCCESS;
}

static OstStatus sum_faces(const View *view, const unsigned char *selected, const OstSurface *surface,
                           double sums[SUMS])
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

/* Owned nodes. Formulas give no reactions at nodes, so a reaction has no distance. */
static OstStatus sum_nodes(const View *view, OstLocal count, const OstLocal *nodes, double sums[SUMS])
{
    const int reaction = view->quantity->kind == OST_MEASURE_REACTION;
    const double *values = reaction ? view->result->reaction : view->result->displacement;
    for (OstLocal i = 0; i < count; i++) {
        double value, distance;
        if (nodes[i] >= view->mesh->owned_nodes)
            continue;
        OST_TRY(find_displacement(view, view->mesh->coordinates + 3 * (size_t)nodes[i], values + 3 * (size_t)nodes[i],
                                  &value, &distance));
        sums[VALUE] += value;
        sums[SQUARE] += reaction ? 0.0 : distance * distance;
        sums[SIZE] += 1.0;
    }
    return OST_SUCCESS;
}

static OstStatus measure_faces(const View *view, OstLocal count, const OstLocal *nodes, double sums[SUMS])
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
        status = ost_view_reduce(ctx, SUMS, sums);
    OST_FREE(selected);
    ost_surface_destroy(&surface);
    return status;
}

static OstStatus sum_selection(const View *view, const OstCase *c, double sums[SUMS])
{
    const OstVerifyQuantity *quantity = view->quantity;
    OstContext *ctx = view->mesh->ctx;
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    OstStatus status = ost_select_nodes(c, view->mesh, &quantity->on, &count, &nodes);
    if (status == OST_SUCCESS && quantity->kind != OST_MEASURE_REACTION)
        status = measure_faces(view, count, nodes, sums);
    if (status == OST_SUCCESS && sums[SIZE] == 0.0 && quantity->kind == OST_MEASURE_STRESS)
        status = OST_RAISE(ctx, OST_INVALID_INPUT, "%s:%d: stress is measured over faces, and the selection has none",
                           c->path, quantity->line);
    if (status == OST_SUCCESS && sums[SIZE] == 0.0) {
        status = ost_agree(ctx, sum_nodes(view, count, nodes, sums));
        if (status == OST_SUCCESS)
            status = ost_view_reduce(ctx, SUMS, sums);
    }
    OST_FREE(nodes);
    return status;
}

/* The mean, or the sum of reactions; and the root mean square of the distance over the selection, because a mean can
 * come out right by accident, where errors of both signs cancel, and then says nothing of the order of convergence. */
static OstStatus measure_selection(const View *view, const OstCase *c, double *value, double *distance)
{
    double sums[SUMS] = {0.0};
    OST_TRY(sum_selection(view, c, sums));
    const double size = view->quantity->kind == OST_MEASURE_REACTION ? 1.0 : sums[SIZE];
    *value = sums[VALUE] / size;
    *distance = sqrt(sums[SQUARE] / size);
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
    double distance = 0.0;
    if (quantity->kind == OST_MEASURE_FIELD)
        return ost_view_measure_field(&view, reading);
    OST_TRY(find_expected(scene->c, exact, quantity, &reading->expected));
    if (quantity->kind == OST_MEASURE_ENERGY)
        reading->obtained = result->checks.strain_energy;
    else
        OST_TRY(measure_selection(&view, scene->c, &reading->obtained, &distance));
    reading->obtained *= quantity->scale;
    distance *= fabs(quantity->scale);
    reading->error = fmax(fabs(reading->obtained - reading->expected), distance) / fabs(reading->expected);
    return OST_SUCCESS;
}
