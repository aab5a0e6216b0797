/* SPDX-License-Identifier: BSD-3-Clause */
#include "accuracy/estimate.h"

#include "accuracy/complement/blocks.h"
#include "accuracy/locking.h"
#include "accuracy/search.h"
#include "algebra/matrix/vector.h"
#include "core/error.h"
#include "core/memory.h"
#include "core/parallel/halo.h"
#include "core/parallel/reduce.h"
#include "core/small.h"
#include "problem/free_body.h"

#include <math.h>
#include <string.h>

/* Gains of pairs of steps are taken to fall by no less than the ratio. On linear tets that lock they fall, and then
 * stay for long: more is asked for there. */
static const Enough enough_of_linear = {0.45, 0.2, 1}, enough_of_locked = {0.25, 0.115, 0},
                    enough_of_quadratic = {0.45, 1.0, 1};
static const double largest_ratio = 0.75;

/* What later steps add to |e|² is about this often what is left of r'B r on the functions: 2 to 5 times after three or
 * four steps in seven of ten errors of `verify`, and to 11 in nine. It tells if r'B r falls, or is small beside |e|².
 * In flat tets without stacks r'B r falls before the error does: 7 to 17 times it is missing where edges are 4 times as
 * long as tets are thick, 26 times for 8 and 41 for 20. That is about the cube of the flatness, from `flat_from` to
 * `flattest`. */
static const double per_left = 3.5, falling = 0.6, share_to_come = 0.3, small_to_come = 0.05;

static const double flat_from = 1.9, flattest = 6.0;

/* With stacks, what later steps add was 2.5 to 10 times what is left after four steps, in plates, strips, leaves and
 * beams of tets whose edges are 4 to 20 times the thickness. All steps then had 0.66 to 0.81 of |e|²: what is missing
 * lies near edges of the body, within a thickness of them, and orders tell little of it. */
static const double per_left_of_stacks = 5.5, least_of_flat = 1.25;

/* What two steps may add, where errors of other loads gave a start, to be the last. */
static const double little_new = 0.03;

enum { least_steps = 3, most_steps = 24 };

void ost_estimate_destroy(OstEstimate **estimate)
{
    if (!*estimate)
        return;
    ost_surplus_loads_clear(&(*estimate)->loads);
    ost_sum_clear(&(*estimate)->kept);
    if (!(*estimate)->is_shared) {
        ost_light_tets_destroy(&(*estimate)->stiffness.light);
        ost_complement_clear(&(*estimate)->complement);
        OST_FREE((*estimate)->factor);
        ost_stacks_destroy(&(*estimate)->stacks);
        ost_earlier_destroy(&(*estimate)->earlier);
    }
    OST_FREE(*estimate);
}

/* What flat tets call for. Nearly incompressible ones have no stacks. */
static OstStatus find_flatness(OstEstimate *estimate, int is_quadratic)
{
    double flatness = 0.0;
    if (is_quadratic) /* of linear tets gains tell, as they lock */
        OST_TRY(ost_flatness(estimate->problem->mesh, &flatness));
    estimate->is_flat = flatness > flat_from;
    estimate->is_stacked = estimate->is_flat && estimate->problem->field->form == OST_SPLIT_NOT;
    const double beyond = estimate->is_flat ? fmin(flatness, flattest) / flat_from : 1.0;
    estimate->per_left = estimate->is_stacked ? per_left_of_stacks : per_left * beyond * beyond * beyond;
    estimate->of_flat = estimate->is_stacked ? least_of_flat : 1.0;
    return OST_SUCCESS;
}

static OstStatus create(OstEstimate *estimate)
{
    const OstProblem *problem = estimate->problem;
    OST_TRY(ost_complement_create(problem->mesh, problem->supports, &estimate->complement));
    OST_TRY(ost_surplus_loads_create(problem, &estimate->complement, &estimate->loads));
    OstOperator *stiffness = &estimate->stiffness;
    *stiffness = (OstOperator){.problem = problem, .complement = &estimate->complement};
    OST_TRY(ost_operator_unit(problem, &stiffness->unit));
    const int is_quadratic = problem->mesh->nodes_per_tet == 10;
    int is_locked = ost_is_nearly_incompressible(problem);
    if (!is_quadratic && !is_locked)
        OST_TRY(ost_has_few_layers(problem->mesh, estimate->complement.owned_edges, &is_locked));
    if (!is_quadratic && !is_locked)
        OST_TRY(ost_stiff_directions_cross(problem, &is_locked));
    estimate->enough = is_quadratic ? enough_of_quadratic : is_locked ? enough_of_locked : enough_of_linear;
    estimate->knows_orders = is_quadratic && !is_locked;
    if (estimate->knows_orders)
        OST_TRY(ost_stiff_directions_cross(problem, &estimate->misses));
    OST_TRY(find_flatness(estimate, is_quadratic));
    estimate->enough_of_adjoint = is_quadratic ? estimate->enough : enough_of_locked;
    estimate->enough_of_adjoint.by_left = 0;
    OstStatus status = ost_light_tets_create(problem, &estimate->complement, stiffness->unit, &stiffness->light);
    OST_THEN(
        ost_surplus_loads_bed(&estimate->loads, &estimate->complement, stiffness->unit, &estimate->complement.bed));
    if (estimate->is_stacked)
        OST_THEN(ost_stacks_create(&estimate->complement, &estimate->stacks));
    else
        OST_THEN(OST_NEW(problem->ctx, &estimate->factor, OST_PER_BLOCK * (size_t)estimate->complement.count));
    return ost_agree(problem->ctx, status);
}

OstStatus ost_estimate_take_loading(OstEstimate *estimate)
{
    if (!estimate->problem->scene)
        return OST_SUCCESS;
    ost_surplus_loads_clear(&estimate->loads);
    return ost_surplus_loads_create(estimate->problem, &estimate->complement, &estimate->loads);
}

OstStatus ost_estimate_remember(OstEstimate *estimate)
{
    const OstProblem *problem = estimate->problem;
    if (!problem->scene || !ost_problem_is_linear(problem) || estimate->earlier)
        return OST_SUCCESS;
    return ost_agree(problem->ctx,
                     ost_earlier_create(problem->ctx, 3 * (size_t)problem->system->matrix->rows,
                                        OST_PER_FUNCTION * (size_t)estimate->complement.count, &estimate->earlier));
}

/* Takes the stiffness to u. */
OstStatus ost_search_move(OstEstimate *estimate, const double *u)
{
    const int is_linear = ost_problem_is_linear(estimate->problem);
    estimate->stiffness.turned_by = is_linear ? NULL : u;
    if (is_linear && estimate->has_factor)
        return OST_SUCCESS;
    estimate->has_factor = is_linear;
    OstOperator *stiffness = &estimate->stiffness;
    return ost_agree(estimate->problem->ctx, estimate->stacks ? ost_stacks_factor(estimate->stacks, estimate->problem,
                                                                                  stiffness->turned_by, stiffness->unit)
                                                              : ost_operator_blocks(stiffness, estimate->factor));
}

OstStatus ost_estimate_create(const OstProblem *problem, OstEstimate **estimate)
{
    OstStatus status = ost_agree(problem->ctx, OST_NEW(problem->ctx, estimate, 1));
    if (status != OST_SUCCESS)
        return status;
    (*estimate)->problem = problem;
    if (problem->scene)
        status = create(*estimate);
    if (status != OST_SUCCESS)
        ost_estimate_destroy(estimate);
    return status;
}

OstStatus ost_estimate_share(OstEstimate *estimate, const OstProblem *problem, OstEstimate **shared)
{
    if (problem->scene)
        OST_TRY(ost_search_move(estimate, NULL));
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, shared, 1)));
    **shared = *estimate;
    (*shared)->problem = (*shared)->stiffness.problem = problem;
    (*shared)->is_shared = 1;
    (*shared)->loads = (OstSurplusLoads){0};
    (*shared)->earlier = NULL;
    (*shared)->keeps = (*shared)->part_count = 0;
    (*shared)->kept = (OstKeptError){0};
    return problem->scene ? ost_surplus_loads_create(problem, &estimate->complement, &(*shared)->loads) : OST_SUCCESS;
}

void ost_estimate_keep(OstEstimate *estimate)
{
    estimate->keeps = 1;
}

void ost_estimate_add_up(OstEstimate *estimate, int count, OstEstimate *const *part, const double *factor)
{
    estimate->part_count = count <= OST_MOST_PARTS ? count : 0;
    for (int k = 0; k < estimate->part_count; k++) {
        estimate->part[k] = part[k];
        estimate->part_factor[k] = factor[k];
    }
}

/* --- the error --- */

OstStatus ost_search_open(OstEstimate *estimate, OstSolver *solver, Search *search)
{
    *search = (Search){.estimate = estimate, .higher = 1.0};
    return ost_steps_open(&estimate->stiffness, estimate->factor, estimate->stacks, solver, &search->steps);
}

/* What all pairs of steps after this one would add to |e|_A², if gains go on falling as from the last to this. */
static double gains_to_come(double gain, double last)
{
    const double ratio = last > 0.0 ? fmin(gain / last, largest_ratio) : 0.0;
    return gain * ratio / (1.0 - ratio);
}

double ost_search_true_square(const Search *search, double square)
{
    return search->steps.size * search->steps.size * search->estimate->stiffness.unit * square;
}

/* What is known after some steps; `sum` is |e|² so far, `pair` and `last` what the last two steps and the two before
 * added. */
typedef struct Progress {
    int steps;
    double start, sum, gain, pair, last, to_come;
} Progress;

static int is_enough(const OstEstimate *estimate, const Enough *enough, const Progress *now)
{
    const int n = now->steps, is_pair = n % 2 == 0;
    const double by_gains = gains_to_come(now->pair, now->last), square = now->sum + now->to_come;
    if (n < least_steps)
        return is_pair && now->start > 0.0 && now->pair <= little_new * now->sum;
    if (enough->by_left && (is_pair || (n == least_steps && !estimate->is_flat)) &&
        now->to_come <= share_to_come * square &&
        (now->to_come <= small_to_come * square || now->to_come <= estimate->per_left * falling * now->gain))
        return 1;
    const int is_left = estimate->is_flat && now->to_come > share_to_come * square;
    const int gains_tell = !is_left && (n > 4 || !enough->by_left);
    return is_pair && gains_tell && now->pair <= enough->gain * now->sum &&
           by_gains <= enough->rest * (now->sum + by_gains);
}

OstStatus ost_search_iterate(Search *search, double start, double *square)
{
    const OstEstimate *estimate = search->estimate;
    const Enough *enough = search->of_adjoint ? &estimate->enough_of_adjoint : &estimate->enough;
    OstSteps *steps = &search->steps;
    Progress now = {.start = start, .sum = start};
    ost_steps_start(steps);
    while (now.steps < most_steps && !steps->failed) {
        OST_TRY(ost_steps_next(steps));
        OST_TRY(ost_steps_left(steps, &now.to_come));
        now.to_come *= estimate->per_left;
        now.gain = steps->gain;
        now.sum += now.gain;
        now.last = now.steps % 2 == 0 ? now.pair : now.last;
        now.pair = now.steps % 2 == 0 ? now.gain : now.pair + now.gain;
        now.steps++;
        if (!enough->by_left)
            now.to_come = fmax(now.to_come, gains_to_come(now.pair, now.last));
        ost_log(estimate->problem->ctx, OST_LOG_VERBOSE, "error estimate: step %d: %.6e, with %.6e to come", now.steps,
                sqrt(ost_search_true_square(search, now.sum)), sqrt(ost_search_true_square(search, now.to_come)));
        if (!(now.gain > 0.0) || is_enough(estimate, enough, &now))
            break;
    }
    *square = now.sum + now.to_come;
    search->longer = now.sum > 0.0 ? *square / now.sum : 1.0;
    return OST_SUCCESS;
}

/* Steps from the best combination of what was found for other loads. */
static OstStatus iterate_from(Search *search, double *square)
{
    OstEarlier *earlier = search->estimate->earlier;
    double start;
    OST_TRY(ost_earlier_start(earlier, &search->steps.r, &start));
    OST_TRY(ost_search_iterate(search, start, square));
    return search->steps.failed ? OST_SUCCESS : ost_earlier_finish(earlier, &search->steps.r, &search->steps.e);
}

OstStatus ost_search_take(Search *search, const double *left)
{
    OstSteps *steps = &search->steps;
    const double unit = search->estimate->stiffness.unit;
    double most = fmax(ost_largest(3 * steps->functions, left), ost_largest(steps->rows, steps->r.rows));
    OST_TRY(ost_max(search->estimate->problem->ctx, 1, &most));
    steps->size = most > 0.0 ? most / unit : 1.0;
    ost_steps_take_residual(steps, left, steps->size * unit);
    for (size_t i = 0; i < steps->rows; i++)
        steps->r.rows[i] /= steps->size * unit;
    return OST_SUCCESS;
}

OstStatus ost_search_residual(Search *search, double t, const double *u)
{
    OstSteps *steps = &search->steps;
    const OstEstimate *estimate = search->estimate;
    const OstProblem *problem = estimate->problem;
    double *left = ost_steps_spare(steps); /* f - A u */
    OST_TRY(
        ost_agree(problem->ctx, ost_operator_force(&estimate->stiffness, t, u, steps->force, left, &search->energy)));
    ost_surplus_loads_add(&estimate->loads, problem, &estimate->complement, t, u, left);
    OST_TRY(ost_steps_take_rows(steps, steps->r.rows));
    return ost_search_take(search, left);
}

OstStatus ost_search_displacement(Search *search)
{
    return ost_system_displacement(search->estimate->problem->system, 0.0, search->steps.e.rows, search->steps.u);
}

/* An e below this share of u is rounding. */
static const double rounding = 1e-12;

/* The share of loads in the work, by the size of each node's. A coupling that is moved is a force here. */
static OstStatus find_share_of_loads(Search *search, double t, const double *u, double energy, double *share)
{
    const OstProblem *problem = search->estimate->problem;
    double *load = search->steps.force, work = 0.0;
    *share = problem->scene->c->load_count > 0 || ost_field_is_eigenstrained(problem->field);
    if (*share == 0.0 || ost_field_is_eigenstrained(problem->field) || problem->scene->drive ||
        !ost_effect_on(&problem->scene->plan.effects, OST_EFFECT_PRESCRIBED_DISPLACEMENT))
        return OST_SUCCESS;
    ost_problem_load(problem, t, u, load);
    for (size_t n = 0; n < (size_t)problem->mesh->owned_nodes; n++)
        work += fabs(ost_dot3(load + 3 * n, u + 3 * n));
    OST_TRY(ost_sum(problem->ctx, 1, &work));
    *share = work < 2.0 * energy ? work / (2.0 * energy) : 1.0;
    return OST_SUCCESS;
}

/* |u + e|², e being orthogonal to u where u is at rest at its supports, and to u + e where nothing but supports moves
 * the body; no less than |e|². `square` is that, `energy` that of u. */
static double whole_square(double by_loads, double energy, double square)
{
    return fmax(2.0 * energy + (2.0 * by_loads - 1.0) * square, square);
}

/* An answer has no smaller norm than this share of its scale: else an error of the equations is compared with itself
 * where an eigenstrain is free, or where incompressible parts bear the loads and nothing moves. */
static const double least_of_scale = 1e-4;

/* The scale's square: of an eigenstrain, the energy norm that it has where nothing gives way to it; of a mixed form,
 * what its pressure is worth. 0 without either. Overwrites steps.u. */
static OstStatus find_scale(Search *search, double t, double *square)
{
    const OstProblem *problem = search->estimate->problem;
    const OstMesh *mesh = problem->mesh;
    const OstPressureSpace *space = problem->pressures;
    double held = 0.0, pressed = 0.0;
    if (ost_field_is_eigenstrained(problem->field)) {
        OstMaterialField field;
        OstProblem at_rest;
        ost_problem_at_pressure(problem, NULL, &field, &at_rest);
        memset(search->steps.u, 0, 3 * (size_t)mesh->node_count * sizeof *search->steps.u);
        OST_TRY(ost_problem_energy(&at_rest, t, search->steps.u, &held));
    }
    for (size_t i = 0; space && problem->field->pressure && i < 4 * (size_t)mesh->owned_tets; i++) {
        const OstLocal tet = (OstLocal)(i / 4);
        const double p = space->of_tet[i] >= 0 ? problem->field->pressure[i] : 0.0;
        if (p != 0.0)
            pressed += 0.25 * fabs(ost_tet_volume(mesh->coordinates, ost_mesh_nodes_of(mesh, tet))) * p * p *
                       ost_field_giving_way(problem->field, mesh->tet_region[tet]);
    }
    OST_TRY(ost_sum(problem->ctx, 1, &pressed));
    *square = 2.0 * held + pressed;
    return OST_SUCCESS;
}

/* `square` is in the case's units. */
static OstStatus compare(Search *search, double t, const double *u, double square, OstAnswerError *found)
{
    const OstProblem *problem = search->estimate->problem;
    double most[2] = {0.0}, energy = 0.0, scale;
    OST_TRY(find_scale(search, t, &scale));
    OST_TRY(ost_search_displacement(search));
    for (size_t n = 0; n < (size_t)problem->mesh->owned_nodes; n++) {
        double better[3];
        for (size_t i = 0; i < 3; i++)
            better[i] = u[3 * n + i] + search->steps.size * search->steps.u[3 * n + i];
        const double of_error = ost_norm3(search->steps.u + 3 * n), of_better = ost_norm3(better);
        most[0] = of_error > most[0] ? of_error : most[0];
        most[1] = of_better > most[1] ? of_better : most[1];
    }
    most[0] *= search->steps.size;
    OST_TRY(ost_max(problem->ctx, 2, most));
    if (isnan(search->energy)) {
        OST_TRY(ost_problem_energy(problem, t, u, &energy));
    } else {
        energy = search->energy;
        OST_TRY(ost_sum(problem->ctx, 1, &energy));
    }
    OST_TRY(find_share_of_loads(search, t, u, energy, &found->by_loads));
    const double whole = whole_square(found->by_loads, energy, square);
    const double least = least_of_scale * least_of_scale * scale;
    found->energy_norm = sqrt(square);
    found->displacement = most[1] > 0.0 ? most[0] / most[1] : 0.0;
    found->relative = square > 0.0 && found->displacement > rounding ? sqrt(square / fmax(whole, least)) : 0.0;
    if (problem->pressures && whole < least) /* nothing moves */
        found->displacement *= sqrt(whole / least);
    found->known = 1;
    return OST_SUCCESS;
}

OstStatus ost_search_share(Search *search, double *square, double *tet_error)
{
    const OstProblem *problem = search->estimate->problem;
    double sum = 0.0;
    OST_TRY(ost_complement_import(&search->estimate->complement, search->steps.e.functions));
    ost_operator_energy(&search->estimate->stiffness, search->steps.u, search->steps.e.functions, tet_error);
    for (OstLocal tet = 0; tet < problem->mesh->owned_tets; tet++)
        sum += tet_error[tet];
    OST_TRY(ost_sum(problem->ctx, 1, &sum));
    search->of_tets = ost_search_true_square(search, sum);
    if (search->stretch > 0.0)
        *square = search->stretch * search->of_tets;
    for (OstLocal tet = 0; tet < problem->mesh->owned_tets; tet++)
        tet_error[tet] *= sum > 0.0 ? *square / sum : 0.0;
    return OST_SUCCESS;
}

/* The surplus at the nodes, lengthened by what was extrapolated of it: its own work on the residual, with what orders
 * that are higher still have. */
static OstStatus hand_out(Search *search, double *surplus)
{
    const OstProblem *problem = search->estimate->problem;
    if (problem->free_body)
        OST_TRY(ost_free_body_centre(problem->mesh, search->steps.u));
    for (size_t i = 0; i < 3 * (size_t)problem->mesh->owned_nodes; i++)
        surplus[i] = search->higher * search->longer * search->steps.size * search->steps.u[i];
    return ost_agree(problem->ctx, ost_halo_import(problem->mesh->halo, 3 * sizeof *surplus, surplus));
}

/* What e adds to displacements and stresses. Means over tets are of the whole body, as displacements are, and
 * lengthened by the higher orders too; stresses at places are not. */
static OstStatus hand_out_all(Search *search, const OstProblem *state, const OstSurplus *surplus)
{
    const OstMesh *mesh = state->mesh;
    OstOperator at_state = search->estimate->stiffness;
    at_state.problem = state;
    if (surplus->stress)
        memset(surplus->stress, 0, 6 * (size_t)mesh->owned_tets * sizeof *surplus->stress);
    if (surplus->along_axes)
        memset(surplus->along_axes, 0, 6 * (size_t)mesh->owned_tets * sizeof *surplus->along_axes);
    if (surplus->node_stress)
        memset(surplus->node_stress, 0,
               6 * (size_t)mesh->nodes_per_tet * (size_t)mesh->tet_count * sizeof *surplus->node_stress);
    const double length = search->longer * search->steps.size;
    if (surplus->stress)
        ost_operator_add_stress(&at_state, search->steps.u, search->steps.e.functions, search->higher * length, NULL,
                                surplus->stress, surplus->along_axes);
    if (surplus->node_stress)
        ost_operator_add_stress(&at_state, search->steps.u, search->steps.e.functions, length, surplus->node_stress,
                                NULL, NULL);
    return surplus->displacement ? hand_out(search, surplus->displacement) : OST_SUCCESS;
}

/* Of a mixed form: of the errors of displacement and pressure, which the e at hand stands for. */
static OstStatus hand_out_mixed(Search *search, double t, const double *u, const OstSurplus *surplus)
{
    const OstProblem *problem = search->estimate->problem;
    const OstState of = {problem, u, ost_problem_eigen_share(problem, t), problem->formulation, 0.0};
    double *of_tets = NULL;
    OstMaterialField field;
    OstProblem state;
    OST_TRY(ost_agree(problem->ctx, OST_NEW(problem->ctx, &of_tets, 4 * (size_t)problem->mesh->tet_count)));
    ost_problem_at_pressure(problem, of_tets, &field, &state);
    OstStatus status = ost_pressure_error(search, &of, of_tets);
    OST_THEN(ost_search_displacement(search));
    OST_THEN(ost_complement_import(&search->estimate->complement, search->steps.e.functions));
    OST_THEN(hand_out_all(search, &state, surplus));
    OST_FREE(of_tets);
    return status;
}

void ost_estimate_add(const OstEstimate *estimate, const double *error, const OstSurplus *surplus)
{
    for (size_t i = 0; i < 3 * (size_t)estimate->problem->mesh->node_count && surplus->displacement; i++)
        surplus->displacement[i] += error[i];
    if ((surplus->stress || surplus->node_stress) && !estimate->problem->pressures)
        ost_operator_add_stress(&estimate->stiffness, error, NULL, 1.0, surplus->node_stress, surplus->stress,
                                surplus->along_axes);
}

/* The steps that find the error; or the sum of errors that other loads had, *is_sum. */
static OstStatus find(Search *search, const double *u, const OstSurplus *surplus, double *square, int *is_sum)
{
    const OstEstimate *estimate = search->estimate;
    OST_TRY(ost_sum_keep_residual(search));
    if (surplus->tet_error)
        OST_TRY(ost_sum_take(search, surplus->displacement != NULL, is_sum));
    if (*is_sum)
        return OST_SUCCESS;
    /* Of the same stiffness. Few steps from there find another error at a place than a run of that load alone: of a
     * stress 24.3 in place of 16.1. So nothing may be watched. */
    const int has_earlier = estimate->earlier && !estimate->stiffness.turned_by && !surplus->displacement;
    OST_TRY(has_earlier ? iterate_from(search, square) : ost_search_iterate(search, 0.0, square));
    *square = ost_search_true_square(search, *square);
    const int goes_along = estimate->is_stacked && !estimate->problem->supports->links;
    return surplus->displacement && !search->steps.failed ? ost_steps_settle(&search->steps, goes_along ? u : NULL)
                                                          : OST_SUCCESS;
}

/* Each tet's share, with orders that are higher still. */
static OstStatus share(Search *search, const double *u, const OstSurplus *surplus, double *square)
{
    OST_TRY(ost_search_share(search, square, surplus->tet_error));
    OST_TRY(ost_sum_keep_error(search, *square, surplus->displacement != NULL));
    const double of_steps = *square;
    OST_TRY(ost_orders_add(search, u, surplus->tet_error, square));
    search->higher = of_steps > 0.0 ? *square / of_steps : 1.0;
    return OST_SUCCESS;
}

OstStatus ost_estimate_find(OstEstimate *estimate, OstSolver *solver, double t, const double *u, OstAnswerError *found,
                            const OstSurplus *surplus)
{
    Search search = {0};
    double square = 0.0;
    int is_sum = 0;
    *found = (OstAnswerError){0};
    if (!estimate->problem->scene)
        return OST_SUCCESS;
    OstStatus status = ost_search_move(estimate, u);
    OST_THEN(ost_search_open(estimate, solver, &search));
    OST_THEN(ost_search_residual(&search, t, u));
    OST_THEN(find(&search, u, surplus, &square, &is_sum));
    if (status == OST_SUCCESS && !search.steps.failed) {
        status = ost_search_displacement(&search);
        if (surplus->tet_error)
            OST_THEN(share(&search, u, surplus, &square));
        OST_THEN(compare(&search, t, u, square, found));
        const int is_mixed = surplus->displacement && estimate->problem->pressures;
        OST_THEN(is_mixed ? hand_out_mixed(&search, t, u, surplus) : hand_out_all(&search, estimate->problem, surplus));
    }
    found->is_indefinite = status == OST_SUCCESS && search.steps.failed;
    ost_steps_close(&search.steps);
    return status;
}
