/* SPDX-License-Identifier: BSD-3-Clause */
#include "case/plan.h"

#include "algebra/solver_plan.h"
#include "algebra/solver_seconds.h"
#include "core/error.h"
#include "fields/output_field.h"
#include "fields/stress_measure.h"
#include "mesh/mesh_data.h"
#include "orthostat/field.h"

#include <math.h>
#include <string.h>

static void count_constraints(const OstCase *c, OstEffectFacts *facts)
{
    facts->constraints = c->constraint_count;
    facts->free_body = c->free_body;
    for (int i = 0; i < c->constraint_count; i++) {
        const OstConstraint *constraint = &c->constraints[i];
        facts->slides += constraint->kind == OST_CONSTRAIN_SLIDE;
        facts->prescribed += ost_constraint_moves(constraint);
        facts->rigid_faces += constraint->kind == OST_CONSTRAIN_RIGID;
        facts->ties += constraint->kind == OST_CONSTRAIN_TIED;
        facts->periodic += constraint->kind == OST_CONSTRAIN_PERIODIC;
    }
}

static void count_loads(const OstCase *c, const OstEffect *known, OstEffectFacts *facts)
{
    facts->loads = c->load_count;
    for (int i = 0; i < c->load_count; i++) {
        const OstEffect effect = known ? known[i] : ost_load_effect(c, &c->loads[i]);
        facts->point_loads += effect == OST_EFFECT_POINT_FORCE;
        facts->surface_loads += effect == OST_EFFECT_SURFACE_LOAD;
        facts->body_loads += effect == OST_EFFECT_BODY_FORCE;
        facts->gravity_loads += c->loads[i].kind == OST_LOAD_GRAVITY;
        facts->follower_loads += effect == OST_EFFECT_FOLLOWER_PRESSURE;
        facts->centrifugal_loads += effect == OST_EFFECT_CENTRIFUGAL;
        facts->moments += effect == OST_EFFECT_MOMENT;
        facts->moved_couplings += c->loads[i].kind == OST_LOAD_DISTRIBUTING;
        for (int k = 0; k < 6 && c->loads[i].kind == OST_LOAD_DISTRIBUTING; k++)
            facts->moved_components += c->loads[i].moved[k];
    }
}

static void count_springs(const OstCase *c, OstEffectFacts *facts)
{
    facts->springs = c->spring_count;
    for (int i = 0; i < c->spring_count; i++)
        facts->foundations += c->springs[i].kind == OST_SPRING_FOUNDATION;
}

/* Numbers a tet and a node of what is computed after the solve; load factors are made of stress. */
static void count_recovered(const OstCase *c, OstEffectFacts *facts)
{
    const unsigned factors = OST_LOAD_FACTORS;
    const unsigned asked = facts->strengths > 0 ? ost_case_recovers(c) | factors : ost_case_recovers(c) & ~factors;
    const unsigned needed = ost_output_fields_needed(asked);
    for (int f = 0; f < OST_FIELD_COUNT; f++) {
        const OstOutputField field = ost_output_field((OstOutputFieldBit)f);
        if (needed >> f & 1U && field.is_recovered)
            *(field.centring == OST_ON_NODES ? &facts->node_fields : &facts->cell_fields) += field.components;
    }
}

/* --- what is watched --- */

/* Do the boundaries watched hold all of a constraint? */
static int holds_all(const OstSelection *watched, const OstSelection *held)
{
    if (watched->kind != OST_SELECT_BOUNDARY || held->kind != OST_SELECT_BOUNDARY)
        return 0;
    for (int b = 0; b < held->boundaries.count; b++)
        if (ost_names_find(&watched->boundaries, held->boundaries.name[b]) < 0)
            return 0;
    return 1;
}

/* Would statics alone give a reaction: that of all there is? */
static int is_static(const OstCase *c, const OstWatch *watch)
{
    int yes = c->spring_count == 0;
    for (int k = 0; k < c->constraint_count; k++)
        yes &= c->constraints[k].kind == OST_CONSTRAIN_TIED || holds_all(&watch->on, &c->constraints[k].on);
    return yes;
}

int ost_watch_is_linear_mean(const OstWatch *watch)
{
    return watch->kind == OST_WATCH_STRESS && watch->region && watch->take == OST_TAKE_MEAN &&
           (watch->component <= OST_STRESS_MEASURE_31 || watch->component == OST_STRESS_MEASURE_PRESSURE);
}

/* Watched reactions that statics alone does not give, as far as the case tells. */
static int count_reactions(const OstCase *c)
{
    int count = 0;
    for (int w = 0; w < c->watch_count; w++)
        count += c->watches[w].kind == OST_WATCH_REACTION && !is_static(c, &c->watches[w]);
    return count;
}

/* Is any reaction watched, be it one that statics gives? */
static int watches_reaction(const OstCase *c)
{
    int any = 0;
    for (int w = 0; w < c->watch_count; w++)
        any |= c->watches[w].kind == OST_WATCH_REACTION;
    return any;
}

/* As in solve/reactions/mean_stress.c. */
static int is_uneven(const OstCase *c)
{
    double most = 0.0, least = INFINITY;
    for (int k = 0; k < 3 * c->material_count; k++) {
        const double modulus = c->materials[k / 3].material.constants.youngs_modulus[k % 3];
        most = fmax(most, modulus);
        least = fmin(least, modulus);
    }
    return most >= OST_UNEVEN_MODULI * least;
}

/* Watched quantities whose error takes an adjoint problem: these, mean stresses of a mixed form or of moduli that
 * differ far, and what an accuracy is asked of. */
static int count_adjoints(const OstCase *c, int mixed)
{
    const int of_means = mixed || is_uneven(c);
    int count = count_reactions(c);
    for (int w = 0; w < c->watch_count && of_means && c->large_rotation != OST_LARGE_ROTATION_ON; w++)
        count += ost_watch_is_linear_mean(&c->watches[w]);
    if (c->interest > 0 && c->watches[c->interest - 1].kind != OST_WATCH_STRAIN_ENERGY)
        count++;
    return count;
}

/* --- the plan --- */

/* Edges of a mesh from a file follow no direction, as a rule. How far they are off the stiff ones, which the solver
 * measures, is 1 + this × the root of the ratio of moduli: gears, brackets, spindles and pins have 1.1 to 1.25 at 10,
 * 1.5 to 2.0 at 100, 2.8 to 5.6 at 1000, 7.6 at 1e4, 22 at 1e5, 67 to 97 at 1e6. */
static const double usual_crossing = 0.07;

/* Cells of a block lie along x, y and z: do stiff directions that are fixed lie across? By more than so much. */
static const double along = 0.995;

static int crosses_cells(const OstCase *c)
{
    int crosses = 0;
    for (int m = 0; m < c->material_count && c->mesh_kind == OST_MESH_BLOCK; m++) {
        const OstAxesSpec *axes = &c->materials[m].axes;
        const int is_fixed =
            axes->kind == OST_AXES_FIXED || axes->kind == OST_AXES_EULER || axes->kind == OST_AXES_QUATERNION;
        for (int i = 0; i < 3 && is_fixed && !c->materials[m].material.isotropic; i++) {
            const double *e = axes->fixed + 3 * i;
            crosses |= !(fmax(fabs(e[0]), fmax(fabs(e[1]), fabs(e[2]))) > along);
        }
    }
    return crosses;
}

/* What the solver measures of a shape's cells, whose diagonals are longer than they are. */
static const double of_diagonals = 1.35;

/* But for materials, what is recovered and what the solver may be. */
static OstEffectFacts state_facts(const OstCase *c, const OstPlanMesh *mesh, const OstMeshCounts *counts, int ranks)
{
    const int classical = c->formulation == OST_FORMULATION_CLASSICAL;
    OstEffectFacts facts = {.quadratic = mesh->quadratic,
                            .nodes = counts->nodes,
                            .tets = counts->tets,
                            .vertices = counts->vertices,
                            .edges = counts->edges,
                            .regions = mesh->regions ? mesh->regions->count : 1,
                            .ranks = ranks,
                            .stiff_welded = (mesh->welded & OST_WELDED_STIFF) != 0,
                            .close_welded = (mesh->welded & OST_WELDED_CLOSE) != 0,
                            .merge = c->merge,
                            .without = c->without,
                            .buckling = c->buckling_modes,
                            .large_rotation = c->large_rotation == OST_LARGE_ROTATION_OFF  ? 0
                                              : c->large_rotation == OST_LARGE_ROTATION_ON ? 2
                                                                                           : 1,
                            .classical = classical,
                            .formulation = classical ? "classical" : "consistent",
                            .accuracy = c->relative_error,
                            .path_steps = c->path_steps,
                            .tables = c->table_count,
                            .asks_error = c->asks_error && c->path_steps == 0,
                            .watches = c->watch_count,
                            .error_field = ost_plan_writes(c, OST_FIELD_ERROR),
                            .mixed = !c->unmixed};
    count_constraints(c, &facts);
    count_loads(c, mesh->load, &facts);
    facts.cases = c->load_case_count;
    count_springs(c, &facts);
    return facts;
}

/* Of the solver's facts those that are not of materials. */
static void state_solver_facts(const OstCase *c, const OstPlanMesh *mesh, const OstPlan *plan, OstSolverFacts *facts)
{
    facts->unknowns = plan->unknowns;
    if (mesh->quadratic) /* two nodes a tet across; a vertex has about half a face on each of two surfaces */
        facts->thickness = 8.0 * plan->counts.vertices / fmax(plan->counts.surface, 1.0);
    facts->stops_early = c->solver.algebraic_fraction > 0.0 && ost_plan_writes(c, OST_FIELD_ERROR);
    facts->repeated = c->path_steps > 0 || c->large_rotation == OST_LARGE_ROTATION_ON;
    if (mesh->quadratic && plan->slenderness < ost_plan_longest_of_columns)
        facts->slenderness = of_diagonals * plan->slenderness;
}

int ost_plan_links(const OstPlan *plan)
{
    return ost_effect_on(&plan->effects, OST_EFFECT_RIGID_FACE) || ost_effect_on(&plan->effects, OST_EFFECT_TIE) ||
           ost_effect_on(&plan->effects, OST_EFFECT_PERIODIC);
}

void ost_plan_make(const OstCase *c, const OstPlanMesh *mesh, int ranks, OstPlan *plan)
{
    const double surface = mesh->surface > 0.0 ? mesh->surface : ost_plan_shape_surface(c);
    memset(plan, 0, sizeof *plan);
    plan->counts = ost_mesh_counts((double)mesh->nodes, (double)mesh->tets, mesh->quadratic, surface);
    plan->quadratic = mesh->quadratic;
    plan->nodes = mesh->nodes;
    plan->tets = mesh->tets;
    plan->unknowns = 3 * mesh->nodes;
    ost_plan_shape_slenderness(c, &plan->slenderness, &plan->cells_across);
    OstEffectFacts facts = state_facts(c, mesh, &plan->counts, ranks);
    state_solver_facts(c, mesh, plan, &plan->facts);
    ost_plan_materials(c, mesh, &facts, &plan->facts);
    if (mesh->quadratic && (c->mesh_kind == OST_MESH_FILE || crosses_cells(c)) && plan->facts.anisotropy > 1.0)
        plan->facts.misalignment = 1.0 + usual_crossing * sqrt(plan->facts.anisotropy);
    count_recovered(c, &facts);
    if (ost_effects_mixed(&facts)) /* what the pressures leave of the stiffness */
        plan->facts.poisson = fmin(plan->facts.poisson, OST_NEARLY_INCOMPRESSIBLE);
    facts.factored = plan->corrects_by_factors = c->solver.method == OST_METHOD_AUTO && !ost_effects_mixed(&facts) &&
                                                 ost_solver_factors_spare_corrections(&plan->facts);
    plan->adjoints = count_adjoints(c, ost_effects_mixed(&facts));
    ost_solver_plan(&c->solver, &plan->facts, &plan->solver);
    facts.multigrid = ost_solver_may_be_multigrid(&plan->solver);
    ost_effects_find(&facts, &plan->effects);
    plan->solves_to_residual =
        c->path_steps > 0 ||
        (watches_reaction(c) && (ost_plan_links(plan) || ost_effect_on(&plan->effects, OST_EFFECT_MIXED)));
    plan->bends = c->mesh_kind == OST_MESH_BLOCK || ost_effect_on(&plan->effects, OST_EFFECT_POINT_FORCE) ||
                  (c->mesh_kind == OST_MESH_SECTOR && ost_effect_on(&plan->effects, OST_EFFECT_BODY_FORCE));
    ost_effects_name_accounts(c->ctx);
    ost_plan_memory(c, ranks, plan);
}

OstStatus ost_plan_check_size(const OstCase *c, OstGlobal nodes)
{
    const OstGlobal most = INT32_MAX / 3;
    if (c->mesh_kind == OST_MESH_FROM_PROGRAM)
        return ost_case_located(c, c->mesh_place,
                                OST_RAISE(c->ctx, OST_INVALID_INPUT,
                                          "the case expects its mesh from a program (ost_scene_create_on), and there "
                                          "is none here; name a shape or a file"));
    if (nodes <= most)
        return OST_SUCCESS;
    return OST_RAISE(c->ctx, OST_LIMIT_EXCEEDED,
                     "%s: %s%lld nodes have three unknowns each; Epetra and ML number at most 2^31 - 1 over all ranks, "
                     "which is %lld nodes: use a coarser mesh",
                     c->path, nodes == OST_PLAN_MOST ? "more than " : "", (long long)nodes, (long long)most);
}

void ost_plan_warn_idle(const OstCase *c, const OstPlan *plan, const char *load_case)
{
    if (c->load_count > 0 || ost_effect_on(&plan->effects, OST_EFFECT_PRESCRIBED_DISPLACEMENT) ||
        ost_effect_on(&plan->effects, OST_EFFECT_EIGENSTRAIN))
        return;
    ost_warn(c->ctx,
             "%s: nothing acts on the body%s%s%s: there is no load, no prescribed displacement and no eigenstrain",
             c->path, load_case ? " in load case '" : "", load_case ? load_case : "", load_case ? "'" : "");
}
