/* SPDX-License-Identifier: BSD-3-Clause */
#include "assembly/links/levers.h"
#include "assembly/links/rigid_faces.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "problem/boundary_conditions.h"
#include "problem/problem.h"

#include <string.h>

static int face_count(const OstProblem *problem)
{
    return problem->supports->links ? problem->supports->links->face_count : 0;
}

/* --- forces at a point of a rigid face --- */

/* The face that all nodes with a force belong to, or -1. */
static OstStatus find_face(const OstLinks *links, const double *force, int *face)
{
    int most[2] = {-1, -links->face_count}; /* the highest number, and the lowest, negative */
    for (OstLocal n = 0; n < links->mesh->owned_nodes; n++) {
        const OstLink *link = ost_link_of(links, n);
        const int number = link ? link->face : -1;
        if (ost_norm3(force + 3 * (size_t)n) == 0.0)
            continue;
        most[0] = number > most[0] ? number : most[0];
        most[1] = -number > most[1] ? -number : most[1];
    }
    OST_TRY(ost_max_ints(links->ctx, 2, most));
    *face = most[0] == -most[1] ? most[0] : -1;
    return OST_SUCCESS;
}

static OstStatus add_lever(const OstLinks *links, const OstLoad *load, const double *force, double *levers)
{
    int f = -1;
    double sum[9] = {0.0};
    OST_TRY(find_face(links, force, &f));
    if (f < 0)
        return OST_SUCCESS;
    const double *point = links->face[f].point;
    for (OstLocal n = 0; n < links->mesh->owned_nodes; n++)
        for (size_t k = 0; k < 9; k++)
            sum[k] -= force[3 * (size_t)n + k / 3] * (links->mesh->coordinates[3 * (size_t)n + k % 3] - point[k % 3]);
    OST_TRY(ost_sum(links->ctx, 9, sum));
    for (int k = 0; k < 9; k++)
        levers[9 * f + k] += sum[k] + load->vector[k / 3] * (load->at[k % 3] - point[k % 3]);
    return OST_SUCCESS;
}

OstStatus ost_problem_find_levers(OstProblem *problem)
{
    const OstScene *scene = problem->scene;
    const OstLinks *links = problem->supports->links;
    const size_t faces = (size_t)face_count(problem), nodes = 3 * (size_t)problem->mesh->node_count;
    double *force = NULL;
    int any = 0;
    for (int i = 0; i < scene->c->load_count; i++)
        any |= scene->c->loads[i].acts_at;
    if (!any || faces == 0)
        return OST_SUCCESS;
    OstStatus status = OST_NEW(problem->ctx, &problem->lever, 9 * faces * (size_t)ost_problem_functions(problem));
    OST_THEN(OST_NEW(problem->ctx, &force, nodes));
    status = ost_agree(problem->ctx, status);
    for (int i = 0; i < scene->c->load_count && status == OST_SUCCESS; i++) {
        const OstLoad *load = &scene->c->loads[i];
        if (!load->acts_at || !ost_effect_on(problem->effects, scene->load_effect[i]))
            continue;
        memset(force, 0, nodes * sizeof *force);
        status = ost_scene_load(scene, i, force);
        OST_THEN(add_lever(links, load, force, problem->lever + 9 * faces * (size_t)load->table));
    }
    OST_FREE(force);
    return status;
}

/* N of a face at t. */
static void lever_at(const OstProblem *problem, int face, double t, double lever[9])
{
    memset(lever, 0, 9 * sizeof *lever);
    for (int k = 0; k < ost_problem_functions(problem); k++)
        for (int n = 0; n < 9; n++)
            lever[n] += ost_problem_factor(problem, k, t) * problem->lever[9 * (k * face_count(problem) + face) + n];
}

/* The columns of N act at the ends of those of R. */
static void find_arms(const OstRigidMotion *motion, const double lever[9], double arm[3][3], double force[3][3])
{
    double slope[9];
    ost_rigid_motion_slope(motion, slope);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 3; i++) {
            arm[k][i] = slope[3 * i + k] + (i == k ? 1.0 : 0.0);
            force[k][i] = lever[3 * i + k];
        }
}

void ost_problem_add_levers(const OstProblem *problem, double t, double *force)
{
    const OstLinks *links = problem->supports->links;
    for (int f = 0; problem->lever && f < links->face_count; f++) {
        double lever[9], arm[3][3], at_arm[3][3], moment[3] = {0.0}, part[3];
        lever_at(problem, f, t, lever);
        find_arms(&links->face[f].now, lever, arm, at_arm);
        for (int k = 0; k < 3; k++) {
            ost_cross3(arm[k], at_arm[k], part);
            for (int i = 0; i < 3; i++)
                moment[i] += part[i];
        }
        ost_rigid_face_add_moment(links, f, moment, force);
    }
}

double ost_problem_lever_work(const OstProblem *problem, double t)
{
    const OstLinks *links = problem->supports->links;
    double work = 0.0;
    for (int f = 0; problem->lever && f < links->face_count; f++) {
        double lever[9], slope[9];
        lever_at(problem, f, t, lever);
        ost_rigid_motion_slope(&links->face[f].now, slope);
        for (int k = 0; k < 9; k++)
            work += slope[k] * lever[k];
    }
    return work;
}

/* --- their rotations --- */

OstStatus ost_problem_turn(const OstProblem *problem, const double *u)
{
    OST_TRY(ost_rigid_faces_turn(problem->supports->links, u));
    return ost_levers_turn(problem->supports->links, u);
}

int ost_problem_has_turning(const OstProblem *problem)
{
    int any = 0;
    for (int f = 0; f < face_count(problem); f++)
        any |= problem->supports->links->face[f].carrier[1] >= 0;
    return any;
}

static void add_force(const double arm[3], const double force[3], double factor, double turning[9], double moment[3])
{
    double part[3];
    ost_add_turning(arm, force, factor, turning);
    ost_cross3(arm, force, part);
    for (int i = 0; i < 3; i++)
        moment[i] += factor * part[i];
}

/* Of the nodes of rigid faces: 9 numbers for each face, and then 3, the moment. */
static OstStatus sum_nodes(const OstLinks *links, const double *force, double *turning)
{
    double *moment = turning + 9 * links->face_count;
    for (OstLocal i = 0; i < links->count; i++) {
        const OstLink *link = &links->link[i];
        double arm[3];
        if (link->face < 0)
            continue;
        ost_rigid_face_arm(links, link, arm);
        add_force(arm, force + 3 * (size_t)link->node, 1.0, turning + 9 * link->face, moment + 3 * link->face);
    }
    return ost_sum(links->ctx, 12 * links->face_count, turning);
}

/* Of a component that is given nothing is left; of what softens, if it is to be definite. */
static OstStatus restrict_to_free(OstContext *ctx, const OstRigidFace *face, int definite, double turning[9])
{
    for (int k = 0; k < 9; k++)
        if (face->constrained[3 + k / 3] || face->constrained[3 + k % 3])
            turning[k] = 0.0;
    return definite ? ost_symmetric_positive_part(ctx, 3, turning) : OST_SUCCESS;
}

static OstStatus turn_faces(const OstProblem *problem, double t, const double *force, int definite, double *turning)
{
    const OstLinks *links = problem->supports->links;
    double *moment = turning + 9 * links->face_count;
    OstStatus status = sum_nodes(links, force, turning);
    for (int f = 0; f < links->face_count && status == OST_SUCCESS; f++) {
        double lever[9], arm[3][3], at_arm[3][3];
        if (problem->lever) {
            lever_at(problem, f, t, lever);
            find_arms(&links->face[f].now, lever, arm, at_arm);
            for (int k = 0; k < 3; k++)
                add_force(arm[k], at_arm[k], -1.0, turning + 9 * f, moment + 3 * f);
        }
        if (links->face[f].by_vector)
            ost_rigid_face_turn_vector(&links->face[f], moment + 3 * f, turning + 9 * f);
        status = restrict_to_free(problem->ctx, &links->face[f], definite, turning + 9 * f);
    }
    return ost_agree(problem->ctx, status);
}

/* The forces that turn, with the stress of the tangent. */
static OstStatus find_forces(const OstProblem *problem, double t, const OstTangent *tangent, double **force)
{
    const size_t owned = 3 * (size_t)problem->mesh->owned_nodes;
    double *internal = NULL;
    OST_TRY(ost_problem_out_of_balance(problem, t, tangent->u, force));
    ost_problem_add_levers(problem, t, *force); /* forces at levers are not those that they are spread as */
    if (!tangent->from)
        return OST_SUCCESS;
    OstStatus status = OST_NEW(problem->ctx, &internal, 2 * owned);
    OST_THEN(ost_internal_force_along(problem->mesh, problem->field, tangent->t, tangent->u, tangent->from, tangent->to,
                                      internal));
    OST_THEN(ost_internal_force_of(problem->mesh, problem->field, problem->formulation, tangent->t, tangent->u,
                                   internal + owned, NULL));
    for (size_t i = 0; i < owned && status == OST_SUCCESS; i++)
        (*force)[i] += internal[i] - internal[owned + i];
    OST_FREE(internal);
    return ost_agree(problem->ctx, status);
}

OstStatus ost_problem_find_turning(const OstProblem *problem, double t, const OstTangent *tangent, OstTurning *turning)
{
    const OstLinks *links = problem->supports->links;
    const int turns = ost_problem_has_turning(problem);
    double *force = NULL;
    *turning = (OstTurning){0};
    if (!turns && !(links && links->gaps))
        return OST_SUCCESS;
    OstStatus status = OST_NEW(problem->ctx, &turning->faces, turns ? 12 * (size_t)links->face_count : 0);
    OST_THEN(OST_NEW(problem->ctx, &turning->levers, 36 * (size_t)links->lever_count));
    status = ost_agree(problem->ctx, status);
    OST_THEN(find_forces(problem, t, tangent, &force));
    if (turns)
        OST_THEN(turn_faces(problem, t, force, tangent->definite, turning->faces));
    OST_THEN(ost_levers_bend(links, tangent->u, force, tangent->definite, turning->levers));
    OST_FREE(force);
    if (!turns)
        OST_FREE(turning->faces);
    return status;
}

/* --- what is prescribed --- */

/* The motions that are given at t, of several functions together. */
static void give_motions(const OstProblem *problem, double t, OstRigidMotion *motion)
{
    for (int f = 0; f < face_count(problem); f++) {
        const OstRigidFace *face = &problem->supports->links->face[f];
        double given[6] = {0.0};
        for (int k = 0; k < ost_problem_functions(problem); k++) {
            const OstSupports *supports = k == 0 ? problem->supports : problem->timed[k - 1].supports;
            for (int i = 0; i < 6; i++)
                given[i] += ost_problem_factor(problem, k, t) * supports->links->face[f].given[i];
        }
        for (int i = 0; i < 3; i++)
            motion[f].shift[i] = face->constrained[i] ? given[i] : motion[f].shift[i];
        if (face->carrier[1] >= 0 && !face->by_vector)
            continue;
        double vector[3];
        ost_rigid_motion_vector(&motion[f], vector);
        for (int i = 0; i < 3; i++)
            vector[i] = face->constrained[3 + i] ? given[3 + i] : vector[i];
        ost_rigid_motion_set_vector(vector, &motion[f]);
    }
}

OstStatus ost_problem_prescribe(const OstProblem *problem, double t, double *v, double *u)
{
    const OstSystem *system = problem->system;
    OstRigidMotion *motion = NULL;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &motion, face_count(problem))));
    OstStatus status = ost_rigid_faces_find(problem->supports->links, u, motion);
    for (OstLocal row = 0; row < system->matrix->rows; row++)
        memcpy(v + 3 * (size_t)row, u + 3 * (size_t)system->node_of_row[row], 3 * sizeof *v);
    OST_THEN(ost_problem_displacement(problem, t, v, u));
    if (status == OST_SUCCESS && face_count(problem) > 0) {
        give_motions(problem, t, motion);
        ost_rigid_faces_put(problem->supports->links, motion, u);
    }
    OST_THEN(ost_levers_put(problem->supports->links, u));
    OST_FREE(motion);
    return status;
}
