/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/loads.h"

#include "assembly/loads.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/small.h"
#include "element/quadrature.h"
#include "element/shape_functions.h"
#include "problem/boundary_conditions.h"

#include <math.h>
#include <string.h>

/* Mid-edge nodes are on their edges within this share of the coordinates. */
static const double straight = 1e-12;

/* --- integrals over one face, and over one tet --- */

typedef struct Face {
    const OstLocal *nodes;
    int node_count, count;
    OstLocal function[4];
    double turn[4];
    double x[3 * OST_MAX_FACE_NODES];
} Face;

static void open_face(const OstComplement *complement, int nodes_per_face, const OstLocal *nodes, Face *face)
{
    const OstMesh *mesh = complement->mesh;
    face->nodes = nodes;
    face->node_count = nodes_per_face;
    face->count = ost_complement_of_face(complement, nodes, face->function);
    for (int k = 0; k < face->count; k++)
        face->turn[k] = k < 3 ? ost_complement_turn(mesh, nodes[k], nodes[(k + 1) % 3]) : 1.0;
    ost_gather3(nodes_per_face, nodes, mesh->coordinates, face->x);
}

static void add(const OstComplement *complement, OstLocal function, double scale, const double vector[3], double *force)
{
    for (int i = 0; i < 3 && ost_complement_owns(complement, function); i++)
        force[3 * (size_t)function + (size_t)i] += scale * vector[i];
}

static void share_over_face(const OstComplement *complement, const Face *face, const double at[3],
                            const double at_point[3], double *force)
{
    double values[4];
    ost_complement_face_values(face->node_count == 6, at, values);
    for (int k = 0; k < face->count; k++)
        add(complement, face->function[k], face->turn[k] * values[k], at_point, force);
}

/* What acts on faces: a traction, a pressure, what a moment makes there, or the closed form's stress. */
typedef struct Traction {
    double vector[3];
    double pressure;
    const OstClosedForm *exact;
    const OstSpread *spread; /* of a moment, or NULL */
} Traction;

static OstStatus load_face(const OstComplement *complement, const Face *face, const Traction *traction, double *force)
{
    for (int q = 0; q < ost_triangle_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_triangle_degree5.point[q];
        double values[OST_MAX_FACE_NODES], place[3], area[3], s[6], at_point[3];
        double vector[3] = {traction->vector[0], traction->vector[1], traction->vector[2]};
        ost_shape_area_vector(face->node_count, point->at, face->x, area);
        ost_shape_values(face->node_count, point->at, values);
        ost_shape_place(face->node_count, values, face->x, place);
        if (traction->spread)
            ost_spread_at(traction->spread, place, vector);
        const double weight = 0.5 * point->weight, size = ost_norm3(area);
        for (int i = 0; i < 3; i++)
            at_point[i] = weight * (size * vector[i] - traction->pressure * area[i]);
        if (traction->exact) {
            OST_TRY(traction->exact->stress(traction->exact->data, place, s));
            at_point[0] = weight * (s[0] * area[0] + s[3] * area[1] + s[5] * area[2]);
            at_point[1] = weight * (s[3] * area[0] + s[1] * area[1] + s[4] * area[2]);
            at_point[2] = weight * (s[5] * area[0] + s[4] * area[1] + s[2] * area[2]);
        }
        share_over_face(complement, face, point->at, at_point, force);
    }
    return OST_SUCCESS;
}

static OstStatus load_faces(const OstComplement *complement, OstLocal count, int nodes_per_face, const OstLocal *faces,
                            const Traction *traction, double *force)
{
    for (OstLocal f = 0; f < count; f++) {
        Face face;
        open_face(complement, nodes_per_face, faces + (size_t)nodes_per_face * (size_t)f, &face);
        OST_TRY(load_face(complement, &face, traction, force));
    }
    return OST_SUCCESS;
}

static void add_to_tet(const OstComplement *complement, OstLocal tet, double weight, const double *values,
                       const double density[3], double *force)
{
    OstLocal function[OST_MAX_FUNCTIONS];
    ost_complement_of_tet(complement, tet, function);
    for (int k = 0; k < ost_complement_per_tet(complement); k++) {
        const double turn = k < 6 ? ost_complement_turn_of(complement, tet, k) : 1.0;
        add(complement, function[k], turn * weight * values[k], density, force);
    }
}

static int is_straight(const OstMesh *mesh, const OstLocal *nodes)
{
    const double *x = mesh->coordinates;
    for (int e = 0; e < 6 && mesh->nodes_per_tet == 10; e++) {
        const double *a = x + 3 * (size_t)nodes[ost_tet_edge[e][0]], *b = x + 3 * (size_t)nodes[ost_tet_edge[e][1]];
        for (int i = 0; i < 3; i++)
            if (fabs(x[3 * (size_t)nodes[4 + e] + (size_t)i] - 0.5 * (a[i] + b[i])) > straight * fabs(a[i] + b[i]))
                return 0;
    }
    return 1;
}

/* A uniform force per volume on a straight tet: the means of the functions are 1/5 on an edge of linear tets, 0 on one
 * of quadratic tets, and 27/120 on a face. */
static void load_tet_evenly(const OstComplement *complement, OstLocal tet, const double density[3], double *force)
{
    static const double linear[6] = {0.2, 0.2, 0.2, 0.2, 0.2, 0.2};
    static const double quadratic[OST_MAX_FUNCTIONS] = {[6] = 0.225, 0.225, 0.225, 0.225};
    const OstMesh *mesh = complement->mesh;
    const double volume = fabs(ost_tet_volume(mesh->coordinates, ost_mesh_nodes_of(mesh, tet)));
    add_to_tet(complement, tet, volume, mesh->nodes_per_tet == 10 ? quadratic : linear, density, force);
}

/* A force per volume: `vector`, or the closed form's. */
static OstStatus load_tet(const OstComplement *complement, OstLocal tet, const double vector[3],
                          const OstClosedForm *exact, double *force)
{
    const OstMesh *mesh = complement->mesh;
    const int n = mesh->nodes_per_tet;
    double x[3 * OST_MAX_TET_NODES], shape[OST_MAX_TET_NODES];
    if (!exact && is_straight(mesh, ost_mesh_nodes_of(mesh, tet))) {
        load_tet_evenly(complement, tet, vector, force);
        return OST_SUCCESS;
    }
    ost_gather3(n, ost_mesh_nodes_of(mesh, tet), mesh->coordinates, x);
    for (int q = 0; q < ost_tet_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_tet_degree5.point[q];
        double values[OST_MAX_FUNCTIONS], place[3], density[3] = {vector[0], vector[1], vector[2]};
        const double weight = point->weight * ost_shape_determinant(n, point->at, x) / 6.0;
        if (exact) {
            ost_shape_values(n, point->at, shape);
            ost_shape_place(n, shape, x, place);
            OST_TRY(exact->body_force(exact->data, place, density));
        }
        ost_complement_values(n == 10, point->at, values);
        add_to_tet(complement, tet, weight, values, density, force);
    }
    return OST_SUCCESS;
}

/* The same of a constant force in straight linear tets, where the mean of a function is 1/5. */
static void load_straight_tet(const OstComplement *complement, OstLocal tet, const double vector[3], double *force)
{
    const OstMesh *mesh = complement->mesh;
    const OstLocal *nodes = ost_mesh_nodes_of(mesh, tet);
    const double share = 0.2 * ost_tet_volume(mesh->coordinates, nodes);
    OstLocal function[OST_MAX_FUNCTIONS];
    ost_complement_of_tet(complement, tet, function);
    for (int k = 0; k < 6; k++)
        add(complement, function[k],
            share * ost_complement_turn(mesh, nodes[ost_tet_edge[k][0]], nodes[ost_tet_edge[k][1]]), vector, force);
}

/* --- the loads of the case --- */

static OstStatus add_body_load(const OstScene *scene, const OstComplement *complement, const OstLoad *load,
                               double *force)
{
    const OstMesh *mesh = complement->mesh;
    const int region = load->region ? ost_mesh_find_region(mesh, load->region) : -1;
    OstSpin spin = ost_load_spin(load);
    const OstClosedForm centrifugal = ost_spin_form(&spin);
    const OstClosedForm *form = load->kind == OST_LOAD_CENTRIFUGAL ? &centrifugal : load->exact ? scene->exact : NULL;
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        if (region >= 0 && mesh->tet_region[tet] != region)
            continue;
        const double density = load->kind == OST_LOAD_BODY_FORCE ? 1.0 : ost_field_density(scene->field, tet);
        double vector[3];
        for (int i = 0; i < 3; i++)
            vector[i] = density * load->vector[i];
        spin.density = density;
        if (mesh->nodes_per_tet == 4 && !form)
            load_straight_tet(complement, tet, vector, force);
        else
            OST_TRY(load_tet(complement, tet, vector, form, force));
    }
    return OST_SUCCESS;
}

static OstStatus add_surface_load(const OstScene *scene, const OstComplement *complement, const OstLoad *load,
                                  double *force)
{
    Traction traction = {.pressure = load->kind == OST_LOAD_PRESSURE ? load->pressure : 0.0,
                         .exact = load->exact ? scene->exact : NULL};
    OstLocal count = 0, *faces = NULL;
    int nodes_per_face = 3;
    double area = 1.0;
    if (load->follows) /* the problem has those */
        return OST_SUCCESS;
    OST_TRY(ost_select_faces(scene->c, scene->mesh, &load->on, &count, &nodes_per_face, &faces));
    OstStatus status = OST_SUCCESS;
    if (load->kind == OST_LOAD_TOTAL_FORCE)
        status = ost_faces_area(scene->mesh, count, faces, nodes_per_face, &area);
    for (int i = 0; i < 3 && load->kind != OST_LOAD_PRESSURE; i++)
        traction.vector[i] = load->vector[i] / area;
    OST_THEN(load_faces(complement, count, nodes_per_face, faces, &traction, force));
    OST_FREE(faces);
    return status;
}

/* Forces on vertices have no part here. */
static OstStatus add_moment(const OstScene *scene, const OstComplement *complement, const OstLoad *load, int function,
                            double *force)
{
    OstSpread spread;
    const Traction traction = {.spread = &spread};
    OstLocal count = 0, *faces = NULL;
    int on_faces = 0, nodes_per_face = 3;
    OstStatus status = ost_scene_spread(scene, load, function, &on_faces, &count, &nodes_per_face, &faces, &spread);
    if (status == OST_SUCCESS && on_faces)
        status = load_faces(complement, count, nodes_per_face, faces, &traction, force);
    OST_FREE(faces);
    return status;
}

/* A table has forces once there is a load that acts on the functions. */
static OstStatus add_load(const OstScene *scene, const OstComplement *complement, int i, int function, double **force)
{
    const OstLoad *load = &scene->c->loads[i];
    const int in_volume = ost_load_in_volume(load->kind), on_surface = scene->load_effect[i] == OST_EFFECT_SURFACE_LOAD;
    if (!in_volume && !on_surface && scene->load_effect[i] != OST_EFFECT_MOMENT &&
        scene->load_effect[i] != OST_EFFECT_MOVED_COUPLING)
        return OST_SUCCESS;
    OstStatus status = *force ? OST_SUCCESS : OST_NEW(scene->ctx, force, 3 * (size_t)complement->count);
    OST_TRY(ost_agree(scene->ctx, status));
    status = in_volume    ? add_body_load(scene, complement, load, *force)
             : on_surface ? add_surface_load(scene, complement, load, *force)
                          : add_moment(scene, complement, load, function, *force);
    return ost_agree(scene->ctx, status);
}

static OstStatus add_foundation(const OstScene *scene, const OstSpring *spring, OstSurplusLoads *loads)
{
    struct OstFoundation *made = NULL;
    OST_TRY(ost_agree(scene->ctx, OST_NEW(scene->ctx, &made, 1)));
    made->along = spring->along;
    made->across = spring->across;
    memcpy(made->direction, spring->direction, sizeof made->direction);
    made->next = loads->foundation;
    loads->foundation = made;
    return ost_select_faces(scene->c, scene->mesh, &spring->on, &made->count, &made->nodes_per_face, &made->faces);
}

OstStatus ost_surplus_loads_create(const OstProblem *problem, const OstComplement *complement, OstSurplusLoads *loads)
{
    const OstScene *scene = problem->scene;
    OstContext *ctx = problem->ctx;
    *loads = (OstSurplusLoads){.count = ost_problem_functions(problem)};
    OST_TRY(ost_agree(ctx, OST_NEW(ctx, &loads->force, loads->count)));
    for (int i = 0; i < scene->c->load_count; i++)
        for (int k = 0; k < loads->count && ost_effect_on(problem->effects, scene->load_effect[i]); k++)
            if (scene->c->loads[i].table == k || scene->c->loads[i].kind == OST_LOAD_DISTRIBUTING)
                OST_TRY(add_load(scene, complement, i, k, &loads->force[k]));
    for (int i = 0; i < scene->c->spring_count; i++)
        if (scene->c->springs[i].kind == OST_SPRING_FOUNDATION &&
            ost_effect_on(problem->effects, OST_EFFECT_FOUNDATION))
            OST_TRY(add_foundation(scene, &scene->c->springs[i], loads));
    return OST_SUCCESS;
}

void ost_surplus_loads_clear(OstSurplusLoads *loads)
{
    for (int k = 0; k < loads->count && loads->force; k++)
        OST_FREE(loads->force[k]);
    OST_FREE(loads->force);
    while (loads->foundation) {
        struct OstFoundation *next = loads->foundation->next;
        OST_FREE(loads->foundation->faces);
        OST_FREE(loads->foundation);
        loads->foundation = next;
    }
}

/* --- loads that depend on the displacement --- */

static void add_follower(const OstComplement *complement, const OstFollower *follower, double factor, const double *u,
                         double *force)
{
    const int n = follower->nodes_per_face;
    for (OstLocal f = 0; f < follower->count; f++) {
        const OstLocal *nodes = follower->faces + (size_t)n * (size_t)f;
        double moved[3 * OST_MAX_FACE_NODES];
        Face face;
        open_face(complement, n, nodes, &face);
        if (u)
            ost_gather3(n, nodes, u, moved);
        for (int i = 0; i < 3 * n && u; i++)
            face.x[i] += moved[i];
        (void)load_face(complement, &face, &(Traction){.pressure = factor * follower->pressure},
                        force); /* cannot fail */
    }
}

/* What a foundation takes at a point of a face that has moved: -S moved, times `weight`. */
static void push_back(const struct OstFoundation *foundation, const double normal[3], double weight,
                      const double moved[3], double force[3])
{
    const double *direction = ost_norm3(foundation->direction) > 0.0 ? foundation->direction : normal;
    const double along = (foundation->along - foundation->across) * ost_dot3(direction, moved);
    for (int i = 0; i < 3; i++)
        force[i] = -weight * (foundation->across * moved[i] + along * direction[i]);
}

/* The unit normal at a point, and its weight in an integral over the face. */
static double open_point(const Face *face, const OstQuadraturePoint *point, double normal[3])
{
    double area[3];
    ost_shape_area_vector(face->node_count, point->at, face->x, area);
    const double size = ost_norm3(area);
    for (int i = 0; i < 3; i++)
        normal[i] = area[i] / size;
    return 0.5 * point->weight * size;
}

/* The elements' foundation acts at the middles of edges (assembly/springs.h), and nothing keeps the vertices of a stiff
 * one near: what it takes is linear between the middles. */
static void load_foundation_face(const OstComplement *complement, const struct OstFoundation *foundation,
                                 const Face *face, const double *u, double *force)
{
    for (int q = 0; q < ost_triangle_degree5.count; q++) {
        const OstQuadraturePoint *point = &ost_triangle_degree5.point[q];
        const double *at = point->at;
        double normal[3], moved[3], at_point[3];
        for (int i = 0; i < 3; i++)
            moved[i] = face->node_count == 6 ? (1.0 - 2.0 * at[2]) * u[9 + i] + (1.0 - 2.0 * at[0]) * u[12 + i] +
                                                   (1.0 - 2.0 * at[1]) * u[15 + i]
                                             : at[0] * u[i] + at[1] * u[3 + i] + at[2] * u[6 + i];
        const double weight = open_point(face, point, normal);
        push_back(foundation, normal, weight, moved, at_point);
        share_over_face(complement, face, at, at_point, force);
    }
}

static void add_foundation_force(const OstComplement *complement, const struct OstFoundation *foundation,
                                 const double *u, double *force)
{
    const int n = foundation->nodes_per_face;
    for (OstLocal f = 0; f < foundation->count; f++) {
        const OstLocal *nodes = foundation->faces + (size_t)n * (size_t)f;
        double moved[3 * OST_MAX_FACE_NODES];
        Face face;
        open_face(complement, n, nodes, &face);
        ost_gather3(n, nodes, u, moved);
        load_foundation_face(complement, foundation, &face, moved, force);
    }
}

/* What a foundation adds to the blocks of a face's functions; what it couples is left out. */
static void add_bed_of_face(const struct OstFoundation *foundation, const Face *face, double divisor, double *bed)
{
    for (int q = 0; q < ost_triangle_degree5.count; q++) {
        double values[4], normal[3];
        const double weight = open_point(face, &ost_triangle_degree5.point[q], normal);
        ost_complement_face_values(face->node_count == 6, ost_triangle_degree5.point[q].at, values);
        for (int p = 0; p < 6; p++) {
            const int row = p % 3, column = p < 3 ? p : (p + 1) % 3;
            double moved[3] = {0.0}, force[3];
            moved[column] = 1.0;
            push_back(foundation, normal, weight / divisor, moved, force);
            for (int k = 0; k < face->count; k++)
                bed[6 * (size_t)face->function[k] + (size_t)p] -= values[k] * values[k] * force[row];
        }
    }
}

OstStatus ost_surplus_loads_bed(const OstSurplusLoads *loads, const OstComplement *complement, double divisor,
                                double **bed)
{
    if (!loads->foundation)
        return OST_SUCCESS;
    OST_TRY(OST_NEW(complement->mesh->ctx, bed, 6 * (size_t)complement->count));
    for (const struct OstFoundation *foundation = loads->foundation; foundation; foundation = foundation->next)
        for (OstLocal f = 0; f < foundation->count; f++) {
            Face face;
            open_face(complement, foundation->nodes_per_face,
                      foundation->faces + (size_t)foundation->nodes_per_face * (size_t)f, &face);
            add_bed_of_face(foundation, &face, divisor, *bed);
        }
    return OST_SUCCESS;
}

void ost_surplus_loads_add(const OstSurplusLoads *loads, const OstProblem *problem, const OstComplement *complement,
                           double t, const double *u, double *force)
{
    const double *moves = ost_problem_is_linear(problem) ? NULL : u;
    for (int k = 0; k < loads->count; k++) {
        const double factor = ost_problem_factor(problem, k, t);
        for (size_t i = 0; i < 3 * (size_t)complement->count && loads->force[k]; i++)
            force[i] += factor * loads->force[k][i];
        for (const OstFollower *follower = problem->follower; follower; follower = follower->next)
            if (follower->function == k)
                add_follower(complement, follower, factor, moves, force);
    }
    for (const struct OstFoundation *foundation = loads->foundation; foundation; foundation = foundation->next)
        add_foundation_force(complement, foundation, u, force);
}
