/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/loads.h"
#include "core/error.h"
#include "core/small.h"
#include "element/element.h"
#include "element/quadrature.h"
#include "element/shape_functions.h"

/* Adds a force at a point to the element's owned nodes, weighted by their shape functions. */
static void share(const OstMesh *mesh, int count, const OstLocal *nodes, const double *values, const double at_point[3],
                  double *force)
{
    for (int a = 0; a < count; a++)
        for (int i = 0; i < 3 && nodes[a] < mesh->owned_nodes; i++)
            force[3 * (size_t)nodes[a] + (size_t)i] += values[a] * at_point[i];
}

OstStatus ost_load_by_traction(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces, int nodes_per_face,
                               OstTractionAt at, const void *data, double *force)
{
    const int n = nodes_per_face;
    for (OstLocal f = 0; f < face_count; f++) {
        const OstLocal *nodes = faces + (size_t)n * (size_t)f;
        double x[3 * OST_MAX_FACE_NODES], values[OST_MAX_FACE_NODES];
        ost_gather3(n, nodes, mesh->coordinates, x);
        for (int q = 0; q < ost_triangle_degree5.count; q++) {
            const OstQuadraturePoint *point = &ost_triangle_degree5.point[q];
            double place[3], area[3], at_point[3];
            ost_shape_values(n, point->at, values);
            ost_shape_place(n, values, x, place);
            ost_shape_area_vector(n, point->at, x, area);
            for (int i = 0; i < 3; i++)
                area[i] *= 0.5 * point->weight;
            OST_TRY(at(data, place, area, at_point));
            share(mesh, n, nodes, values, at_point, force);
        }
    }
    return OST_SUCCESS;
}

static OstStatus force_of_stress(const void *data, const double place[3], const double area[3], double force[3])
{
    const OstClosedForm *solution = data;
    double s[6];
    OST_TRY(solution->stress(solution->data, place, s));
    force[0] = s[0] * area[0] + s[3] * area[1] + s[5] * area[2];
    force[1] = s[3] * area[0] + s[1] * area[1] + s[4] * area[2];
    force[2] = s[5] * area[0] + s[4] * area[1] + s[2] * area[2];
    return OST_SUCCESS;
}

OstStatus ost_load_closed_form_traction(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces,
                                        int nodes_per_face, const OstClosedForm *solution, double *force)
{
    ost_ledger_enter(mesh->ctx, OST_EFFECT_SURFACE_LOAD);
    const OstStatus status =
        ost_load_by_traction(mesh, face_count, faces, nodes_per_face, force_of_stress, solution, force);
    ost_ledger_leave(mesh->ctx);
    return status;
}

static OstStatus load_tet(const OstMesh *mesh, OstLocal tet, const OstClosedForm *solution, double *force)
{
    const int n = mesh->nodes_per_tet;
    const OstLocal *nodes = mesh->tet_nodes + (size_t)n * (size_t)tet;
    double x[3 * OST_MAX_TET_NODES], values[OST_MAX_TET_NODES], gradients[3 * OST_MAX_TET_NODES];
    ost_gather3(n, nodes, mesh->coordinates, x);
    for (int q = 0; q < ost_tet_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_tet_degree5.point[q];
        double place[3], density[3];
        ost_shape_values(n, point->at, values);
        ost_shape_place(n, values, x, place);
        const double volume = ost_shape_gradients(n, point->at, x, gradients) / 6.0;
        OST_TRY(solution->body_force(solution->data, place, density));
        for (int i = 0; i < 3; i++)
            density[i] *= point->weight * volume;
        share(mesh, n, nodes, values, density, force);
    }
    return OST_SUCCESS;
}

OstStatus ost_load_closed_form_body_force(const OstMesh *mesh, int region, const OstClosedForm *solution, double *force)
{
    OstStatus status = OST_SUCCESS;
    ost_ledger_enter(mesh->ctx, OST_EFFECT_BODY_FORCE);
    for (OstLocal tet = 0; tet < mesh->tet_count && status == OST_SUCCESS; tet++)
        if (region < 0 || mesh->tet_region[tet] == region)
            status = load_tet(mesh, tet, solution, force);
    ost_ledger_leave(mesh->ctx);
    return status;
}

static OstStatus spin_force(const void *data, const double point[3], double force[3])
{
    const OstSpin *spin = data;
    const double arm[3] = {point[0] - spin->origin[0], point[1] - spin->origin[1], point[2] - spin->origin[2]};
    const double along = ost_dot3(arm, spin->axis);
    for (int i = 0; i < 3; i++)
        force[i] = spin->density * spin->speed * spin->speed * (arm[i] - along * spin->axis[i]);
    return OST_SUCCESS;
}

OstClosedForm ost_spin_form(const OstSpin *spin)
{
    return (OstClosedForm){.data = spin, .body_force = spin_force};
}

OstStatus ost_load_centrifugal(const OstMesh *mesh, const OstMaterialField *field, int region, const OstSpin *spin,
                               double *force)
{
    OstSpin of_tet = *spin;
    const OstClosedForm form = ost_spin_form(&of_tet);
    OstStatus status = OST_SUCCESS;
    ost_ledger_enter(mesh->ctx, OST_EFFECT_CENTRIFUGAL);
    for (OstLocal tet = 0; tet < mesh->tet_count && status == OST_SUCCESS; tet++) {
        of_tet.density = ost_field_density(field, tet);
        if (region < 0 || mesh->tet_region[tet] == region)
            status = load_tet(mesh, tet, &form, force);
    }
    ost_ledger_leave(mesh->ctx);
    return status;
}
