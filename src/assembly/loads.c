/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/loads.h"

#include "core/error.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "element/element.h"

static void add_scaled(double *force, OstLocal node, double scale, const double vector[3])
{
    for (int i = 0; i < 3; i++)
        force[3 * (size_t)node + (size_t)i] += scale * vector[i];
}

OstStatus ost_load_point_force(const OstMesh *mesh, OstLocal count, const OstLocal *nodes, const double force_each[3],
                               double *force)
{
    ost_ledger_enter(mesh->ctx, OST_EFFECT_POINT_FORCE);
    for (OstLocal n = 0; n < count; n++)
        if (nodes[n] < mesh->owned_nodes)
            add_scaled(force, nodes[n], 1.0, force_each);
    ost_ledger_leave(mesh->ctx);
    return OST_SUCCESS;
}

/* Collective. Number of the nodes over all ranks, each counted by its owner. */
static OstStatus count_owned(const OstMesh *mesh, OstLocal count, const OstLocal *nodes, OstGlobal *total)
{
    *total = 0;
    for (OstLocal n = 0; n < count; n++)
        *total += nodes[n] < mesh->owned_nodes;
    OST_TRY(ost_sum_numbers(mesh->ctx, 1, total));
    if (*total == 0)
        return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                         "a total force is to be shared by vertices, but none is selected");
    return OST_SUCCESS;
}

OstStatus ost_load_shared_force(const OstMesh *mesh, OstLocal count, const OstLocal *nodes, const double total[3],
                                double *force)
{
    OstGlobal sharers;
    ost_ledger_enter(mesh->ctx, OST_EFFECT_POINT_FORCE);
    const OstStatus status = ost_agree(mesh->ctx, count_owned(mesh, count, nodes, &sharers));
    for (OstLocal n = 0; n < count && status == OST_SUCCESS; n++)
        if (nodes[n] < mesh->owned_nodes)
            add_scaled(force, nodes[n], 1.0 / (double)sharers, total);
    ost_ledger_leave(mesh->ctx);
    return status;
}

/* The mesh's kind of tet; raises OST_INVALID_INPUT if its faces have another number of nodes (0: not asked). */
static OstStatus find_element(const OstMesh *mesh, int nodes_per_face, const OstElement **element)
{
    *element = ost_element_of(mesh->nodes_per_tet);
    if (!*element)
        return OST_RAISE(mesh->ctx, OST_INVALID_INPUT, "no tets of %d nodes are known; 4 or 10 are expected",
                         mesh->nodes_per_tet);
    if (nodes_per_face != 0 && nodes_per_face != (*element)->nodes_per_face)
        return OST_RAISE(mesh->ctx, OST_INVALID_INPUT, "faces of %d nodes are loaded, on tets whose faces have %d",
                         nodes_per_face, (*element)->nodes_per_face);
    return OST_SUCCESS;
}

/* Adds to each owned node traction × its share of the area, minus pressure × its share of the area vector. */
static void load_faces(const OstMesh *mesh, const OstElement *element, OstLocal face_count, const OstLocal *faces,
                       const double traction[3], double pressure, double *force)
{
    const int n = element->nodes_per_face;
    for (OstLocal f = 0; f < face_count; f++) {
        const OstLocal *nodes = faces + (size_t)n * (size_t)f;
        double x[3 * OST_MAX_FACE_NODES];
        double areas[OST_MAX_FACE_NODES];
        double area_vectors[3 * OST_MAX_FACE_NODES];
        ost_gather3(n, nodes, mesh->coordinates, x);
        element->node_areas(x, areas, area_vectors);
        for (int a = 0; a < n; a++) {
            if (nodes[a] >= mesh->owned_nodes)
                continue;
            add_scaled(force, nodes[a], areas[a], traction);
            add_scaled(force, nodes[a], -pressure, area_vectors + 3 * a);
        }
    }
}

OstStatus ost_load_traction(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces, int nodes_per_face,
                            const double traction[3], double *force)
{
    const OstElement *element;
    OST_TRY(find_element(mesh, nodes_per_face, &element));
    ost_ledger_enter(mesh->ctx, OST_EFFECT_SURFACE_LOAD);
    load_faces(mesh, element, face_count, faces, traction, 0.0, force);
    ost_ledger_leave(mesh->ctx);
    return OST_SUCCESS;
}

OstStatus ost_load_pressure(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces, int nodes_per_face,
                            double pressure, double *force)
{
    const OstElement *element;
    const double no_traction[3] = {0.0, 0.0, 0.0};
    OST_TRY(find_element(mesh, nodes_per_face, &element));
    ost_ledger_enter(mesh->ctx, OST_EFFECT_SURFACE_LOAD);
    load_faces(mesh, element, face_count, faces, no_traction, pressure, force);
    ost_ledger_leave(mesh->ctx);
    return OST_SUCCESS;
}

/* Area of the faces that this rank owns: a face's owner is that of its node with the lowest global number. */
static double owned_area(const OstMesh *mesh, const OstElement *element, OstLocal face_count, const OstLocal *faces)
{
    const int n = element->nodes_per_face;
    double sum = 0.0;
    for (OstLocal f = 0; f < face_count; f++) {
        const OstLocal *nodes = faces + (size_t)n * (size_t)f;
        OstGlobal local[OST_MAX_FACE_NODES];
        double x[3 * OST_MAX_FACE_NODES];
        double areas[OST_MAX_FACE_NODES];
        double area_vectors[3 * OST_MAX_FACE_NODES];
        for (int a = 0; a < n; a++)
            local[a] = nodes[a];
        if (!ost_mesh_owns(mesh, n, local))
            continue;
        ost_gather3(n, nodes, mesh->coordinates, x);
        element->node_areas(x, areas, area_vectors);
        for (int a = 0; a < n; a++)
            sum += areas[a];
    }
    return sum;
}

OstStatus ost_faces_area(const OstMesh *mesh, OstLocal face_count, const OstLocal *faces, int nodes_per_face,
                         double *area)
{
    const OstElement *element;
    OST_TRY(ost_agree(mesh->ctx, find_element(mesh, nodes_per_face, &element)));
    *area = owned_area(mesh, element, face_count, faces);
    return ost_sum(mesh->ctx, 1, area);
}

/* Adds the force per volume `vector`, times the density if `field` is not NULL. */
static OstStatus load_volumes(const OstMesh *mesh, const OstMaterialField *field, int region, const double vector[3],
                              double *force)
{
    const OstElement *element;
    OST_TRY(find_element(mesh, 0, &element));
    ost_ledger_enter(mesh->ctx, OST_EFFECT_BODY_FORCE);
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        const OstLocal *nodes = mesh->tet_nodes + (size_t)element->nodes * (size_t)tet;
        double x[3 * OST_MAX_TET_NODES];
        double volumes[OST_MAX_TET_NODES];
        if (region >= 0 && mesh->tet_region[tet] != region)
            continue;
        const double density = field ? ost_field_density(field, tet) : 1.0;
        ost_gather3(element->nodes, nodes, mesh->coordinates, x);
        element->node_volumes(x, volumes);
        for (int a = 0; a < element->nodes; a++)
            if (nodes[a] < mesh->owned_nodes)
                add_scaled(force, nodes[a], density * volumes[a], vector);
    }
    ost_ledger_leave(mesh->ctx);
    return OST_SUCCESS;
}

OstStatus ost_load_gravity(const OstMesh *mesh, const OstMaterialField *field, int region, const double acceleration[3],
                           double *force)
{
    return load_volumes(mesh, field, region, acceleration, force);
}

OstStatus ost_load_body_force(const OstMesh *mesh, int region, const double force_per_volume[3], double *force)
{
    return load_volumes(mesh, NULL, region, force_per_volume, force);
}
