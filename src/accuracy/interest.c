/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/estimate.h"

#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "fields/stress_measure.h"
#include "material/field_data.h"
#include "mesh/nearest.h"

#include <math.h>
#include <string.h>

void ost_interest_clear(OstInterest *interest)
{
    OST_FREE(interest->load);
    OST_FREE(interest->moved);
    OST_FREE(interest->strain);
}

/* The direction of the quantity: an axis, or that of the vector. */
static void take_direction(const OstWatch *watch, const double vector[3], double direction[3])
{
    const double length = ost_norm3(vector);
    const int axis = watch->component == OST_WATCH_LENGTH ? 0 : watch->component;
    memset(direction, 0, 3 * sizeof *direction);
    if (watch->component == OST_WATCH_LENGTH && length > 0.0)
        for (int i = 0; i < 3; i++)
            direction[i] = vector[i] / length;
    else
        direction[axis] = 1.0;
}

static OstStatus of_displacement(const OstProblem *problem, const OstWatch *watch, const double *u,
                                 OstInterest *interest)
{
    OstNearest vertex;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &interest->load, 3 * (size_t)problem->mesh->owned_nodes)));
    OST_TRY(ost_mesh_nearest(problem->mesh, watch->on.point, &vertex));
    if (vertex.node >= 0) {
        const double *at = u + 3 * (size_t)vertex.node;
        double *direction = interest->load + 3 * (size_t)vertex.node;
        take_direction(watch, at, direction);
        interest->value = ost_dot3(direction, at);
    }
    return ost_sum(problem->ctx, 1, &interest->value);
}

/* How a node's place, which moves where rotations are large, is seen from the point that a moment is about. */
static void find_arm(const OstProblem *problem, const OstWatch *watch, const double *u, OstLocal node, double arm[3])
{
    const int turns = !ost_problem_is_linear(problem);
    for (size_t i = 0; i < 3; i++) {
        const size_t n = 3 * (size_t)node + i;
        arm[i] = problem->mesh->coordinates[n] + (turns ? u[n] : 0.0) - watch->about[i];
    }
}

/* Of what is out of balance at a node, what supports take, with the force of its spring. Nodes that follow others, and
 * those that they follow, are solved for to the residual. */
static void keep_reaction(const OstSupports *supports, const double *u, OstLocal node, double force[3])
{
    double projector[9], free_force[3], of_spring[3] = {0.0};
    ost_supports_get(supports, node, projector, NULL);
    ost_apply3(projector, force, free_force);
    if (supports->spring)
        ost_apply3(supports->spring + 9 * (size_t)node, u + 3 * (size_t)node, of_spring);
    for (int i = 0; i < 3; i++)
        force[i] -= (supports->links ? 0.0 : free_force[i]) + of_spring[i];
}

/* The nodes of a reaction, and which components of what acts there others bear, too or alone (ost_select_shared). */
typedef struct Borne {
    OstLocal count, *nodes;
    unsigned char *shared;
} Borne;

static OstStatus select_borne(const OstProblem *problem, const OstWatch *watch, Borne *borne)
{
    const OstMesh *mesh = problem->mesh;
    unsigned char *held = NULL;
    OST_TRY(ost_select_nodes(problem->scene->c, mesh, &watch->on, &borne->count, &borne->nodes));
    OST_TRY(ost_agree(mesh->ctx, OST_NEW(mesh->ctx, &held, mesh->node_count)));
    for (OstLocal n = 0; n < mesh->node_count; n++)
        held[n] = ost_supports_held(problem->supports, n);
    const OstStatus status =
        ost_select_shared(problem->scene->c, mesh, held, borne->count, borne->nodes, &borne->shared);
    OST_FREE(held);
    return status;
}

/* Seven numbers: their reaction, or its moment; the part that other supports may bear as well; and the sum of the
 * lengths of the nodes' forces, or moments. */
static OstStatus find_reaction(const OstProblem *problem, const OstWatch *watch, double t, const double *u,
                               const Borne *borne, double *forces, double sum[7])
{
    const size_t numbers = 3 * (size_t)problem->mesh->owned_nodes;
    const OstLocal *nodes = borne->nodes;
    double *force = NULL, *load = NULL;
    OstStatus status = OST_NEW(problem->ctx, &force, numbers);
    OST_THEN(OST_NEW(problem->ctx, &load, numbers));
    OST_THEN(ost_problem_force(problem, t, u, force));
    if (status == OST_SUCCESS)
        ost_problem_load(problem, t, u, load);
    memset(sum, 0, 7 * sizeof *sum);
    for (OstLocal n = 0; n < borne->count && status == OST_SUCCESS; n++) {
        double of_node[3], in_doubt[3], arm[3], moment[3], moment_in_doubt[3];
        if (nodes[n] >= problem->mesh->owned_nodes)
            continue;
        find_arm(problem, watch, u, nodes[n], arm);
        for (size_t i = 0; i < 3; i++)
            of_node[i] = force[3 * (size_t)nodes[n] + i] - load[3 * (size_t)nodes[n] + i];
        keep_reaction(problem->supports, u, nodes[n], of_node);
        for (int i = 0; i < 3; i++) {
            const double share = ost_select_share(borne->shared[nodes[n]], i);
            of_node[i] *= share;
            in_doubt[i] = share < 1.0 ? of_node[i] : 0.0;
        }
        ost_cross3(arm, of_node, moment);
        ost_cross3(arm, in_doubt, moment_in_doubt);
        if (forces)
            memcpy(forces + 3 * (size_t)nodes[n], of_node, sizeof of_node);
        for (int i = 0; i < 3; i++) {
            sum[i] += watch->of_moment ? moment[i] : of_node[i];
            sum[3 + i] += watch->of_moment ? moment_in_doubt[i] : in_doubt[i];
        }
        sum[6] += ost_norm3(watch->of_moment ? moment : of_node);
    }
    OST_FREE(force);
    OST_FREE(load);
    OST_TRY(ost_agree(problem->ctx, status));
    return ost_sum(problem->ctx, 7, sum);
}

static OstStatus of_reaction(const OstProblem *problem, const OstWatch *watch, double t, const double *u,
                             OstInterest *interest)
{
    Borne borne = {0};
    double sum[7] = {0.0}, direction[3];
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &interest->moved, 3 * (size_t)problem->mesh->node_count)));
    if (watch->of_moment && !ost_problem_is_linear(problem))
        OST_TRY(
            ost_agree(problem->ctx, OST_NEW(problem->ctx, &interest->load, 3 * (size_t)problem->mesh->owned_nodes)));
    OstStatus status = select_borne(problem, watch, &borne);
    OST_THEN(find_reaction(problem, watch, t, u, &borne, interest->load, sum));
    const OstLocal *nodes = borne.nodes;
    take_direction(watch, sum, direction);
    memcpy(interest->direction, direction, sizeof direction);
    interest->value = ost_dot3(direction, sum);
    interest->doubt = fabs(ost_dot3(direction, sum + 3));
    interest->size = sum[6];
    for (OstLocal n = 0; n < borne.count && status == OST_SUCCESS; n++) {
        double arm[3], *moved = interest->moved + 3 * (size_t)nodes[n];
        find_arm(problem, watch, u, nodes[n], arm);
        memcpy(moved, direction, sizeof direction);
        if (watch->of_moment)
            ost_cross3(direction, arm, moved);
        for (int i = 0; i < 3; i++)
            moved[i] *= ost_select_share(borne.shared[nodes[n]], i);
        if (interest->load && nodes[n] < problem->mesh->owned_nodes) { /* arms grow with the displacement */
            double force[3];
            memcpy(force, interest->load + 3 * (size_t)nodes[n], sizeof force);
            ost_cross3(direction, force, interest->load + 3 * (size_t)nodes[n]);
        }
    }
    OST_FREE(borne.nodes);
    OST_FREE(borne.shared);
    return status;
}

/* The strain whose product with a stress is the measure, along the tet's material axes. */
static void find_strain(const OstMaterialField *field, OstLocal tet, OstStressMeasure measure, double strain[6])
{
    double axes[9], turned[9], of_world[6] = {0.0};
    memset(strain, 0, 6 * sizeof *strain);
    if (measure >= OST_STRESS_MEASURE_11 && measure <= OST_STRESS_MEASURE_31) {
        strain[measure - OST_STRESS_MEASURE_11] = 1.0;
        return;
    }
    for (int i = 0; i < 3 && measure == OST_STRESS_MEASURE_PRESSURE; i++)
        of_world[i] = -1.0 / 3.0;
    if (measure < OST_STRESS_MEASURE_11)
        of_world[measure] = 1.0;
    ost_field_axes(field, tet, axes);
    for (int n = 0; n < 9; n++)
        turned[n] = axes[3 * (n % 3) + n / 3];
    ost_strain_to_world(of_world, turned, strain);
}

static OstStatus of_mean_stress(const OstProblem *problem, const OstWatch *watch, OstInterest *interest)
{
    const OstMesh *mesh = problem->mesh;
    const int every = ost_is_every_region(watch->region);
    double volume = 0.0;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &interest->strain, 6 * (size_t)mesh->tet_count)));
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        if (!every && strcmp(mesh->regions.name[mesh->tet_region[tet]], watch->region) != 0)
            continue;
        find_strain(problem->field, tet, (OstStressMeasure)watch->component, interest->strain + 6 * (size_t)tet);
        if (tet < mesh->owned_tets)
            volume += fabs(ost_tet_volume(mesh->coordinates, ost_mesh_nodes_of(mesh, tet)));
    }
    OST_TRY(ost_sum(problem->ctx, 1, &volume));
    for (size_t i = 0; i < 6 * (size_t)mesh->tet_count; i++)
        interest->strain[i] /= volume;
    return OST_SUCCESS;
}

OstStatus ost_interest_create(const OstProblem *problem, const OstWatch *watch, double t, const double *u,
                              OstInterest *interest)
{
    *interest = (OstInterest){0};
    if (watch->kind == OST_WATCH_STRESS)
        return of_mean_stress(problem, watch, interest);
    return watch->kind == OST_WATCH_REACTION ? of_reaction(problem, watch, t, u, interest)
                                             : of_displacement(problem, watch, u, interest);
}
