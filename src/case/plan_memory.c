/* SPDX-License-Identifier: BSD-3-Clause */
#include "algebra/solver_plan.h"
#include "algebra/solver_seconds.h"
#include "case/plan.h"
#include "core/together/together.h"
#include "fields/output_field.h"

#include <math.h>
#include <stdio.h>

/* Bytes at the peak of a run, when the solver is made or solves. Where arrays follow from the data structures (of
 * mesh.h, block_matrix.h, level_matrix.h, prolongator.h) their sizes are stated; the rest, marked as measured, is
 * fitted to the ledgers of tubes, blocks, beams and octants with 1 to 30 hexes across. */
static const double block_bytes = 72.0 + 4.0;     /* nine doubles and a column */
static const double left_block_bytes = 4.0 + 4.0; /* left of the diagonal: a column, and where its transpose is */
static const double row_bytes = 8.0 + 5.0 * 4.0;  /* label, start, diagonal twice, both maps of nodes and rows */
static const double node_bytes = 96.0;            /* displacement, load, supports, free motions */
static const double vectors = 9.0;                /* of three doubles a node, in the solver and around it */

/* The mesh, its halo and its surface, for each vertex, tet and face on the surface; quadratic tets have their edges'
 * nodes on top. Measured. */
static const struct {
    double vertex, tet, face;
} mesh_bytes[2] = {{56.0, 25.3, 22.0}, {50.0, 97.0, 77.0}};

/* Multigrid. Of a node of linear tets: half the blocks in single precision with their column; diagonal, smoother's
 * factors and vectors; more, measured, with each aggregate: a row of the coarse matrix, and columns of the prolongator.
 */
static const double half_block_bytes = 40.0, smoother_bytes = 216.0;
static const double prolongator_bytes = 370.0, column_bytes = 76.0;
/* An aggregate has as many bytes far from the surface, and as many less at a wall of one hex (see thinness). */
static const double aggregate_bytes = 8.5e3, aggregate_inside = 27e3, aggregate_decay = 1.4;
static const double single_coarse = 0.72; /* of that, where there is one coarse level */
static const double quadratic_node_bytes = 480.0;

/* While it is made: one triangle of the coarse matrix in double precision, for each node; smaller aggregates have more
 * of it. Measured. */
static const double galerkin_bytes = 40.0, galerkin_inside = 300.0, galerkin_decay = 1.5;
static const double galerkin_power = 1.7, usual_aggregate = 38.0;
static const double quadratic_transient = 200.0;

/* Multigrid takes aggregates of quadratic tets' nodes where cells are longer than so many thicknesses, and columns
 * where they are longer than so many; what a node has then on top, at the peak, and what where it goes over vertices
 * that turn, in a thin body factored. Measured. */
static const double longest = 5.0, of_coarsening[5] = {0.0, 1900.0, 3200.0, 1050.0, 900.0};
const double ost_plan_longest_of_columns = 8.0;

static const double plain_copies = 3.0; /* scalar copy for ML and Gauss-Seidel, and the hierarchy */

/* All nodes and tets that ranks hold, over those they own: each holds a layer of ghost nodes around its part of the
 * partition. A part of n nodes has about 6 n^(2/3) nodes on its faces; about half of its faces border on another part.
 */
static double halo_factor(double nodes, int ranks)
{
    if (ranks <= 1 || nodes <= 0.0)
        return 1.0;
    return 1.0 + fmin(3.0 * cbrt((double)ranks / nodes), (double)ranks - 1.0);
}

/* Surface faces a vertex: 2 for a wall of one hex, 0 for an infinite body. A node on the surface has fewer neighbours,
 * and so have the aggregates there. */
static double thinness(const OstMeshCounts *counts)
{
    return counts->vertices > 0.0 ? fmin(counts->surface / counts->vertices, 2.5) : 0.0;
}

/* Coarsening stops at coarsest_unknowns. Aggregates turn out a little smaller than they are asked for, so a level that
 * is expected to have just too many may have few enough; taken as the last, it is the dearest there can be. */
static void foretell_levels(const OstPlan *plan, OstPlanLevels *levels)
{
    const OstSolverOptions *options = &plan->solver.options;
    const double most = 1.1 * options->coarsest_unknowns;
    double unknowns = 3.0 * plan->counts.vertices;
    levels->aggregate_nodes = options->aggregate_nodes * (0.985 - 0.05 * thinness(&plan->counts));
    for (levels->count = 1; unknowns > most && levels->count < options->most_levels; levels->count++)
        unknowns /= levels->count == 1 ? 0.5 * levels->aggregate_nodes : fmax(options->coarse_aggregate_nodes, 2.0);
    levels->coarsest = unknowns;
}

/* Of linear tets' multigrid; under quadratic tets their level comes on top. Every rank has the coarsest level's
 * factors. */
static void foretell_hierarchy(const OstPlan *plan, int ranks, OstPlanLevels *levels)
{
    const OstMeshCounts *counts = &plan->counts;
    const double thin = thinness(counts);
    foretell_levels(plan, levels);
    const double share = levels->count > 2 ? 1.0 : single_coarse;
    const double of_aggregates =
        share * (aggregate_bytes + aggregate_inside * exp(-aggregate_decay * thin)) / levels->aggregate_nodes;
    const double of_product = (galerkin_bytes + galerkin_inside * exp(-galerkin_decay * thin)) *
                              pow(usual_aggregate / levels->aggregate_nodes, galerkin_power);
    levels->columns = (prolongator_bytes + of_aggregates) / column_bytes;
    levels->kept = half_block_bytes * 0.5 * (counts->linear_blocks - counts->vertices) +
                   counts->vertices * (smoother_bytes + prolongator_bytes + of_aggregates);
    levels->transient = levels->count > 2 ? counts->vertices * of_product : 0.0;
    if (levels->coarsest <= 2000.0)
        levels->kept += 8.0 * levels->coarsest * levels->coarsest * ranks;
    if (!plan->quadratic)
        return;
    levels->kept += half_block_bytes * 0.5 * (counts->blocks - counts->nodes) + quadratic_node_bytes * counts->nodes;
    levels->transient = fmax(levels->transient, quadratic_transient * counts->nodes);
}

static double solver_bytes(const OstPlan *plan)
{
    const double vector_bytes = vectors * 24.0 * plan->counts.nodes;
    switch (plan->solver.first) {
    case OST_METHOD_DIRECT:
        return vector_bytes + ost_solver_factor_bytes(plan->unknowns);
    case OST_METHOD_PLAIN:
        return vector_bytes + plain_copies * plan->counts.blocks * block_bytes;
    default:
        return plan->levels.kept + fmax(vector_bytes, plan->levels.transient) +
               of_coarsening[plan->coarsening] * plan->counts.nodes;
    }
}

static OstCoarsening find_coarsening(const OstPlan *plan)
{
    if (plan->quadratic && ost_solver_is_over_vertices(&plan->facts))
        return OST_COARSEN_VERTICES;
    if (plan->quadratic && plan->solver.first == OST_METHOD_TWO_LEVEL)
        return OST_COARSEN_FACTORS;
    if (!plan->quadratic || plan->slenderness < longest)
        return OST_COARSEN_TETS;
    return plan->slenderness < ost_plan_longest_of_columns ? OST_COARSEN_NODES : OST_COARSEN_COLUMNS;
}

int ost_plan_writes(const OstCase *c, OstOutputFieldBit field)
{
    return (c->output_fields >> field & 1U) != 0;
}

/* Of the file: places and labels of nodes; nodes, offset, type and label of tets; and the fields. */
static double output_bytes(const OstCase *c, const OstPlan *plan)
{
    const unsigned absent = ost_effect_on(&plan->effects, OST_EFFECT_STRENGTH) ? 0U : OST_LOAD_FACTORS;
    double node = 24.0, tet = 32.0 + 8.0 + 1.0;
    for (int f = 0; f < OST_FIELD_COUNT; f++) {
        const OstOutputField field = ost_output_field((OstOutputFieldBit)f);
        if ((c->output_fields & ~absent) >> f & 1U)
            *(field.centring == OST_ON_NODES ? &node : &tet) +=
                field.components * (field.type == OST_VALUES_INT32 ? 4.0 : 8.0);
    }
    return node * (double)plan->nodes + tet * (double)plan->tets;
}

/* Fewest ranks by the limits of assembly/limits.c: nonzeros of K, and nodes of tets, on one rank. Assumes equal parts.
 */
static int least_ranks(double blocks, double tet_nodes)
{
    return (int)fmin(fmax(ceil(fmax(9.0 * blocks, tet_nodes) / INT32_MAX), 1.0), INT32_MAX);
}

/* Of adjoint problems: the surplus of z on nodes and functions; and of what is out of balance, and a rigid motion. */
static double adjoint_bytes(const OstCase *c, const OstPlan *plan)
{
    const OstMeshCounts *counts = &plan->counts;
    const double functions = counts->edges + (plan->quadratic ? 2.0 * counts->tets : 0.0);
    const double most = c->load_case_count > 0 || c->path_steps > 0 ? OST_PLAN_MOST_SHARED : 1.0;
    if (plan->adjoints == 0 || !ost_effect_on(&plan->effects, OST_EFFECT_ERROR_ESTIMATE))
        return 0.0;
    return 48.0 * counts->nodes + fmin(plan->adjoints, most) * (16.0 * functions + 48.0 * counts->nodes);
}

/* Columns of fields of the mesh file, if they are at vertices where they may be, and the moduli and eigenstrains that
 * tets have of them. */
static double field_bytes(const OstCase *c, const OstPlan *plan)
{
    static const double columns[] = {
        [OST_CASE_FIELD_OF_NUMBERS] = 4.0, [OST_CASE_FIELD_OF_DIRECTIONS] = 3.0, [OST_CASE_FIELD_OF_AXES] = 36.0};
    double numbers = 0.0;
    int is_modulus = 0, is_strain = 0;
    for (int f = 0; f < c->field_count; f++)
        numbers += columns[c->fields[f].use] *
                   (plan->quadratic && c->fields[f].use == OST_CASE_FIELD_OF_DIRECTIONS ? 4.0 : 1.0);
    for (int m = 0; m < c->material_count; m++) {
        is_modulus |= c->materials[m].modulus.field != NULL;
        is_strain |= c->materials[m].eigen_field != NULL;
    }
    return 8.0 * (numbers + (is_modulus ? 4.0 : 0.0) + (is_strain ? 4.0 : 0.0)) * plan->counts.tets;
}

/* Of a load case that is solved beside another: for each node its answer and the solve's vectors, and for each tet what
 * the estimate of its error takes. Measured on blocks, 5 and 10 cases. */
static const double company_node = 540.0, company_tet[2] = {104.0, 552.0};

static double company_bytes(const OstCase *c, const OstPlan *plan)
{
    static const OstEffect alone[] = {OST_EFFECT_MIXED,    OST_EFFECT_RIGID_FACE,     OST_EFFECT_TIE,
                                      OST_EFFECT_PERIODIC, OST_EFFECT_MOVED_COUPLING, OST_EFFECT_FOLLOWER_PRESSURE};
    const OstMeshCounts *counts = &plan->counts;
    const int beside = c->load_case_count < OST_MOST_TOGETHER ? c->load_case_count - 1 : OST_MOST_TOGETHER;
    if (beside < 1 || c->large_rotation == OST_LARGE_ROTATION_ON)
        return 0.0;
    for (size_t k = 0; k < sizeof alone / sizeof alone[0]; k++)
        if (ost_effect_on(&plan->effects, alone[k]))
            return 0.0;
    const double recovery = ost_effect_state(&plan->effects, OST_EFFECT_RECOVERY)->bytes;
    const double estimate =
        ost_effect_on(&plan->effects, OST_EFFECT_ERROR_ESTIMATE) ? company_tet[plan->quadratic] * counts->tets : 0.0;
    return beside * (company_node * counts->nodes + fmax(estimate, recovery));
}

void ost_plan_memory(const OstCase *c, int ranks, OstPlan *plan)
{
    const OstMeshCounts *counts = &plan->counts;
    const double recovery = ost_effect_state(&plan->effects, OST_EFFECT_RECOVERY)->bytes;
    const double adjoints = adjoint_bytes(c, plan);
    const double estimate = ost_effect_state(&plan->effects, OST_EFFECT_ERROR_ESTIMATE)->bytes + adjoints;
    const int q = plan->quadratic;
    plan->least_ranks = least_ranks(counts->blocks, (q ? 10.0 : 4.0) * counts->tets);
    plan->bytes_mesh =
        node_bytes * counts->nodes + halo_factor(counts->nodes, ranks) *
                                         (mesh_bytes[q].vertex * counts->vertices + mesh_bytes[q].tet * counts->tets +
                                          mesh_bytes[q].face * counts->surface + field_bytes(c, plan));
    const double left = 0.5 * (counts->blocks - counts->nodes); /* of the diagonal */
    plan->bytes_matrix = (counts->blocks - left) * block_bytes + left * left_block_bytes + counts->nodes * row_bytes;
    if (plan->solver.first != OST_METHOD_DIRECT && plan->solver.first != OST_METHOD_PLAIN)
        foretell_hierarchy(plan, ranks, &plan->levels);
    plan->coarsening = find_coarsening(plan);
    plan->bytes_solver = solver_bytes(plan);
    plan->bytes_effects = adjoints;
    for (int e = OST_EFFECT_FIRST; e < OST_EFFECT_END; e++)
        plan->bytes_effects += ost_effect_state(&plan->effects, (OstEffect)e)->bytes;
    /* A level of vertices that turn stays while the error is estimated. */
    const double turning = plan->coarsening == OST_COARSEN_VERTICES ? of_coarsening[plan->coarsening] : 0.0;
    const double hierarchy = plan->levels.kept + turning * counts->nodes;
    const double potentials = ost_effect_state(&plan->effects, OST_EFFECT_GRADIENT_AXES)->bytes; /* given back before */
    const double kept = plan->bytes_mesh + plan->bytes_effects - estimate - recovery - potentials;
    plan->bytes_in_all = fmax(kept + potentials, kept + plan->bytes_matrix +
                                                     fmax(fmax(plan->bytes_solver, hierarchy + estimate), recovery));
    if (ost_plan_links(plan)) /* the stiffness of all nodes is kept beside that of what they follow */
        plan->bytes_in_all = fmax(plan->bytes_in_all, kept + 2.0 * plan->bytes_matrix + plan->bytes_solver);
    plan->bytes_company = company_bytes(c, plan);
    plan->bytes_output = output_bytes(c, plan) * (c->path_steps > 0 ? c->path_steps : 1);
}

void ost_plan_fit(const OstCase *c, int ranks, double room, OstPlan *plan)
{
    const OstPlan with = *plan;
    const double gibibyte = 1073741824.0;
    char reason[160];
    if (c->asks_error || plan->bytes_in_all <= room || !ost_effect_on(&plan->effects, OST_EFFECT_ERROR_ESTIMATE))
        return;
    snprintf(reason, sizeof reason, "with it the run would take about %.3g GiB, and %.3g GiB are free",
             plan->bytes_in_all / gibibyte, room / gibibyte);
    ost_effects_leave_out(&plan->effects, OST_EFFECT_ERROR_ESTIMATE, reason);
    ost_plan_memory(c, ranks, plan);
    if (plan->bytes_in_all > room)
        *plan = with;
    else
        plan->facts.stops_early = 0;
}
