/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/estimate.h"

#include "assembly/springs.h"
#include "case/select.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "fields/stress_measure.h"
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

/* The nodes of a reaction, and its shares of what acts there. */
typedef struct Borne {
    OstLocal count, *nodes;
    OstBearing *shares;
} Borne;

static OstStatus select_borne(const OstProblem *problem, const OstWatch *watch, Borne *borne)
{
    const OstCase *c = problem->scene->c;
    OST_TRY(ost_select_nodes(c, problem->mesh, &watch->on, &borne->count, &borne->nodes));
    return ost_select_shares(c, problem->mesh, watch, borne->count, borne->nodes, &borne->shares);
}

/* The forces on owned nodes, 3 × owned_nodes each. */
typedef struct Forces {
    double *force, *load;   /* what is out of balance; room, then that of springs */
    double *borne, *passed; /* as ost_supports_split has it */
} Forces;

static OstStatus find_forces(const OstProblem *problem, double t, const double *u, Forces *of)
{
    const size_t numbers = 3 * (size_t)problem->mesh->owned_nodes;
    OstStatus status = OST_NEW(problem->ctx, &of->force, numbers);
    OST_THEN(OST_NEW(problem->ctx, &of->load, numbers));
    OST_THEN(OST_NEW(problem->ctx, &of->borne, numbers));
    OST_THEN(OST_NEW(problem->ctx, &of->passed, numbers));
    OST_TRY(ost_agree(problem->ctx, status));
    OST_TRY(ost_problem_force(problem, t, u, of->force));
    ost_problem_load(problem, t, u, of->load);
    for (size_t i = 0; i < numbers; i++)
        of->force[i] -= of->load[i];
    memset(of->load, 0, numbers * sizeof *of->load);
    if (problem->supports->spring)
        ost_spring_force(problem->supports, 1.0, u, of->load);
    return ost_supports_split(problem->supports, of->force, of->borne, of->passed, NULL);
}

/* Seven numbers: their reaction, or its moment; the part that other supports may bear as well; and the sum of the
 * lengths of the nodes' forces, or moments. */
static OstStatus find_reaction(const OstProblem *problem, const OstWatch *watch, double t, const double *u,
                               const Borne *borne, double *forces, double sum[7])
{
    const OstLocal *nodes = borne->nodes;
    Forces of = {NULL, NULL, NULL, NULL};
    const OstStatus status = find_forces(problem, t, u, &of);
    memset(sum, 0, 7 * sizeof *sum);
    for (OstLocal k = 0; k < borne->count && status == OST_SUCCESS; k++) {
        const OstBearing *share = &borne->shares[k];
        double own[3], of_node[3], in_doubt[3], arm[3], moment[3], moment_in_doubt[3];
        if (nodes[k] >= problem->mesh->owned_nodes)
            continue;
        find_arm(problem, watch, u, nodes[k], arm);
        const size_t first = 3 * (size_t)nodes[k];
        for (size_t i = 0; i < 3; i++)
            own[i] = of.borne[first + i] + of.load[first + i];
        ost_apply3(share->own, own, of_node);
        ost_apply3(share->in_doubt, own, in_doubt);
        for (size_t i = 0; i < 3 && share->is_passed; i++)
            of_node[i] += of.passed[first + i];
        ost_cross3(arm, of_node, moment);
        ost_cross3(arm, in_doubt, moment_in_doubt);
        if (forces)
            memcpy(forces + 3 * (size_t)nodes[k], of_node, sizeof of_node);
        for (int i = 0; i < 3; i++) {
            sum[i] += watch->of_moment ? moment[i] : of_node[i];
            sum[3 + i] += watch->of_moment ? moment_in_doubt[i] : in_doubt[i];
        }
        sum[6] += ost_norm3(watch->of_moment ? moment : of_node);
    }
    OST_FREE(of.force, of.load, of.borne, of.passed);
    OST_TRY(status);
    return ost_sum(problem->ctx, 7, sum);
}

/* A leader's support takes what its followers pass on: these move by it as they would without it. What links pass on
 * counts where the selection has it: with the part that no support takes, the leader moves alone. `motion`: of the
 * selected nodes alone. */
static OstStatus move_linked(const OstProblem *problem, const Borne *borne, double *motion)
{
    const OstSupports *supports = problem->supports;
    const OstLinks *links = supports->links;
    const OstLocal owned = problem->mesh->owned_nodes;
    double *held = NULL, *followed = NULL;
    OstStatus status = OST_NEW(problem->ctx, &held, 3 * (size_t)links->slots);
    OST_THEN(OST_NEW(problem->ctx, &followed, 3 * (size_t)owned));
    OST_TRY_DONE(ost_agree(problem->ctx, status));
    for (OstLocal k = 0; k < borne->count; k++) {
        const OstLocal node = borne->nodes[k];
        const double is_passed = borne->shares[k].is_passed ? 1.0 : 0.0;
        double *m = motion + 3 * (size_t)node, projector[9], given[3], shared[3], free_part[3], free_share[3];
        if (node >= owned || !(links->leads[node] || links->of_node[node] >= 0))
            continue;
        memcpy(given, m, sizeof given);
        ost_supports_get(supports, node, projector, NULL);
        ost_apply3(projector, given, free_part);
        for (int i = 0; i < 3; i++)
            m[i] = is_passed * given[i];
        if (links->of_node[node] >= 0)
            continue;
        ost_apply3_transposed(borne->shares[k].own, given, shared);
        ost_apply3(projector, shared, free_share);
        for (int i = 0; i < 3; i++) {
            held[3 * (size_t)node + (size_t)i] = shared[i] - m[i];
            m[i] = shared[i] - free_share[i] + is_passed * free_part[i];
        }
    }
    OST_TRY_DONE(ost_links_follow_held(links, held, followed));
    for (size_t i = 0; i < 3 * (size_t)owned; i++)
        motion[i] += followed[i];
done:
    OST_FREE(held, followed);
    return status;
}

/* What a node does that moves by one along the reaction's direction, or turns so about its axis. */
static void move_along(const OstProblem *problem, const OstWatch *watch, const double *u, const double direction[3],
                       OstLocal node, double motion[3])
{
    double arm[3];
    find_arm(problem, watch, u, node, arm);
    memcpy(motion, direction, 3 * sizeof *motion);
    if (watch->of_moment)
        ost_cross3(direction, arm, motion);
}

/* The motion that the reaction is the work on, of what is out of balance: not where who takes it is in doubt. */
static OstStatus find_motion(const OstProblem *problem, const OstWatch *watch, const double *u, const Borne *borne,
                             OstInterest *interest)
{
    const OstLinks *links = problem->supports->links;
    int is_unknown = 0;
    for (OstLocal k = 0; k < borne->count; k++) {
        const OstLocal node = borne->nodes[k];
        double *moved = interest->moved + 3 * (size_t)node;
        if (node >= problem->mesh->owned_nodes)
            continue;
        is_unknown |= borne->shares[k].unknown != OST_BEARING_KNOWN;
        move_along(problem, watch, u, interest->direction, node, moved);
        const double given[3] = {moved[0], moved[1], moved[2]};
        if (!links || (!links->leads[node] && links->of_node[node] < 0))
            ost_apply3_transposed(borne->shares[k].own, given, moved);
    }
    if (links)
        OST_TRY(move_linked(problem, borne, interest->moved));
    OST_TRY(ost_agree(problem->ctx, ost_halo_import(problem->mesh->halo, 3 * sizeof(double), interest->moved)));
    OST_TRY(ost_max_ints(problem->ctx, 1, &is_unknown));
    interest->doubt = is_unknown ? NAN : interest->doubt;
    return OST_SUCCESS;
}

/* The body's work on the motion has a spring's force where that is the share. Where nodes follow others it need not be:
 * the difference is a function of the displacement. */
static void add_springs(const OstProblem *problem, const OstWatch *watch, const double *u, const Borne *borne,
                        OstInterest *interest)
{
    for (OstLocal k = 0; k < borne->count; k++) {
        double given[3], shared[3], force[3];
        const OstLocal node = borne->nodes[k];
        if (node >= problem->mesh->owned_nodes)
            continue;
        move_along(problem, watch, u, interest->direction, node, given);
        ost_apply3_transposed(borne->shares[k].own, given, shared);
        ost_apply3(problem->supports->spring + 9 * (size_t)node, shared, force);
        for (size_t i = 0; i < 3; i++)
            interest->load[3 * (size_t)node + i] += force[i];
    }
    ost_spring_force(problem->supports, 1.0, interest->moved, interest->load);
}

static OstStatus of_reaction(const OstProblem *problem, const OstWatch *watch, double t, const double *u,
                             OstInterest *interest)
{
    Borne borne = {0};
    double sum[7] = {0.0}, direction[3];
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &interest->moved, 3 * (size_t)problem->mesh->node_count)));
    const int turns = watch->of_moment && !ost_problem_is_linear(problem);
    const int differs = problem->supports->links && problem->supports->spring;
    if (turns || differs)
        OST_TRY(
            ost_agree(problem->ctx, OST_NEW(problem->ctx, &interest->load, 3 * (size_t)problem->mesh->owned_nodes)));
    OstStatus status = select_borne(problem, watch, &borne);
    OST_THEN(find_reaction(problem, watch, t, u, &borne, turns ? interest->load : NULL, sum));
    const OstLocal *nodes = borne.nodes;
    take_direction(watch, sum, direction);
    memcpy(interest->direction, direction, sizeof direction);
    interest->value = ost_dot3(direction, sum);
    interest->doubt = fabs(ost_dot3(direction, sum + 3));
    interest->size = sum[6];
    OST_THEN(find_motion(problem, watch, u, &borne, interest));
    for (OstLocal n = 0; n < borne.count && turns && status == OST_SUCCESS; n++) {
        double force[3], *turned = interest->load + 3 * (size_t)nodes[n];
        if (nodes[n] >= problem->mesh->owned_nodes)
            continue;
        memcpy(force, turned, sizeof force); /* arms grow with the displacement */
        ost_cross3(direction, force, turned);
    }
    if (differs && status == OST_SUCCESS)
        add_springs(problem, watch, u, &borne, interest);
    OST_FREE(borne.nodes, borne.shares);
    return status;
}

/* The strain whose product with a stress is the measure, in world axes or along material ones. */
static void find_strain(OstStressMeasure measure, double strain[6])
{
    memset(strain, 0, 6 * sizeof *strain);
    for (int i = 0; i < 3 && measure == OST_STRESS_MEASURE_PRESSURE; i++)
        strain[i] = -1.0 / 3.0;
    if (measure <= OST_STRESS_MEASURE_31)
        strain[measure % 6] = 1.0;
}

static OstStatus of_mean_stress(const OstProblem *problem, const OstWatch *watch, OstInterest *interest)
{
    const OstMesh *mesh = problem->mesh;
    const int every = ost_is_every_region(watch->region);
    double volume = 0.0;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &interest->strain, 6 * (size_t)mesh->tet_count)));
    interest->strain_in_world = watch->component < (int)OST_STRESS_MEASURE_11;
    for (OstLocal tet = 0; tet < mesh->tet_count; tet++) {
        if (!every && strcmp(mesh->regions.name[mesh->tet_region[tet]], watch->region) != 0)
            continue;
        find_strain((OstStressMeasure)watch->component, interest->strain + 6 * (size_t)tet);
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
