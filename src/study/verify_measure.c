/* SPDX-License-Identifier: BSD-3-Clause */
#include "study/verify.h"

#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "element/element.h"
#include "element/quadrature.h"
#include "element/shape_functions.h"

#include <string.h>

/* What is measured, and where. */
typedef struct View {
    const OstMesh *mesh;
    const OstResult *result;
    const OstClosedForm *exact;
    const OstVerifyQuantity *quantity;
} View;

/* A tet's nodes: coordinates and displacements, three numbers each. */
typedef struct Tet {
    int nodes;
    OstLocal number;
    double x[3 * OST_MAX_TET_NODES], u[3 * OST_MAX_TET_NODES];
    const double *pressure; /* at its vertices, of a mixed form; else NULL */
} Tet;

/* Quadratic tets of a nearly incompressible material see one mode of the strain by its mean over the tet alone
 * (ost_field_mean_dilatation). m: that mode's stress at a point, in world axes; zeros for other tets. */
typedef struct Mode {
    int split;
    double m[6];
} Mode;

/* --- inside a tet --- */

static void gather_tet(const View *view, OstLocal tet, Tet *gathered)
{
    const int n = view->mesh->nodes_per_tet;
    const OstLocal *nodes = view->mesh->tet_nodes + (size_t)n * (size_t)tet;
    gathered->nodes = n;
    gathered->number = tet;
    ost_gather3(n, nodes, view->mesh->coordinates, gathered->x);
    ost_gather3(n, nodes, view->result->displacement, gathered->u);
    gathered->pressure = NULL;
    if (view->result->pressure && ost_field_stiff_mode(view->result->field, view->mesh->tet_region[tet]))
        gathered->pressure = view->result->pressure + 4 * (size_t)tet;
}

/* 11 22 33 12 23 31, shear twice. */
static void strain_of_gradient(const double g[9], double strain[6])
{
    for (int i = 0; i < 3; i++) {
        const int next = (i + 1) % 3;
        strain[i] = g[4 * i];
        strain[3 + i] = g[3 * i + next] + g[3 * next + i];
    }
}

/* Of the answer, at barycentric coordinates. */
static void strain_at(const Tet *tet, const double at[4], double strain[6])
{
    double gradients[3 * OST_MAX_TET_NODES];
    double g[9] = {0.0};
    ost_shape_gradients(tet->nodes, at, tet->x, gradients);
    for (int a = 0; a < tet->nodes; a++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                g[3 * i + j] += tet->u[3 * a + i] * gradients[3 * a + j];
    strain_of_gradient(g, strain);
}

static void find_mode(const View *view, OstLocal tet, const double at[4], const double place[3], Mode *mode)
{
    const OstMaterialField *field = view->result->field;
    const double *along = ost_field_stiff_mode(field, field->tet_region[tet]);
    double axes[9];
    *mode = (Mode){.split = along != NULL && view->mesh->nodes_per_tet > 4};
    if (!mode->split)
        return;
    ost_field_axes_at(field, tet, at, place, axes);
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < 3; i++) {
            mode->m[i] += along[a] * axes[3 * a + i] * axes[3 * a + i];
            mode->m[3 + i] += along[a] * axes[3 * a + i] * axes[3 * a + (i + 1) % 3];
        }
}

static void take_off_eigenstrain(const View *view, OstLocal tet, const double at[4], const double place[3],
                                 double strain[6])
{
    const OstMaterialField *field = view->result->field;
    double axes[9];
    if (!ost_field_is_eigenstrained(field))
        return;
    ost_field_axes_at(field, tet, at, place, axes);
    ost_field_add_eigenstrain(field, tet, at, -1.0, axes, strain);
}

/* What is left of the answer's strain when the eigenstrain is taken off. */
static void elastic_strain_at(const View *view, const Tet *tet, const double at[4], const double place[3],
                              double strain[6])
{
    strain_at(tet, at, strain);
    take_off_eigenstrain(view, tet->number, at, place, strain);
}

static double pressure_at(const Tet *tet, const double at[4])
{
    return at[0] * tet->pressure[0] + at[1] * tet->pressure[1] + at[2] * tet->pressure[2] + at[3] * tet->pressure[3];
}

/* A mixed form's stress without its pressure, of a strain. */
static void rest_stress(const View *view, OstLocal tet, const double at[4], const double place[3],
                        const double strain[6], double stress[6])
{
    const OstMaterialField *field = view->result->field;
    double axes[9], rest[36];
    ost_field_axes_at(field, tet, at, place, axes);
    ost_material_rotate_stiffness(ost_field_rest(field, field->tet_region[tet]), axes, rest);
    ost_apply6(rest, strain, stress);
}

/* Mean over a tet of m'(elastic strain); 0 without mean dilatation. */
static double mean_of_mode(const View *view, const Tet *tet)
{
    double sum = 0.0, volume = 0.0;
    for (int q = 0; q < ost_tet_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_tet_degree5.point[q];
        double values[OST_MAX_TET_NODES], gradients[3 * OST_MAX_TET_NODES], place[3], strain[6];
        Mode mode;
        ost_shape_values(tet->nodes, point->at, values);
        ost_shape_place(tet->nodes, values, tet->x, place);
        find_mode(view, tet->number, point->at, place, &mode);
        if (!mode.split)
            return 0.0;
        const double weight = point->weight * ost_shape_gradients(tet->nodes, point->at, tet->x, gradients);
        elastic_strain_at(view, tet, point->at, place, strain);
        sum += weight * ost_dot6(mode.m, strain);
        volume += weight;
    }
    return sum / volume;
}

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
static OstStatus stress_in_tet(const View *view, const Tet *tet, const double at[4], const double place[3],
                               double stress[6])
{
    double c[36], strain[6];
    Mode mode;
    elastic_strain_at(view, tet, at, place, strain);
    if (tet->pressure) {
        find_mode(view, tet->number, at, place, &mode);
        rest_stress(view, tet->number, at, place, strain, stress);
        for (int p = 0; p < 6; p++)
            stress[p] += pressure_at(tet, at) * mode.m[p];
        return OST_SUCCESS;
    }
    OST_TRY(view->exact->stiffness(view->exact->data, place, c));
    ost_apply6(c, strain, stress);
    find_mode(view, tet->number, at, place, &mode);
    const double excess = ost_dot6(mode.m, strain) - mean_of_mode(view, tet);
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
    Tet tet;
    for (int v = 0; v < 4; v++)
        for (int a = 0; a < 3; a++)
            if (face[a] == vertices[v])
                in_tet[v] = point->at[a];
    gather_tet(view, number, &tet);
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
    ost_gather3(n, nodes, view->mesh->coordinates, x);
    ost_gather3(n, nodes, view->result->displacement, u);
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
    const OstSurface *surface = NULL;
    unsigned char *selected = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_mesh_surface(view->mesh, &surface));
    OST_TRY_DONE(ost_agree(ctx, OST_NEW(ctx, &selected, view->mesh->node_count)));
    for (OstLocal i = 0; i < count; i++)
        selected[nodes[i]] = 1;
    OST_TRY_DONE(ost_agree(ctx, sum_faces(view, selected, surface, sums)));
    status = ost_sum(ctx, SUMS, sums);
done:
    OST_FREE(selected);
    return status;
}

static OstStatus sum_selection(const View *view, const OstCase *c, double sums[SUMS])
{
    const OstVerifyQuantity *quantity = view->quantity;
    OstContext *ctx = view->mesh->ctx;
    OstLocal count = 0;
    OstLocal *nodes = NULL;
    OstStatus status = OST_SUCCESS;
    OST_TRY_DONE(ost_select_nodes(c, view->mesh, &quantity->on, &count, &nodes));
    if (quantity->kind != OST_MEASURE_REACTION)
        OST_TRY_DONE(measure_faces(view, count, nodes, sums));
    if (sums[SIZE] != 0.0)
        goto done;
    if (quantity->kind == OST_MEASURE_STRESS)
        OST_TRY_DONE(OST_RAISE(ctx, OST_INVALID_INPUT,
                               "%s:%d: stress is measured over faces, and the selection has "
                               "none",
                               c->path, quantity->line));
    OST_TRY_DONE(ost_agree(ctx, sum_nodes(view, count, nodes, sums)));
    status = ost_sum(ctx, SUMS, sums);
done:
    OST_FREE(nodes);
    return status;
}

/* --- over the body --- */

/* Squares of the formula's field and of the answer's distance from it, integrated over the body. */
enum { OF_FORMULA, OF_DIFFERENCE, SQUARES };

/* One quadrature point of a tet. */
typedef struct TetPoint {
    const double *at;
    double values[OST_MAX_TET_NODES];
    double place[3];
    double weight; /* in volume */
} TetPoint;

static OstStatus add_displacement(const View *view, const Tet *tet, const TetPoint *point, double squares[SQUARES])
{
    double exact[3], moved[3];
    OST_TRY(view->exact->displacement(view->exact->data, point->place, exact));
    ost_shape_place(tet->nodes, point->values, tet->u, moved);
    for (int i = 0; i < 3; i++) {
        squares[OF_FORMULA] += point->weight * exact[i] * exact[i];
        squares[OF_DIFFERENCE] += point->weight * (moved[i] - exact[i]) * (moved[i] - exact[i]);
    }
    return OST_SUCCESS;
}

/* The element's energy: with mean dilatation, the stiff mode is left out here and its integral goes to `modes`. */
static OstStatus add_energy(const View *view, const Tet *tet, const TetPoint *point, double squares[SQUARES],
                            double modes[SQUARES])
{
    double g[9], c[36], strain[SQUARES][6], stress[6];
    Mode mode;
    OST_TRY(view->exact->gradient(view->exact->data, point->place, g));
    OST_TRY(view->exact->stiffness(view->exact->data, point->place, c));
    strain_of_gradient(g, strain[OF_FORMULA]);
    strain_at(tet, point->at, strain[OF_DIFFERENCE]);
    find_mode(view, tet->number, point->at, point->place, &mode);
    for (int p = 0; p < 6; p++)
        strain[OF_DIFFERENCE][p] -= strain[OF_FORMULA][p];
    for (int s = 0; s < SQUARES; s++) {
        const double part = ost_dot6(mode.m, strain[s]);
        ost_apply6(c, strain[s], stress);
        squares[s] += point->weight * (ost_dot6(stress, strain[s]) - part * part);
        modes[s] += point->weight * part;
    }
    return OST_SUCCESS;
}

/* A mixed form's energy, or its pressure alone: strain and pressure, and how far they are from the formula's. */
static OstStatus add_mixed(const View *view, const Tet *tet, const TetPoint *point, double squares[SQUARES])
{
    const double looseness = view->result->field->mixed.looseness[view->mesh->tet_region[tet->number]];
    const int only_pressure = view->quantity->norm == OST_NORM_PRESSURE;
    double g[9], strain[SQUARES][6], elastic[6], stress[6], exact[6], pressure[SQUARES];
    Mode mode;
    OST_TRY(view->exact->gradient(view->exact->data, point->place, g));
    OST_TRY(view->exact->stress(view->exact->data, point->place, exact));
    strain_of_gradient(g, strain[OF_FORMULA]);
    memcpy(elastic, strain[OF_FORMULA], sizeof elastic);
    take_off_eigenstrain(view, tet->number, point->at, point->place, elastic);
    rest_stress(view, tet->number, point->at, point->place, elastic, stress);
    find_mode(view, tet->number, point->at, point->place, &mode);
    for (int p = 0; p < 6; p++)
        exact[p] -= stress[p];
    pressure[OF_FORMULA] = ost_dot6(mode.m, exact) / ost_dot6(mode.m, mode.m);
    pressure[OF_DIFFERENCE] = pressure_at(tet, point->at) - pressure[OF_FORMULA];
    strain_at(tet, point->at, strain[OF_DIFFERENCE]);
    for (int p = 0; p < 6; p++)
        strain[OF_DIFFERENCE][p] -= strain[OF_FORMULA][p];
    for (int s = 0; s < SQUARES; s++) {
        rest_stress(view, tet->number, point->at, point->place, strain[s], stress);
        squares[s] +=
            point->weight * (only_pressure ? pressure[s] * pressure[s]
                                           : ost_dot6(stress, strain[s]) + looseness * pressure[s] * pressure[s]);
    }
    return OST_SUCCESS;
}

static OstStatus add_point(const View *view, const Tet *tet, const TetPoint *point, double squares[SQUARES],
                           double modes[SQUARES])
{
    if (view->quantity->norm == OST_NORM_DISPLACEMENT)
        return add_displacement(view, tet, point, squares);
    if (tet->pressure)
        return add_mixed(view, tet, point, squares);
    if (view->quantity->norm == OST_NORM_ENERGY)
        return add_energy(view, tet, point, squares, modes);
    return OST_RAISE(view->mesh->ctx, OST_INVALID_INPUT,
                     "field: pressure is an unknown of the mixed form alone, that of quadratic tets of a nearly "
                     "incompressible material");
}

static OstStatus add_tet(const View *view, OstLocal number, double squares[SQUARES])
{
    Tet tet;
    double modes[SQUARES] = {0.0}; /* integrals of m'strain, m being the stiff mode */
    double gradients[3 * OST_MAX_TET_NODES], volume = 0.0;
    gather_tet(view, number, &tet);
    for (int q = 0; q < ost_tet_degree5.count; q++) {
        TetPoint point = {.at = ost_tet_degree5.point[q].at};
        ost_shape_values(tet.nodes, point.at, point.values);
        ost_shape_place(tet.nodes, point.values, tet.x, point.place);
        point.weight =
            ost_tet_degree5.point[q].weight * ost_shape_gradients(tet.nodes, point.at, tet.x, gradients) / 6.0;
        volume += point.weight;
        OST_TRY(add_point(view, &tet, &point, squares, modes));
    }
    for (int s = 0; s < SQUARES; s++)
        squares[s] += modes[s] * modes[s] / volume;
    return OST_SUCCESS;
}

static OstStatus measure_field(const View *view, OstVerifyReading *reading)
{
    OstContext *ctx = view->mesh->ctx;
    double squares[SQUARES] = {0.0};
    OstStatus status = OST_SUCCESS;
    for (OstLocal tet = 0; tet < view->mesh->owned_tets && status == OST_SUCCESS; tet++)
        status = add_tet(view, tet, squares);
    OST_TRY(ost_agree(ctx, status));
    OST_TRY(ost_sum(ctx, SQUARES, squares));
    reading->expected = sqrt(squares[OF_FORMULA]);
    reading->obtained = sqrt(fmax(squares[OF_DIFFERENCE], 0.0));
    reading->error = reading->obtained / reading->expected;
    return OST_SUCCESS;
}

/* --- a quantity --- */

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

/* Over a selection: the mean, or the sum of reactions; and the root mean square of the distance, because a mean can
 * come out right by accident, where errors of both signs cancel, and then says nothing of the order of convergence. */
OstStatus ost_verify_measure(const OstScene *scene, const OstResult *result, const OstExact *exact,
                             const OstVerifyQuantity *quantity, OstVerifyReading *reading)
{
    const View view = {scene->mesh, result, &exact->field, quantity};
    double sums[SUMS] = {0.0};
    if (quantity->kind == OST_MEASURE_FIELD)
        return measure_field(&view, reading);
    OST_TRY(find_expected(scene->c, exact, quantity, &reading->expected));
    if (quantity->kind == OST_MEASURE_ENERGY)
        sums[VALUE] = result->checks.strain_energy;
    else
        OST_TRY(sum_selection(&view, scene->c, sums));
    const double size =
        quantity->kind == OST_MEASURE_ENERGY || quantity->kind == OST_MEASURE_REACTION ? 1.0 : sums[SIZE];
    const double distance = sqrt(sums[SQUARE] / size) * fabs(quantity->scale);
    reading->obtained = sums[VALUE] / size * quantity->scale;
    reading->error = fmax(fabs(reading->obtained - reading->expected), distance) / fabs(reading->expected);
    return OST_SUCCESS;
}
