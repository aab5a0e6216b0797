/* SPDX-License-Identifier: BSD-3-Clause */
#include "problem/problem.h"

#include "algebra/matrix/fold.h"
#include "assembly/batch.h"
#include "assembly/links/levers.h"
#include "assembly/links/rigid_faces.h"
#include "assembly/springs.h"
#include "case/plan.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/free_memory.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "problem/boundary_conditions.h"
#include "problem/free_body.h"

#include <float.h>
#include <math.h>
#include <string.h>

void ost_problem_destroy(OstProblem **problem)
{
    if (!*problem)
        return;
    ost_problem_release_stiffness(*problem);
    ost_pressure_space_destroy(&(*problem)->pressures);
    ost_problem_release_timed(*problem);
    ost_supports_destroy(&(*problem)->supports);
    OST_FREE((*problem)->driven);
    ost_follower_destroy(&(*problem)->follower);
    OST_FREE((*problem)->lever);
    OST_FREE((*problem)->force);
    OST_FREE(*problem);
}

static OstStatus add_springs(const OstProblemParts *parts, OstSupports *supports)
{
    for (OstLocal i = 0; i < parts->spring_count; i++) {
        const OstNodeSpring *spring = &parts->springs[i];
        const double length = ost_norm3(spring->direction);
        OstSpringStiffness stiffness = {.along = spring->stiffness, .across = length > 0.0 ? 0.0 : spring->stiffness};
        if (spring->node < 0 || spring->node >= parts->mesh->owned_nodes || !(spring->stiffness >= 0.0))
            return OST_RAISE(
                parts->mesh->ctx, OST_INVALID_INPUT,
                "spring %d has stiffness %g on node %d; expected 0 or above, on one of this rank's nodes, 0 "
                "to %d",
                i, spring->stiffness, spring->node, parts->mesh->owned_nodes - 1);
        for (int k = 0; k < 3 && length > 0.0; k++)
            stiffness.direction[k] = spring->direction[k] / length;
        ost_supports_add_spring(supports, spring->node, &stiffness);
    }
    return OST_SUCCESS;
}

/* `displacement`: one for each constraint, in place of its own; or NULL. */
static OstStatus constrain_nodes(const OstProblemParts *parts, const double *displacement, OstSupports **supports)
{
    OstContext *ctx = parts->mesh->ctx;
    int springs = parts->spring_count > 0;
    if (parts->free_body)
        return ost_free_body_supports(parts->mesh, NULL, supports);
    OST_TRY(ost_max_ints(ctx, 1, &springs));
    OstStatus status = ost_supports_create(parts->mesh, supports);
    for (OstLocal i = 0; i < parts->constraint_count && status == OST_SUCCESS; i++) {
        const OstNodeConstraint *constraint = &parts->constraints[i];
        if (constraint->node < 0 || constraint->node >= parts->mesh->owned_nodes)
            status = OST_RAISE(ctx, OST_INVALID_INPUT, "constraint %d is on node %d, but this rank owns nodes 0 to %d",
                               i, constraint->node, parts->mesh->owned_nodes - 1);
        else
            status = ost_supports_constrain(*supports, constraint->node, constraint->direction,
                                            displacement ? displacement[i] : constraint->displacement);
    }
    if (status == OST_SUCCESS && springs)
        status = ost_supports_allow_springs(*supports);
    OST_THEN(add_springs(parts, *supports));
    OST_TRY(ost_agree(ctx, status));
    return ost_supports_complete(*supports);
}

/* nu = 1/2 leaves linear tets, and quadratic ones without pressures, no stiffness. */
static OstStatus check_incompressible(const OstMesh *mesh, const OstMaterialField *field)
{
    const int region = ost_field_incompressible(field);
    if (region < 0 || (ost_field_is_mixed(field) && mesh->nodes_per_tet == 10))
        return OST_SUCCESS;
    return OST_RAISE(mesh->ctx, OST_INVALID_INPUT,
                     "material '%s' is incompressible (nu = 1/2): it needs quadratic tets and the mixed form "
                     "(ost_field_mixed, or Problem(..., mixed=True) in Python)",
                     field->material[region].name);
}

/* Without supports and facts, with room for loads on `nodes` nodes. */
static OstStatus create(const OstMesh *mesh, const OstMaterialField *field, OstLocal nodes, OstProblem **problem)
{
    OstContext *ctx = mesh->ctx;
    const OstElement *element = ost_element_of(mesh->nodes_per_tet);
    if (!element)
        return OST_RAISE(ctx, OST_INVALID_INPUT, "the mesh has tets of %d nodes; 4 or 10 are expected",
                         mesh->nodes_per_tet);
    OST_TRY(check_incompressible(mesh, field));
    OstStatus status = OST_NEW(ctx, problem, 1);
    if (status == OST_SUCCESS) {
        **problem = (OstProblem){.ctx = ctx, .mesh = mesh, .field = field, .linear = element->linear};
        status = OST_NEW(ctx, &(*problem)->force, 3 * (size_t)nodes);
    }
    status = ost_agree(ctx, status);
    if (status == OST_SUCCESS && ost_field_is_mixed(field) && mesh->nodes_per_tet == 10)
        status = ost_pressure_space_create(mesh, field, &(*problem)->pressures);
    return status;
}

/* Displacements that follow a table: zero unless the caller gives them. */
static OstStatus make_timed(const OstProblemParts *parts, OstProblem *problem)
{
    OstContext *ctx = problem->ctx;
    for (int k = 0; k < parts->timed_count; k++) {
        const OstTimedParts *given = &parts->timed[k];
        double *zero = NULL;
        OST_TRY(ost_problem_add_timed(problem, &given->table));
        OstTimed *timed = &problem->timed[k];
        if (given->force)
            memcpy(timed->force, given->force, 3 * (size_t)parts->mesh->owned_nodes * sizeof(double));
        OST_TRY(ost_agree(ctx, OST_NEW(ctx, &zero, given->displacement ? 0 : parts->constraint_count)));
        const OstStatus status =
            constrain_nodes(parts, given->displacement ? given->displacement : zero, &timed->supports);
        OST_FREE(zero);
        OST_TRY(status);
    }
    return OST_SUCCESS;
}

/* Collective. What the solver's plan needs of the materials, of a modulus that differs from tet to tet its least and
 * its greatest. */
static OstStatus add_material_facts(const OstMaterialField *field, const OstMesh *mesh, OstSolverFacts *facts)
{
    OstContext *ctx = mesh->ctx;
    double *least = NULL, *most = NULL;
    OstModuli moduli = {0};
    const int regions = field->region_count;
    OstStatus status = OST_NEW(ctx, &least, regions);
    OST_THEN(OST_NEW(ctx, &most, regions));
    OST_TRY_DONE(ost_agree(ctx, status));
    for (int r = 0; r < regions; r++) {
        least[r] = field->tet_scale ? DBL_MAX : 1.0;
        most[r] = field->tet_scale ? DBL_MIN : 1.0;
    }
    for (OstLocal t = 0; t < mesh->owned_tets && field->tet_scale; t++) {
        const int r = mesh->tet_region[t];
        least[r] = fmin(least[r], ost_field_scale(field, t, NULL));
        most[r] = fmax(most[r], ost_field_scale(field, t, NULL));
    }
    if (field->tet_scale) {
        OST_TRY_DONE(ost_min(ctx, regions, least));
        OST_TRY_DONE(ost_max(ctx, regions, most));
    }
    for (int r = 0; r < regions; r++)
        for (int end = 0; end < 2; end++) {
            OstOrthotropic constants = field->material[r].constants;
            const double scale = least[r] > most[r] ? 1.0 : end == 0 ? least[r] : most[r];
            for (int k = 0; k < 3; k++) {
                constants.youngs_modulus[k] *= scale;
                constants.shear_modulus[k] *= scale;
            }
            ost_plan_add_facts(ctx, &constants, &moduli, facts);
        }
done:
    OST_FREE(least, most);
    return status;
}

OstStatus ost_problem_create(const OstProblemParts *parts, OstProblem **problem)
{
    OstProblem *made = NULL;
    OstStatus status = create(parts->mesh, parts->field, parts->mesh->owned_nodes, &made);
    if (status == OST_SUCCESS) {
        ost_problem_set_formulation(made, parts->formulation);
        made->free_body = parts->free_body;
        made->with_metric = parts->field->region_axes != NULL;
        if (parts->force)
            ost_problem_set_load(made, parts->force);
        made->eigen_function = parts->eigenstrain_follows;
        int pressed = parts->pressed_count > 0;
        status = add_material_facts(parts->field, parts->mesh, &made->facts);
        OST_THEN(ost_max_ints(made->ctx, 1, &pressed));
        if (status == OST_SUCCESS && pressed)
            status = ost_follower_add(parts->mesh, parts->pressed_count, parts->pressed_faces,
                                      parts->mesh->nodes_per_tet == 10 ? 6 : 3, parts->pressure, 0, &made->follower);
        if (made->eigen_function < 0 || made->eigen_function > parts->timed_count)
            status = OST_RAISE(made->ctx, OST_INVALID_INPUT,
                               "eigenstrain_follows is %d; expected 0, or the number of one of %d time tables, from 1",
                               made->eigen_function, parts->timed_count);
        status = ost_agree(made->ctx, status);
        OST_THEN(constrain_nodes(parts, NULL, &made->supports));
        OST_THEN(make_timed(parts, made));
        OST_THEN(ost_follower_conserves(made->follower, made->supports, &made->conservative));
    }
    if (status != OST_SUCCESS)
        ost_problem_destroy(&made);
    *problem = made;
    return status;
}

static OstStatus make_timed_of_scene(const OstScene *scene, OstProblem *problem)
{
    for (int k = 0; k < scene->c->table_count; k++) {
        OST_TRY(ost_problem_add_timed(problem, &scene->c->tables[k]));
        OST_TRY(ost_scene_supports(scene, 1 + k, &problem->timed[k].supports));
        OST_TRY(ost_scene_loads(scene, 1 + k, problem->timed[k].supports, problem->timed[k].force, &problem->follower));
    }
    return OST_SUCCESS;
}

OstStatus ost_scene_problem(const OstScene *scene, OstProblem **problem)
{
    OstContext *ctx = scene->ctx;
    OstProblem *made = NULL;
    OstStatus status = create(scene->mesh, scene->field, scene->mesh->node_count, &made);
    if (status != OST_SUCCESS)
        goto done;
    made->scene = scene;
    made->c = scene->c;
    made->effects = &scene->plan.effects;
    made->free_body = ost_effect_on(made->effects, OST_EFFECT_FREE_BODY);
    made->with_metric = ost_effect_on(made->effects, OST_EFFECT_ORTHOTROPY);
    made->facts = scene->plan.facts;
    if (ost_effect_on(made->effects, OST_EFFECT_LARGE_ROTATION))
        made->beyond_linear = scene->c->formulation;
    made->automatic = scene->c->large_rotation == OST_LARGE_ROTATION_AUTO;
    made->accuracy = scene->c->relative_error;
    if (ost_effect_on(made->effects, OST_EFFECT_BUCKLING))
        made->buckling_modes = scene->c->buckling_modes;
    made->eigen_function = scene->c->eigen_table;
    OST_TRY_DONE(ost_scene_supports(scene, 0, &made->supports));
    OST_TRY_DONE(ost_scene_loads(scene, 0, made->supports, made->force, &made->follower));
    OST_TRY_DONE(ost_agree(ctx, OST_RESIZE(ctx, &made->force, 3 * (size_t)scene->mesh->owned_nodes)));
    OST_TRY_DONE(make_timed_of_scene(scene, made));
    OST_TRY_DONE(ost_problem_find_levers(made));
    OST_TRY_DONE(ost_follower_conserves(made->follower, made->supports, &made->conservative));
done:
    if (status != OST_SUCCESS)
        ost_problem_destroy(&made);
    *problem = made;
    return status;
}

const char *ost_problem_name(const OstProblem *problem)
{
    return problem->c ? problem->c->path : "the problem";
}

const OstMesh *ost_problem_mesh(const OstProblem *problem)
{
    return problem->mesh;
}

const OstMaterialField *ost_problem_field(const OstProblem *problem)
{
    return problem->field;
}

OstGlobal ost_problem_unknowns(const OstProblem *problem)
{
    return problem->system ? 3 * problem->system->matrix->global_rows : 0;
}

int ost_problem_is_linear(const OstProblem *problem)
{
    return problem->linear;
}

/* Values of the matrix are of the formulation that was: they do not count. */
void ost_problem_take_formulation(OstProblem *problem, OstFormulation formulation)
{
    if (problem->formulation != formulation)
        problem->filled = 0;
    problem->formulation = formulation;
    problem->linear = formulation == OST_FORMULATION_LINEAR && ost_element_of(problem->mesh->nodes_per_tet)->linear;
}

void ost_problem_set_formulation(OstProblem *problem, OstFormulation formulation)
{
    ost_problem_take_formulation(problem, formulation);
    problem->beyond_linear = formulation;
    problem->automatic = 0;
}

OstFormulation ost_problem_formulation(const OstProblem *problem)
{
    return problem->formulation;
}

void ost_problem_set_load(OstProblem *problem, const double *force)
{
    memcpy(problem->force, force, 3 * (size_t)problem->mesh->owned_nodes * sizeof *force);
}

void ost_problem_load(const OstProblem *problem, double t, const double *u, double *force)
{
    const double *shape = ost_problem_is_linear(problem) ? NULL : u;
    memset(force, 0, 3 * (size_t)problem->mesh->owned_nodes * sizeof *force);
    for (int k = 0; k < ost_problem_functions(problem); k++)
        ost_problem_add_load(problem, k, ost_problem_factor(problem, k, t), shape, force);
    if (shape)
        ost_problem_add_levers(problem, t, force);
}

OstStatus ost_problem_load_work(const OstProblem *problem, double t, const double *u, double *work)
{
    *work = 0.0;
    for (int k = 0; k < ost_problem_functions(problem); k++)
        *work += ost_problem_work(problem, k, ost_problem_factor(problem, k, t), u);
    OST_TRY(ost_sum(problem->ctx, 1, work));
    *work += ost_problem_lever_work(problem, t);
    return OST_SUCCESS;
}

OstStatus ost_problem_energy(const OstProblem *problem, double t, const double *u, double *energy)
{
    const double grown = ost_problem_eigen_share(problem, t);
    *energy = problem->supports->spring ? ost_spring_energy(problem->supports, u) : 0.0;
    if (problem->formulation == OST_FORMULATION_LINEAR)
        ost_visit_means(problem->mesh, problem->field, grown, u, ost_visit_energy, energy);
    else
        *energy += ost_large_rotation_energy_of(problem->mesh, problem->field, problem->formulation, grown, u);
    return ost_sum(problem->ctx, 1, energy);
}

OstStatus ost_problem_force(const OstProblem *problem, double t, const double *u, double *force)
{
    const double grown = ost_problem_eigen_share(problem, t);
    OST_TRY(ost_internal_force_of(problem->mesh, problem->field, problem->formulation, grown, u, force, NULL));
    if (problem->supports->spring)
        ost_spring_force(problem->supports, -1.0, u, force);
    return OST_SUCCESS;
}

OstStatus ost_problem_out_of_balance(const OstProblem *problem, double t, const double *u, double **force)
{
    const size_t owned = 3 * (size_t)problem->mesh->owned_nodes;
    double *load = NULL;
    OstStatus status = OST_NEW(problem->ctx, force, owned);
    OST_THEN(OST_NEW(problem->ctx, &load, owned));
    OST_THEN(ost_problem_force(problem, t, u, *force));
    if (status == OST_SUCCESS) {
        ost_problem_load(problem, t, u, load);
        for (size_t i = 0; i < owned; i++)
            (*force)[i] -= load[i];
    }
    OST_FREE(load);
    return ost_agree(problem->ctx, status);
}

OstStatus ost_problem_force_and_stress(const OstProblem *problem, double t, const double *u, double *force,
                                       double *stress)
{
    const double grown = ost_problem_eigen_share(problem, t);
    OST_TRY(ost_internal_force_and_stress(problem->mesh, problem->field, grown, u, force, stress));
    if (problem->supports->spring)
        ost_spring_force(problem->supports, -1.0, u, force);
    return OST_SUCCESS;
}

/* A failure names the line of the first constraint. */
static OstStatus make_pattern(OstProblem *problem)
{
    const OstCase *c = problem->c;
    const OstStatus status = ost_system_create(problem->mesh, problem->supports, &problem->system);
    if (status != OST_INVALID_INPUT || !c || c->constraint_count == 0)
        return status;
    return ost_case_located(c, c->constraints[0].on.place, status);
}

static OstStatus factors_at(const OstProblem *problem, double t, double **factor)
{
    OST_TRY(OST_NEW(problem->ctx, factor, ost_problem_functions(problem)));
    for (int k = 0; k < ost_problem_functions(problem); k++)
        (*factor)[k] = ost_problem_factor(problem, k, t);
    return OST_SUCCESS;
}

OstStatus ost_problem_add_skew(const OstProblem *problem, double t, const double *u, const double *v, double *product)
{
    double *factor = NULL;
    OST_TRY(factors_at(problem, t, &factor));
    ost_follower_add_skew(problem->follower, factor, u, v, product);
    OST_FREE(factor);
    return OST_SUCCESS;
}

/* Where the last step would have ended had nodes that turn with rigid faces and levers gone straight on. */
static OstStatus find_straight(const OstProblem *problem, const double *from, const double *u, double **to)
{
    const size_t count = 3 * (size_t)problem->mesh->node_count;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, to, count)));
    for (size_t i = 0; i < count; i++)
        (*to)[i] = u[i] - from[i];
    OST_TRY(ost_rigid_faces_change(problem->supports->links, from, u, 0, 1.0, *to));
    OST_TRY(ost_levers_change(problem->supports->links, from, *to));
    for (size_t i = 0; i < count; i++)
        (*to)[i] += from[i];
    return OST_SUCCESS;
}

/* The load stiffness of a follower pressure may be indefinite: it has no place in a definite stiffness. */
static OstStatus fill(const OstProblem *problem, double t, const double *u, const double *from, int definite)
{
    OstTangent tangent = {.formulation = problem->formulation,
                          .t = ost_problem_eigen_share(problem, t),
                          .u = u,
                          .from = from,
                          .to = u,
                          .definite = definite};
    const OstLinks *links = problem->supports->links;
    double *factor = NULL, *straight = NULL;
    OstTurning turning = {0};
    if (problem->formulation == OST_FORMULATION_LINEAR || !u) /* where all formulations agree */
        return ost_system_fill_tangent(problem->system, problem->field, NULL);
    OstStatus status = OST_SUCCESS;
    if (from && links && (links->face_count > 0 || links->gaps)) {
        status = find_straight(problem, from, u, &straight);
        tangent.to = straight;
    }
    OST_THEN(ost_problem_find_turning(problem, t, &tangent, &turning));
    tangent.turning = &turning;
    if (problem->follower && !definite) {
        OST_THEN(factors_at(problem, t, &factor));
        tangent.follower = problem->follower;
        tangent.factor = factor;
    }
    OST_THEN(ost_system_fill_tangent(problem->system, problem->field, &tangent));
    OST_FREE(straight, factor, turning.faces, turning.levers);
    return status;
}

/* The matrix stays where it is, so that a solver on it can be kept. */
static OstStatus make_stiffness(OstProblem *problem, double t, const double *u, const double *from, int definite,
                                OstStiffness *stiffness)
{
    if (!problem->system)
        OST_TRY(make_pattern(problem));
    OST_TRY(ost_problem_turn(problem, problem->formulation == OST_FORMULATION_LINEAR ? NULL : u));
    OstBlockMatrix *matrix = problem->system->matrix;
    const int fills = problem->system->block_of_tet || !(problem->filled && ost_problem_is_linear(problem));
    if (fills || stiffness)
        OST_TRY(ost_problem_unfold_stiffness(problem));
    if (fills && !problem->system->block_of_tet)
        OST_TRY(ost_agree(problem->ctx, ost_system_restore_scatter(problem->system)));
    if (fills)
        OST_TRY(ost_agree(problem->ctx, fill(problem, t, u, from, definite)));
    problem->filled = 1;
    if (problem->pressures && !problem->coupling)
        OST_TRY(ost_pressure_coupling(problem->pressures, problem->system, problem->field, &problem->coupling));
    else if (problem->pressures && fills)
        OST_TRY(ost_pressure_coupling_at(problem->pressures, problem->system, problem->field,
                                         problem->formulation == OST_FORMULATION_LINEAR ? NULL : u, problem->coupling));
    problem->lent |= stiffness != NULL;
    if (stiffness)
        *stiffness = (OstStiffness){.rows = matrix->rows,
                                    .columns = matrix->columns,
                                    .global_rows = matrix->global_rows,
                                    .row_start = matrix->row_start,
                                    .column = matrix->column,
                                    .value = matrix->value,
                                    .node = problem->system->node_of_row};
    return OST_SUCCESS;
}

OstStatus ost_problem_stiffness(OstProblem *problem, double t, const double *u, OstStiffness *stiffness)
{
    return make_stiffness(problem, t, u, NULL, 0, stiffness);
}

OstStatus ost_problem_definite_stiffness(OstProblem *problem, double t, const double *u, OstStiffness *stiffness)
{
    return make_stiffness(problem, t, u, NULL, 1, stiffness);
}

OstStatus ost_problem_stiffness_from(OstProblem *problem, double t, const double *u, const double *from, int definite)
{
    return make_stiffness(problem, t, u, from, definite, NULL);
}

OstStatus ost_problem_worst_tet(const OstProblem *problem, const double *u, OstWorstTet *worst)
{
    OstContext *ctx = problem->ctx;
    const OstMesh *mesh = problem->mesh;
    OstLeastStretch least;
    ost_least_stretch(mesh, problem->field, u, &least);
    *worst = (OstWorstTet){.stretch = least.stretch, .inverted = least.inverted};
    OST_TRY(ost_min(ctx, 1, &worst->stretch));
    OST_TRY(ost_sum_numbers(ctx, 1, &worst->inverted));
    /* Of several with that stretch, the one of the lowest label. */
    worst->tet = least.tet >= 0 && least.stretch == worst->stretch ? mesh->tet_label[least.tet] : INT64_MAX;
    OST_TRY(ost_min_numbers(ctx, 1, &worst->tet));
    double found[4] = {0.0}; /* place and region: of the rank that has it, 0 of the others */
    if (least.tet >= 0 && least.stretch == worst->stretch && mesh->tet_label[least.tet] == worst->tet) {
        const OstLocal *nodes = ost_mesh_nodes_of(mesh, least.tet);
        found[3] = mesh->tet_region[least.tet];
        for (int a = 0; a < 4; a++)
            for (int i = 0; i < 3; i++)
                found[i] += 0.25 * mesh->coordinates[3 * (size_t)nodes[a] + (size_t)i];
    }
    OST_TRY(ost_sum(ctx, 4, found));
    memcpy(worst->place, found, sizeof worst->place);
    worst->region = (int)found[3];
    return OST_SUCCESS;
}

void ost_problem_release_scatter(OstProblem *problem)
{
    if (problem->system)
        ost_system_release_scatter(problem->system);
}

OstStatus ost_problem_fold_stiffness(OstProblem *problem)
{
    if (problem->lent || !problem->linear)
        return OST_SUCCESS;
    return ost_agree(problem->ctx, ost_block_matrix_fold(problem->system->matrix));
}

OstStatus ost_problem_unfold_stiffness(OstProblem *problem)
{
    OstBlockMatrix *matrix = problem->system->matrix;
    OstStatus status = OST_SUCCESS;
    if (matrix->upper) {
        ost_ledger_enter(problem->ctx, OST_LEDGER_PATTERN);
        status = ost_block_matrix_unfold(matrix);
        ost_ledger_leave(problem->ctx);
    }
    return ost_agree(problem->ctx, status);
}

void ost_problem_release_stiffness(OstProblem *problem)
{
    ost_coupling_destroy(&problem->coupling);
    ost_system_destroy(&problem->system);
    problem->filled = problem->lent = 0;
}

OstStatus ost_problem_right_hand_side(const OstProblem *problem, double t, double *rhs)
{
    const size_t unknowns = 3 * (size_t)problem->system->matrix->rows;
    double *timed = NULL;
    OST_TRY(ost_problem_function_right_hand_side(problem, 0, rhs));
    for (size_t i = 0; i < unknowns; i++)
        rhs[i] *= t;
    if (problem->timed_count > 0)
        OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &timed, unknowns)));
    OstStatus status = OST_SUCCESS;
    for (int k = 1; k <= problem->timed_count && status == OST_SUCCESS; k++) {
        status = ost_problem_function_right_hand_side(problem, k, timed);
        for (size_t i = 0; i < unknowns; i++)
            rhs[i] += ost_problem_factor(problem, k, t) * timed[i];
    }
    OST_FREE(timed);
    return status;
}

OstStatus ost_problem_displacement(const OstProblem *problem, double t, const double *v, double *u)
{
    OST_TRY(ost_system_displacement(problem->system, t, v, u));
    for (int k = 0; k < problem->timed_count; k++)
        ost_supports_add(problem->timed[k].supports, ost_time_factor(&problem->timed[k].table, t), u);
    return OST_SUCCESS;
}

OstStatus ost_problem_facts(const OstProblem *problem, OstSolverFacts *facts)
{
    OstContext *ctx = problem->ctx;
    const OstMesh *mesh = problem->mesh;
    double worst = 1.0;
    *facts = problem->facts;
    if (problem->pressures) /* what the pressures leave of the stiffness */
        facts->poisson = fmin(facts->poisson, OST_NEARLY_INCOMPRESSIBLE);
    facts->unknowns = 3 * problem->system->matrix->global_rows;
    for (OstLocal t = 0; t < mesh->owned_tets; t++)
        worst =
            fmin(worst, ost_tet_quality(mesh->coordinates, mesh->tet_nodes + (size_t)mesh->nodes_per_tet * (size_t)t));
    facts->quality = worst;
    OST_TRY(ost_min(ctx, 1, &facts->quality));
    return ost_memory_free(ctx, &facts->free_memory);
}
